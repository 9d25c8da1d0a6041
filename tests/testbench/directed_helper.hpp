// SPDX-License-Identifier: Apache-2.0
// What the tests of the directed checks share: the RTL as the checks want it, and what has to be so of each result.
#pragma once

#include "testbench/stimulus/directed.hpp"

namespace fastsplat::testbench {

MakeDevice rtl_of(const cmodel::Config& config);

/// Nothing failed, something was compared, and every bin was hit.
void expect_all(const DirectedResult& result);

/// How many streams were refused as the model refuses them; printed by rule.
int refused_streams(const DirectedResult& result);

}  // namespace fastsplat::testbench
