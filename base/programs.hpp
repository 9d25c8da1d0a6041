// SPDX-License-Identifier: Apache-2.0
// Finds other programs in PATH.
#pragma once

#include <string>

namespace fastsplat {

/// The path at which a shell would find `program`; empty if it would not.
std::string path_of(const std::string& program);

/// Whether a shell would find `program`.
bool in_path(const std::string& program);

}  // namespace fastsplat
