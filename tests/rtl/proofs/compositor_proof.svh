// SPDX-License-Identifier: Apache-2.0
// The compositor's pipe and its picture (docs/microarchitecture.md, "Pipe" and "Pixel out"), written again from the
// page and put inside compositor by prove_control.sh. A block picked in k0 is written in k6. A word of the picture has
// one writer, reads as written last, and is blank behind the wipe and behind pixel out. The proof follows one arbitrary
// word. The walk and the arithmetic are free; reading the word that is being written returns an arbitrary value.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);
(* anyconst *) logic [AB-1:0] f_block;
(* anyconst *) logic [fastsplat_pkg::LANE_LOG2-1:0] f_g, f_h;  // its bank's column and row
always @* assume (32'(f_block) < NB);

// A block picked in k0 is written in k6 (M-pipe-1). It is picked in all of its slices, one after the other; the word is
// in one of them (M-slices-1).
logic [6:1] f_way_q, f_mine;
logic [AB-1:0] f_at_q[1:6];
logic [LB-1:0] f_slice_q[0:6];  // 0: the next to be picked
logic [LB-1:0] f_slice;
logic f_last;
logic [AB-1:0] f_whole_q;  // the block whose slices are picked
assign f_slice = LB'((32'(f_h) * P + 32'(f_g)) / C);
assign f_last = 32'(f_slice_q[0]) == R - 1;
always @(posedge clk_i) begin
  f_way_q <= {f_way_q[5:1], issue};
  f_at_q[1] <= sheet_addr_o;
  f_slice_q[1] <= f_slice_q[0];
  if (issue) f_slice_q[0] <= f_last ? '0 : f_slice_q[0] + LB'(1);
  if (issue) f_whole_q <= sheet_addr_o;
  for (int s = 2; s <= 6; s++) f_at_q[s] <= f_at_q[s-1];
  for (int s = 2; s <= 6; s++) f_slice_q[s] <= f_slice_q[s-1];
  if (!rst_ni) f_way_q <= '0;
  if (!rst_ni) f_slice_q[0] <= '0;
end
always @* for (int s = 1; s <= 6; s++) f_mine[s] = f_way_q[s] && f_at_q[s] == f_block && f_slice_q[s] == f_slice;

// The word's place in the picture, and whether it lies in the tile.
localparam int FS = SIDE + AB + 2;
logic [FS-1:0] f_x, f_y;
assign f_x = FS'(f_block % BX) * FS'(P) + FS'(f_g);
assign f_y = FS'(f_block / BX) * FS'(P) + FS'(f_h);

// The lane's signals, and what its memory holds (tied to the memories' probes by the script).
logic [4*DB-1:0] f_memory0, f_memory1, f_memory2, f_memory3, f_memory, f_seen, f_k4, f_new, f_tap, f_kept, f_made_q, f_lane, f_sent;
always @* begin
  f_memory = f_h ? (f_g ? f_memory3 : f_memory2) : (f_g ? f_memory1 : f_memory0);
  f_seen = f_h ? (f_g ? picture[3] : picture[2]) : (f_g ? picture[1] : picture[0]);
  f_seen = f_seen ^ transparent;
  // Its lane; where a block is several slices there are fewer of them.
  f_k4 = f_h ? (f_g ? state_k4_q[3%C] : state_k4_q[2%C]) : (f_g ? state_k4_q[1%C] : state_k4_q[0]);
  f_lane = f_h ? (f_g ? states[3%C] : states[2%C]) : (f_g ? states[1%C] : states[0]);
  f_new = f_lane;
  f_kept = f_h ? (f_g ? shown[3] : shown[2]) : (f_g ? shown[1] : shown[0]);
  f_tap = f_h ? (f_g ? tap_state_o[12*DB+:4*DB] : tap_state_o[8*DB+:4*DB]) : (f_g ? tap_state_o[4*DB+:4*DB] : tap_state_o[0+:4*DB]);
  f_sent = f_g ? picture_o[4*DB+:4*DB] : picture_o[0+:4*DB];
end

// The word, as the page has it: unknown until wiped, then blank or a state.
logic f_known_q, f_blank_q, f_read_q, f_write;
logic [4*DB-1:0] f_state_q, f_blank, f_word;
// A blank picture (M-reset-6).
assign f_blank = mode_i == 2'd2 ? '0 : {DB'(1) << fastsplat_pkg::TRANS_FRAC, (3 * DB)'(0)};
assign f_word = f_blank_q ? f_blank : f_state_q;
assign f_write = f_mine[6] && f_y < FS'(height_i);  // M-pixel-3
// Reads of it: by the pipe, which has in k4 what was written up to k2; by pixel out, and what that saw holds until the next read.
logic f_passes, f_made_known_q, f_pipe, f_out, f_pipe_q, f_shown_q, f_again_q;
logic [4*DB-1:0] f_expect_q, f_due_q, f_lane_q;
logic f_holds_q;
assign f_pipe = f_mine[3];
assign f_passes = f_way_q[6] && f_slice_q[6] == f_slice;  // the bank's pixel of any block
assign f_out = picture_re_i && picture_addr_i == f_block;
logic [1:0] f_mode_q;
logic [SIDE-1:0] f_width_q, f_height_q;
always @(posedge clk_i) begin
  f_read_q <= rst_ni && f_out;
  f_pipe_q <= rst_ni && f_pipe;
  if (f_way_q[3]) f_expect_q <= f_word;
  if (f_passes) f_made_q <= f_new;
  f_made_known_q <= rst_ni && (f_made_known_q || f_passes);
  if (f_way_q[2] || picture_re_i) begin
    f_shown_q <= f_out;
    f_again_q <= f_out && f_read_q && picture_row_i[f_h];
    f_due_q <= f_word;
  end
  f_lane_q <= f_lane;
  f_holds_q <= f_started && !valid_q[5];
  if (f_write) begin
    f_state_q <= f_new;
    f_blank_q <= 1'b0;
  end
  if (f_read_q && picture_row_i[f_h]) f_blank_q <= 1'b1;  // M-pixel-3
  if (wipe_i && wipe_addr_i == f_block) begin
    f_blank_q <= 1'b1;
    f_known_q <= 1'b1;
  end
  f_mode_q <= mode_i;
  f_width_q <= width_i;
  f_height_q <= height_i;
  if (!rst_ni) f_known_q <= 1'b0;
  if (!rst_ni) f_shown_q <= 1'b0;
end

// Assumed, and proved in dirty_map_proof.svh, composite_lane_proof.svh, pixel_out_proof.svh and core_proof.svh: a block
// comes back four cycles later at the earliest, and then no other came between; a lane holds its state without a block;
// all is still while the picture is wiped or sent; pixel out sends no row twice; a tile has one mode and size, and
// begins when the previous one was sent.
always @* begin
  if (rst_ni) begin
    assume (!(issue && walk_idle));
    if (R > 1) assume (!issue || slice == f_slice_q[0]);
    assume (f_slice_q[0] == '0 || (issue && sheet_addr_o == f_whole_q));
    // Of slices the same: from the last of a block to the first of the next, which may be the same, there are four cycles.
    if (R == 1) begin
      for (int s = 1; s <= 3; s++) assume (!(issue && sheet_addr_o == f_block && f_way_q[s] && f_at_q[s] == f_block));
      assume (!(issue && sheet_addr_o == f_block && f_way_q[4] && f_at_q[4] == f_block && f_way_q[3:1] != '0));
    end else begin
      for (int s = 1; s <= 3; s++) assume (!(issue && f_slice_q[0] == '0 && sheet_addr_o == f_block && f_way_q[s] && f_at_q[s] == f_block));
    end
    assume (!f_holds_q || f_lane == f_lane_q);
    assume (!picture_re_i || idle_o);
    assume (!(wipe_i && (issue || picture_re_i || f_way_q != '0 || f_read_q || sent_q)));
    assume (f_known_q || !(issue || picture_re_i));
    assume (!f_again_q || !picture_row_i[f_h]);
    if (f_started && !(f_known_q && f_blank_q && idle_o && !issue && !picture_re_i && picture_row_i == '0))
      assume (!f_known_q || (mode_i == f_mode_q && width_i == f_width_q && height_i == f_height_q));
    if (mode_i != f_mode_q) assume (!f_shown_q && f_way_q == '0);
  end
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // Sums are read with a block's first slice (M-slices-2).
    assert (sheet_re_o == (issue && f_slice_q[0] == '0) && sheet_addr_o == pick && free_o == finish && tap_sheet_o == finish && free_buffer_o == sheet_buffer_o);
    assert (idle_o == (walk_idle && f_way_q == '0));
    // Through the pipe (M-pipe-1).
    assert (event_valid_o == f_way_q[6] && tap_valid_o == (f_way_q[6] && 32'(f_slice_q[6]) == R - 1));
    assert (!tap_valid_o || tap_block_o == f_at_q[6]);
    assert (!(event_valid_o && addr_q[6] == f_block) || (inside_x_q[f_g] == (f_x < FS'(width_i)) && inside_y_q[f_h] == (f_y < FS'(height_i))));
    assert (!f_mine[6] || event_inside_o[(32'(f_h) * P + 32'(f_g)) % C] == (f_x < FS'(width_i) && f_y < FS'(height_i)));
    // The tap has all of the block, with its last slice (M-pipe-1).
    assert (!tap_valid_o || f_tap == (f_passes ? f_new : f_made_q));
    // The picture: as written last, by the lane or in memory (M-walk-5, M-slices-3); blank behind wipe and pixel out (M-reset-4, M-reset-6).
    assert (!f_pipe_q || f_k4 == f_expect_q);
    assert (!(f_shown_q && picture_row_i == P'(1) << f_h) || f_sent == f_due_q);

    // For induction.
    assert (valid_q == f_way_q);
    for (int s = 1; s <= 6; s++) assert (!f_way_q[s] || (addr_q[s] == f_at_q[s] && (R == 1 || slice_q[s] == f_slice_q[s]) && 32'(f_slice_q[s]) < R));
    assert (32'(f_slice_q[0]) < R);
    // The pick after a slice that is not the last is the next slice of the block.
    for (int s = 1; s <= 6; s++) begin
      if (f_way_q[s] && f_slice_q[s] != '0) begin
        if (s < 6) assert (f_way_q[s+1] && f_at_q[s+1] == f_at_q[s] && f_slice_q[s+1] == f_slice_q[s] - LB'(1));
      end
      if (f_way_q[s] && 32'(f_slice_q[s]) != R - 1) begin
        if (s > 1) assert (f_way_q[s-1] && f_at_q[s-1] == f_at_q[s] && f_slice_q[s-1] == f_slice_q[s] + LB'(1));
        else assert (f_slice_q[0] == f_slice_q[1] + LB'(1) && f_whole_q == f_at_q[1]);
      end
    end
    assert (32'(f_slice) == R - 1 || !f_made_known_q || f_kept == f_made_q);
    assert (!f_way_q[6] || f_slice_q[6] <= f_slice || f_made_known_q);
    assert (f_slice_q[0] == '0 || (f_way_q[1] && f_slice_q[1] == f_slice_q[0] - LB'(1)));
    assert (!f_known_q || f_memory == (f_blank_q ? '0 : f_state_q ^ f_blank));
    assert (f_known_q || !(f_way_q != '0 || sent_q || f_shown_q));
    assert (!f_read_q || (sent_q && sent_addr_q == f_block));
    assert (!(sent_q && sent_addr_q == f_block) || f_read_q);
    assert (!(f_shown_q && !f_again_q) || f_seen == f_due_q);
    assert (!f_pipe || ((forward_q && inside_y_q[f_h]) ? f_lane : f_seen) == f_word);
    assert (R == 1 || !forward_q);  // M-slices-4
    assert (!(sent_q && f_way_q != '0));
    for (int s = 1; s <= 6; s++) begin
      for (int t = 1; t <= 3; t++) if (s + t <= 6) assert (!(f_way_q[s] && f_slice_q[s] == '0 && f_way_q[s+t] && f_at_q[s] == f_block && f_at_q[s+t] == f_block));
      for (int t = 1; t <= (R == 1 ? 3 : R == 2 ? 4 : 5); t++) if (s + t <= 6) assert (!(f_mine[s] && f_mine[s+t]));
    end
    if (R == 1) for (int s = 1; s <= 2; s++) assert (!(f_way_q[s] && f_way_q[s+4] && f_at_q[s] == f_block && f_at_q[s+4] == f_block && ((f_way_q >> s) & 6'd7) != '0));
    if (R == 1) cover (f_pipe && forward_q && inside_y_q[f_h]);
    if (R > 1) cover (tap_valid_o && tap_block_o == f_block && !f_mine[6] && f_made_q != f_blank);
    cover (f_pipe_q && f_expect_q != f_blank && f_expect_q != '0);
    cover (f_read_q && picture_row_i[f_h] && !f_blank_q && f_again_q == 1'b0);
    cover (f_pipe && f_way_q[6] && f_at_q[6] != f_block && !f_blank_q);
  end
end
