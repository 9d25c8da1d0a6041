// SPDX-License-Identifier: Apache-2.0
// Unit "RLUT": squared distances along one axis, P consecutive columns a read (docs/numerics.md, section 4;
// cmodel/splat/rlut.hpp). Lane l holds the columns with column mod P = l. Instantiated once for x and once for y.
// One register: words_o belong to the address of the cycle before.
module fastsplat_rlut (
    input  logic                                    clk_i,
    // load: one word a cycle
    input  logic                                    we_i,
    input  logic [fastsplat_pkg::PHASE_BITS-1:0]    wphase_i,
    input  logic [fastsplat_pkg::COL_BITS-1:0]      wcolumn_i,
    input  logic [fastsplat_pkg::RLUT_BITS-1:0]     wdata_i,
    // read
    input  logic                                    re_i,
    input  logic [fastsplat_pkg::PHASE_BITS-1:0]    phase_i,
    input  logic [fastsplat_pkg::COL_BITS-1:0]      column_i,  // first column, a multiple of P
    output logic [fastsplat_pkg::LANES*fastsplat_pkg::RLUT_BITS-1:0] words_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int GROUPS = fastsplat_pkg::RLUT_COLUMNS / P;
  localparam int GROUP_LOG2 = (GROUPS > 1) ? $clog2(GROUPS) : 1;
  localparam int WORDS = fastsplat_pkg::PHASES << GROUP_LOG2;
  localparam int ADDR = fastsplat_pkg::PHASE_BITS + GROUP_LOG2;
  localparam int W = fastsplat_pkg::RLUT_BITS;

  logic [ADDR-1:0] raddr, waddr;
  assign raddr = {phase_i, GROUP_LOG2'(column_i >> fastsplat_pkg::LANE_LOG2)};
  assign waddr = {wphase_i, GROUP_LOG2'(wcolumn_i >> fastsplat_pkg::LANE_LOG2)};

  for (genvar l = 0; l < P; l++) begin : gen_lane
    logic lane_we;
    assign lane_we = we_i && (wcolumn_i & fastsplat_pkg::COL_BITS'(P - 1)) == fastsplat_pkg::COL_BITS'(l);
    fastsplat_ram_1r1w #(.BITS(W), .WORDS(WORDS), .ADDR(ADDR)) u_ram (
        .clk_i,
        .re_i,
        .raddr_i(raddr),
        .rdata_o(words_o[l*W+:W]),
        .we_i(lane_we),
        .waddr_i(waddr),
        .wdata_i
    );
  end
endmodule
