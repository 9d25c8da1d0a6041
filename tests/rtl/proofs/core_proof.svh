// SPDX-License-Identifier: Apache-2.0
// How check, decode, splat path, compositor and pixel out share the sheet buffers (docs/microarchitecture.md), put
// inside fastsplat_core by prove_core.sh. Proved: a memory has one owner at a time (assumed by sheet_bank_proof.svh);
// the assumptions that dirty_map_proof.svh, compositor_proof.svh and stream_decode_proof.svh make of each other; no
// deadlock. The source is free and soft resets come at any time. Data is cut off: any pixel may lie inside, and check
// may call any field of a record right or wrong (the true ones are in stream_check_proof.svh). The walk picks freely in
// the cycles of dirty_map_proof.svh, a block in as many cycles as it has slices, and is read in the first. The script
// ties undriven names to registers below; stage 0 of the pipe is decode's output.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

logic f_beat, f_payload, f_take, f_splat, f_table, f_begin, f_idle_pixel;  // of decode and pixel out
logic f_kind_splat, f_kind_sheet, f_kind_rest;  // what decode read off its record on the way
logic [7:0] f_opcode;
logic [7:0] f_check_opcode;  // of the beat in check's second stage, and its legal place
logic [2:0] f_check_wants;
logic f_pixel_running, f_pixel_r1, f_pixel_r2;  // of pixel out
logic f_next_here, f_here, f_soft;  // of check: beats, a soft reset
logic [2:0] f_check_place;  // 0 before begin_frame, 1 in the frame, 2 in a table, 3 in a tile, 4 in a sheet
logic [1:0] f_busy;
logic f_buffer, f_idle_walk, f_issue, f_still;
logic [8:0] f_valid_below, f_last_below, f_buffer_below;
logic [5:0] f_blocks;  // in the compositor's pipe
logic [9:0] f_valid, f_last, f_of;
assign f_valid = {f_valid_below, window_valid};
assign f_last = {f_last_below, window_last};
assign f_of = {f_buffer_below, window_buffer};

