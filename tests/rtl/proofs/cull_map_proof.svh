// SPDX-License-Identifier: Apache-2.0
// The cull map and its tables (docs/microarchitecture.md, "Map"; docs/numerics.md, N-6.1-4, N-6.1-5), written again and
// put inside cull_map by prove_cull.sh: 2 x 2 blocks. A rectangle's words give the number of its blocks that were
// opaque when the last sheet but one had been composited; so does the map for windows. With cull_windows' proof, no
// window is left out if a pixel of it in the tile was not frozen. The compositor is any that keeps the page's times:
// blocks in rising order, a sheet's first in k6 four cycles after the last of the previous one, T never rising.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* assume (rst_ni == f_started);
localparam int F_BLOCKS = fastsplat_pkg::BLOCKS;

// One tile, of any sides.
(* anyconst *) logic [SIDE-1:0] f_width, f_height;
always @* assume (width_i == f_width && height_i == f_height && 32'(f_width) >= 1 && 32'(f_width) <= fastsplat_pkg::TILE_WIDTH &&
                  32'(f_height) >= 1 && 32'(f_height) <= fastsplat_pkg::TILE_HEIGHT && culls_i && !tile_end_i && !blank_i);
logic f_begun_q;
always @(posedge clk_i) f_begun_q <= rst_ni && (f_begun_q || tile_begin_i);
always @* begin
  assume (!tile_begin_i || !f_begun_q);
  assume (f_begun_q || (!block_valid_i && !finish_i && !re_i));
end

// The compositor: `finish` at f; blocks are in k6 from the cycle after the sheet before has left it to f + 6.
logic [6:1] f_finish_q;        // as of the page: 6 is k6 of the last pick
logic [1:0] f_gap_q;           // cycles since a sheet left k6, up to 3
logic f_leaves;
logic [F_BLOCKS-1:0] f_now_q, f_now, f_frozen_block;
logic [AB:0] f_least_q;        // the lowest block that may come
assign f_leaves = f_finish_q[6];
always @* begin
  f_frozen_block = '0;
  f_frozen_block[block_i] = 1'b1;
  f_now = f_now_q | ((block_valid_i && frozen_i == '1) ? f_frozen_block : '0);
  assume (32'(block_i) < F_BLOCKS);
  // inside the tile
  assume (!block_valid_i || ((32'(block_i) % BX) * P < 32'(f_width) && (32'(block_i) / BX) * P < 32'(f_height)));
  assume (!block_valid_i || ((AB + 1)'(block_i) >= f_least_q && f_gap_q == 2'd3));
  // frozen pixels stay frozen; changed: it was not frozen before
  assume (!(block_valid_i && f_now_q[block_i]) || (frozen_i == '1 && !changed_i));
  assume (!(block_valid_i && frozen_i == '1 && !f_now_q[block_i]) || changed_i);
  assume (!finish_i || f_finish_q[3:1] == '0);
end
always @(posedge clk_i) begin
  f_finish_q <= {f_finish_q[5:1], finish_i};
  f_now_q <= f_now;
  if (f_gap_q != 2'd3) f_gap_q <= f_gap_q + 2'd1;
  if (block_valid_i) f_least_q <= (AB + 1)'(block_i) + (AB + 1)'(1);
  if (f_leaves) begin
    f_gap_q <= '0;
    f_least_q <= '0;
  end
  if (!rst_ni) begin
    f_finish_q <= '0;
    f_now_q <= '0;
    f_gap_q <= 2'd3;
    f_least_q <= '0;
  end
end

// Decode and the test unit: sheets 0, 1, 2, ...; the table that each is tested against.
logic [2:0] f_left_q, f_whole_q;        // sheets that left k6, whole tables
logic [2:0] f_done_q;                   // sheets whose walk has ended
logic [F_BLOCKS-1:0] f_after_q[0:1];    // opaque when the sheet of that parity had left k6 (M-cull-8): what its table has to hold (M-cull-13)
always @(posedge clk_i) begin
  if (f_leaves) begin
    f_after_q[f_left_q[0]] <= f_now;
    f_left_q <= f_left_q + 3'd1;
  end
  if (finish_i) f_done_q <= f_done_q + 3'd1;
  if (whole_o) f_whole_q <= f_whole_q + 3'd1;
  if (!rst_ni) begin
    f_left_q <= '0;
    f_whole_q <= '0;
    f_done_q <= '0;
  end
end
(* anyseq *) logic [2:0] f_sheet;  // the one that is tested
logic [2:0] f_wait_q[0:1];          // cycles since its table is whole
always @* begin
  assume (f_done_q != 3'd6);        // so that numbers do not go round
  // Of the sheet that is splatted: two of them are alive.
  assume (!re_i || (f_sheet >= 3'd2 && f_sheet >= f_done_q && f_sheet - f_whole_q <= 3'd1 && sheet_i == f_sheet[0]));
  // begin_sheet leaves t0 a cycle after (M-cull-10), and a splat reads in t1, two cycles later
  assume (!re_i || f_wait_q[f_sheet[0]] >= 3'd3);
  assume (!re_i || (i0_i < i1_i && j0_i < j1_i && 32'(i1_i) * P < 32'(f_width) + P && 32'(j1_i) * P < 32'(f_height) + P));
  // A sheet waits for the table of the last but one: no third one ends before.
  assume (!finish_i || f_done_q - f_whole_q <= 3'd1);
end
always @(posedge clk_i) begin
  for (int p = 0; p < 2; p++) if (f_wait_q[p] != 3'd7) f_wait_q[p] <= f_wait_q[p] + 3'd1;
  if (whole_o) f_wait_q[f_whole_q[0]] <= 3'd1;
  if (!rst_ni) begin
    f_wait_q[0] <= '0;
    f_wait_q[1] <= '0;
  end
end

logic f_read_q = 1'b0;
logic [B-1:0] f_count, f_count_q;
always @* begin
  f_count = '0;
  for (int b = 0; b < F_BLOCKS; b++) begin
    if (f_after_q[sheet_i][b] && b % BX >= 32'(i0_i) && b % BX < 32'(i1_i) && b / BX >= 32'(j0_i) && b / BX < 32'(j1_i)) f_count = f_count + B'(1);
  end
end
always @(posedge clk_i) begin
  f_read_q <= rst_ni && re_i;
  f_count_q <= f_count;
  if (f_read_q) assert (count_o == f_count_q);  // M-cull-9, M-cull-13
  // Decode requests a row three cycles later still: windows have a map of the same moment (M-cull-5, M-cull-13).
  if (rst_ni && re_i)
    for (int b = 0; b < F_BLOCKS; b++) assert (copy[(sheet_i ? BY : 0)+b/BX][b%BX] == f_after_q[sheet_i][b]);
  cover (f_read_q && f_count_q == B'(1) && f_whole_q >= 3'd2 && f_after_q[0] != f_after_q[1]);
  cover (f_read_q && f_count_q == B'(4));
  cover (rst_ni && leaves && !left_any && any_q);
end
