// SPDX-License-Identifier: Apache-2.0
// Unit "compositor": takes the dirty blocks of a finished sheet, lowest number first, one slice of COMPOSITE_LANES
// pixels of a P x P block a cycle. Clears them behind itself and composites them over the picture (docs/numerics.md,
// section 6; docs/microarchitecture.md).
// k0 pick -> k1 sums -> k2 factor -> k3 slope, picture -> k4 slab, state -> k5 products -> k6 new state, written.
// In tiles that composite every sample, the splat array's windows use the same pipe: products in place of sums, each
// bank with its own address (fastsplat_sample_places.sv). No block is dirty then.
// In tiles of densities, dirty blocks are only passed on, a block a cycle, and come back classified
// (fastsplat_densities.sv). Sheets and picture then lie one pixel further right and down.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_compositor (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,
    // factor table load, one word a cycle
    input  logic                                   factor_we_i,
    input  logic [31:0]                            table_index_i,   // 0..G
    input  logic [31:0]                            table_word_i,
    // picture memory after reset: a word a cycle to blank
    input  logic                                   wipe_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]    wipe_addr_i,
    // tile
    input  logic [1:0]                             mode_i,
    input  logic                                   every_sample_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]    width_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]    height_i,
    // every sample: a window comes in k0, its products and places in k1
    input  logic                                   sample_valid_i,
    input  logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] sample_products_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] sample_column_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] sample_row_i,
    input  logic [fastsplat_pkg::LANES-1:0]        sample_inside_x_i,
    input  logic [fastsplat_pkg::LANES-1:0]        sample_inside_y_i,
    input  logic [fastsplat_pkg::BANKS-1:0]        sample_weighted_i,
    // densities: their tables, the tile's place in the image, a finished sheet's number; flush: no sheet comes any more
    input  logic                                   densities_i,
    input  logic                                   density_we_i,
    input  logic [7:0]                             table_i,
    input  logic [63:0]                            place_i,
    input  logic [31:0]                            sheet_number_i,
    input  logic                                   flush_i,
    // dirty marks from the splat path
    input  logic                                   dirty_valid_i,
    input  logic                                   dirty_buffer_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] dirty_column_i,
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] dirty_row_i,
    input  logic [fastsplat_pkg::LANES-1:0]        dirty_inside_x_i,
    input  logic [fastsplat_pkg::LANES-1:0]        dirty_inside_y_i,
    // sheets: marked: all windows of the sheet have marked; done hands a buffer over; free gives it back
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
    // tap, k6 of a block's last slice, or of a window
    output logic                                   tap_valid_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0]    tap_block_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] tap_state_o,
    output logic                                   tap_sheet_o,     // pulse: a sheet's walk ended
    // culling, k6 of a block's last slice: pixels now terminated or outside the tile; whether one is newly terminated
    output logic [fastsplat_pkg::BANKS-1:0]        cull_frozen_o,
    output logic                                   cull_changed_o,
    // the picture's words being blanked
    output logic                                   blank_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0]    blank_addr_o,
    // events of a slice, k6
    output logic                                   event_valid_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES-1:0]   event_inside_o,  // in the tile; of windows only those of weight
    output logic [fastsplat_pkg::COMPOSITE_LANES-1:0]   event_frozen_o,
    output logic [4*fastsplat_pkg::COMPOSITE_LANES-1:0] event_opacity_saturated_o,
    output logic [4*fastsplat_pkg::COMPOSITE_LANES-1:0] event_saturated_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int C = fastsplat_pkg::COMPOSITE_LANES;
  localparam int R = fastsplat_pkg::SLICES;
  localparam int LB = fastsplat_pkg::SLICE_BITS;
  localparam int NB = fastsplat_pkg::BLOCKS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int DB = fastsplat_pkg::STATE_BITS;
  localparam int FB = fastsplat_pkg::FACTOR_BITS;
  localparam int TB = fastsplat_pkg::TRANS_BITS;
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;

  // ---- k0: a slice of a dirty block a cycle. Its first slice reads the block's sums; the banks hold them for the
  // others.
  logic issue, finish, walk_idle;
  logic [AB-1:0] pick;
  logic [LB-1:0] slice;
  logic classified;  // densities are composited
  assign classified = fastsplat_pkg::DENSITIES != 0 && densities_i;
  // Unit "densities", between dirty walk and pipe: blocks leave in k0, slices come back in k0, their sums in k1.
  logic density_hold, density_free, density_idle, density_valid, density_done;
  logic [AB-1:0] density_block;
  logic [LB-1:0] density_slice;
  logic [C*4*SB-1:0] density_sums;
  if (fastsplat_pkg::DENSITIES != 0) begin : gen_densities
    fastsplat_densities u_densities (
        .clk_i,
        .rst_ni,
        .table_we_i(density_we_i),
        .table_i,
        .table_index_i,
        .table_word_i,
        .place_i,
        .copy_i(classified && issue),
        .copy_block_i(pick),
        .finish_i(classified && finish),
        .number_i(sheet_number_i),
        .sheet_data_i,
        .flush_i,
        .hold_o(density_hold),
        .free_o(density_free),
        .idle_o(density_idle),
        .valid_o(density_valid),
        .slice_o(density_slice),
        .block_o(density_block),
        .done_o(density_done),
        .sums_o(density_sums)
    );
  end else begin : gen_colours
    assign {density_hold, density_free, density_valid, density_done, density_block, density_slice} = '0;
    for (genvar lane = 0; lane < C; lane++) begin : gen_none
      assign density_sums[lane*4*SB+:4*SB] = '0;
    end
    assign density_idle = 1'b1;
    logic unused_densities;
    assign unused_densities = &{1'b0, densities_i, density_we_i, table_i, table_index_i, table_word_i, place_i, sheet_number_i, flush_i,
                                density_free, density_done, density_valid, density_block, density_slice, density_sums};
  end
  fastsplat_dirty_map u_dirty (
      .clk_i,
      .rst_ni,
      .whole_i(classified),
      .hold_i(density_hold),
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
      .slice_o(slice),
      .finish_o(finish),
      .idle_o(walk_idle)
  );
  assign sheet_re_o = issue && (R == 1 || slice == '0);
  assign sheet_addr_o = pick;
  // In tiles of densities a buffer is free once the sheet before the copied one has been classified.
  if (fastsplat_pkg::DENSITIES != 0) begin : gen_late_free
    logic buffer_q;
    always_ff @(posedge clk_i) if (finish) buffer_q <= sheet_buffer_o;
    assign free_o = classified ? density_free : finish;
    assign free_buffer_o = finish ? sheet_buffer_o : buffer_q;
  end else begin : gen_free
    assign free_o = finish;
    assign free_buffer_o = sheet_buffer_o;
  end
  assign tap_sheet_o = classified ? density_done : finish;

  // ---- every sample
  logic sampling;
  assign sampling = fastsplat_pkg::EVERY_SAMPLE != 0 && every_sample_i;

  // ---- pipe control
  logic picked;
  assign picked = classified ? density_valid : issue || (sampling && sample_valid_i);
  logic [6:1] valid_q;
  logic [AB-1:0] addr_q[1:6];
  logic [LB-1:0] slice_q[1:6];
  logic still_q;  // valid_q is 0; registered, so that waiting for rest costs no comparison
  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[5:1], picked};
    still_q <= !rst_ni || {valid_q[5:1], picked} == '0;
    if (!rst_ni) valid_q <= '0;
    addr_q[1] <= classified ? density_block : pick;
    slice_q[1] <= classified ? density_slice : slice;
    for (int s = 2; s <= 6; s++) begin
      addr_q[s] <= addr_q[s-1];
      slice_q[s] <= slice_q[s-1];
    end
  end
  assign idle_o = walk_idle && still_q && density_idle;

  // ---- factor table: word j closes segment j-1
  localparam int SEG = fastsplat_pkg::SEG_LOG2;
  logic [FB-1:0] previous_q, factor_word;
  logic [SEG:0] factor_index;
  assign factor_word = table_word_i[FB-1:0];
  assign factor_index = table_index_i[SEG:0];
  logic segment_we;
  logic [fastsplat_pkg::SEG_LOG2-1:0] segment;
  logic [2*FB-1:0] segment_word;
  always_ff @(posedge clk_i) if (factor_we_i) previous_q <= factor_word;
  assign segment_we = factor_we_i && factor_index != '0;
  assign segment = fastsplat_pkg::SEG_LOG2'(factor_index - (fastsplat_pkg::SEG_LOG2 + 1)'(1));
  assign segment_word = {previous_q, previous_q - factor_word};

  // ---- which pixels of the block lie in the tile, k5
  logic [SIDE+1:0] block_x, block_y;
  localparam int BXL = $clog2(BX);
  logic [AB-1:0] number_x, number_y;
  assign number_x = addr_q[5] & AB'(BX - 1);
  assign number_y = addr_q[5] >> BXL;
  assign block_x = (SIDE + 2)'(number_x) << fastsplat_pkg::LANE_LOG2;
  assign block_y = (SIDE + 2)'(number_y) << fastsplat_pkg::LANE_LOG2;

  logic [P-1:0] inside_x_q, inside_y_q;  // by lane column and row, k6
  logic [P*P-1:0] in_tile;
  always_ff @(posedge clk_i) begin
    if (valid_q[5]) begin
      for (int g = 0; g < P; g++) begin
        inside_x_q[g] <= (block_x + (SIDE + 2)'(g)) < (SIDE + 2)'(width_i);
        inside_y_q[g] <= !sampling && (block_y + (SIDE + 2)'(g)) < (SIDE + 2)'(height_i);
        if (classified) begin  // without the halo
          inside_x_q[g] <= (block_x + (SIDE + 2)'(g)) <= (SIDE + 2)'(width_i) && (g != 0 || block_x != '0);
          inside_y_q[g] <= (block_y + (SIDE + 2)'(g)) <= (SIDE + 2)'(height_i) && (g != 0 || block_y != '0);
        end
      end
    end
  end
  for (genvar b = 0; b < P * P; b++) begin : gen_inside
    assign in_tile[b] = inside_x_q[b%P] && inside_y_q[b/P];
  end

  // ---- picture: blank is 0, so the top bit of a transmittance is kept inverted (1.0 is that bit alone). Written rows
  // lie in the tile. Pixel out reads each of them once; a word that was read is blanked in the next cycle.
  logic [AB-1:0] picture_raddr, picture_waddr, sent_addr_q;
  logic sent_q;
  logic [4*DB-1:0] transparent;
  // In tiles of densities a beat begins in bank column 1 (M-density-5); column 0 is that of the next block, if any.
  logic [AB-1:0] beside_addr, beside_sent_q;
  if (fastsplat_pkg::DENSITIES != 0) begin : gen_beside
    assign beside_addr = picture_addr_i + AB'(classified && (picture_addr_i & AB'(BX - 1)) != AB'(BX - 1));
    always_ff @(posedge clk_i) beside_sent_q <= beside_addr;
  end else begin : gen_aligned
    assign beside_addr = picture_addr_i;
    assign beside_sent_q = sent_addr_q;
  end
  assign picture_raddr = picture_re_i ? picture_addr_i : addr_q[2];
  assign picture_waddr = wipe_i ? wipe_addr_i : sent_q ? sent_addr_q : addr_q[6];
  assign transparent = (mode_i == 2'd2) ? '0 : {DB'(1) << fastsplat_pkg::TRANS_FRAC, {(3 * DB) {1'b0}}};
  always_ff @(posedge clk_i) begin
    sent_q <= picture_re_i && !`FASTSPLAT_FAULT(STALE_PICTURE);
    sent_addr_q <= picture_addr_i;
    if (!rst_ni) sent_q <= 1'b0;
  end

  // Read in k2. The first block of a sheet may be the last of the sheet before, picked at least four cycles ago. It is
  // then written in this cycle, and the lane still holds it in the next (M-walk-5). With several slices a block, all of
  // it was written before (M-slices-4).
  logic forward_q;
  always_ff @(posedge clk_i) forward_q <= R == 1 && valid_q[6] && addr_q[6] == addr_q[2];

  // Every sample, by bank: address of its pixel in k2 and k6; whether it lies in the tile and has a weight in k6. By
  // distance: whether in k3 a window 2, 3 or 4 cycles ago had the same pixel.
  logic [P*P*AB-1:0] sample_raddr, sample_waddr;
  logic [P*P-1:0] sample_written, sample_weighted, sample_forward_2, sample_forward_3, sample_forward_4;
  if (fastsplat_pkg::EVERY_SAMPLE != 0) begin : gen_samples
    fastsplat_sample_places u_places (
        .clk_i,
        .rst_ni,
        .valid_i(valid_q[6:2] & {5{sampling}}),
        .column_i(sample_column_i),
        .row_i(sample_row_i),
        .inside_x_i(sample_inside_x_i),
        .inside_y_i(sample_inside_y_i),
        .weighted_i(sample_weighted_i),
        .raddr_o(sample_raddr),
        .forward_2_o(sample_forward_2),
        .forward_3_o(sample_forward_3),
        .forward_4_o(sample_forward_4),
        .waddr_o(sample_waddr),
        .written_o(sample_written),
        .weighted_o(sample_weighted)
    );
  end else begin : gen_sheets_only
    assign sample_raddr = '0;
    assign sample_waddr = '0;
    assign {sample_written, sample_weighted, sample_forward_2, sample_forward_3, sample_forward_4} = '0;
    logic unused;
    assign unused = &{1'b0, every_sample_i, sample_valid_i, sample_products_i, sample_column_i, sample_row_i, sample_inside_x_i,
                      sample_inside_y_i, sample_weighted_i, sample_weighted, sample_forward_2, sample_forward_3, sample_forward_4};
  end

  // By bank: the picture. Bank b is worked on in slice b / C, by lane b mod C.
  logic [4*DB-1:0] picture[0:P*P-1], shown[0:P*P-1], states[0:C-1];  // k3; k6, of the tap; k6
  for (genvar h = 0; h < P; h++) begin : gen_row
    for (genvar g = 0; g < P; g++) begin : gen_bank
      localparam int B = h * P + g;
      localparam int LANE = B % C;
      localparam bit BESIDE = fastsplat_pkg::DENSITIES != 0 && g == 0;
      logic read, written;
      assign read = valid_q[2] && (R == 1 || slice_q[2] == LB'(B / C));
      assign written = valid_q[6] && (R == 1 || slice_q[6] == LB'(B / C));
      fastsplat_ram_1r1w #(.BITS(4 * DB), .WORDS(NB), .ADDR(AB)) u_picture (
          .clk_i,
          .re_i(read || picture_re_i),
          .raddr_i((sampling && !picture_re_i) ? sample_raddr[B*AB+:AB] : (BESIDE && picture_re_i) ? beside_addr : picture_raddr),
          .rdata_o(picture[B]),
          .we_i(wipe_i || (sent_q && picture_row_i[h]) || ((written && inside_y_q[h]) && (!classified || inside_x_q[g])) || sample_written[B]),
          .waddr_i((sampling && !wipe_i && !sent_q) ? sample_waddr[B*AB+:AB] : (BESIDE && !wipe_i && sent_q) ? beside_sent_q : picture_waddr),
          .wdata_i((wipe_i || sent_q) ? '0 : states[LANE] ^ transparent)
      );
      // The tap shows a whole block: results of earlier slices are kept.
      if (B / C == R - 1) begin : gen_last
        assign shown[B] = states[LANE];
      end else begin : gen_kept
        logic [4*DB-1:0] state_q;
        always_ff @(posedge clk_i) if (written) state_q <= states[LANE];
        assign shown[B] = state_q;
      end
      assign tap_state_o[B*4*DB+:4*DB] = tap_valid_o ? shown[B] : '0;
    end
  end

  // By lane: in slice r, lane c works on bank C r + c.
  logic [4*DB-1:0] state_k4_q[0:C-1];
  for (genvar c = 0; c < C; c++) begin : gen_lane
    logic [4*SB-1:0] sums;          // k1
    logic [4*DB-1:0] stored, slab, next;  // k3, k4, k5
    logic sample_forwarded;               // k3
    logic [4*DB-1:0] sample_state;
    logic [3:0] opacity_saturated_k4, opacity_saturated_k5_q, opacity_saturated_k6_q;
    always_comb begin
      sums = sheet_data_i[c*4*SB+:4*SB];
      stored = picture[c];
      event_inside_o[c] = in_tile[c];
      for (int r = 1; r < R; r++) begin
        if (slice_q[1] == LB'(r)) sums = sheet_data_i[(r*C+c)*4*SB+:4*SB];
        if (slice_q[3] == LB'(r) && !(`FASTSPLAT_FAULT(STALE_SLICE) && r == 1)) stored = picture[r*C+c];
        if (slice_q[6] == LB'(r)) event_inside_o[c] = in_tile[r*C+c];
      end
      if (classified) sums = density_sums[c*4*SB+:4*SB];
      if (sampling) begin
        sums = sample_products_i[c*4*SB+:4*SB];
        event_inside_o[c] = sample_weighted[c];
      end
    end
    fastsplat_slab_opacity u_opacity (
        .clk_i,
        .we_i(segment_we),
        .waddr_i(segment),
        .wdata_i(segment_word),
        .valid_i(valid_q[3:1]),
        .mode_i,
        .sums_i(sums),
        .slab_o(slab),
        .saturated_o(opacity_saturated_k4)
    );
    fastsplat_composite_lane u_composite (
        .clk_i,
        .rst_ni,
        .valid_i(valid_q[5:4]),
        .mode_i,
        .slab_i(slab),
        .state_i(state_k4_q[c]),
        .next_o(next),
        .state_o(states[c]),
        .frozen_o(event_frozen_o[c]),
        .saturated_o(event_saturated_o[4*c+:4])
    );
    // Only written rows, those in the tile, are forwarded. Where a block is one slice, lane c is bank c.
    always_ff @(posedge clk_i) begin
      if (valid_q[3]) state_k4_q[c] <= (forward_q && inside_y_q[c/P]) ? states[c] : stored ^ transparent;
      if (valid_q[3] && sample_forwarded) state_k4_q[c] <= sample_state;
      if (valid_q[4]) opacity_saturated_k5_q <= opacity_saturated_k4;
      if (valid_q[5]) opacity_saturated_k6_q <= opacity_saturated_k5_q;
    end
    assign event_opacity_saturated_o[4*c+:4] = opacity_saturated_k6_q;
    // A window 2, 3 or 4 cycles ago may have had the same pixel. Its new state is in k5, in k6, or was written while
    // this one was read. The latest window counts (M-hazard-2).
    if (fastsplat_pkg::EVERY_SAMPLE != 0) begin : gen_forward
      logic [4*DB-1:0] past_q;  // of the cycle before
      always_ff @(posedge clk_i) if (valid_q[6]) past_q <= states[c];
      assign sample_forwarded = sample_forward_2[c] || sample_forward_3[c] || sample_forward_4[c];
      assign sample_state = (sample_forward_4[c] && `FASTSPLAT_FAULT(SAMPLE_OLDEST)) ? past_q :
                            sample_forward_2[c] ? next : sample_forward_3[c] ? states[c] : past_q;
    end else begin : gen_no_forward
      assign sample_forwarded = 1'b0;
      assign sample_state = '0;
      logic unused;
      assign unused = &{1'b0, next};
    end
  end

  // Reported to the cull map. A terminated pixel is new unless it was terminated before this slab.
  assign blank_o = wipe_i || sent_q;
  assign blank_addr_o = wipe_i ? wipe_addr_i : sent_addr_q;
  if (fastsplat_pkg::CULL_MAP != 0) begin : gen_frozen
    logic [C-1:0] frozen, changed;
    logic changed_q;  // by the block's earlier slices
    for (genvar c = 0; c < C; c++) begin : gen_pixel
      // verilator lint_off UNSIGNED
      assign frozen[c] = states[c][3*DB+:TB] < TB'(fastsplat_pkg::FREEZE_BELOW);
      // verilator lint_on UNSIGNED
      assign changed[c] = event_inside_o[c] && frozen[c] && !event_frozen_o[c];
    end
    for (genvar b = 0; b < P * P; b++) begin : gen_bank
      logic now;
      assign now = frozen[b%C] || !in_tile[b];
      if (b / C == R - 1) begin : gen_last
        assign cull_frozen_o[b] = now;
      end else begin : gen_kept
        logic now_q;
        always_ff @(posedge clk_i) if (valid_q[6] && slice_q[6] == LB'(b / C)) now_q <= now;
        assign cull_frozen_o[b] = now_q;
      end
    end
    always_ff @(posedge clk_i) begin
      if (valid_q[6]) changed_q <= !tap_valid_o && (changed_q || changed != '0);
      if (!rst_ni) changed_q <= 1'b0;
    end
    assign cull_changed_o = changed != '0 || changed_q;
  end else begin : gen_no_cull
    assign cull_frozen_o = '0;
    assign cull_changed_o = 1'b0;
  end
  always_comb begin
    picture_o = '0;  // verilator lint_off WIDTHCONCAT
    for (int h = 0; h < P; h++) begin  // verilator lint_on WIDTHCONCAT
      for (int g = 0; g < P; g++) begin
        if (picture_row_i[h]) picture_o[g*4*DB+:4*DB] = picture[h*P+(classified?(g+1)%P:g)] ^ transparent;
      end
    end
  end
  assign event_valid_o = valid_q[6];
  assign tap_valid_o = valid_q[6] && (R == 1 || slice_q[6] == LB'(R - 1));
  assign tap_block_o = sampling ? '0 : addr_q[6];

  `FASTSPLAT_ASSERT(rest_foretold, still_q == (valid_q == '0))
  `FASTSPLAT_ASSERT(picture_sent_when_still, !picture_re_i || idle_o)
  `FASTSPLAT_ASSERT(picture_has_one_writer, $onehot0({wipe_i, sent_q, valid_q[6]}))
endmodule
