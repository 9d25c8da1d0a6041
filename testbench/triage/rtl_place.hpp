// SPDX-License-Identifier: Apache-2.0
// Which module of the RTL makes a word, and the instance to look at in a waveform.
#pragma once

#include <string>

#include "testbench/check/scoreboard.hpp"

namespace fastsplat::testbench {

struct RtlPlace {
  std::string module;    ///< "fastsplat_sheet_bank"
  std::string instance;  ///< "u_top.u_core.u_splat.gen_row[1].gen_bank[2].u_bank", below fastsplat_dut
};

/// Where the divergence's word is made. `halo`: pixels around the tile that its sheets hold (modes 8 and 9: 1).
RtlPlace rtl_place(const cmodel::Config& config, const Divergence& divergence, int halo);

}  // namespace fastsplat::testbench
