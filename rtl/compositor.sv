// Unit "compositor": walks the dirty blocks of a finished sheet, one P x P block a cycle, lowest number first, clears them
// behind itself and composites them over the picture (docs/numerics.md, section 6; docs/microarchitecture.md).
// k0 pick -> k1 sums -> k2 factor -> k3 slope -> k4 slab, state -> k5 products -> k6 new state, written.
`include "assertions.svh"
`include "fault.svh"

module compositor (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,
    // factor table load, one word a cycle
    input  logic                                   factor_we_i,
    input  logic [fastsplat_pkg::SEG_LOG2:0]       factor_index_i,  // 0..G
    input  logic [fastsplat_pkg::FACTOR_BITS-1:0]  table_word_i,
    // tile
    input  logic                                   tile_begin_i,    // pulse: forget the picture
    input  logic [1:0]                             mode_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]    width_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]    height_i,
    // dirty marks from the splat path
    input  logic                                   dirty_valid_i,
    input  logic                                   dirty_buffer_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] dirty_column_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] dirty_row_i,
    input  logic [fastsplat_pkg::LANES-1:0]        dirty_inside_x_i,
    input  logic [fastsplat_pkg::LANES-1:0]        dirty_inside_y_i,
    // sheets: done hands a buffer over, free gives it back
    input  logic                                   done_i,
    input  logic                                   done_buffer_i,
    output logic                                   free_o,
    output logic                                   free_buffer_o,
    output logic                                   idle_o,          // no sheet waiting, walking or in the pipe
    // sheet buffer
    output logic                                   sheet_re_o,
    output logic                                   sheet_buffer_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0]    sheet_addr_o,
    input  logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] sheet_data_i,  // k1
    // pixel out reads the picture when idle
    input  logic                                   picture_re_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]    picture_addr_i,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] picture_o,     // a cycle later
    output logic [fastsplat_pkg::BLOCKS-1:0]       blocks_touched_o,  // blocks that any sheet of the tile reached
    // taps and events, k6
    output logic                                   tap_valid_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0]    tap_block_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] tap_state_o,
    output logic [fastsplat_pkg::BANKS-1:0]        tap_inside_o,
    output logic [fastsplat_pkg::BANKS-1:0]        tap_frozen_o,
    output logic [4*fastsplat_pkg::BANKS-1:0]      tap_opacity_saturated_o,
    output logic [4*fastsplat_pkg::BANKS-1:0]      tap_saturated_o,
    output logic                                   tap_sheet_o    // pulse: a sheet's walk ended
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int NB = fastsplat_pkg::BLOCKS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int BLK = fastsplat_pkg::BLK_BITS;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int DB = fastsplat_pkg::STATE_BITS;
  localparam int FB = fastsplat_pkg::FACTOR_BITS;
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;

  // ---- dirty maps: a window marks at most two block columns and two block rows
  logic [NB-1:0] dirty_q[0:1];
  logic [NB-1:0] mark;
  logic [BX-1:0] mark_x;
  logic [fastsplat_pkg::BLOCKS_Y-1:0] mark_y;
  always_comb begin
    mark_x = '0;
    mark_y = '0;
    mark   = '0;
    if (dirty_valid_i) begin
      for (int g = 0; g < P; g++) begin
        if (dirty_inside_x_i[g]) mark_x[dirty_column_i[g*BLK+:BLK]] = 1'b1;
        if (dirty_inside_y_i[g]) mark_y[dirty_row_i[g*BLK+:BLK]] = 1'b1;
      end
      for (int r = 0; r < fastsplat_pkg::BLOCKS_Y; r++) begin
        if (mark_y[r] && !(`FASTSPLAT_FAULT(MISSED_DIRTY) && r % 4 == 2)) mark[r*BX+:BX] = mark_x;
      end
    end
  end

  // ---- walk
  typedef enum logic [1:0] {StIdle, StWalk, StGap} state_e;
  state_e state_q;
  logic [1:0] gap_q;
  logic walk_buffer_q;
  logic [1:0] full_q;
  logic [NB-1:0] walk_dirty, lowest, rest;
  logic [AB-1:0] pick;
  logic any, issue, finish;
  function automatic logic [AB*NB-1:0] number_has_bit(input int unused_argument);
    number_has_bit = '0;
    for (int k = 0; k < AB; k++) begin
      for (int b = 0; b < NB; b++) number_has_bit[k*NB+b] = ((b >> k) & 1) != 0;
    end
  endfunction
  localparam logic [AB*NB-1:0] NUMBER_HAS_BIT = number_has_bit(0);
  assign walk_dirty = walk_buffer_q ? dirty_q[1] : dirty_q[0];
  assign lowest = walk_dirty & (~walk_dirty + NB'(1));
  assign rest = walk_dirty & ~lowest;
  assign any = |walk_dirty;
  always_comb begin
    // One-hot to number: bit k is set when the hot bit's number has bit k.
    pick = '0;
    if (state_q == StWalk) begin
      for (int k = 0; k < AB; k++) pick[k] = |(lowest & NUMBER_HAS_BIT[k*NB+:NB]);
    end
  end
  assign issue = state_q == StWalk && any;
  assign finish = state_q == StWalk && rest == '0;
  assign sheet_re_o = issue;
  assign sheet_buffer_o = walk_buffer_q;
  assign sheet_addr_o = pick;
  assign free_o = finish;
  assign free_buffer_o = walk_buffer_q;
  assign tap_sheet_o = finish;

  logic [NB-1:0] touched_q;
  always_ff @(posedge clk_i) begin
    for (int m = 0; m < 2; m++) begin
      dirty_q[m] <= (dirty_q[m] | (dirty_buffer_i == 1'(m) ? mark : '0)) & ~((issue && walk_buffer_q == 1'(m)) ? lowest : '0);
    end
    if (issue) touched_q <= touched_q | lowest;
    if (tile_begin_i && !`FASTSPLAT_FAULT(STALE_PICTURE)) touched_q <= '0;
    case (state_q)
      StIdle: if (full_q[walk_buffer_q]) state_q <= StWalk;
      StWalk:
      if (finish) begin
        full_q[walk_buffer_q] <= 1'b0;
        state_q <= StGap;
        gap_q <= 2'd1;
      end
      StGap: begin
        gap_q <= gap_q - 2'd1;
        if (gap_q == 2'd0) begin
          state_q <= StIdle;
          walk_buffer_q <= !walk_buffer_q;
        end
      end
      default: state_q <= StIdle;
    endcase
    if (done_i) full_q[done_buffer_i] <= 1'b1;
    if (!rst_ni) begin
      state_q <= StIdle;
      gap_q <= '0;
      walk_buffer_q <= 1'b0;
      full_q <= '0;
      dirty_q[0] <= '0;
      dirty_q[1] <= '0;
      touched_q <= '0;
    end
  end

  // ---- pipe control
  logic [6:1] valid_q;
  logic [AB-1:0] addr_q[1:6];
  logic [4:1] touched_k_q;
  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[5:1], issue};
    if (!rst_ni) valid_q <= '0;
    touched_k_q <= {touched_k_q[3:1], |(touched_q & lowest)};
    addr_q[1] <= pick;
    for (int s = 2; s <= 6; s++) addr_q[s] <= addr_q[s-1];
  end
  assign idle_o = state_q == StIdle && full_q == '0 && valid_q == '0;

  // ---- factor table: word j closes segment j-1
  logic [FB-1:0] previous_q;
  logic segment_we;
  logic [fastsplat_pkg::SEG_LOG2-1:0] segment;
  logic [2*FB-1:0] segment_word;
  always_ff @(posedge clk_i) if (factor_we_i) previous_q <= table_word_i;
  assign segment_we = factor_we_i && factor_index_i != '0;
  assign segment = fastsplat_pkg::SEG_LOG2'(factor_index_i - (fastsplat_pkg::SEG_LOG2 + 1)'(1));
  assign segment_word = {previous_q, previous_q - table_word_i};

  // ---- which pixels of the block lie in the tile, k5
  logic [SIDE+1:0] block_x, block_y;
  localparam int BXL = $clog2(BX);
  logic [AB-1:0] number_x, number_y;
  assign number_x = addr_q[5] & AB'(BX - 1);
  assign number_y = addr_q[5] >> BXL;
  assign block_x = (SIDE + 2)'(number_x) << fastsplat_pkg::LANE_LOG2;
  assign block_y = (SIDE + 2)'(number_y) << fastsplat_pkg::LANE_LOG2;

  logic [AB-1:0] picture_raddr;
  assign picture_raddr = picture_re_i ? picture_addr_i : addr_q[3];

  for (genvar h = 0; h < P; h++) begin : gen_row
    for (genvar g = 0; g < P; g++) begin : gen_lane
      localparam int B = h * P + g;
      logic [4*DB-1:0] slab, state_k4, memory_word, state_k6, blank;
      logic [3:0] opacity_saturated_k4, opacity_saturated_k5_q, opacity_saturated_k6_q;
      slab_opacity u_opacity (
          .clk_i,
          .we_i(segment_we),
          .waddr_i(segment),
          .wdata_i(segment_word),
          .mode_i,
          .sums_i(sheet_data_i[B*4*SB+:4*SB]),
          .slab_o(slab),
          .saturated_o(opacity_saturated_k4)
      );
      ram_1r1w #(.BITS(4 * DB), .WORDS(NB), .ADDR(AB)) u_picture (
          .clk_i,
          .re_i(valid_q[3] || picture_re_i),
          .raddr_i(picture_raddr),
          .rdata_o(memory_word),
          .we_i(rst_ni && valid_q[6]),
          .waddr_i(addr_q[6]),
          .wdata_i(state_k6)
      );
      assign blank = (mode_i == 2'd2) ? '0 : {DB'(1) << fastsplat_pkg::TRANS_FRAC, {(3 * DB) {1'b0}}};
      assign state_k4 = touched_k_q[4] ? memory_word : blank;
      composite_lane u_composite (
          .clk_i,
          .mode_i,
          .slab_i(slab),
          .state_i(state_k4),
          .state_o(state_k6),
          .frozen_o(tap_frozen_o[B]),
          .saturated_o(tap_saturated_o[4*B+:4])
      );
      assign picture_o[B*4*DB+:4*DB] = memory_word;
      assign tap_state_o[B*4*DB+:4*DB] = state_k6;
      always_ff @(posedge clk_i) begin
        opacity_saturated_k5_q <= opacity_saturated_k4;
        opacity_saturated_k6_q <= opacity_saturated_k5_q;
        tap_inside_o[B] <= (block_x + (SIDE + 2)'(g)) < (SIDE + 2)'(width_i) && (block_y + (SIDE + 2)'(h)) < (SIDE + 2)'(height_i);
      end
      assign tap_opacity_saturated_o[4*B+:4] = opacity_saturated_k6_q;
      // What is absorbed comes off the transmittance: it never rises and never wraps.
      `FASTSPLAT_ASSERT(transmittance_falls, !valid_q[6] || mode_i == 2'd2 || state_k6[3*DB+:DB] <= $past(state_k4[3*DB+:DB], 2))
    end
  end
  assign tap_valid_o = valid_q[6];
  assign tap_block_o = addr_q[6];

  // Which blocks hold a picture: pixel out asks by address.
  assign blocks_touched_o = touched_q;
  `FASTSPLAT_ASSERT(pick_is_one_block, $onehot0(lowest))
  `FASTSPLAT_ASSERT(pick_is_dirty, !sheet_re_o || walk_dirty[pick])
  `FASTSPLAT_ASSERT(walk_owns_its_sheet, state_q != StWalk || full_q[walk_buffer_q])
  `FASTSPLAT_ASSERT(handed_over_once, !done_i || !full_q[done_buffer_i])
  `FASTSPLAT_ASSERT_NEXT(walk_leaves_no_dirt, finish, walk_dirty == '0)
  `FASTSPLAT_ASSERT(no_mark_behind_the_walk, !(dirty_valid_i && full_q[dirty_buffer_i]))
  `FASTSPLAT_ASSERT(picture_sent_when_still, !picture_re_i || idle_o)
  `FASTSPLAT_COVER(empty_sheet_walked, finish && !any)
endmodule
