// SPDX-License-Identifier: Apache-2.0
// The kinds of TOML files that the program reads.
#pragma once

namespace fastsplat {

enum class TomlKind { Configuration, Scene, TransferFunction, Plan, VerificationPlan, Exclusions };

}  // namespace fastsplat
