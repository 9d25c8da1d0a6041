// SPDX-License-Identifier: Apache-2.0
// The dirty walk (docs/microarchitecture.md, "Dirty walk"), written again from the page and put inside dirty_map by
// prove_control.sh: each block that a sheet marked is picked once, in rising order, slice by slice, one a cycle, in its cycle,
// and is clean afterwards; nothing else is picked. One block of one buffer is looked at: any.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);
(* anyconst *) logic f_buffer;
(* anyconst *) logic [AB-1:0] f_block;
localparam int F_BLOCKS = fastsplat_pkg::BLOCKS;
logic [YB-1:0] f_row;
logic [XB-1:0] f_column;
assign f_row = YB'(f_block / BX);
assign f_column = XB'(f_block % BX);
always @* assume (32'(f_block) < F_BLOCKS);

// A window marks the blocks of its lanes inside the tile: by lane column and lane row (M-walk-1).
logic f_in_column, f_in_row, f_mark;
always @* begin
  f_in_column = 1'b0;
  f_in_row = 1'b0;
  for (int g = 0; g < P; g++) begin
    // Inside is inside the memory.
    if (mark_i && mark_inside_x_i[g]) assume (32'(mark_column_i[g*BLK+:BLK]) < BX);
    if (mark_i && mark_inside_y_i[g]) assume (32'(mark_row_i[g*BLK+:BLK]) < BY);
    if (mark_inside_x_i[g] && mark_column_i[g*BLK+:BLK] == BLK'(f_column)) f_in_column = 1'b1;
    if (mark_inside_y_i[g] && mark_row_i[g*BLK+:BLK] == BLK'(f_row)) f_in_row = 1'b1;
  end
end
assign f_mark = mark_i && mark_buffer_i == f_buffer && f_in_column && f_in_row;

// The slice that is picked next: 0 to the last of a block (M-slices-1).
localparam int F_SLICES = fastsplat_pkg::SLICES;
logic [fastsplat_pkg::SLICE_BITS-1:0] f_slice_q, f_slice_next;
logic f_last_slice;
assign f_last_slice = 32'(f_slice_q) == F_SLICES - 1;
assign f_slice_next = !valid_o ? f_slice_q : f_last_slice ? '0 : f_slice_q + fastsplat_pkg::SLICE_BITS'(1);

// The block's mark by the page, and the walk's effect on it: its last slice's pick ends it.
logic f_marked_q, f_picked_q;
logic f_at_it, f_pick;
assign f_at_it = valid_o && buffer_o == f_buffer && block_o == f_block;
assign f_pick = f_at_it && f_last_slice;
always @(posedge clk_i) begin
  f_slice_q <= rst_ni ? f_slice_next : '0;
  if (f_mark) f_marked_q <= 1'b1;
  if (f_pick) f_marked_q <= 1'b0;
  if (f_pick) f_picked_q <= 1'b1;
  if (done_i && done_buffer_i == f_buffer) f_picked_q <= 1'b0;
  if (!rst_ni) begin
    f_marked_q <= 1'b0;
    f_picked_q <= 1'b0;
  end
end

// When: a(s) = max(token at W + 2, f(s-1) + 4) (M-walk-2, M-walk-4). Cycles since the token of each buffer, and since the last walk ended, to 3.
logic [1:0] f_full_q;       // handed over and not walked to its end
logic [1:0] f_age_q[0:1];   // 1: the cycle after the hand-over
logic [1:0] f_since_q;      // last pick: 0 is the cycle after it
logic f_turn_q;             // whose walk is next or under way
logic f_walking, f_begun_q;
assign f_walking = f_full_q[f_turn_q] && (f_begun_q || (f_age_q[f_turn_q] >= 2'd2 && f_since_q == 2'd3));
logic [AB-1:0] f_last_q;
logic [2:0] f_recent_q;      // picks of the three cycles before
logic [5:0] f_token_q[0:1];  // of each buffer, behind c4: 5 is W
always @(posedge clk_i) begin
  for (int m = 0; m < 2; m++) begin
    if (f_age_q[m] != 2'd3) f_age_q[m] <= f_age_q[m] + 2'd1;
    f_token_q[m] <= {f_token_q[m][4:1], marked_i && marked_buffer_i == 1'(m), 1'b0};
    if (!rst_ni) f_token_q[m] <= '0;
  end
  if (f_since_q != 2'd3) f_since_q <= f_since_q + 2'd1;
  f_begun_q <= f_walking && !finish_o;
  f_recent_q <= {f_recent_q[1:0], valid_o};
  if (valid_o) f_last_q <= block_o;
  if (finish_o) begin
    f_full_q[buffer_o] <= 1'b0;
    f_since_q <= '0;
    f_turn_q <= !f_turn_q;
  end
  if (done_i) begin
    f_full_q[done_buffer_i] <= 1'b1;
    f_age_q[done_buffer_i] <= 2'd1;
  end
  if (!rst_ni) begin  // M-reset-2
    f_full_q <= '0;
    f_recent_q <= '0;
    f_since_q <= 2'd3;
    f_turn_q <= 1'b0;
    f_begun_q <= 1'b0;
  end
end

// Assumed of core (proved in core_proof.svh): the token passes c4, and five cycles later W; no window marks a sheet
// behind its token; sheets end in turn.
logic [1:0] f_ended;
assign f_ended = {f_token_q[1] != '0 || f_full_q[1], f_token_q[0] != '0 || f_full_q[0]};
always @* begin
  if (rst_ni) begin
    assume (done_i == (f_token_q[0][5] || f_token_q[1][5]));
    assume (!done_i || f_token_q[done_buffer_i][5]);
    if (mark_i) assume (!f_ended[mark_buffer_i] && !(marked_i && marked_buffer_i == mark_buffer_i));
    if (marked_i) assume (!f_ended[marked_buffer_i] && marked_buffer_i == (f_ended == '0 ? f_turn_q : !f_turn_q));
  end
end

// Where the mark is: in the map, on its way in f2 or f3, or picked in this cycle.
logic f_dirty, f_in_f2, f_in_f3, f_go_q;
assign f_dirty = (f_buffer ? dirty[BY+f_row][f_column] : dirty[f_row][f_column]) && !(fetched_q[f_row] && fetched_buffer_q == f_buffer);
assign f_in_f2 = buffer_q == f_buffer && f2_number_q == f_row && f2_row_q[f_column];
assign f_in_f3 = buffer_q == f_buffer && f3_number_q == f_row && f3_row_q[f_column];
always @(posedge clk_i) f_go_q <= rst_ni && walking;
logic [BY-1:0] f_rows;
assign f_rows = rows_q[buffer_q];
always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // Each block once, and marked ones alone (M-walk-3).
    assert (!f_at_it || f_marked_q);
    assert (!f_pick || !f_picked_q);
    assert (!(finish_o && buffer_o == f_buffer) || !f_marked_q || f_pick);
    // Rising, one a cycle, in its cycle: a walk picks from its first cycle to its last; a clean sheet's takes one (M-walk-3, M-walk-4).
    assert (!(valid_o && f_begun_q && f_slice_q == '0) || block_o > f_last_q);
    // All slices of a block, one behind the other; the last of the last ends the walk.
    assert (!valid_o || slice_o == f_slice_q);
    assert (f_slice_q == '0 || (valid_o && f_begun_q && block_o == f_last_q));
    assert (!(valid_o && finish_o) || f_last_slice);
    assert (valid_o || finish_o || !f_walking);
    assert (!(valid_o || finish_o) || f_walking);
    assert (!f_begun_q || valid_o);
    assert (!(valid_o || finish_o) || buffer_o == f_turn_q);
    assert (!valid_o || f_begun_q || f_recent_q == '0);
    assert (idle_o == (f_full_q == '0 && f_since_q >= 2'd2));

    // For induction. The slices.
    assert (32'(f_slice_q) < F_SLICES && slice_q == f_slice_next);
    // The hand-over.
    assert (f_go_q == f_walking);
    assert (buffer_q == (finish_o ? !f_turn_q : f_turn_q));
    assert (f_since_q == 2'd3 || !(f_begun_q || finish_o));
    assert (finish_q[2:1] == {f_since_q == 2'd1, f_since_q == 2'd0});
    assert (!f_begun_q || f_full_q[f_turn_q]);
    for (int n = 0; n < 3; n++) assert (f_begun_q || !f_recent_q[n] || f_since_q <= 2'(n));
    assert (f_ended == '0 || f_ended[f_turn_q]);
    for (int m = 0; m < 2; m++) begin
      assert (full_q[m] == (f_full_q[m] && !(finish_o && buffer_o == 1'(m))));
      assert (marked_q[m] == (f_token_q[m] != '0 || full_q[m]));
      assert (!(f_token_q[m] != '0 && f_full_q[m]) && $onehot0(f_token_q[m]));
      assert (!f_full_q[m] || f_age_q[m] != '0);
    end
    assert ((f_token_q[0] & f_token_q[1]) == '0 && (f_full_q == '0 || f_full_q[f_turn_q]));
    assert (f_turn_q ? f_full_q[1] || f_token_q[0] <= f_token_q[1] : f_full_q[0] || f_token_q[1] <= f_token_q[0]);
    // The state: f1 to f3 begin to fill when the token has passed c4 and the walk before has ended.
    assert (state_q == StIdle || marked_q[buffer_q]);
    assert (state_q != StIdle || !marked_q[buffer_q] || f_token_q[buffer_q][1] || finish_o);
    assert (!finish_o || state_q == StIdle);
    assert (state_q != StRow || ((f_token_q[buffer_q][2] || f_since_q == 2'd0) && !f_token_q[buffer_q][1]));
    assert (state_q != StBlocks || ((f_token_q[buffer_q][3] || f_since_q == 2'd1) && f_since_q >= 2'd1 && !f_token_q[buffer_q][2:1]));
    assert (state_q != StWalk || (f_since_q >= 2'd2 && f_token_q[buffer_q][3:1] == '0));
    // The stages: f1 the lowest row left, nothing behind an empty one, each filled by now.
    assert (f1_valid_q == (f1_row_q != '0) && (f1_row_q & (f1_row_q - BY'(1))) == '0);
    assert (f2_valid_q == (f2_row_q != '0));
    assert (state_q != StIdle || (!f1_valid_q && !f2_valid_q && f3_row_q == '0));
    assert (state_q != StRow || (!f2_valid_q && f3_row_q == '0));
    assert (state_q != StBlocks || f3_row_q == '0);
    assert (state_q == StIdle || f1_valid_q || f_rows == '0);
    assert (state_q == StIdle || state_q == StRow || f2_valid_q || !f1_valid_q);
    assert (state_q != StWalk || f3_row_q != '0 || !f2_valid_q);
    assert (state_q != StWalk || f3_rest_q == (f3_row_q & (f3_row_q - BX'(1))));
    assert (fetched_q == '0 || (f2_valid_q && fetched_q == BY'(1) << f2_number_q && fetched_buffer_q == buffer_q));
    assert (state_q != StWalk || one_left_q == ((f3_row_q & (f3_row_q - BX'(1))) == '0));
    assert (!f_walking || finish_o || f3_row_q != '0);
    assert (!f1_valid_q || (f_rows & (f1_row_q | (f1_row_q - BY'(1)))) == '0);
    assert (!(f1_valid_q && f2_valid_q) || f1_row_q > BY'(1) << f2_number_q);
    assert (f3_row_q == '0 || !f2_valid_q || f2_number_q > f3_number_q);
    assert (!valid_o || finish_o || !f_last_slice || ((AB'(f3_number_q) << BXL) | AB'(column)) > block_o);
    assert (!valid_o || f_last_slice || ((AB'(f3_number_q) << BXL) | AB'(column)) == block_o);
    // A row holds dirt if its bit says so, or it is in f1.
    for (int m = 0; m < 2; m++) begin
      for (int r = 0; r < BY; r++) begin
        assert ((dirty[m*BY+r] != '0) == (rows_q[m][r] || (buffer_q == 1'(m) && f1_row_q[r]) || (fetched_buffer_q == 1'(m) && fetched_q[r])));
        assert (!(fetched_buffer_q == 1'(m) && fetched_q[r]) || !(rows_q[m][r] || (buffer_q == 1'(m) && f1_row_q[r])));
      end
    end
    assert (f_marked_q == (f_dirty || f_in_f2 || f_in_f3 || f_pick));
    assert (!(f_dirty && (f_in_f2 || f_in_f3 || f_pick)) && !(f_in_f2 && (f_in_f3 || f_pick)) && !(f_in_f3 && f_pick));
    assert (!(f_picked_q && f_full_q[f_buffer] && f_marked_q));
    cover (f_pick && f_begun_q && finish_o);
    cover (finish_o && !valid_o);
    cover (f_pick && f_recent_q[0]);
    cover (f_pick && f_full_q == 2'b11 && f_since_q == 2'd3 && f_row == YB'(BY - 1));
  end
end
