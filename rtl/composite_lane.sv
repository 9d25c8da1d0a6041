// One lane of the compositor: a slab over a pixel, front to back, with freezing; or X-ray sums
// (docs/numerics.md, section 6; cmodel/compositor.hpp). Registers: k5 (products), k6 (new state).
`include "fault.svh"

module composite_lane (
    input  logic                                   clk_i,
    input  logic [1:0]                             mode_i,    // held over a tile
    // k4
    input  logic [4*fastsplat_pkg::STATE_BITS-1:0] slab_i,
    input  logic [4*fastsplat_pkg::STATE_BITS-1:0] state_i,   // C_R, C_G, C_B, T, or the four sums
    // k6
    output logic [4*fastsplat_pkg::STATE_BITS-1:0] state_o,
    output logic                                   frozen_o,
    output logic [3:0]                             saturated_o
);
  localparam int DB = fastsplat_pkg::STATE_BITS;
  localparam int TB = fastsplat_pkg::TRANS_BITS;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int TF = fastsplat_pkg::TRANS_FRAC;

  logic sum_mode;
  assign sum_mode = mode_i == 2'd2;

  // k4: T * slab, four times
  logic [TB-1:0] transmittance;
  logic frozen, frozen_k5_q;
  logic [4*DB-1:0] state_k5_q, light_k5_q;
  assign transmittance = state_i[3*DB+:TB];
  assign frozen = !sum_mode && transmittance < TB'(fastsplat_pkg::FREEZE_BELOW) && !`FASTSPLAT_FAULT(UNFROZEN);
  for (genvar c = 0; c < 4; c++) begin : gen_light
    logic [2*TB-1:0] product;
    logic [TB-1:0] light;
    logic overflow;
    assign product = (2 * TB)'(transmittance) * (2 * TB)'(slab_i[c*DB+:TB]);
    narrow #(.IN_BITS(2 * TB), .SHIFT(TF), .OUT_BITS(TB), .ROUND(1), .UNIT(1)) u_narrow (
        .value_i(product),
        .word_o(light),
        .overflow_o(overflow)
    );
    always_ff @(posedge clk_i) light_k5_q[c*DB+:DB] <= sum_mode ? slab_i[c*DB+:DB] : DB'(light);
    logic unused;
    assign unused = &{1'b0, overflow};
  end

  // k5: C + light, T - absorbed, X + S
  logic [4*DB-1:0] next;
  logic [3:0] overflow_k5;
  for (genvar c = 0; c < 4; c++) begin : gen_next
    logic [TB:0] colour_exact;
    logic [TB-1:0] colour;
    logic [SB:0] sum_exact;
    logic [SB-1:0] sum;
    logic colour_overflow, sum_overflow;
    assign colour_exact = {1'b0, state_k5_q[c*DB+:TB]} + {1'b0, light_k5_q[c*DB+:TB]};
    assign sum_exact = {1'b0, state_k5_q[c*DB+:SB]} + {1'b0, light_k5_q[c*DB+:SB]};
    narrow #(.IN_BITS(TB + 1), .SHIFT(0), .OUT_BITS(TB), .ROUND(0)) u_colour (
        .value_i(colour_exact),
        .word_o(colour),
        .overflow_o(colour_overflow)
    );
    narrow #(.IN_BITS(SB + 1), .SHIFT(0), .OUT_BITS(SB), .ROUND(0)) u_sum (
        .value_i(sum_exact),
        .word_o(sum),
        .overflow_o(sum_overflow)
    );
    always_comb begin
      next[c*DB+:DB] = state_k5_q[c*DB+:DB];
      overflow_k5[c] = 1'b0;
      if (sum_mode) begin
        next[c*DB+:DB] = DB'(sum);
        overflow_k5[c] = sum_overflow;
      end else if (!frozen_k5_q) begin
        if (c == 3) begin
          next[c*DB+:DB] = state_k5_q[c*DB+:DB] - light_k5_q[c*DB+:DB];
        end else begin
          next[c*DB+:DB] = DB'(colour);
          overflow_k5[c] = colour_overflow;
        end
      end
    end
  end

  always_ff @(posedge clk_i) begin
    state_k5_q <= state_i;
    frozen_k5_q <= frozen;
    state_o <= next;
    frozen_o <= frozen_k5_q;
    saturated_o <= overflow_k5;
  end
endmodule
