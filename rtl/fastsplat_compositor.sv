// Unit "compositor": takes the dirty blocks of a finished sheet, one P x P block a cycle, lowest number first, clears them
// behind itself and composites them over the picture (docs/numerics.md, section 6; docs/microarchitecture.md).
// k0 pick -> k1 sums -> k2 factor -> k3 slope, picture -> k4 slab, state -> k5 products -> k6 new state, written.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_compositor (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,
    // factor table load, one word a cycle
    input  logic                                   factor_we_i,
    input  logic [fastsplat_pkg::SEG_LOG2:0]       factor_index_i,  // 0..G
    input  logic [fastsplat_pkg::FACTOR_BITS-1:0]  table_word_i,
    // picture memory after reset: a word a cycle to blank
    input  logic                                   wipe_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]    wipe_addr_i,
    // tile
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
    // sheets: marked says that all of its windows have marked, done hands a buffer over, free gives it back
    input  logic                                   marked_i,
    input  logic                                   marked_buffer_i,
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
    // pixel out reads the picture when idle, and leaves it blank
    input  logic                                   picture_re_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]    picture_addr_i,
    input  logic [fastsplat_pkg::LANES-1:0]        picture_row_i,     // of the block, one bit each; a cycle later
    output logic [fastsplat_pkg::LANES*4*fastsplat_pkg::STATE_BITS-1:0] picture_o,     // with it
    // taps and events, k6
    output logic                                   tap_valid_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0]    tap_block_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] tap_state_o,
    output logic [fastsplat_pkg::LANES-1:0]        tap_inside_x_o,  // by lane column and row
    output logic [fastsplat_pkg::LANES-1:0]        tap_inside_y_o,
    output logic [fastsplat_pkg::BANKS-1:0]        tap_frozen_o,
    output logic [4*fastsplat_pkg::BANKS-1:0]      tap_opacity_saturated_o,
    output logic [4*fastsplat_pkg::BANKS-1:0]      tap_saturated_o,
    output logic                                   tap_sheet_o    // pulse: a sheet's walk ended
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int NB = fastsplat_pkg::BLOCKS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int DB = fastsplat_pkg::STATE_BITS;
  localparam int FB = fastsplat_pkg::FACTOR_BITS;
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;

  // ---- k0: a dirty block a cycle
  logic issue, finish, walk_idle;
  logic [AB-1:0] pick;
  fastsplat_dirty_map u_dirty (
      .clk_i,
      .rst_ni,
      .mark_i(dirty_valid_i),
      .mark_buffer_i(dirty_buffer_i),
      .mark_column_i(dirty_column_i),
      .mark_row_i(dirty_row_i),
      .mark_inside_x_i(dirty_inside_x_i),
      .mark_inside_y_i(dirty_inside_y_i),
      .marked_i,
      .marked_buffer_i,
      .done_i,
      .done_buffer_i,
      .valid_o(issue),
      .buffer_o(sheet_buffer_o),
      .block_o(pick),
      .finish_o(finish),
      .idle_o(walk_idle)
  );
  assign sheet_re_o = issue;
  assign sheet_addr_o = pick;
  assign free_o = finish;
  assign free_buffer_o = sheet_buffer_o;
  assign tap_sheet_o = finish;

  // ---- pipe control
  logic [6:1] valid_q;
  logic [AB-1:0] addr_q[1:6];
  logic still_q;  // valid_q is 0: what waits for rest waits for no comparison
  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[5:1], issue};
    still_q <= !rst_ni || {valid_q[5:1], issue} == '0;
    if (!rst_ni) valid_q <= '0;
    addr_q[1] <= pick;
    for (int s = 2; s <= 6; s++) addr_q[s] <= addr_q[s-1];
  end
  assign idle_o = walk_idle && still_q;

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

  always_ff @(posedge clk_i) begin
    if (valid_q[5]) begin
      for (int g = 0; g < P; g++) begin
        tap_inside_x_o[g] <= (block_x + (SIDE + 2)'(g)) < (SIDE + 2)'(width_i);
        tap_inside_y_o[g] <= (block_y + (SIDE + 2)'(g)) < (SIDE + 2)'(height_i);
      end
    end
  end

  // ---- picture: blank is 0, so the top bit of a transmittance is kept inverted (1.0 is that bit alone). Written rows lie in
  // the tile: pixel out reads each of them once, and what was read is blanked in the next cycle.
  logic [AB-1:0] picture_raddr, picture_waddr, sent_addr_q;
  logic sent_q;
  logic [4*DB-1:0] transparent;
  assign picture_raddr = picture_re_i ? picture_addr_i : addr_q[2];
  assign picture_waddr = wipe_i ? wipe_addr_i : sent_q ? sent_addr_q : addr_q[6];
  assign transparent = (mode_i == 2'd2) ? '0 : {DB'(1) << fastsplat_pkg::TRANS_FRAC, {(3 * DB) {1'b0}}};
  always_ff @(posedge clk_i) begin
    sent_q <= picture_re_i && !`FASTSPLAT_FAULT(STALE_PICTURE);
    sent_addr_q <= picture_addr_i;
    if (!rst_ni) sent_q <= 1'b0;
  end

  // k2 reads. The first block of a sheet may be the last of the one before, at the least four cycles ago: then it is written in
  // this cycle, and the lane holds it in the next.
  logic forward_q;
  always_ff @(posedge clk_i) forward_q <= valid_q[6] && addr_q[6] == addr_q[2];

  logic [4*DB-1:0] picture[0:P*P-1], state_k4_q[0:P*P-1], states[0:P*P-1];
  for (genvar h = 0; h < P; h++) begin : gen_row
    for (genvar g = 0; g < P; g++) begin : gen_lane
      localparam int B = h * P + g;
      logic [4*DB-1:0] slab;
      logic [3:0] opacity_saturated_k4, opacity_saturated_k5_q, opacity_saturated_k6_q;
      fastsplat_slab_opacity u_opacity (
          .clk_i,
          .we_i(segment_we),
          .waddr_i(segment),
          .wdata_i(segment_word),
          .valid_i(valid_q[3:1]),
          .mode_i,
          .sums_i(sheet_data_i[B*4*SB+:4*SB]),
          .slab_o(slab),
          .saturated_o(opacity_saturated_k4)
      );
      fastsplat_ram_1r1w #(.BITS(4 * DB), .WORDS(NB), .ADDR(AB)) u_picture (
          .clk_i,
          .re_i(valid_q[2] || picture_re_i),
          .raddr_i(picture_raddr),
          .rdata_o(picture[B]),
          .we_i(wipe_i || (sent_q && picture_row_i[h]) || (valid_q[6] && tap_inside_y_o[h])),
          .waddr_i(picture_waddr),
          .wdata_i((wipe_i || sent_q) ? '0 : states[B] ^ transparent)
      );
      fastsplat_composite_lane u_composite (
          .clk_i,
          .rst_ni,
          .valid_i(valid_q[5:4]),
          .mode_i,
          .slab_i(slab),
          .state_i(state_k4_q[B]),
          .state_o(states[B]),
          .frozen_o(tap_frozen_o[B]),
          .saturated_o(tap_saturated_o[4*B+:4])
      );
      always_ff @(posedge clk_i) begin
        if (valid_q[3]) state_k4_q[B] <= (forward_q && tap_inside_y_o[h]) ? states[B] : picture[B] ^ transparent;
        if (valid_q[4]) opacity_saturated_k5_q <= opacity_saturated_k4;
        if (valid_q[5]) opacity_saturated_k6_q <= opacity_saturated_k5_q;
      end
      assign tap_opacity_saturated_o[4*B+:4] = opacity_saturated_k6_q;
    end
  end
  always_comb begin
    picture_o = '0;  // verilator lint_off WIDTHCONCAT
    tap_state_o = '0;  // verilator lint_on WIDTHCONCAT
    for (int h = 0; h < P; h++) begin
      for (int g = 0; g < P; g++) begin
        if (picture_row_i[h]) picture_o[g*4*DB+:4*DB] = picture[h*P+g] ^ transparent;
        if (valid_q[6]) tap_state_o[(h*P+g)*4*DB+:4*DB] = states[h*P+g];
      end
    end
  end
  assign tap_valid_o = valid_q[6];
  assign tap_block_o = addr_q[6];

  `FASTSPLAT_ASSERT(rest_foretold, still_q == (valid_q == '0))
  `FASTSPLAT_ASSERT(picture_sent_when_still, !picture_re_i || idle_o)
  `FASTSPLAT_ASSERT(picture_has_one_writer, $onehot0({wipe_i, sent_q, valid_q[6]}))
endmodule
