// SPDX-License-Identifier: Apache-2.0
// One lane of the compositor: composites a slab over a pixel, front to back, with early termination; or adds X-ray sums
// (docs/numerics.md, N-6-6 to N-6-9; cmodel/composite/composite_lane.hpp).
// Registers: k5 (products), k6 (new state). A stage without a block holds.
`include "assertions.svh"
`include "fault.svh"
`include "narrow.svh"
module fastsplat_composite_lane (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,    // for the assertions
    input  logic [5:4]                             valid_i,   // stages that hold a block: k4, k5
    input  logic [1:0]                             mode_i,    // held over a tile
    // k4
    input  logic [4*fastsplat_pkg::STATE_BITS-1:0] slab_i,
    input  logic [4*fastsplat_pkg::STATE_BITS-1:0] state_i,   // C_R, C_G, C_B, T, or the four sums
    // k5: what state_o is in the next cycle, if k5 holds a block
    output logic [4*fastsplat_pkg::STATE_BITS-1:0] next_o,
    // k6
    output logic [4*fastsplat_pkg::STATE_BITS-1:0] state_o,
    output logic                                   frozen_o,
    output logic [3:0]                             saturated_o
);
  localparam int DB = fastsplat_pkg::STATE_BITS;
  localparam int TB = fastsplat_pkg::TRANS_BITS + fastsplat_pkg::COLOUR_INT;  // of colours; T has zeros above
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  `FASTSPLAT_NARROW(narrow_light, 2 * TB, TB, LIGHT)
  `FASTSPLAT_NARROW(narrow_absorbed, 2 * TB, TB, ABSORBED)
  `FASTSPLAT_NARROW(narrow_colour, TB + 1, TB, OVER)
  `FASTSPLAT_NARROW(narrow_sum, SB + 1, SB, SUM_OVER)

  // {overflow, word} with the word as wide as the state
  function automatic logic [DB:0] colour_to_state(input logic [TB:0] narrowed);
    colour_to_state = {narrowed[TB], DB'(narrowed[TB-1:0])};
  endfunction
  function automatic logic [DB:0] sum_to_state(input logic [SB:0] narrowed);
    sum_to_state = {narrowed[SB], DB'(narrowed[SB-1:0])};
  endfunction

  logic sum_mode, frozen_k5_q;
  logic [TB-1:0] transmittance;
  assign sum_mode = mode_i == 2'd2;
  assign transmittance = state_i[3*DB+:TB];
  always_ff @(posedge clk_i) begin
    // freeze_below 0: no pixel is ever terminated
    // verilator lint_off UNSIGNED
    if (valid_i[4]) frozen_k5_q <= !sum_mode && transmittance < TB'(fastsplat_pkg::FREEZE_BELOW) && !`FASTSPLAT_FAULT(UNFROZEN);
    // verilator lint_on UNSIGNED
    if (valid_i[5]) frozen_o <= frozen_k5_q;
  end

  // k5: X + S; C + light, T - absorbed
  function automatic logic [DB:0] stepped(input logic sums, input logic frozen, input logic is_transmittance,
                                          input logic [DB-1:0] state, input logic [DB-1:0] light);
    if (sums) stepped = sum_to_state(narrow_sum({1'b0, state[SB-1:0]} + {1'b0, light[SB-1:0]}));
    else if (frozen) stepped = {1'b0, state};
    else if (is_transmittance) stepped = {1'b0, state - light};
    else stepped = colour_to_state(narrow_colour({1'b0, state[TB-1:0]} + {1'b0, light[TB-1:0]}));
  endfunction

  for (genvar c = 0; c < 4; c++) begin : gen_channel
    logic [DB-1:0] state_k5_q, light_k5_q;
    always_ff @(posedge clk_i) begin
      // k4: T * slab
      if (valid_i[4]) begin
        state_k5_q <= state_i[c*DB+:DB];
        light_k5_q <= sum_mode ? slab_i[c*DB+:DB] :
                      DB'(TB'((c == 3) ? narrow_absorbed((2 * TB)'(transmittance) * (2 * TB)'(slab_i[c*DB+:TB])) :
                                         narrow_light((2 * TB)'(transmittance) * (2 * TB)'(slab_i[c*DB+:TB]))));
      end
      if (valid_i[5]) {saturated_o[c], state_o[c*DB+:DB]} <= stepped(sum_mode, frozen_k5_q, c == 3, state_k5_q, light_k5_q);
    end
    // Unused where only sheets are composited.
    if (fastsplat_pkg::EVERY_SAMPLE != 0) begin : gen_next
      logic overflow;
      assign {overflow, next_o[c*DB+:DB]} = stepped(1'b0, frozen_k5_q, c == 3, state_k5_q, light_k5_q);
      logic unused;
      assign unused = &{1'b0, overflow};
    end else begin : gen_no_next
      assign next_o[c*DB+:DB] = '0;
    end
  end
  // Absorbed light is subtracted from the transmittance, which never rises and never wraps.
  `FASTSPLAT_ASSERT(transmittance_falls,
                    !valid_i[5] || sum_mode || frozen_k5_q || gen_channel[3].light_k5_q <= gen_channel[3].state_k5_q)
endmodule
