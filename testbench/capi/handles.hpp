// Which handles are alive, and of what kind: a pointer that is none of them is refused, never followed.
#pragma once

#include <cstdint>
#include <string>

#include "testbench/capi/fastsplat.h"

namespace fastsplat::capi {

enum class Kind { Config, Model, Pattern, Checker };

void born(const void* handle, Kind kind);
/// Throws as require_live does; the handle lives no more.
void bury(const char* function, const void* handle, Kind kind);
/// Throws UserError (Usage) in the name of `function` unless the handle lives.
void require_live(const char* function, const void* handle, Kind kind);

/// Throws UserError (Usage): the caller of `function` did what its contract excludes.
[[noreturn]] void misuse(const char* function, const std::string& what, const std::string& expected = {},
                         const std::string& got = {});

template <class Pointer>
Pointer* require(const char* function, const char* argument, Pointer* pointer) {
  if (pointer == nullptr) misuse(function, std::string(argument) + " is NULL");
  return pointer;
}

/// Of a structure that the caller fills or has filled: what this version needs of it.
void require_size(const char* function, std::size_t expected, std::size_t got);

/// 0 or 1: FASTSPLAT_WHOLE or FASTSPLAT_SUBSET.
void require_scope(const char* function, std::uint32_t scope);

}  // namespace fastsplat::capi
