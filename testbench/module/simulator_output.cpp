// SPDX-License-Identifier: Apache-2.0
#include "testbench/module/simulator_output.hpp"

#include <cstdarg>
#include <cstdio>
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
  // The runtime is about to end the process: this is the last chance to print the reason.
  if (text.starts_with("Aborting")) std::fputs(printed.c_str(), stderr);
  return length;
}

std::string take_simulator_output() { return std::exchange(printed, {}); }

}  // namespace fastsplat::testbench
