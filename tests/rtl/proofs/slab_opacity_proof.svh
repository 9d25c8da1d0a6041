// SPDX-License-Identifier: Apache-2.0
// Bounds of a slab's words (docs/numerics.md, N-6-2, N-6-3), put inside slab_opacity by prove_bounds.sh: for every table that the
// stream may load, every sum and every mode.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
localparam int F_OF = FB - 1;  // the factor is One.of
localparam logic [FB-1:0] F_ONE = FB'(1) << F_OF;
localparam logic [TB-1:0] F_TRANS = TB'(1) << fastsplat_pkg::TRANS_FRAC;

// A segment's two ends: of One.of, never rising (docs/stream.md).
logic [FB-1:0] f_start, f_fall, f_start_q, f_end_q;
assign {f_start, f_fall} = segment_k2;
always @* assume (f_start <= F_ONE && f_fall <= f_start && mode_i <= 2'd2);
// What k3 holds and k4 was made of.
logic f_k3_q = 1'b0, f_k4_q = 1'b0;
logic [1:0] f_mode_q;
logic [FB-1:0] f_factor_q;
always @(posedge clk_i) begin
  if (valid_i[2]) begin
    f_start_q <= f_start;
    f_end_q <= f_start - f_fall;
    f_k3_q <= 1'b1;
  end
  if (valid_i[3]) begin
    f_k4_q <= f_k3_q;
    f_factor_q <= factor_k3_q;
    f_mode_q <= mode_i;
  end
end
always @(posedge clk_i) begin
  assert (f_started || !(f_k3_q || f_k4_q));
  // Between the segment's ends, and so 1 at most.
  if (f_started && f_k3_q) assert (factor_k3_q <= f_start_q && factor_k3_q >= f_end_q && factor_k3_q <= F_ONE);
  if (f_started && f_k4_q) assert (f_factor_q <= F_ONE);
  if (f_started && f_k3_q) cover (factor_k3_q < f_start_q && factor_k3_q > f_end_q);
end
for (genvar c = 0; c < 4; c++) begin : gen_f_channel
  logic [SB-1:0] f_sum_q;
  logic [SB+FB-1:0] f_exact_q;
  logic [DB-1:0] f_word;
  localparam int F_DROP = (c == 3) ? fastsplat_pkg::SHIFT_SLAB_OPACITY : fastsplat_pkg::SHIFT_SLAB_COLOUR;
  assign f_word = slab_o[c*DB+:DB];
  always @(posedge clk_i) begin
    if (valid_i[3]) begin
      f_sum_q <= gen_channel[c].sum_k3_q;
      f_exact_q <= (SB + FB)'(gen_channel[c].sum_k3_q) * (SB + FB)'(factor_k3_q);
    end
    if (f_started && f_k4_q) begin
      // One.tf; in the sum mode the sum itself. Cut only where the exact value is above.
      if (f_mode_q == 2'd2) assert (f_word == DB'(f_sum_q) && !saturated_o[c]);
      else assert (f_word <= DB'(F_TRANS));
      if (saturated_o[c]) assert (f_mode_q != 2'd2 && f_word == DB'(F_TRANS));
      if (f_mode_q == 2'd0) begin
        // Half a unit of the word away from S f, at most.
        if (!saturated_o[c])
          assert ({1'b0, f_exact_q} + ((SB + FB + 1)'(1) << (F_DROP - 1)) >= (SB + FB + 1)'(f_word) << F_DROP &&
                  {1'b0, f_exact_q} <= ((SB + FB + 1)'(f_word) << F_DROP) + ((SB + FB + 1)'(1) << (F_DROP - 1)));
        else assert ({1'b0, f_exact_q} > (SB + FB + 1)'(F_TRANS) << F_DROP);
        cover (saturated_o[c]);
        cover (f_word == DB'(F_TRANS) && !saturated_o[c]);
      end
    end
  end
end
