// SPDX-License-Identifier: Apache-2.0
// Unit "decode": checked beats in (fastsplat_stream_check.sv), table words, windows and sheet tokens out
// (docs/stream.md; cmodel/cycles/cycle_model.hpp).
// One beat register. A beat takes one cycle, except table payload (a cycle per word), splats (a cycle per window), and
// begin_tile, begin_sheet and end_tile, which wait for the compositor and pixel out.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_stream_decode (
    input  logic                                       clk_i,
    input  logic                                       rst_ni,
    // legal beats
    input  logic                                       valid_i,
    output logic                                       ready_o,
    input  logic [fastsplat_pkg::BEAT_BITS-1:0]                               data_i,
    input  logic                                       payload_i,   // words of the table announced last
    input  logic                                       aborted_i,   // an end_tile of the device's own
    input  logic [fastsplat_pkg::COL_BITS-1:0]         extent_i,    // padded extent of the set announced last
    // culling: verdicts of the beat, and a splat's first pixel
    input  logic                                       swallowed_i,
    input  logic                                       hidden_i,
    input  logic                                       culls_i,     // its tile is culled
    input  logic                                       sheet_i,     // its sheet's number in the tile, modulo 2
    input  logic signed [fastsplat_pkg::ORG_BITS-1:0]  x_i,
    input  logic signed [fastsplat_pkg::ORG_BITS-1:0]  y_i,
    output logic                                       map_sheet_o,  // opaque blocks of a row, and of the row below
    output logic [fastsplat_pkg::BLK_BITS-1:0]         map_row_o,
    input  logic [fastsplat_pkg::BLOCKS_X-1:0]         map_row_i,
    input  logic [fastsplat_pkg::BLOCKS_X-1:0]         map_row_below_i,
    // table load
    output logic                                       rlut_we_o,
    output logic [fastsplat_pkg::PHASE_BITS-1:0]       rlut_wphase_o,
    output logic [fastsplat_pkg::COL_BITS-1:0]         rlut_wcolumn_o,
    output logic                                       radial_we_o,
    output logic                                       factor_we_o,
    output logic                                       density_we_o,
    output logic [7:0]                                 table_o,
    output logic [31:0]                                table_index_o,
    output logic [31:0]                                table_word_o,
    // tile
    output logic                                       tile_begin_o,  // pulse: begin_tile carried out
    output logic                                       tile_end_o,    // pulse: send the picture
    output logic                                       tile_aborted_o,  // with it: of a tile that was cut short
    output logic                                       frame_end_o,   // pulse: end_frame carried out
    output logic                                       tile_open_o,   // between begin_tile and end_tile
    input  logic                                       tile_idle_i,   // compositor and pixel out have nothing to do
    output logic [1:0]                                 mode_o,
    output logic                                       every_sample_o,  // mode bit 2
    output logic                                       densities_o,     // mode bit 3
    output logic                                       tile_flush_o,    // end_tile is here, and all sheets have left their buffers
    output logic [63:0]                                place_o,         // densities: {image height, width, tile y, x}
    output logic [31:0]                                sheet_number_o,  // densities: of the sheet in the buffer given
                                                                        // back
    output logic [31:0]                                tile_number_o,
    output logic [fastsplat_pkg::SIDE_BITS-1:0]        width_o,
    output logic [fastsplat_pkg::SIDE_BITS-1:0]        height_o,
    // sheet buffers given back by the compositor
    input  logic                                       free_i,
    input  logic                                       free_buffer_i,
    // c0
    output logic                                       window_valid_o,
    output logic                                       window_last_o,   // end-of-sheet token
    output logic                                       window_first_o,
    output logic                                       window_buffer_o,
    output logic [31:0]                                window_tag_o,
    output logic signed [fastsplat_pkg::POS_BITS-1:0]  window_x_o,
    output logic signed [fastsplat_pkg::POS_BITS-1:0]  window_y_o,
    output logic [fastsplat_pkg::RHO_BITS-1:0]         window_rho_o,
    output logic [fastsplat_pkg::COL_BITS-1:0]         window_base_o,
    output logic [fastsplat_pkg::WINDOW_BITS-1:0]      window_column_o,
    output logic [fastsplat_pkg::WINDOW_BITS-1:0]      window_row_o,
    output logic                                       window_ellipse_o,
    output logic [fastsplat_pkg::SHAPE_BITS-1:0]       window_shape_o,  // {top, left, h, C, B, A}
    output logic [4*fastsplat_pkg::COLOUR_BITS-1:0]    window_colour_o,
    // status
    output logic                                       event_splat_o,
    output logic                                       event_cull_o,
    output logic                                       event_hidden_o,          // a splat
    output logic [fastsplat_pkg::WINDOWS_X-1:0]        event_hidden_windows_o,  // of a row
    output logic                                       stall_input_o,   // nothing to decode
    output logic                                       stall_table_o,   // a table word
    output logic                                       stall_buffer_o,  // begin_sheet waits for a buffer
    output logic                                       stall_tile_o,    // begin_tile or end_tile waits
    output logic                                       stall_hazard_o   // a window that lies over the one before waits
);
  localparam int CB = fastsplat_pkg::COLOUR_BITS;
  localparam int COL = fastsplat_pkg::COL_BITS;
  localparam int P = fastsplat_pkg::LANES;
  localparam int WORD_BITS = $clog2(fastsplat_pkg::BEAT_WORDS);
  localparam logic [WORD_BITS-1:0] LAST_WORD = WORD_BITS'(fastsplat_pkg::BEAT_WORDS - 1);

  logic beat_valid_q, payload_q, aborted_q, take;
  logic [fastsplat_pkg::BEAT_BITS-1:0] beat_q;
  logic [31:0] w0, w1, w2, w3, w4, w5, w6, w7;
  assign {w7, w6, w5, w4, w3, w2, w1, w0} = beat_q;  // where fields lie
  logic unused;
  assign unused = &{1'b0, w0, w2, w3, w4, w5, w6, w7};
  logic [7:0] opcode;
  assign opcode = w0[7:0];
  assign ready_o = !beat_valid_q || take;

  // Radius sets
  logic [fastsplat_pkg::RHO_BITS-1:0] rho_q[0:fastsplat_pkg::RLUT_SETS-1];
  logic [COL-1:0] base_q[0:fastsplat_pkg::RLUT_SETS-1];
  logic [COL-1:0] extent_q[0:fastsplat_pkg::RLUT_SETS-1];
  logic [fastsplat_pkg::SET_BITS-1:0] set;
  assign set = w0[8+:fastsplat_pkg::SET_BITS];

  // Table payload
  logic [7:0] table_q;
  logic [31:0] left_q;  // words after this one
  logic last_word_q;
  logic [31:0] index_q;
  logic [WORD_BITS-1:0] word_in_beat_q;
  logic [COL-1:0] table_base_q, table_extent_q, table_column_q;
  logic [fastsplat_pkg::PHASE_BITS-1:0] table_phase_q;
  assign table_word_o = beat_q[32*word_in_beat_q+:32];
  logic table_write;
  assign table_write = beat_valid_q && payload_q;
  assign rlut_we_o = table_write && table_q == fastsplat_pkg::TABLE_RLUT;
  assign radial_we_o = table_write && table_q == fastsplat_pkg::TABLE_RADIAL && !(`FASTSPLAT_FAULT(STALE_TABLE) && index_q[3:0] == 4'd5);
  assign factor_we_o = table_write && table_q == fastsplat_pkg::TABLE_FACTOR;
  assign density_we_o = fastsplat_pkg::DENSITIES != 0 && table_write && table_q > fastsplat_pkg::TABLE_FACTOR;
  assign table_o = table_q;
  assign rlut_wphase_o = table_phase_q;
  assign rlut_wcolumn_o = table_base_q + table_column_q;
  assign table_index_o = index_q;

  // Windows of the splat in the beat register
  localparam int WIN = fastsplat_pkg::WINDOW_BITS;
  logic [WIN-1:0] column_q, row_q, extent_x, extent_y;
  logic [fastsplat_pkg::RLUT_SETS-1:0] single_q;  // by set: one window
  logic last_column_q, last_row_q, last_window;   // computed a cycle ahead: the source's handshake waits for it
  logic is_ellipse;
  if (fastsplat_pkg::ELLIPSES != 0) begin : gen_ellipse
    assign is_ellipse = opcode == fastsplat_pkg::OP_ELLIPSE;
    assign extent_x = is_ellipse ? (WIN'(w2[26:22]) + WIN'(1)) << fastsplat_pkg::LANE_LOG2 : WIN'(extent_q[set]);
    assign extent_y = is_ellipse ? (WIN'(w2[31:27]) + WIN'(1)) << fastsplat_pkg::LANE_LOG2 : WIN'(extent_q[set]);
    always_ff @(posedge clk_i) begin
      window_ellipse_o <= is_ellipse;
      window_shape_o <= {w7[31:22], w6[31:22], w3[27:22], w7[21:0], w0[31:8], w6[21:0]};
    end
  end else begin : gen_circles
    assign is_ellipse = 1'b0;
    assign extent_x = extent_q[set];
    assign extent_y = extent_q[set];
    assign window_ellipse_o = 1'b0;
    assign window_shape_o = '0;
  end
  assign last_window = last_column_q && last_row_q;
  logic issues, window_first;  // a window of the splat in the register is issued; it is its first
  logic swallowed_q;           // of a hidden group

  logic ellipse_next, one_column;  // the record entering the register; of the one in it
  assign ellipse_next = fastsplat_pkg::ELLIPSES != 0 && data_i[7:0] == fastsplat_pkg::OP_ELLIPSE;
  assign one_column = is_ellipse && w2[26:22] == '0;

  // Sheet buffers
  logic [1:0] busy_q;
  logic buffer_q;

  // Kind of the record in the register, decoded on its way there, because the source's handshake waits for it.
  logic splat_q, begins_sheet_q, waits_for_rest_q;
  logic is_splat, wait_buffer, wait_tile, wait_hazard;
  assign is_splat = beat_valid_q && splat_q;
  assign wait_buffer = beat_valid_q && begins_sheet_q && busy_q[buffer_q];
  // A sheet on its way through the splat path keeps its buffer busy, so "all buffers free" covers the pipe as well.
  assign wait_tile = beat_valid_q && waits_for_rest_q && (!tile_idle_i || busy_q != '0);
  always_comb begin
    take = beat_valid_q;
    if (payload_q) take = beat_valid_q && (last_word_q || word_in_beat_q == LAST_WORD);
    else if (is_splat) take = last_window;
    else if (wait_buffer || wait_tile) take = 1'b0;
    if (wait_hazard) take = 1'b0;
  end

  logic accepted;  // the record in the register is carried out in this cycle
  logic tile_begin;
  // Every sample: a window over that of the cycle before would read a state that is not there yet
  // (docs/microarchitecture.md, M-hazard-1). Windows of one record never meet, so only a record's first one waits, a
  // cycle.
  if (fastsplat_pkg::EVERY_SAMPLE != 0) begin : gen_samples
    logic overlap;
    localparam int PB = fastsplat_pkg::POS_BITS;
    fastsplat_overlap u_overlap (
        .clk_i,
        .enter_i(ready_o),
        .ellipse_i(ellipse_next),
        .x_i(data_i[64+:PB]),
        .y_i(data_i[96+:PB]),
        .rho_i(rho_q[data_i[8+:fastsplat_pkg::SET_BITS]]),
        .left_i(data_i[214+:10]),
        .top_i(data_i[246+:10]),
        .column_i(column_q),
        .row_i(row_q),
        .overlap_o(overlap)
    );
    assign wait_hazard = every_sample_o && is_splat && window_valid_o && overlap && !`FASTSPLAT_FAULT(SAMPLE_STALL);
    always_ff @(posedge clk_i) begin
      if (tile_begin) every_sample_o <= w0[10];
      if (!rst_ni) every_sample_o <= 1'b0;
    end
    `FASTSPLAT_ASSERT_NEXT(hazard_lasts_a_cycle, wait_hazard, is_splat && !wait_hazard && !window_valid_o)
  end else begin : gen_sheets_only
    assign wait_hazard = 1'b0;
    assign every_sample_o = 1'b0;
  end
  assign stall_hazard_o = wait_hazard;

  // What the classification of densities needs.
  if (fastsplat_pkg::DENSITIES != 0) begin : gen_densities
    logic [31:0] number_q[0:1];  // by buffer
    always_ff @(posedge clk_i) begin
      if (accepted && opcode == fastsplat_pkg::OP_BEGIN_FRAME) place_o[63:32] <= w4;
      if (accepted && opcode == fastsplat_pkg::OP_BEGIN_SHEET) number_q[buffer_q] <= w1;
      if (tile_begin) begin
        densities_o <= w0[11];
        place_o[31:0] <= {w3[15:0], w2[15:0]};
      end
      if (!rst_ni) densities_o <= 1'b0;
    end
    assign tile_flush_o = beat_valid_q && waits_for_rest_q && opcode == fastsplat_pkg::OP_END_TILE && busy_q == '0;
    assign sheet_number_o = number_q[free_buffer_i];
  end else begin : gen_colours
    assign {densities_o, tile_flush_o, place_o, sheet_number_o} = '0;
  end

  assign accepted = take && !payload_q;
  assign tile_begin = accepted && opcode == fastsplat_pkg::OP_BEGIN_TILE;
  assign tile_end_o = accepted && opcode == fastsplat_pkg::OP_END_TILE;
  assign tile_aborted_o = aborted_q;
  assign frame_end_o = accepted && opcode == fastsplat_pkg::OP_END_FRAME;
  assign tile_begin_o = tile_begin;
  assign event_splat_o = accepted && is_splat && !swallowed_q;
  assign event_cull_o = accepted && opcode == fastsplat_pkg::OP_CULL_BLOCK;
  assign stall_input_o = !beat_valid_q;
  assign stall_table_o = table_write;
  assign stall_buffer_o = wait_buffer;
  assign stall_tile_o = wait_tile;

  always_ff @(posedge clk_i) begin
    if (ready_o) begin
      beat_valid_q <= valid_i;
      beat_q <= data_i;
      payload_q <= payload_i;
      aborted_q <= aborted_i;
      splat_q <= !payload_i && (data_i[7:0] == fastsplat_pkg::OP_SPLAT || ellipse_next);
      begins_sheet_q <= !payload_i && data_i[7:0] == fastsplat_pkg::OP_BEGIN_SHEET;
      waits_for_rest_q <= !payload_i && (data_i[7:0] == fastsplat_pkg::OP_BEGIN_TILE || data_i[7:0] == fastsplat_pkg::OP_END_TILE);
    end
    if (`FASTSPLAT_FAULT(LOST_BEAT) && ready_o && valid_i && is_splat && data_i[7:0] == fastsplat_pkg::OP_SPLAT && w1[2:0] == 3'd5)
      beat_valid_q <= 1'b0;

    // tables
    if (accepted && opcode == fastsplat_pkg::OP_LOAD_TABLE) begin
      table_q <= w0[15:8];
      left_q <= w3 - 32'd1;
      last_word_q <= w3 == 32'd1;
      index_q <= '0;
      word_in_beat_q <= '0;
      table_base_q <= w4[COL-1:0];
      table_extent_q <= extent_i;
      table_column_q <= '0;
      table_phase_q <= '0;
      if (w0[15:8] == fastsplat_pkg::TABLE_RLUT) begin
        rho_q[w1[fastsplat_pkg::SET_BITS-1:0]] <= w2[fastsplat_pkg::RHO_BITS-1:0];
        base_q[w1[fastsplat_pkg::SET_BITS-1:0]] <= w4[COL-1:0];
        extent_q[w1[fastsplat_pkg::SET_BITS-1:0]] <= extent_i;
        single_q[w1[fastsplat_pkg::SET_BITS-1:0]] <= extent_i <= COL'(P);
      end
    end
    if (table_write) begin
      index_q <= index_q + 32'd1;
      left_q <= left_q - 32'd1;
      last_word_q <= left_q == 32'd1;
      word_in_beat_q <= word_in_beat_q + WORD_BITS'(1);  // their number is a power of two
      table_column_q <= table_column_q + COL'(1);
      if (table_column_q + COL'(1) == table_extent_q) begin
        table_column_q <= '0;
        table_phase_q <= table_phase_q + fastsplat_pkg::PHASE_BITS'(1);
      end
    end

    // tile and sheet
    if (tile_end_o) tile_open_o <= 1'b0;
    if (tile_begin) begin
      tile_open_o <= 1'b1;
      mode_o <= w0[9:8];
      tile_number_o <= w1;
      width_o <= w4[fastsplat_pkg::SIDE_BITS-1:0];
      height_o <= w4[16+:fastsplat_pkg::SIDE_BITS];
    end
    if (free_i && !(`FASTSPLAT_FAULT(LOST_FREE) && free_buffer_i)) busy_q[free_buffer_i] <= 1'b0;
    if (accepted && opcode == fastsplat_pkg::OP_BEGIN_SHEET) busy_q[buffer_q] <= 1'b1;
    if (accepted && opcode == fastsplat_pkg::OP_END_SHEET) buffer_q <= !buffer_q;

    // windows
    window_valid_o <= issues;
    window_last_o <= accepted && opcode == fastsplat_pkg::OP_END_SHEET;
    window_first_o <= window_first;
    window_buffer_o <= buffer_q;
    window_tag_o <= w1;
    window_x_o <= w2[fastsplat_pkg::POS_BITS-1:0];
    window_y_o <= w3[fastsplat_pkg::POS_BITS-1:0];
    window_rho_o <= rho_q[set];
    window_base_o <= base_q[set];
    window_column_o <= column_q;
    window_row_o <= row_q;
    window_colour_o <= {w5[16+:CB], w5[0+:CB], w4[16+:CB], w4[0+:CB]};
    if (!rst_ni) begin
      beat_valid_q <= 1'b0;
      tile_open_o <= 1'b0;
      busy_q <= '0;
      buffer_q <= 1'b0;
      window_valid_o <= 1'b0;
      window_last_o <= 1'b0;
    end
  end

  // ---- next window: each of the footprint's, or only the visible ones
  logic last_column_next, last_row_next;  // of a walk through all windows
  assign last_column_next = (WIN + 1)'(column_q) + (WIN + 1)'(2 * P) >= (WIN + 1)'(extent_x);
  assign last_row_next = (WIN + 1)'(row_q) + (WIN + 1)'(2 * P) >= (WIN + 1)'(extent_y);
  if (fastsplat_pkg::CULL_MAP != 0) begin : gen_seen
    localparam int NW = fastsplat_pkg::WINDOWS_X;
    localparam int ORG = fastsplat_pkg::ORG_BITS;
    logic [NW-1:0] there_q[0:fastsplat_pkg::RLUT_SETS-1];  // by set: windows of a row
    logic [NW-1:0] there, seen, seen_q, rest, next;
    logic culls_q, sheet_q, gone_q, hidden_q, new_row_q, issued_q, enters, new_row;
    logic signed [ORG-1:0] x_q, y_q;
    logic [WIN-1:0] column;
    assign enters = ready_o && valid_i;
    assign new_row = enters || (is_splat && !wait_hazard && last_column_q && !last_row_q);
    assign there = there_q[enters ? data_i[8+:fastsplat_pkg::SET_BITS] : set];
    assign map_sheet_o = enters ? sheet_i : sheet_q;
    fastsplat_cull_windows u_windows (
        .culls_i(enters ? culls_i : culls_q),
        .x_i(enters ? x_i : x_q),
        .y_i(enters ? y_i : y_q + ORG'(P)),
        .width_i(width_o),
        .height_i(height_o),
        .there_i(there),
        .row_o(map_row_o),
        .row_i(map_row_i),
        .row_below_i(map_row_below_i),
        .seen_o(seen)
    );
    assign rest = seen_q & (seen_q - NW'(1));
    assign next = new_row ? (enters && (swallowed_i || hidden_i)) ? '0 : seen : rest;
    always_comb begin
      column = '0;
      for (int w = 0; w < NW; w++) if (next[w] && (next & ((NW'(1) << w) - NW'(1))) == '0) column = column | WIN'(w * P);
    end
    assign issues = is_splat && !wait_hazard && seen_q != '0;
    assign window_first = !issued_q;
    assign event_hidden_o = accepted && is_splat && hidden_q && !swallowed_q;
    assign event_hidden_windows_o = (is_splat && new_row_q && !gone_q && !is_ellipse) ? there_q[set] & ~seen_q : '0;
    always_ff @(posedge clk_i) begin
      new_row_q <= new_row;
      if (accepted && opcode == fastsplat_pkg::OP_LOAD_TABLE && w0[15:8] == fastsplat_pkg::TABLE_RLUT)
        for (int w = 0; w < NW; w++) there_q[w1[fastsplat_pkg::SET_BITS-1:0]][w] <= extent_i > COL'(w * P);
      if (enters) begin
        swallowed_q <= swallowed_i;
        hidden_q <= hidden_i;
        gone_q <= swallowed_i || hidden_i;
        culls_q <= culls_i;
        sheet_q <= sheet_i;
        x_q <= x_i;
        y_q <= y_i;
        row_q <= '0;
        last_row_q <= swallowed_i || hidden_i || (ellipse_next ? data_i[91+:5] == '0 : single_q[data_i[8+:fastsplat_pkg::SET_BITS]]);
        issued_q <= 1'b0;
      end else begin
        if (issues) issued_q <= 1'b1;
        if (new_row) begin
          row_q <= row_q + WIN'(P);
          y_q <= y_q + ORG'(P);
          last_row_q <= last_row_next;
        end
      end
      // A row without visible windows takes a cycle, too.
      if (new_row || issues) begin
        seen_q <= next;
        column_q <= column;
        last_column_q <= (next & (next - NW'(1))) == '0;
        // Windows of an ellipse are not tested (N-6.1-10): all of them follow, from the row's first on.
        if (enters ? ellipse_next : is_ellipse) begin
          seen_q <= NW'(!(enters && (swallowed_i || hidden_i)));
          column_q <= new_row ? '0 : column_q + WIN'(P);
          last_column_q <= enters ? swallowed_i || hidden_i || data_i[86+:5] == '0 :
                           new_row ? one_column : last_column_next;
        end
      end
    end
    logic unused_way;
    assign unused_way = &{1'b0, one_column, last_column_next};
    `FASTSPLAT_ASSERT(seen_splat_has_windows, !(take && is_splat && !gone_q) || issued_q || issues)
    `FASTSPLAT_ASSERT(last_column_foretold, !is_splat || (last_column_q == (is_ellipse ? gone_q || column_q + WIN'(P) >= extent_x : rest == '0) && (gone_q || last_row_q == (row_q + WIN'(P) >= extent_y))))
  end else begin : gen_all
    assign issues = is_splat && !wait_hazard;
    assign window_first = column_q == '0 && row_q == '0;
    assign swallowed_q = 1'b0;
    assign {map_sheet_o, map_row_o, event_hidden_o, event_hidden_windows_o} = '0;
    logic unused_verdict;
    assign unused_verdict = &{1'b0, swallowed_i, hidden_i, culls_i, sheet_i, x_i, y_i, map_row_i, map_row_below_i};
    always_ff @(posedge clk_i) begin
      if (ready_o) begin
        last_column_q <= ellipse_next ? data_i[86+:5] == '0 : single_q[data_i[8+:fastsplat_pkg::SET_BITS]];
        last_row_q <= ellipse_next ? data_i[91+:5] == '0 : single_q[data_i[8+:fastsplat_pkg::SET_BITS]];
      end
      if (is_splat && !wait_hazard) begin
        column_q <= last_column_q ? '0 : column_q + WIN'(P);
        if (last_column_q) row_q <= last_window ? '0 : row_q + WIN'(P);
        if (!last_window) begin  // then there are at least two columns or two rows, of a circle both
          last_column_q <= last_column_q ? one_column : last_column_next;
          if (last_column_q) last_row_q <= last_row_next;
        end
      end
      if (!rst_ni) begin
        column_q <= '0;
        row_q <= '0;
      end
    end
    `FASTSPLAT_ASSERT(last_window_foretold, !is_splat || (last_column_q == (column_q + WIN'(P) >= extent_x) && last_row_q == (row_q + WIN'(P) >= extent_y)))
  end
  `FASTSPLAT_ASSUME_HELD(input_held, valid_i && !ready_o, valid_i, data_i)
  `FASTSPLAT_ASSERT_NEXT(accepted_beat_arrives, valid_i && ready_o, beat_valid_q)
  `FASTSPLAT_ASSERT_HELD(waiting_beat_stays, beat_valid_q && !take, beat_valid_q, beat_q)
  `FASTSPLAT_ASSERT(one_thing_at_a_time,
                    $onehot0({tile_begin, tile_end_o, event_splat_o, event_cull_o, rlut_we_o, radial_we_o, factor_we_o, density_we_o}))
  `FASTSPLAT_ASSERT(window_in_open_sheet, !window_valid_o || busy_q[window_buffer_o])
  `FASTSPLAT_ASSERT(only_busy_buffers_come_back, !free_i || busy_q[free_buffer_i])
  `FASTSPLAT_ASSERT(kind_foretold, !beat_valid_q || {splat_q, begins_sheet_q, waits_for_rest_q} ==
                    {!payload_q && (opcode == fastsplat_pkg::OP_SPLAT || is_ellipse), !payload_q && opcode == fastsplat_pkg::OP_BEGIN_SHEET,
                     !payload_q && (opcode == fastsplat_pkg::OP_BEGIN_TILE || opcode == fastsplat_pkg::OP_END_TILE)})
  `FASTSPLAT_COVER(sheet_waits_for_buffer, wait_buffer)
  `FASTSPLAT_COVER(both_buffers_busy, busy_q == 2'b11)
endmodule
