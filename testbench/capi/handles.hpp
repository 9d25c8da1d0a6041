// SPDX-License-Identifier: Apache-2.0
// Registry of live handles and their kinds: any other pointer is refused, never followed.
#pragma once

#include <cstdint>
#include <string>

#include "testbench/capi/fastsplat.h"

namespace fastsplat::capi {

enum class Kind { Config, Model, Pattern, Checker };

void born(const void* handle, Kind kind);
/// Removes the handle from the registry; throws as require_live does.
void bury(const char* function, const void* handle, Kind kind);
/// Throws UserError (Usage), with the name of `function`, unless the handle is live.
void require_live(const char* function, const void* handle, Kind kind);

/// Throws UserError (Usage): the caller of `function` broke its contract.
[[noreturn]] void misuse(const char* function, const std::string& what, const std::string& expected = {},
                         const std::string& got = {});

template <class Pointer>
Pointer* require(const char* function, const char* argument, Pointer* pointer) {
  if (pointer == nullptr) misuse(function, std::string(argument) + " is NULL");
  return pointer;
}

/// Checks the struct_size of a caller's structure: at least what this version needs.
void require_size(const char* function, std::size_t expected, std::size_t got);

/// Checks that `scope` is FASTSPLAT_WHOLE or FASTSPLAT_SUBSET.
void require_scope(const char* function, std::uint32_t scope);

}  // namespace fastsplat::capi
