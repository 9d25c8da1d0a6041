// SPDX-License-Identifier: Apache-2.0
// Contents of a configuration's handle.
#pragma once

#include "cmodel/numbers/config.hpp"
#include "testbench/capi/fastsplat.h"

struct fastsplat_config {
  fastsplat::cmodel::Config config;
};

namespace fastsplat::capi {

/// Throws UserError (Usage) unless the handle is live.
const cmodel::Config& config_of(const char* function, const fastsplat_config* handle);

}  // namespace fastsplat::capi
