// SPDX-License-Identifier: Apache-2.0
// Slab opacity of one lane: turns a pixel's sheet sums into the slab's colour and opacity (docs/numerics.md, N-6-2 and
// N-6-3; cmodel/composite/slab_opacity.hpp).
// Registers: k2 (table), k3 (factor), k4 (slab). Input k1, output three cycles later. In mode 2 (sum) the sums pass
// through unchanged. A stage without a block holds.
`include "narrow.svh"

module fastsplat_slab_opacity (
    input  logic                                    clk_i,
    // factor table load: segment start and fall to the next
    input  logic                                    we_i,
    input  logic [fastsplat_pkg::SEG_LOG2-1:0]      waddr_i,
    input  logic [2*fastsplat_pkg::FACTOR_BITS-1:0] wdata_i,  // {start, fall}
    // stages that hold a block: k1, k2, k3
    input  logic [3:1]                              valid_i,
    // k1
    input  logic [1:0]                              mode_i,   // held over a tile
    input  logic [4*fastsplat_pkg::SHEET_BITS-1:0]  sums_i,   // R, G, B, tau
    // k4
    output logic [4*fastsplat_pkg::STATE_BITS-1:0]  slab_o,   // colours and opacity (N-6-3), or U si.sf in mode 2
    output logic [3:0]                              saturated_o
);
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int FB = fastsplat_pkg::FACTOR_BITS;
  localparam int REM = fastsplat_pkg::REM_BITS;
  localparam int TB = fastsplat_pkg::TRANS_BITS;
  localparam int LB = (fastsplat_pkg::COLOUR_INT == 0) ? TB : TB - 1 + fastsplat_pkg::COLOUR_INT;  // of colours
  localparam int DB = fastsplat_pkg::STATE_BITS;

  `FASTSPLAT_NARROW(narrow_fall, FB + REM, FB, FALL)
  `FASTSPLAT_NARROW(narrow_colour, SB + FB, LB, SLAB_COLOUR)
  `FASTSPLAT_NARROW(narrow_opacity, SB + FB, TB, SLAB_OPACITY)
  `FASTSPLAT_NARROW(narrow_added_colour, SB, LB, ADDED_COLOUR)
  `FASTSPLAT_NARROW(narrow_added_opacity, SB, TB, ADDED_OPACITY)

  // {overflow, word} with the word as wide as the state
  function automatic logic [DB:0] to_state(input logic [LB:0] narrowed);
    to_state = {narrowed[LB], DB'(narrowed[LB-1:0])};
  endfunction
  // An opacity as wide as a colour.
  function automatic logic [LB:0] widened(input logic [TB:0] narrowed);
    widened = {narrowed[TB], LB'(narrowed[TB-1:0])};
  endfunction

  logic [2*FB-1:0] segment_k2;
  fastsplat_ram_1r1w #(.BITS(2 * FB), .WORDS(fastsplat_pkg::SEGMENTS), .ADDR(fastsplat_pkg::SEG_LOG2)) u_factor (
      .clk_i,
      .re_i(valid_i[1]),
      .raddr_i(sums_i[3*SB+REM+:fastsplat_pkg::SEG_LOG2]),
      .rdata_o(segment_k2),
      .we_i,
      .waddr_i,
      .wdata_i
  );

  // k2: interpolate
  logic [REM-1:0] remainder_k2_q;
  logic [FB-1:0] factor_k3_q;
  always_ff @(posedge clk_i) begin
    if (valid_i[1]) remainder_k2_q <= sums_i[3*SB+:REM];
    if (valid_i[2]) begin
      factor_k3_q <= segment_k2[2*FB-1:FB] - FB'(narrow_fall((FB + REM)'(segment_k2[FB-1:0]) * (FB + REM)'(remainder_k2_q)));
    end
  end

  // k3: scale, or only round in additive mode
  for (genvar c = 0; c < 4; c++) begin : gen_channel
    logic [SB-1:0] sum_k2_q, sum_k3_q;
    always_ff @(posedge clk_i) begin
      if (valid_i[1]) sum_k2_q <= sums_i[c*SB+:SB];
      if (valid_i[2]) sum_k3_q <= sum_k2_q;
      if (valid_i[3]) begin
        case (mode_i)
          2'd0: {saturated_o[c], slab_o[c*DB+:DB]} <= to_state((c == 3) ?
              widened(narrow_opacity((SB + FB)'(sum_k3_q) * (SB + FB)'(factor_k3_q))) :
              narrow_colour((SB + FB)'(sum_k3_q) * (SB + FB)'(factor_k3_q)));
          2'd1: {saturated_o[c], slab_o[c*DB+:DB]} <= to_state((c == 3) ? widened(narrow_added_opacity(sum_k3_q)) : narrow_added_colour(sum_k3_q));
          default: {saturated_o[c], slab_o[c*DB+:DB]} <= {1'b0, DB'(sum_k3_q)};
        endcase
      end
    end
  end
endmodule
