// SPDX-License-Identifier: Apache-2.0
#include "testbench/capi/handles.hpp"

#include <mutex>
#include <shared_mutex>
#include <unordered_map>

#include "base/error.hpp"

namespace fastsplat::capi {
namespace {

struct Register {
  std::shared_mutex mutex;
  std::unordered_map<const void*, Kind> kinds;
};

/// Never destroyed: a bench may destroy its handles while the process ends.
Register& alive() {
  static auto* handles = new Register;
  return *handles;
}

const char* name_of(Kind kind) {
  constexpr const char* kNames[] = {"configuration", "model", "pattern", "checker"};
  return kNames[static_cast<std::size_t>(kind)];
}

}  // namespace

void born(const void* handle, Kind kind) {
  const std::unique_lock lock(alive().mutex);
  alive().kinds[handle] = kind;
}

void bury(const char* function, const void* handle, Kind kind) {
  require_live(function, handle, kind);
  const std::unique_lock lock(alive().mutex);
  alive().kinds.erase(handle);
}

void require_live(const char* function, const void* handle, Kind kind) {
  if (handle == nullptr) misuse(function, std::string("the ") + name_of(kind) + " is NULL");
  const std::shared_lock lock(alive().mutex);
  const auto found = alive().kinds.find(handle);
  if (found == alive().kinds.end())
    misuse(function, "invalid handle", std::string("a live ") + name_of(kind), "a destroyed handle, or not a handle");
  if (found->second != kind) misuse(function, "wrong kind of handle", name_of(kind), name_of(found->second));
}

void misuse(const char* function, const std::string& what, const std::string& expected, const std::string& got) {
  throw_usage({.where = function, .what = what, .expected = expected, .got = got, .fix = {}});
}

void require_size(const char* function, std::size_t expected, std::size_t got) {
  if (got >= expected) return;
  misuse(function, "struct_size is too small", "at least " + std::to_string(expected) + ", sizeof the structure",
         std::to_string(got));
}

void require_scope(const char* function, std::uint32_t scope) {
  if (scope > FASTSPLAT_SUBSET) misuse(function, "unknown scope", "0 or 1", std::to_string(scope));
}

}  // namespace fastsplat::capi
