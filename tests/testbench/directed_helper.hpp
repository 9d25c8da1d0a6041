// SPDX-License-Identifier: Apache-2.0
// Shared by the tests of the directed checks: their RTL, and the conditions on each result.
#pragma once

#include "testbench/stimulus/directed.hpp"

namespace fastsplat::testbench {

MakeDevice rtl_of(const cmodel::Config& config);

/// Nothing failed, something was compared, and every bin was hit.
void expect_all(const DirectedResult& result);

/// Number of streams that were refused as by the model; printed by rule.
int refused_streams(const DirectedResult& result);

}  // namespace fastsplat::testbench
