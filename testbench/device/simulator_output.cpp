#include "testbench/device/simulator_output.hpp"

#include <cstdarg>
#include <cstdio>
#include <cstring>
#include <utility>

namespace fastsplat::testbench {
namespace {

thread_local std::string printed;

}  // namespace

int simulator_print(const char* format, ...) {
  std::va_list arguments, again;
  va_start(arguments, format);
  va_copy(again, arguments);
  const int length = std::vsnprintf(nullptr, 0, format, arguments);
  std::string text(length > 0 ? static_cast<std::size_t>(length) : 0, '\0');
  std::vsnprintf(text.data(), text.size() + 1, format, again);
  va_end(again);
  va_end(arguments);
  printed += text;
  // The runtime is about to end the process: nobody else will tell why.
  if (text.starts_with("Aborting")) std::fputs(printed.c_str(), stderr);
  return length;
}

std::string take_simulator_output() { return std::exchange(printed, {}); }

FailedAssertion first_failed_assertion(const std::string& output) {
  constexpr const char* kError = "%Error: ";
  constexpr const char* kFailed = ": Assertion failed in ";
  const auto failed = output.find(kFailed);
  if (failed == std::string::npos) return {};
  const auto error = output.rfind(kError, failed), place = error + std::strlen(kError);
  const auto path = failed + std::strlen(kFailed), end = output.find_first_of(":\n", path);
  FailedAssertion out;
  if (error != std::string::npos) out.place = output.substr(place, failed - place);
  out.path = output.substr(path, end - path);
  const auto dot = out.path.rfind('.');
  out.name = out.path.substr(dot + 1);
  if (dot != std::string::npos) out.path.resize(dot);
  if (out.path.starts_with("TOP.")) out.path.erase(0, 4);
  return out;
}

}  // namespace fastsplat::testbench
