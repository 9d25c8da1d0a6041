// SPDX-License-Identifier: Apache-2.0
// Progress callback of a long call.
#pragma once

#include <cstddef>
#include <functional>

namespace fastsplat {

/// Called with (done, total) in units of the callee's choice; may be called from any thread, concurrently.
/// An empty function: progress is not reported.
using Progress = std::function<void(std::size_t done, std::size_t total)>;

}  // namespace fastsplat
