// SPDX-License-Identifier: Apache-2.0
// Initial contents of every register and memory of a simulated device, before reset.
#pragma once

#include <string>

namespace fastsplat::testbench {

enum class ResetFill { Zero, One, Random };

ResetFill reset_fill_from(const std::string& name);  ///< throws UserError (Usage)
const char* to_string(ResetFill fill);

}  // namespace fastsplat::testbench
