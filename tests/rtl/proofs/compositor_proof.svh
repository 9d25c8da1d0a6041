// The compositor's walk (docs/microarchitecture.md, "Dirty walk"), written again from the page and put inside compositor by
// prove_control.sh: each block that a sheet marked is picked once, in rising order, one a cycle, in its cycle, and is clean
// afterwards; nothing else is picked. One block of one buffer is looked at: any.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);
(* anyconst *) logic f_buffer;
(* anyconst *) logic [AB-1:0] f_block;
localparam int F_BLOCKS = fastsplat_pkg::BLOCKS;
always @* assume (32'(f_block) < F_BLOCKS);

// A window marks the blocks of its lanes inside the tile: by lane column and lane row.
logic f_in_column, f_in_row, f_mark;
always @* begin
  f_in_column = 1'b0;
  f_in_row = 1'b0;
  for (int g = 0; g < P; g++) begin
    // Inside is inside the memory.
    if (dirty_valid_i && dirty_inside_x_i[g]) assume (32'(dirty_column_i[g*BLK+:BLK]) < BX);
    if (dirty_valid_i && dirty_inside_y_i[g]) assume (32'(dirty_row_i[g*BLK+:BLK]) < BY);
    if (dirty_inside_x_i[g] && (AB + BLK)'(dirty_column_i[g*BLK+:BLK]) == (AB + BLK)'(f_block) % (AB + BLK)'(BX)) f_in_column = 1'b1;
    if (dirty_inside_y_i[g] && (AB + BLK)'(dirty_row_i[g*BLK+:BLK]) == (AB + BLK)'(f_block) / (AB + BLK)'(BX)) f_in_row = 1'b1;
  end
end
assign f_mark = dirty_valid_i && dirty_buffer_i == f_buffer && f_in_column && f_in_row;

// The block's mark, as the page has it, and what the walk did to it.
logic f_marked_q, f_picked_q, f_touched_q;
logic f_pick;
assign f_pick = sheet_re_o && sheet_buffer_o == f_buffer && sheet_addr_o == f_block;
always @(posedge clk_i) begin
  if (f_mark) f_marked_q <= 1'b1;
  if (f_pick) f_marked_q <= 1'b0;
  if (f_pick) f_picked_q <= 1'b1;
  if (done_i && done_buffer_i == f_buffer) f_picked_q <= 1'b0;
  // Of the tile: whatever the buffer.
  if (sheet_re_o && sheet_addr_o == f_block) f_touched_q <= 1'b1;
  if (tile_begin_i) f_touched_q <= 1'b0;
  if (!rst_ni) begin
    f_marked_q <= 1'b0;
    f_picked_q <= 1'b0;
    f_touched_q <= 1'b0;
  end
end

// When: a(s) = max(token at W + 2, f(s-1) + 4). Cycles since the token of each buffer, and since the last walk ended, to 3.
logic [1:0] f_full_q;       // handed over and not walked to its end
logic [1:0] f_age_q[0:1];   // 1: the cycle after the hand-over
logic [1:0] f_since_q;      // last pick: 0 is the cycle after it
logic f_turn_q;             // whose walk is next or under way
logic f_walking, f_begun_q;
assign f_walking = f_full_q[f_turn_q] && (f_begun_q || (f_age_q[f_turn_q] >= 2'd2 && f_since_q == 2'd3));
logic [AB-1:0] f_last_q;
always @(posedge clk_i) begin
  for (int m = 0; m < 2; m++) if (f_age_q[m] != 2'd3) f_age_q[m] <= f_age_q[m] + 2'd1;
  if (f_since_q != 2'd3) f_since_q <= f_since_q + 2'd1;
  f_begun_q <= f_walking && !free_o;
  if (sheet_re_o) f_last_q <= sheet_addr_o;
  if (free_o) begin
    f_full_q[free_buffer_o] <= 1'b0;
    f_since_q <= '0;
    f_turn_q <= !f_turn_q;
  end
  if (done_i) begin
    f_full_q[done_buffer_i] <= 1'b1;
    f_age_q[done_buffer_i] <= 2'd1;
  end
  if (!rst_ni) begin
    f_full_q <= '0;
    f_since_q <= 2'd3;
    f_turn_q <= 1'b0;
    f_begun_q <= 1'b0;
  end
end

// What is picked in k0 is written in k6.
logic [6:1] f_way_q;
logic [AB-1:0] f_at_q[1:6];
always @(posedge clk_i) begin
  f_way_q <= {f_way_q[5:1], sheet_re_o && rst_ni};
  f_at_q[1] <= sheet_addr_o;
  for (int s = 2; s <= 6; s++) f_at_q[s] <= f_at_q[s-1];
  if (!rst_ni) f_way_q <= '0;
end

// What core promises (core_proof.svh): no window marks a sheet that was handed over; a sheet is handed over once, and in
// turn; a tile begins when all is still.
always @* begin
  if (rst_ni) begin
    if (dirty_valid_i) assume (!f_full_q[dirty_buffer_i] && !(done_i && done_buffer_i == dirty_buffer_i));
    if (done_i) assume (!f_full_q[done_buffer_i] && done_buffer_i == (f_full_q == '0 ? f_turn_q : !f_turn_q));
    if (tile_begin_i) assume (idle_o);
    if (picture_re_i) assume (idle_o);
  end
end

logic f_dirty;  // the block's bit
assign f_dirty = f_buffer ? dirty[BY+f_block/BX][f_block%BX] : dirty[f_block/BX][f_block%BX];
always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // Each block once, and marked ones alone.
    assert (!f_pick || f_marked_q);
    assert (!f_pick || !f_picked_q);
    assert (!(free_o && free_buffer_o == f_buffer) || !f_marked_q || f_pick);
    // Rising, one a cycle, in its cycle: a walk picks from its first cycle to its last; a clean sheet's takes one.
    assert (!(sheet_re_o && f_begun_q) || sheet_addr_o > f_last_q);
    assert (sheet_re_o || free_o || !f_walking);
    assert (!(sheet_re_o || free_o) || f_walking);
    assert (!f_begun_q || sheet_re_o);
    assert (!(sheet_re_o || free_o) || (sheet_buffer_o == f_turn_q && free_buffer_o == f_turn_q));
    assert (idle_o == (f_full_q == '0 && f_way_q == '0 && f_since_q >= 2'd2));
    assert (blocks_touched_o[f_block] == f_touched_q);
    // Through the pipe.
    assert (tap_valid_o == f_way_q[6]);
    assert (!tap_valid_o || tap_block_o == f_at_q[6]);

    // For induction.
    assert (f_dirty == f_marked_q);
    assert (full_q == f_full_q);
    assert (state_q == StIdle || state_q == StWalk || state_q == StGap);
    assert (!f_begun_q || f_since_q == 2'd3);
    assert ((state_q == StWalk) == f_walking);
    assert ((state_q == StGap) == (f_since_q == 2'd0 || f_since_q == 2'd1));
    assert (state_q != StGap || gap_q == 2'd1 - f_since_q);
    assert (walk_buffer_q == (state_q == StGap ? !f_turn_q : f_turn_q));
    assert (valid_q == f_way_q);
    for (int s = 1; s <= 6; s++) assert (!f_way_q[s] || addr_q[s] == f_at_q[s]);
    assert (!f_begun_q || f_full_q[f_turn_q]);
    assert (f_full_q[f_turn_q] || !f_full_q[!f_turn_q]);
    for (int m = 0; m < 2; m++) assert (!f_full_q[m] || f_age_q[m] != '0);
    assert (!f_begun_q || f_marked_q == 1'b0 || f_buffer != f_turn_q || f_block > f_last_q);
    assert (!(f_picked_q && f_full_q[f_buffer]) || (f_begun_q && f_turn_q == f_buffer && f_block <= f_last_q));
    cover (f_pick && f_begun_q && free_o);
    cover (free_o && !sheet_re_o);
    cover (tap_valid_o && tap_block_o == f_block && f_full_q == 2'b11);
  end
end
