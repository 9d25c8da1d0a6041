// SPDX-License-Identifier: Apache-2.0
// The dirty blocks of both sheet buffers and the walk over those of a finished sheet: lowest number first, one slice of
// a block a cycle (docs/microarchitecture.md, "Dirty walk" and "Slices"; cmodel/splat/dirty_map.hpp).
// No cycle looks at the whole map: f1 lowest dirty row -> f2 its blocks -> f3 the row being walked -> k0 block. The
// three cycles of f1 to f3 pass while the end of the sheet goes down the splat path, or the last blocks of the sheet
// before go down the compositor's.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_dirty_map (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,
    input  logic                                   whole_i,   // a block is one slice, whatever SLICES is; held over a tile
    input  logic                                   hold_i,    // no walk begins
    // c3: a window marks the blocks it meets inside the tile, at most two block columns and two block rows
    input  logic                                   mark_i,
    input  logic                                   mark_buffer_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] mark_column_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] mark_row_i,
    input  logic [fastsplat_pkg::LANES-1:0]        mark_inside_x_i,
    input  logic [fastsplat_pkg::LANES-1:0]        mark_inside_y_i,
    // c4: the last window of this buffer's sheet has marked
    input  logic                                   marked_i,
    input  logic                                   marked_buffer_i,
    // W: the sums of this buffer are complete
    input  logic                                   done_i,
    input  logic                                   done_buffer_i,
    // k0
    output logic                                   valid_o,   // a slice of a block
    output logic                                   buffer_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0]    block_o,
    output logic [fastsplat_pkg::SLICE_BITS-1:0]   slice_o,
    output logic                                   finish_o,  // the sheet's last slice, or a sheet without blocks
    output logic                                   idle_o     // no finished sheet waits or is walked, nor was in the last 2 cycles
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int BLK = fastsplat_pkg::BLK_BITS;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int BY = fastsplat_pkg::BLOCKS_Y;
  localparam int BXL = $clog2(BX);
  localparam int XB = BX > 1 ? BXL : 1;
  localparam int YB = BY > 1 ? $clog2(BY) : 1;

  logic [BX-1:0] mark_x;
  logic [BY-1:0] mark_y;
  always_comb begin
    mark_x = '0;
    mark_y = '0;
    for (int g = 0; g < P; g++) begin
      if (mark_inside_x_i[g]) mark_x[mark_column_i[g*BLK+:XB]] = 1'b1;
      if (mark_i && mark_inside_x_i != '0 && mark_inside_y_i[g]) mark_y[mark_row_i[g*BLK+:YB]] = 1'b1;
    end
    if (`FASTSPLAT_FAULT(MISSED_DIRTY)) for (int r = 2; r < BY; r += 4) mark_y[r] = 1'b0;
  end

  // ---- the walk's control
  typedef enum logic [1:0] {StIdle, StRow, StBlocks, StWalk} state_e;  // fills f1, f2, f3; then walks
  state_e state_q;
  logic buffer_q;  // walked, or next to be
  logic [1:0] marked_q, full_q;
  logic f1_valid_q, f2_valid_q;
  logic [BX-1:0] f2_row_q, f3_row_q, f3_rest_q, f2_rest, rest;  // rest: a row without its lowest block
  logic start, advance, walking, go, one_left_q, finish;  // go: the block's last slice, or an empty walk
  logic [2:0] finish_q;
  logic [fastsplat_pkg::SLICE_BITS-1:0] slice_q;
  assign start = state_q == StIdle && marked_q[buffer_q];
  assign walking = state_q == StWalk && full_q[buffer_q] && !(fastsplat_pkg::DENSITIES != 0 && hold_i);
  assign go = walking && (fastsplat_pkg::SLICES == 1 || (fastsplat_pkg::DENSITIES != 0 && whole_i) || slice_q == fastsplat_pkg::SLICE_BITS'(fastsplat_pkg::SLICES - 1) || f3_row_q == '0);
  assign f2_rest = f2_row_q & (f2_row_q - BX'(1));
  assign rest = f3_rest_q & (f3_rest_q - BX'(1));
  // Rows follow one another without a gap: where f2 is empty there are no more.
  assign finish = go && one_left_q && !f2_valid_q;
  assign advance = start || state_q == StRow || state_q == StBlocks || (go && one_left_q);

  // ---- the maps, of buffer 0 and 1: which rows hold dirt, and which blocks of a row. Fetched bits are cleared.
  logic [BY-1:0] rows_q[0:1], f1_row, f1_row_q;
  logic [BX-1:0] dirty[0:2*BY-1], f2_row;
  logic [BY-1:0] fetched_q;  // the row that went to f2; cleared a cycle later, because the whole map waits for this
  logic fetched_buffer_q;
  assign f1_row = rows_q[buffer_q] & (~rows_q[buffer_q] + BY'(1));
  for (genvar m = 0; m < 2; m++) begin : gen_buffer
    always_ff @(posedge clk_i) begin
      rows_q[m] <= (rows_q[m] | (mark_buffer_i == 1'(m) ? mark_y : '0)) & ~((advance && buffer_q == 1'(m)) ? f1_row : '0);
      if (!rst_ni) rows_q[m] <= '0;
    end
    for (genvar r = 0; r < BY; r++) begin : gen_row
      logic [BX-1:0] row_q;
      always_ff @(posedge clk_i) begin
        if (mark_y[r] && mark_buffer_i == 1'(m)) row_q <= row_q | mark_x;
        if (!rst_ni || (fetched_q[r] && fetched_buffer_q == 1'(m))) row_q <= '0;
      end
      assign dirty[m*BY+r] = row_q;
    end
  end

  logic [YB-1:0] f2_number, f2_number_q, f3_number_q;
  logic [XB-1:0] column;
  always_comb begin
    f2_row = '0;
    f2_number = '0;
    column = '0;
    for (int r = 0; r < BY; r++) begin
      if (f1_row_q[r]) begin
        f2_row = f2_row | (buffer_q ? dirty[BY+r] : dirty[r]);
        f2_number = f2_number | YB'(r);
      end
    end
    for (int b = 0; b < BX; b++) if (f3_row_q[b] && !f3_rest_q[b]) column = column | XB'(b);
  end

  always_ff @(posedge clk_i) begin
    fetched_q <= advance ? f1_row_q : '0;
    fetched_buffer_q <= buffer_q;
    if (advance) begin
      f1_row_q <= f1_row;
      f1_valid_q <= f1_row != '0;
      f2_row_q <= f2_row;
      f2_number_q <= f2_number;
      f2_valid_q <= f1_valid_q;
      f3_number_q <= f2_number_q;
    end
    // One block left in the row, or none: known a cycle ahead, because the whole fetch waits for it.
    if (advance) begin
      f3_row_q <= f2_row_q;
      f3_rest_q <= f2_rest;
      one_left_q <= f2_rest == '0;
    end else if (go) begin
      f3_row_q <= f3_rest_q;
      f3_rest_q <= rest;
      one_left_q <= rest == '0;
    end

    case (state_q)
      StIdle: if (start) state_q <= StRow;
      StRow: state_q <= StBlocks;
      StBlocks: state_q <= StWalk;
      default:
      if (finish) begin
        state_q <= StIdle;
        buffer_q <= !buffer_q;
        marked_q[buffer_q] <= 1'b0;
        full_q[buffer_q] <= 1'b0;
      end
    endcase
    if (marked_i) marked_q[marked_buffer_i] <= 1'b1;
    if (done_i) full_q[done_buffer_i] <= 1'b1;
    finish_q <= {finish_q[1:0], finish};
    idle_o <= full_q == '0 && !done_i && !finish && finish_q[1:0] == '0;
    valid_o <= walking && f3_row_q != '0;
    slice_q <= (walking && !go) ? slice_q + fastsplat_pkg::SLICE_BITS'(1) : '0;
    slice_o <= slice_q;
    buffer_o <= buffer_q;
    block_o <= (AB'(f3_number_q) << BXL) | AB'(column);
    if (!rst_ni) begin
      state_q <= StIdle;
      buffer_q <= 1'b0;
      marked_q <= '0;
      full_q <= '0;
      f1_row_q <= '0;
      f1_valid_q <= 1'b0;
      fetched_q <= '0;
      f2_row_q <= '0;
      f2_valid_q <= 1'b0;
      f3_row_q <= '0;
      slice_q <= '0;
      finish_q <= '0;
      idle_o <= 1'b1;
      valid_o <= 1'b0;
    end
  end
  assign finish_o = finish_q[0];

  logic [BY-1:0] left;  // rows that hold dirt of the buffer whose walk ends
  for (genvar r = 0; r < BY; r++) begin : gen_left
    assign left[r] = (buffer_q ? dirty[BY+r] : dirty[r]) != '0;
  end
  `FASTSPLAT_ASSERT(walk_leaves_no_dirt, !finish || (left == '0 && rows_q[buffer_q] == '0))
  `FASTSPLAT_ASSERT(last_of_row_foretold, !go || (f3_rest_q == (f3_row_q & (f3_row_q - BX'(1))) && one_left_q == (f3_rest_q == '0)))
  `FASTSPLAT_ASSERT(rows_without_gap, !(state_q == StWalk && f3_row_q == '0) || (!f1_valid_q && !f2_valid_q))
  `FASTSPLAT_ASSERT(walk_owns_its_sheet, !valid_o || finish_o || full_q[buffer_o])
  `FASTSPLAT_ASSERT(rest_foretold, idle_o == (full_q == '0 && finish_q == '0))
  `FASTSPLAT_ASSERT(handed_over_once, !done_i || !full_q[done_buffer_i])
  `FASTSPLAT_ASSERT(marked_before_done, !done_i || marked_q[done_buffer_i] || (marked_i && marked_buffer_i == done_buffer_i))
  `FASTSPLAT_ASSERT(no_mark_behind_the_walk, !(mark_i && marked_q[mark_buffer_i]))
  `FASTSPLAT_COVER(empty_sheet_walked, finish_o && !valid_o)
endmodule
