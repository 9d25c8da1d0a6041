// SPDX-License-Identifier: Apache-2.0
// Refuses packages whose parameters contradict each other, or describe a device that the RTL does not support:
// elaboration stops with the values (rtl/assertions.svh). Packages of fastsplat_emit_package pass.
`include "assertions.svh"

module fastsplat_parameters ();
  `FASTSPLAT_INIT(lanes, fastsplat_pkg::LANES == 1 << fastsplat_pkg::LANE_LOG2, "LANES is %0d, but 2^LANE_LOG2 is %0d",
                  fastsplat_pkg::LANES, 1 << fastsplat_pkg::LANE_LOG2)
  `FASTSPLAT_INIT(banks, fastsplat_pkg::BANKS == fastsplat_pkg::LANES * fastsplat_pkg::LANES,
                  "BANKS is %0d, but LANES squared is %0d", fastsplat_pkg::BANKS,
                  fastsplat_pkg::LANES * fastsplat_pkg::LANES)
  `FASTSPLAT_INIT(slices, fastsplat_pkg::SLICES * fastsplat_pkg::COMPOSITE_LANES == fastsplat_pkg::BANKS,
                  "SLICES is %0d, but %0d of COMPOSITE_LANES pixels make a block",
                  fastsplat_pkg::SLICES, fastsplat_pkg::BANKS / fastsplat_pkg::COMPOSITE_LANES)
  `FASTSPLAT_INIT(every_sample, fastsplat_pkg::EVERY_SAMPLE == 0 || fastsplat_pkg::SLICES == 1,
                  "EVERY_SAMPLE is %0d, but a block has %0d slices", fastsplat_pkg::EVERY_SAMPLE, fastsplat_pkg::SLICES)
  `FASTSPLAT_INIT(culling, fastsplat_pkg::CULL_MAP == 0 || fastsplat_pkg::DENSITIES == 0,
                  "CULL_MAP is %0d, but DENSITIES is %0d, not 0", fastsplat_pkg::CULL_MAP,
                  fastsplat_pkg::DENSITIES)
  `FASTSPLAT_INIT(samples, fastsplat_pkg::EVERY_SAMPLE == 0 || fastsplat_pkg::DENSITIES == 0,
                  "EVERY_SAMPLE is %0d, but DENSITIES is %0d, not 0", fastsplat_pkg::EVERY_SAMPLE, fastsplat_pkg::DENSITIES)
  `FASTSPLAT_INIT(blocks, fastsplat_pkg::BLOCKS == fastsplat_pkg::BLOCKS_X * fastsplat_pkg::BLOCKS_Y,
                  "BLOCKS is %0d, but BLOCKS_X * BLOCKS_Y is %0d", fastsplat_pkg::BLOCKS,
                  fastsplat_pkg::BLOCKS_X * fastsplat_pkg::BLOCKS_Y)
  `FASTSPLAT_INIT(blocks_x, fastsplat_pkg::BLOCKS_X == 1 << $clog2(fastsplat_pkg::BLOCKS_X),
                  "BLOCKS_X is %0d, but must be a power of two: %0d is the next", fastsplat_pkg::BLOCKS_X,
                  1 << $clog2(fastsplat_pkg::BLOCKS_X))
  `FASTSPLAT_INIT(address, fastsplat_pkg::BLOCKS <= 1 << fastsplat_pkg::ADDR_BITS, "BLOCKS is %0d, but addresses end at %0d",
                  fastsplat_pkg::BLOCKS, 1 << fastsplat_pkg::ADDR_BITS)
  `FASTSPLAT_INIT(phases, fastsplat_pkg::POS_FRAC >= fastsplat_pkg::PHASE_LOG2,
                  "POS_FRAC is %0d, but phases need %0d fraction bits", fastsplat_pkg::POS_FRAC, fastsplat_pkg::PHASE_LOG2)
  `FASTSPLAT_INIT(columns, fastsplat_pkg::RLUT_COLUMNS % fastsplat_pkg::LANES == 0,
                  "RLUT_COLUMNS is %0d, but must be a multiple of %0d", fastsplat_pkg::RLUT_COLUMNS, fastsplat_pkg::LANES)
  `FASTSPLAT_INIT(radial, fastsplat_pkg::RADIAL_ENTRIES == 1 << fastsplat_pkg::RADIAL_LOG2,
                  "RADIAL_ENTRIES is %0d, but 2^RADIAL_LOG2 is %0d", fastsplat_pkg::RADIAL_ENTRIES,
                  1 << fastsplat_pkg::RADIAL_LOG2)
  `FASTSPLAT_INIT(state, fastsplat_pkg::STATE_BITS >= fastsplat_pkg::TRANS_BITS &&
                  fastsplat_pkg::STATE_BITS >= fastsplat_pkg::SHEET_BITS,
                  "STATE_BITS is %0d, but holds words of %0d bits", fastsplat_pkg::STATE_BITS,
                  (fastsplat_pkg::TRANS_BITS > fastsplat_pkg::SHEET_BITS) ?
                  fastsplat_pkg::TRANS_BITS : fastsplat_pkg::SHEET_BITS)
  `FASTSPLAT_INIT(transmittance, fastsplat_pkg::TRANS_BITS == fastsplat_pkg::TRANS_FRAC + 1,
                  "TRANS_BITS is %0d, but 1.0 needs %0d", fastsplat_pkg::TRANS_BITS, fastsplat_pkg::TRANS_FRAC + 1)
endmodule