// Where the records that decode carried out lead to: 0 in the frame, 1 in a tile, 2 in a sheet; and with the one in its register.
logic [1:0] f_place_q, f_next_place;
logic f_record, f_out;
assign f_record = f_beat && !f_payload;
assign f_out = f_record && f_take;
always @* begin
  f_next_place = f_place_q;
  if (f_record && f_opcode == 8'h54) f_next_place = 2'd1;
  if (f_record && f_opcode == 8'h53) f_next_place = 2'd2;
  if (f_record && f_opcode == 8'h73) f_next_place = 2'd1;
  if (f_record && f_opcode == 8'h74) f_next_place = 2'd0;
end
always @(posedge clk_i) begin
  if (f_out) f_place_q <= f_next_place;
  if (!rst_ni) f_place_q <= 2'd0;
end

// Any word of the memories: wiped once, before anything moves (M-reset-4).
(* anyconst *) logic [fastsplat_pkg::ADDR_BITS-1:0] f_word;
logic f_wiped_q, f_moved_q, f_cleared_q, f_cleared_of_q;
always @* assume (32'(f_word) < fastsplat_pkg::BLOCKS);
always @(posedge clk_i) begin
  if (wiping_q && wipe_addr_q == f_word) f_wiped_q <= 1'b1;
  f_cleared_q <= rst_ni && sheet_re;  // the compositor's words are cleared a cycle after the read
  f_cleared_of_q <= sheet_buffer;
  f_moved_q <= rst_ni && (f_moved_q || f_valid[6] || sheet_re);
  if (!rst_ni) f_wiped_q <= 1'b0;
end

// Something moves: a beat that is not swallowed, a window, a table word, a block, a sheet given back, pixels, the wipe; if there is
// something to do, the sink is ready, and no soft reset is being requested.
localparam int F_SLICES = fastsplat_pkg::SLICES;
integer f_slice_q;  // of the block that is walked
logic f_moves, f_fair;
logic [4:0] f_still_q;
localparam int F_LONGEST = 11;  // cycles between end_sheet, when the beat behind it moves to decode, and the first pick of its walk
assign f_moves = wiping_q || (s_tvalid_i && s_tready_o && !error_o) || (beat_valid && beat_ready) || f_splat || f_table || sheet_re || f_slice_q != 0 || free || (m_tvalid_o && m_tready_i);
assign f_fair = m_tready_i && !soft_reset && ((s_tvalid_i && !error_o) || check_busy || f_beat || !f_idle_pixel);
always @(posedge clk_i) f_still_q <= (!rst_ni || f_moves || !f_fair) ? '0 : f_still_q + 5'(f_still_q != '1);

// The walk: when it picks, as in dirty_map_proof.svh, from which these are. Whose walk is next or under way: f_turn.
logic [1:0] f_full;        // handed over and not walked to its end
logic [1:0] f_age_q[0:1];  // cycles since the hand-over
logic [1:0] f_since_q;     // and since the last pick
logic f_turn, f_walking, f_begun_q;
assign f_walking = f_full[f_turn] && (f_begun_q || ((f_turn ? f_age_q[1] : f_age_q[0]) >= 2'd2 && f_since_q == 2'd3));
always @(posedge clk_i) begin
  for (int m = 0; m < 2; m++) if (f_age_q[m] != 2'd3) f_age_q[m] <= f_age_q[m] + 2'd1;
  if (f_since_q != 2'd3) f_since_q <= f_since_q + 2'd1;
  f_begun_q <= f_walking && !free;
  if (sheet_re || f_slice_q != 0) f_slice_q <= f_slice_q == F_SLICES - 1 ? 0 : f_slice_q + 1;
  if (free) begin
    f_full[free_buffer] <= 1'b0;
    f_since_q <= '0;
    f_turn <= !f_turn;
  end
  if (done) begin
    f_full[done_buffer] <= 1'b1;
    f_age_q[done_buffer] <= 2'd1;
  end
  if (!rst_ni) begin
    f_full <= '0;
    f_since_q <= 2'd3;
    f_turn <= 1'b0;
    f_begun_q <= 1'b0;
    f_slice_q <= 0;
  end
end
always @* begin
  if (rst_ni) begin
    assume (f_slice_q != 0 ? !sheet_re : (sheet_re || free) == f_walking);
    assume (!f_begun_q || f_slice_q != 0 || sheet_re);
    assume (f_issue == (sheet_re || f_slice_q != 0));
    assume (!free || f_slice_q == F_SLICES - 1 || (f_slice_q == 0 && !sheet_re));
    assume (!(sheet_re || free) || sheet_buffer == f_turn);
    assume (f_idle_walk == (f_full == '0 && f_since_q >= 2'd2));
  end
end

// Where buffer m is: open (begun), token (ended, on its way), marked (the same, behind c4), full (with the compositor).
logic [1:0] f_open, f_token, f_marked, f_ended;
logic [5:1] f_marked_way_q;
always @(posedge clk_i) f_marked_way_q <= rst_ni ? {f_marked_way_q[4:1], marked} : '0;
always @* begin
  for (int m = 0; m < 2; m++) begin
    f_open[m] = f_place_q == 2'd2 && f_buffer == 1'(m);
    f_token[m] = 1'b0;
    f_marked[m] = f_full[m];
    for (int s = 0; s <= 9; s++) if (f_last[s] && f_of[s] == 1'(m)) f_token[m] = 1'b1;
    for (int s = 5; s <= 9; s++) if (f_last[s] && f_of[s] == 1'(m)) f_marked[m] = 1'b1;
    f_ended[m] = f_token[m] || f_full[m];
  end
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // sheet_bank_proof.svh: a memory has one owner at a time, and is wiped first (M-reset-4). It is cleared a cycle after the read
    // (M-slices-2).
    for (int s = 6; s <= 9; s++) assert (!(sheet_re && f_valid[s] && f_of[s] == sheet_buffer));
    assert (!(f_cleared_q && f_valid[6] && f_of[6] == f_cleared_of_q));
    assert (f_wiped_q || !(f_valid[6] || sheet_re));
    assert (!wiping_q || !(f_valid[6] || sheet_re || f_cleared_q));
    assert (!(wiping_q && (f_moved_q || (wipe_addr_q == f_word && f_wiped_q))));
    // dirty_map_proof.svh. The token is at W five cycles behind c4 (M-path-3).
    assert (done == f_marked_way_q[5]);
    assert (!done || (!f_full[done_buffer] && done_buffer == (f_full == '0 ? f_turn : !f_turn)));
    assert (!(dirty_valid && (f_marked[dirty_buffer] || (marked && marked_buffer == dirty_buffer))));
    assert (!marked || (!f_marked[marked_buffer] && marked_buffer == (f_marked == '0 ? f_turn : !f_turn)));
    // compositor_proof.svh.
    assert (!(f_begin || picture_re) || compositor_idle);
    assert (!f_begin || pixel_idle);
    // pixel_out_proof.svh.
    assert (!tile_end || pixel_idle);
    // A soft reset ends when nothing is left of the frame before (stream_check_proof.svh; M-check-11).
    assert (!(f_soft && at_rest && !f_here && f_check_place <= 3'd2) ||
            (!f_beat && f_busy == '0 && f_valid == '0 && f_last == '0 && f_full == '0 && f_place_q == '0 && f_idle_pixel && compositor_idle));
    // stream_decode_proof.svh.
    assert (!free || (f_busy[free_buffer] && !f_open[free_buffer]));
    assert (f_still_q <= 5'(F_LONGEST));  // No deadlock: while source and sink are ready something moves

    // For induction. What was refused is not in check any more.
    assert (!(error_o && (f_here || f_next_here)));
    // Nothing moves before all is wiped.
    assert (wiping_q || f_wiped_q);
    assert (32'(wipe_addr_q) < fastsplat_pkg::BLOCKS);
    assert (!wiping_q || f_wiped_q == (wipe_addr_q > f_word));
    assert (!wiping_q || !(f_here || f_next_here || f_check_place != '0 || f_beat || f_busy != '0 || f_valid != '0 || f_last != '0 || f_full != '0 || f_since_q != 2'd3 || f_blocks != '0 || !f_idle_pixel || f_cleared_q || f_place_q != '0));
    // A buffer is in one place, its windows before its token (M-path-3), busy from begin_sheet to its walk's end (M-decode-5).
    assert (f_busy == (f_open | f_ended));
    assert ((f_open & f_ended) == '0 && (f_token & f_full) == '0);
    for (int s = 0; s <= 9; s++) begin
      assert (!(f_valid[s] && f_last[s]));
      for (int t = 0; t < s; t++) begin
        assert (!(f_last[s] && f_last[t] && f_of[s] == f_of[t]));
        assert (!(f_last[s] && f_valid[t] && f_of[s] == f_of[t]));
        // Sheets end in turn.
        assert (!(f_last[s] && f_last[t]) || f_of[s] == f_turn);
      end
      assert (!f_valid[s] || (f_busy[f_of[s]] && !f_full[f_of[s]]));
    end
    assert (f_ended != '0 || f_buffer == f_turn);
    assert (f_ended == '0 || f_ended[f_turn]);
    assert (f_ended == '0 || f_ended == 2'b11 || f_buffer != f_turn);
    assert (f_ended != 2'b11 || f_buffer == f_turn);
    assert (f_full == '0 || f_full[f_turn]);
    // The walk.
    assert (!f_begun_q || (f_full[f_turn] && f_since_q == 2'd3));
    assert (f_slice_q >= 0 && f_slice_q < F_SLICES && (f_slice_q == 0 || f_begun_q));
    for (int m = 0; m < 2; m++) assert (!f_full[m] || f_age_q[m] != '0);
    for (int s = 1; s <= 5; s++) assert (f_marked_way_q[s] == f_last[s+4]);
    assert (!(f_cleared_q && f_valid[0] && f_of[0] == f_cleared_of_q && !f_full[f_cleared_of_q]));
    // Beats passed by check and carried out by decode: one beat lies between.
    assert (f_check_place <= 3'd4);
    assert (!f_here || f_check_wants == (f_check_opcode == 8'h46 ? 3'd0 : f_check_opcode == 8'h53 || f_check_opcode == 8'h74 ? 3'd3 :
                                         f_check_opcode == 8'h50 || f_check_opcode == 8'h45 || f_check_opcode == 8'h43 || f_check_opcode == 8'h73 ? 3'd4 : 3'd1));
    assert (!f_beat || {f_kind_splat, f_kind_sheet, f_kind_rest} ==
                       {f_record && f_opcode == 8'h50, f_record && f_opcode == 8'h53, f_record && (f_opcode == 8'h54 || f_opcode == 8'h74)});
    assert (f_next_place == (f_check_place == 3'd4 ? 2'd2 : f_check_place == 3'd3 ? 2'd1 : 2'd0));
    if (f_record) begin
      if (f_opcode == 8'h46 || f_opcode == 8'h4C || f_opcode == 8'h54 || f_opcode == 8'h66) assert (f_place_q == 2'd0);
      if (f_opcode == 8'h53 || f_opcode == 8'h74) assert (f_place_q == 2'd1);
      if (f_opcode == 8'h50 || f_opcode == 8'h43 || f_opcode == 8'h73) assert (f_place_q == 2'd2);
    end
    // Tiles.
    assert (tile_open == (f_place_q != '0));
    assert (f_place_q != 2'd3 && (f_place_q != '0 || f_busy == '0));
    assert (f_still == (f_blocks == '0));
    assert (f_idle_pixel == !(f_pixel_running || f_pixel_r1 || f_pixel_r2));
    assert (!!f_idle_pixel || (f_place_q == '0 && f_busy == '0 && compositor_idle));
    assert (!(f_beat && f_payload) || f_place_q == '0);
    cover (f_still_q == 5'(F_LONGEST));
    cover (sheet_re && f_valid[9]);
    cover (f_soft && error_o && m_tvalid_o && m_tuser_o);
  end
end
