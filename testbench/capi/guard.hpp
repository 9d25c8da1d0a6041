// SPDX-License-Identifier: Apache-2.0
// Exception barrier of the C interface: an exception becomes a status and the thread's last error.
#pragma once

#include <exception>
#include <new>

#include "base/error.hpp"
#include "testbench/capi/fastsplat.h"

namespace fastsplat::capi {

/// Keeps the text, cut at some length, for fastsplat_last_error(). Allocates nothing.
fastsplat_status fail(fastsplat_status status, const char* text) noexcept;

constexpr fastsplat_status status_of(ExitCode code) {
  if (code == ExitCode::Usage) return FASTSPLAT_USAGE;
  return code == ExitCode::Input ? FASTSPLAT_INPUT : FASTSPLAT_INTERNAL;
}

/// Calls `action` with the function's name. Returns its status, or that of the exception it throws.
template <class Action>
fastsplat_status guarded(const char* function, Action action) noexcept {
  try {
    return action(function);
  } catch (const UserError& error) {
    return fail(status_of(error.code()), error.what());
  } catch (const std::bad_alloc&) {
    return fail(FASTSPLAT_NO_MEMORY, "out of memory");
  } catch (const std::exception& error) {
    return fail(FASTSPLAT_INTERNAL, error.what());
  } catch (...) {
    return fail(FASTSPLAT_INTERNAL, "unknown exception");
  }
}

}  // namespace fastsplat::capi
