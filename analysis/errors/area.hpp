// SPDX-License-Identifier: Apache-2.0
// Area of any configuration that the RTL supports: a model fitted to syntheses (docs/errors.md, section 5).
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"

namespace fastsplat::analysis {

/// Cells of a 7-series FPGA after synthesis by Yosys: figures of the kind that synthesised() has for few
/// configurations.
struct Area {
  double lut = 0.0;         ///< look-up tables of logic
  double ff = 0.0;          ///< flip-flops
  double bram = 0.0;        ///< RAMB18E1 and RAMB36E1, each counted as one
  double dsp = 0.0;         ///< DSP48E1
  double half_bram = 0.0;   ///< the block RAMs in halves: a RAMB36E1 is two
  double memory_lut = 0.0;  ///< look-up tables that hold the small tables
  /// The area as one number, by the shares of a Kintex-7 XC7K325T: LUTs of the same share as all resources together.
  double equivalent_luts() const;
};

/// Throws UserError (Input) if the RTL cannot be built from the configuration.
Area area(const cmodel::Config& config);

/// null if the RTL cannot be built from the configuration.
nlohmann::ordered_json area_json(const cmodel::Config& config);

/// A synthesis that the model is fitted to, or is compared with if `held_out`.
struct AreaSample {
  std::string name, hash;
  cmodel::Config config;
  bool held_out = false;
  Area cells;  ///< lut, ff, bram, dsp
};
std::vector<AreaSample> area_samples();
/// The area of the sample's configuration by a fit that leaves it out.
Area area_without(const AreaSample& sample);

}  // namespace fastsplat::analysis
