// SPDX-License-Identifier: Apache-2.0
// Bounds of a pixel's state (docs/numerics.md, N-6-6, N-6-7), put inside composite_lane by prove_bounds.sh: for every state that can
// be, every slab (One.tf, as proved of slab_opacity) and every mode.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
localparam logic [TB-1:0] F_ONE = TB'(1) << fastsplat_pkg::TRANS_FRAC;
// A block moves on every cycle: the block in k5 was in k4. A tile's mode holds.
logic f_k4_q = 1'b0;
always @(posedge clk_i) f_k4_q <= valid_i[4];
always @* assume (valid_i[5] == f_k4_q);
(* anyconst *) logic [1:0] f_mode;
always @* begin
  assume (f_mode <= 2'd2 && mode_i == f_mode);
  if (f_mode != 2'd2) begin
    assume (state_i[3*DB+:DB] <= DB'(F_ONE));
    for (int c = 0; c < 4; c++) begin
      assume (slab_i[c*DB+:DB] <= DB'(F_ONE));
      assume ((state_i[c*DB+:DB] >> TB) == '0);
    end
  end else for (int c = 0; c < 4; c++) assume ((state_i[c*DB+:DB] >> SB) == '0 && (slab_i[c*DB+:DB] >> SB) == '0);
end
// State and slab in k5 and k6.
logic f_k5_q = 1'b0, f_k6_q = 1'b0;
logic [4*DB-1:0] f_before_k5_q, f_before_q, f_slab_k5_q, f_slab_q;
logic [TB-1:0] f_trans, f_trans_after;
assign f_trans = f_before_q[3*DB+:TB];
assign f_trans_after = state_o[3*DB+:TB];
always @(posedge clk_i) begin
  if (valid_i[4]) begin
    f_before_k5_q <= state_i;
    f_slab_k5_q <= slab_i;
    f_k5_q <= 1'b1;
  end
  if (valid_i[5]) begin
    f_before_q <= f_before_k5_q;
    f_slab_q <= f_slab_k5_q;
    f_k6_q <= f_k5_q;
  end
end
// A lane without a block holds what it has.
logic f_holds_q = 1'b0;
logic [4*DB-1:0] f_held_q;
always @(posedge clk_i) begin
  f_holds_q <= !valid_i[5];
  f_held_q <= state_o;
  if (f_started && f_holds_q) assert (state_o == f_held_q);
end
logic f_frozen;
assign f_frozen = f_mode != 2'd2 && 32'(f_trans) < fastsplat_pkg::FREEZE_BELOW;
always @(posedge clk_i) begin
  if (f_started && f_k6_q) begin
    assert (frozen_o == f_frozen);
    // N-6-6
    if (f_frozen) assert (state_o == f_before_q && saturated_o == '0);
    else if (f_mode != 2'd2) begin
      // Transmittance stays One.tf, never rises, never wraps; a clear slab leaves it, an opaque one takes it all.
      assert (state_o[3*DB+:DB] <= DB'(f_trans) && DB'(f_trans) <= DB'(F_ONE) && !saturated_o[3]);
      if (f_slab_q[3*DB+:DB] == '0) assert (f_trans_after == f_trans);
      if (f_slab_q[3*DB+:DB] == DB'(F_ONE)) assert (f_trans_after == '0);
    end
    cover (!f_frozen && f_mode == 2'd0 && f_trans_after != f_trans && f_trans_after != '0);
    cover (f_frozen);
  end
  // For induction.
  assert (f_started || !(f_k4_q || f_k5_q || f_k6_q));
  if (f_started && f_k4_q) assert (f_k5_q);
  if (f_started && f_k5_q) begin
    assert (frozen_k5_q == (f_mode != 2'd2 && 32'(f_before_k5_q[3*DB+:TB]) < fastsplat_pkg::FREEZE_BELOW));
    if (f_mode != 2'd2) assert (f_before_k5_q[3*DB+:DB] <= DB'(F_ONE));
  end
end
for (genvar c = 0; c < 4; c++) begin : gen_f_channel
  logic [DB-1:0] f_was, f_is, f_slab;
  assign f_was = f_before_q[c*DB+:DB];
  assign f_is = state_o[c*DB+:DB];
  assign f_slab = f_slab_q[c*DB+:DB];
  always @(posedge clk_i) begin
    if (f_started && f_k5_q) begin
      assert (gen_channel[c].state_k5_q == f_before_k5_q[c*DB+:DB]);
      if (f_mode == 2'd2) assert (gen_channel[c].light_k5_q == f_slab_k5_q[c*DB+:DB]);
      // T times a word of One.tf is T at most; nothing of nothing, T of 1.
      if (f_mode != 2'd2) begin
        assert (gen_channel[c].light_k5_q <= f_before_k5_q[3*DB+:DB]);
        if (f_slab_k5_q[c*DB+:DB] == '0) assert (gen_channel[c].light_k5_q == '0);
        if (f_slab_k5_q[c*DB+:DB] == DB'(F_ONE)) assert (gen_channel[c].light_k5_q == f_before_k5_q[3*DB+:DB]);
      end
    end
    if (f_started && f_k6_q) begin
      if (f_mode == 2'd2) begin
        // X + S, the largest word at most (N-6-9).
        assert ((DB + 1)'(f_is) == (((DB + 1)'(f_was) + (DB + 1)'(f_slab) >> SB) != '0 ? ((DB + 1)'(1) << SB) - (DB + 1)'(1) : (DB + 1)'(f_was) + (DB + 1)'(f_slab)));
        assert (saturated_o[c] == (((DB + 1)'(f_was) + (DB + 1)'(f_slab)) >> SB != '0));
        cover (saturated_o[c]);
      end else if (!f_frozen && c != 3) begin
        // Colour never falls, gains T at most, and is cut only at its largest word.
        assert (f_is >= f_was && (f_is >> TB) == '0);
        assert ((DB + 1)'(f_is) <= (DB + 1)'(f_was) + (DB + 1)'(f_trans));
        if (f_slab == '0) assert (f_is == f_was);
        if (saturated_o[c]) assert (f_is == DB'({TB{1'b1}}));
      end
    end
  end
  if (c != 3) begin : gen_f_colour
    always @(posedge clk_i) if (f_started && f_k6_q && f_mode == 2'd0) cover (saturated_o[c]);
  end
end
// Every sample: the value forwarded out of k5 is the one that k6 will hold (samples_proof.svh assumes it).
logic f_next_known_q = 1'b0;
logic [4*DB-1:0] f_next_q;
always @(posedge clk_i) begin
  f_next_known_q <= fastsplat_pkg::EVERY_SAMPLE != 0 && f_mode != 2'd2 && valid_i[5];
  f_next_q <= next_o;
  if (f_started && f_next_known_q) assert (state_o == f_next_q);
end
