// SPDX-License-Identifier: Apache-2.0
// The FastSplat device: stream in, pixels out, registers beside (docs/microarchitecture.md).
//
//   stream -> check -> [cull] -> decode -> splat array (snap, RLUT, lanes, sheet banks) -> compositor -> pixel out -> pixels
//
// Synchronous reset, active low. After reset the sheet memories are wiped (BLOCKS cycles) before the first beat is
// taken.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_core #(
    parameter bit SLICED = 1'b0  // 1: register slices lie between these streams and source and sink, and report below (fastsplat_top)
) (
    input  logic         clk_i,
    input  logic         rst_ni,
    // AXI4-Stream in: one beat of docs/stream.md
    input  logic         s_tvalid_i,
    output logic         s_tready_o,
    input  logic [fastsplat_pkg::BEAT_BITS-1:0] s_tdata_i,
    // AXI4-Stream out: P pixels of a row, R, G, B, A of 32 bits each; keep marks the pixels inside the tile
    output logic         m_tvalid_o,
    input  logic         m_tready_i,
    output logic [fastsplat_pkg::LANES*128-1:0] m_tdata_o,
    output logic [fastsplat_pkg::LANES-1:0] m_tkeep_o,
    output logic         m_tlast_o,
    output logic         m_tuser_o,  // the tile was cut short: on all of its beats
    // culling: a pulse for each cull_block that passed check: its tag; whether its group is hidden and need not be sent
    output logic         verdict_valid_o,
    output logic [31:0]  verdict_tag_o,
    output logic         verdict_hidden_o,
    // AXI4-Lite
    input  logic         awvalid_i,
    output logic         awready_o,
    input  logic [11:0]  awaddr_i,
    input  logic         wvalid_i,
    output logic         wready_o,
    input  logic [31:0]  wdata_i,
    output logic         bvalid_o,
    input  logic         bready_i,
    output logic [1:0]   bresp_o,
    input  logic         arvalid_i,
    output logic         arready_o,
    input  logic [11:0]  araddr_i,
    output logic         rvalid_o,
    input  logic         rready_i,
    output logic [31:0]  rdata_o,
    output logic [1:0]   rresp_o,
    // taps: what passes each boundary (docs/microarchitecture.md, "Taps")
    output logic         tap_snap_valid_o,
    output logic [31:0]  tap_snap_tag_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_snap_x_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_snap_y_o,
    output logic [fastsplat_pkg::WAY_BITS-1:0] tap_snap_mx_o,
    output logic [fastsplat_pkg::WAY_BITS-1:0] tap_snap_my_o,
    output logic         tap_window_valid_o,
    output logic [31:0]  tap_window_tag_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_window_x_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_window_y_o,
    output logic [fastsplat_pkg::BANKS*fastsplat_pkg::WEIGHT_BITS-1:0] tap_weights_o,
    output logic         tap_sheet_valid_o,
    output logic [31:0]  tap_sheet_tag_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] tap_sums_o,
    output logic         tap_composite_valid_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0] tap_composite_block_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] tap_state_o,
    output logic [31:0]  tap_tile_o,
    output logic         tap_sheet_done_o,
    output logic         error_o,
    output logic         irq_o,
    // where SLICED: end_frame was carried out and all pixels have left this module; the slices hold something, the sink has taken the last
    // beat of a tile, of a frame
    output logic         frame_end_o,
    input  logic         slices_busy_i,
    input  logic         tile_left_i,
    input  logic         frame_left_i
);
  localparam int BANKS = fastsplat_pkg::BANKS;

  // Wipe after reset: both memories of every bank and the picture, one word a cycle.
  logic wiping_q;
  logic [fastsplat_pkg::ADDR_BITS-1:0] wipe_addr_q;
  always_ff @(posedge clk_i) begin
    if (!rst_ni) begin
      wiping_q <= 1'b1;
      wipe_addr_q <= '0;
    end else if (wiping_q) begin
      wipe_addr_q <= wipe_addr_q + fastsplat_pkg::ADDR_BITS'(1);
      if (wipe_addr_q == fastsplat_pkg::ADDR_BITS'(fastsplat_pkg::BLOCKS - 1)) wiping_q <= 1'b0;
    end
  end

  logic rlut_we, radial_we, factor_we, density_we;
  logic [7:0] table_number;
  logic [fastsplat_pkg::PHASE_BITS-1:0] rlut_wphase;
  logic [fastsplat_pkg::COL_BITS-1:0] rlut_wcolumn;
  logic [31:0] table_index, table_word;
  logic tile_end, tile_open, compositor_idle, pixel_idle;
  logic [1:0] mode;
  logic every_sample, densities, tile_flush;
  logic [63:0] place;
  logic [31:0] sheet_number;
  logic [fastsplat_pkg::SIDE_BITS-1:0] width, height;
  logic free, free_buffer;
  logic window_valid, window_last, window_first, window_buffer;
  logic [31:0] window_tag;
  logic signed [fastsplat_pkg::POS_BITS-1:0] window_x, window_y;
  logic [fastsplat_pkg::RHO_BITS-1:0] window_rho;
  logic [fastsplat_pkg::COL_BITS-1:0] window_base;
  logic [fastsplat_pkg::WINDOW_BITS-1:0] window_column, window_row;
  logic window_ellipse;
  logic [fastsplat_pkg::SHAPE_BITS-1:0] window_shape;
  logic [4*fastsplat_pkg::COLOUR_BITS-1:0] window_colour;
  logic event_splat, event_cull, stall_input, stall_table, stall_buffer, stall_tile, stall_hazard;
  logic beat_valid, beat_ready, beat_payload, beat_aborted, check_busy, soft_reset, at_rest;
  logic [fastsplat_pkg::BEAT_BITS-1:0] beat;
  logic [fastsplat_pkg::COL_BITS-1:0] set_extent;
  logic [7:0] error_rule, error_opcode;
  logic [31:0] error_beat;
  logic cull_idle;
  assign at_rest = stall_input && compositor_idle && pixel_idle && cull_idle;
  fastsplat_stream_check u_check (
      .clk_i,
      .rst_ni,
      .enable_i(!wiping_q),
      .valid_i(s_tvalid_i),
      .ready_o(s_tready_o),
      .data_i(s_tdata_i),
      .valid_o(beat_valid),
      .ready_i(beat_ready),
      .data_o(beat),
      .payload_o(beat_payload),
      .aborted_o(beat_aborted),
      .extent_o(set_extent),
      .reset_i(soft_reset),
      .idle_i(at_rest),
      .busy_o(check_busy),
      .error_o(error_o),
      .error_rule_o(error_rule),
      .error_opcode_o(error_opcode),
      .error_beat_o(error_beat)
  );
  // Beats to decode: check's, or the test unit's with their verdicts.
  logic tested_valid, tested_ready, tested_payload, tested_aborted, swallowed, hidden, culls, sheet_odd;
  logic [fastsplat_pkg::BEAT_BITS-1:0] tested;
  logic [fastsplat_pkg::COL_BITS-1:0] tested_extent;
  logic signed [fastsplat_pkg::ORG_BITS-1:0] first_x, first_y;
  logic tile_begin, map_sheet;
  logic [fastsplat_pkg::BLK_BITS-1:0] map_row;
  logic [fastsplat_pkg::BLOCKS_X-1:0] opaque_row, opaque_row_below;
  logic [BANKS-1:0] frozen;
  logic frozen_changed, blank;
  logic [fastsplat_pkg::ADDR_BITS-1:0] blank_addr;
  logic event_test, event_hidden_set, event_hidden;
  logic [fastsplat_pkg::WINDOWS_X-1:0] event_hidden_windows;
  if (fastsplat_pkg::CULL_MAP != 0) begin : gen_cull
    fastsplat_cull u_cull (
        .clk_i,
        .rst_ni,
        .valid_i(beat_valid),
        .ready_o(beat_ready),
        .data_i(beat),
        .payload_i(beat_payload),
        .aborted_i(beat_aborted),
        .extent_i(set_extent),
        .valid_o(tested_valid),
        .ready_i(tested_ready),
        .data_o(tested),
        .payload_o(tested_payload),
        .aborted_o(tested_aborted),
        .extent_o(tested_extent),
        .swallowed_o(swallowed),
        .hidden_o(hidden),
        .culls_o(culls),
        .sheet_o(sheet_odd),
        .x_o(first_x),
        .y_o(first_y),
        .row_sheet_i(map_sheet),
        .row_i(map_row),
        .row_o(opaque_row),
        .row_below_o(opaque_row_below),
        .tile_begin_i(tile_begin),
        .tile_end_i(tile_end),
        .mode_i(mode),
        .every_sample_i(every_sample),
        .width_i(width),
        .height_i(height),
        .block_valid_i(tap_composite_valid_o),
        .block_i(tap_composite_block_o),
        .frozen_i(frozen),
        .changed_i(frozen_changed),
        .finish_i(tap_sheet_done_o),
        .blank_i(blank),
        .blank_addr_i(blank_addr),
        .verdict_valid_o,
        .verdict_tag_o,
        .verdict_hidden_o,
        .idle_o(cull_idle),
        .event_test_o(event_test),
        .event_hidden_set_o(event_hidden_set)
    );
  end else begin : gen_no_cull
    assign tested_valid = beat_valid;
    assign beat_ready = tested_ready;
    assign tested = beat;
    assign tested_payload = beat_payload;
    assign tested_aborted = beat_aborted;
    assign tested_extent = set_extent;
    assign {swallowed, hidden, culls, sheet_odd, event_test, event_hidden_set} = '0;
    assign {first_x, first_y} = '0;
    assign {opaque_row, opaque_row_below} = '0;
    assign {verdict_valid_o, verdict_tag_o, verdict_hidden_o} = '0;
    assign cull_idle = 1'b1;
    logic unused_cull;
    assign unused_cull = &{1'b0, tile_begin, map_sheet, map_row, frozen, frozen_changed, blank, blank_addr};
  end
  logic tile_aborted, frame_end;
  fastsplat_stream_decode u_decode (
      .clk_i,
      .rst_ni,
      .valid_i(tested_valid),
      .ready_o(tested_ready),
      .data_i(tested),
      .payload_i(tested_payload),
      .aborted_i(tested_aborted),
      .extent_i(tested_extent),
      .swallowed_i(swallowed),
      .hidden_i(hidden),
      .culls_i(culls),
      .sheet_i(sheet_odd),
      .x_i(first_x),
      .y_i(first_y),
      .map_sheet_o(map_sheet),
      .map_row_o(map_row),
      .map_row_i(opaque_row),
      .map_row_below_i(opaque_row_below),
      .rlut_we_o(rlut_we),
      .rlut_wphase_o(rlut_wphase),
      .rlut_wcolumn_o(rlut_wcolumn),
      .radial_we_o(radial_we),
      .factor_we_o(factor_we),
      .density_we_o(density_we),
      .table_o(table_number),
      .table_index_o(table_index),
      .table_word_o(table_word),
      .tile_begin_o(tile_begin),
      .tile_end_o(tile_end),
      .tile_aborted_o(tile_aborted),
      .frame_end_o(frame_end),
      .tile_open_o(tile_open),
      .tile_idle_i(compositor_idle && pixel_idle),
      .mode_o(mode),
      .every_sample_o(every_sample),
      .densities_o(densities),
      .tile_flush_o(tile_flush),
      .place_o(place),
      .sheet_number_o(sheet_number),
      .tile_number_o(tap_tile_o),
      .width_o(width),
      .height_o(height),
      .free_i(free),
      .free_buffer_i(free_buffer),
      .window_valid_o(window_valid),
      .window_last_o(window_last),
      .window_first_o(window_first),
      .window_buffer_o(window_buffer),
      .window_tag_o(window_tag),
      .window_x_o(window_x),
      .window_y_o(window_y),
      .window_rho_o(window_rho),
      .window_base_o(window_base),
      .window_column_o(window_column),
      .window_row_o(window_row),
      .window_ellipse_o(window_ellipse),
      .window_shape_o(window_shape),
      .window_colour_o(window_colour),
      .event_splat_o(event_splat),
      .event_cull_o(event_cull),
      .event_hidden_o(event_hidden),
      .event_hidden_windows_o(event_hidden_windows),
      .stall_input_o(stall_input),
      .stall_table_o(stall_table),
      .stall_buffer_o(stall_buffer),
      .stall_tile_o(stall_tile),
      .stall_hazard_o(stall_hazard)
  );

  logic dirty_valid, dirty_buffer, marked, marked_buffer, done, done_buffer;
  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] dirty_column, dirty_row;
  logic [fastsplat_pkg::LANES-1:0] dirty_inside_x, dirty_inside_y;
  logic sheet_re, sheet_buffer;
  logic [fastsplat_pkg::ADDR_BITS-1:0] sheet_addr;
  logic [BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] sheet_data;
  logic [1:0] snap_saturated;
  logic [fastsplat_pkg::LANES-1:0] window_inside_x, window_inside_y;
  logic [BANKS-1:0] weighted;
  logic sample_valid;
  logic [BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] sample_products;
  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] sample_column, sample_row;
  logic [4*BANKS-1:0] product_saturated, sheet_saturated;
  fastsplat_splat_array u_splat (
      .clk_i,
      .rst_ni,
      .rlut_we_i(rlut_we),
      .rlut_wphase_i(rlut_wphase),
      .rlut_wcolumn_i(rlut_wcolumn),
      .radial_we_i(radial_we),
      .radial_waddr_i(table_index[fastsplat_pkg::RADIAL_LOG2:0]),
      .table_word_i(table_word[fastsplat_pkg::TABLE_BITS-1:0]),
      .width_i(width),
      .height_i(height),
      .every_sample_i(every_sample),
      .densities_i(densities),
      .valid_i(window_valid),
      .last_i(window_last),
      .first_window_i(window_first),
      .buffer_i(window_buffer),
      .tag_i(window_tag),
      .x_i(window_x),
      .y_i(window_y),
      .rho_i(window_rho),
      .base_i(window_base),
      .column_i(window_column),
      .row_i(window_row),
      .ellipse_i(window_ellipse),
      .shape_i(window_shape),
      .colour_i(window_colour),
      .dirty_valid_o(dirty_valid),
      .dirty_buffer_o(dirty_buffer),
      .dirty_column_o(dirty_column),
      .dirty_row_o(dirty_row),
      .dirty_inside_x_o(dirty_inside_x),
      .dirty_inside_y_o(dirty_inside_y),
      .marked_o(marked),
      .marked_buffer_o(marked_buffer),
      .done_o(done),
      .done_buffer_o(done_buffer),
      .wipe_i(wiping_q),
      .wipe_addr_i(wipe_addr_q),
      .comp_re_i(sheet_re),
      .comp_buffer_i(sheet_buffer),
      .comp_addr_i(sheet_addr),
      .comp_data_o(sheet_data),
      .sample_valid_o(sample_valid),
      .sample_products_o(sample_products),
      .sample_column_o(sample_column),
      .sample_row_o(sample_row),
      .tap_snap_valid_o,
      .tap_snap_tag_o,
      .tap_snap_x_o,
      .tap_snap_y_o,
      .tap_snap_mx_o,
      .tap_snap_my_o,
      .tap_snap_saturated_o(snap_saturated),
      .tap_window_valid_o,
      .tap_window_tag_o,
      .tap_window_x_o,
      .tap_window_y_o,
      .tap_weights_o,
      .tap_inside_x_o(window_inside_x),
      .tap_inside_y_o(window_inside_y),
      .tap_weighted_o(weighted),
      .tap_product_saturated_o(product_saturated),
      .tap_sheet_valid_o,
      .tap_sheet_tag_o,
      .tap_sums_o,
      .tap_sheet_saturated_o(sheet_saturated)
  );

  logic picture_re;
  logic [fastsplat_pkg::ADDR_BITS-1:0] picture_addr;
  logic [fastsplat_pkg::LANES-1:0] picture_row;
  logic [fastsplat_pkg::LANES*4*fastsplat_pkg::STATE_BITS-1:0] picture;
  localparam int COMPOSITED = fastsplat_pkg::COMPOSITE_LANES;
  logic slice_valid;
  logic [COMPOSITED-1:0] slice_inside, slice_frozen;
  logic [4*COMPOSITED-1:0] opacity_saturated, composite_saturated;
  fastsplat_compositor u_compositor (
      .clk_i,
      .rst_ni,
      .factor_we_i(factor_we),
      .wipe_i(wiping_q),
      .wipe_addr_i(wipe_addr_q),
      .mode_i(mode),
      .every_sample_i(every_sample),
      .width_i(width),
      .height_i(height),
      .sample_valid_i(sample_valid),
      .sample_products_i(sample_products),
      .sample_column_i(sample_column),
      .sample_row_i(sample_row),
      .sample_inside_x_i(window_inside_x),
      .sample_inside_y_i(window_inside_y),
      .sample_weighted_i(weighted),
      .densities_i(densities),
      .density_we_i(density_we),
      .table_i(table_number),
      .table_index_i(table_index),
      .table_word_i(table_word),
      .place_i(place),
      .sheet_number_i(sheet_number),
      .flush_i(tile_flush),
      .dirty_valid_i(dirty_valid),
      .dirty_buffer_i(dirty_buffer),
      .dirty_column_i(dirty_column),
      .dirty_row_i(dirty_row),
      .dirty_inside_x_i(dirty_inside_x),
      .dirty_inside_y_i(dirty_inside_y),
      .marked_i(marked),
      .marked_buffer_i(marked_buffer),
      .done_i(done),
      .done_buffer_i(done_buffer),
      .free_o(free),
      .free_buffer_o(free_buffer),
      .idle_o(compositor_idle),
      .sheet_re_o(sheet_re),
      .sheet_buffer_o(sheet_buffer),
      .sheet_addr_o(sheet_addr),
      .sheet_data_i(sheet_data),
      .picture_re_i(picture_re),
      .picture_addr_i(picture_addr),
      .picture_row_i(picture_row),
      .picture_o(picture),
      .tap_valid_o(tap_composite_valid_o),
      .tap_block_o(tap_composite_block_o),
      .tap_state_o(tap_state_o),
      .tap_sheet_o(tap_sheet_done_o),
      .cull_frozen_o(frozen),
      .cull_changed_o(frozen_changed),
      .blank_o(blank),
      .blank_addr_o(blank_addr),
      .event_valid_o(slice_valid),
      .event_inside_o(slice_inside),
      .event_frozen_o(slice_frozen),
      .event_opacity_saturated_o(opacity_saturated),
      .event_saturated_o(composite_saturated)
  );

  logic [4*fastsplat_pkg::LANES-1:0] pixel_saturated;
  fastsplat_pixel_out u_pixel_out (
      .clk_i,
      .rst_ni,
      .start_i(tile_end),
      .aborted_i(tile_aborted),
      .idle_o(pixel_idle),
      .mode_i(mode),
      .densities_i(densities),
      .width_i(width),
      .height_i(height),
      .picture_re_o(picture_re),
      .picture_addr_o(picture_addr),
      .picture_row_o(picture_row),
      .picture_i(picture),
      .valid_o(m_tvalid_o),
      .ready_i(m_tready_i),
      .last_o(m_tlast_o),
      .aborted_o(m_tuser_o),
      .data_o(m_tdata_o),
      .keep_o(m_tkeep_o),
      .saturated_o(pixel_saturated)
  );

  // ---- events: counted in two cycles, in the counters a cycle later
  logic [BANKS-1:0] window_inside;
  logic [4*COMPOSITED-1:0] slice_inside4;
  for (genvar b = 0; b < BANKS; b++) begin : gen_inside
    assign window_inside[b] = window_inside_x[b%fastsplat_pkg::LANES] && window_inside_y[b/fastsplat_pkg::LANES];
  end
  for (genvar c = 0; c < COMPOSITED; c++) begin : gen_slice_inside
    assign slice_inside4[4*c+:4] = {4{slice_inside[c]}};
  end
  logic pixel_taken, running, clear_counters;
  assign pixel_taken = m_tvalid_o && m_tready_i;
  // An open tile counts even while nothing moves: its input is late. The compositor only works in a tile.
  assign running = !stall_input || tile_open || !pixel_idle;

  // Events of each counter: the number of bits set in a cycle.
  localparam int MOST = (fastsplat_pkg::CULL_MAP != 0 && fastsplat_pkg::WINDOWS_X > 4 * BANKS) ? fastsplat_pkg::WINDOWS_X : 4 * BANKS;
  logic [MOST-1:0] events[0:fastsplat_pkg::COUNTERS-1];
  always_comb begin
    // Counters that not every device has.
    for (int n = 0; n < fastsplat_pkg::COUNTERS; n++) begin
      events[n] = (n == fastsplat_pkg::CNT_HIDDEN_WINDOWS) ? MOST'(event_hidden_windows)
                  : MOST'((n == fastsplat_pkg::CNT_STALL_HAZARD && stall_hazard) || (n == fastsplat_pkg::CNT_CULL_TESTS && event_test) ||
                          (n == fastsplat_pkg::CNT_HIDDEN_SETS && event_hidden_set) ||
                          (n == fastsplat_pkg::CNT_HIDDEN_SPLATS && event_hidden));
    end
    events[fastsplat_pkg::CNT_SHEETS][0] = tap_sheet_done_o;
    events[fastsplat_pkg::CNT_SPLATS][0] = event_splat;
    events[fastsplat_pkg::CNT_CULL_BLOCKS][0] = event_cull;
    if (tap_snap_valid_o) events[fastsplat_pkg::CNT_SNAP_SATURATED][1:0] = snap_saturated;
    events[fastsplat_pkg::CNT_WINDOWS][0] = tap_window_valid_o;
    if (tap_window_valid_o) begin
      events[fastsplat_pkg::CNT_LANES_INSIDE][BANKS-1:0] = window_inside;
      events[fastsplat_pkg::CNT_LANES_WEIGHTED][BANKS-1:0] = weighted;
      events[fastsplat_pkg::CNT_PRODUCT_SATURATED][4*BANKS-1:0] = product_saturated;
    end
    if (tap_sheet_valid_o && !`FASTSPLAT_FAULT(LOST_COUNT)) events[fastsplat_pkg::CNT_SHEET_SATURATED][4*BANKS-1:0] = sheet_saturated;
    events[fastsplat_pkg::CNT_DIRTY_BLOCKS][0] = tap_composite_valid_o && !every_sample;
    if (slice_valid) begin
      events[fastsplat_pkg::CNT_PIXELS_COMPOSITED][COMPOSITED-1:0] = slice_inside;
      events[fastsplat_pkg::CNT_FROZEN_PIXELS][COMPOSITED-1:0] = slice_inside & slice_frozen;
      events[fastsplat_pkg::CNT_OPACITY_SATURATED][4*COMPOSITED-1:0] = slice_inside4 & opacity_saturated;
      events[fastsplat_pkg::CNT_COMPOSITE_SATURATED][4*COMPOSITED-1:0] = slice_inside4 & composite_saturated;
    end
    if (pixel_taken) begin
      events[fastsplat_pkg::CNT_TILES][0] = m_tlast_o;
      events[fastsplat_pkg::CNT_PIXEL_SATURATED][4*fastsplat_pkg::LANES-1:0] = pixel_saturated;
    end
    events[fastsplat_pkg::CNT_CYCLES][0] = running;
    events[fastsplat_pkg::CNT_STALL_INPUT][0] = running && stall_input;
    events[fastsplat_pkg::CNT_STALL_TABLE][0] = stall_table;
    events[fastsplat_pkg::CNT_STALL_BUFFER][0] = stall_buffer;
    events[fastsplat_pkg::CNT_STALL_TILE][0] = stall_tile;
  end
  logic [16*fastsplat_pkg::COUNTERS-1:0] increments;
  for (genvar n = 0; n < fastsplat_pkg::COUNTERS; n++) begin : gen_count
    localparam bit OfLanes = n == fastsplat_pkg::CNT_LANES_INSIDE || n == fastsplat_pkg::CNT_LANES_WEIGHTED;
    localparam bit OfProducts = n == fastsplat_pkg::CNT_PRODUCT_SATURATED || n == fastsplat_pkg::CNT_SHEET_SATURATED;
    localparam bit OfPixels = n == fastsplat_pkg::CNT_PIXELS_COMPOSITED || n == fastsplat_pkg::CNT_FROZEN_PIXELS;
    localparam bit OfSlabs = n == fastsplat_pkg::CNT_OPACITY_SATURATED || n == fastsplat_pkg::CNT_COMPOSITE_SATURATED;
    localparam int Bits = OfLanes ? BANKS
                        : OfProducts ? 4 * BANKS
                        : OfPixels ? COMPOSITED
                        : OfSlabs ? 4 * COMPOSITED
                        : n == fastsplat_pkg::CNT_PIXEL_SATURATED ? 4 * fastsplat_pkg::LANES
                        : n == fastsplat_pkg::CNT_HIDDEN_WINDOWS ? fastsplat_pkg::WINDOWS_X
                        : n == fastsplat_pkg::CNT_SNAP_SATURATED ? 2 : 1;
    fastsplat_popcount #(.BITS(Bits)) u_count (
        .clk_i,
        .rst_ni,
        .clear_i(clear_counters),
        .bits_i(events[n][Bits-1:0]),
        .count_o(increments[16*n+:16])
    );
  end

  // A frame has left when its end_frame was carried out and its last picture is gone.
  logic frame_ending_q;
  assign frame_end_o = frame_ending_q && pixel_idle;
  always_ff @(posedge clk_i) frame_ending_q <= rst_ni && (frame_end || (frame_ending_q && !frame_end_o));

  fastsplat_csr u_csr (
      .clk_i,
      .rst_ni,
      .awvalid_i,
      .awready_o,
      .awaddr_i,
      .wvalid_i,
      .wready_o,
      .wdata_i,
      .bvalid_o,
      .bready_i,
      .bresp_o,
      .arvalid_i,
      .arready_o,
      .araddr_i,
      .rvalid_o,
      .rready_i,
      .rdata_o,
      .rresp_o,
      .busy_i(running || check_busy || !cull_idle || (SLICED && slices_busy_i)),
      .error_i(error_o),
      .error_rule_i(error_rule),
      .error_opcode_i(error_opcode),
      .error_beat_i(error_beat),
      .reset_o(soft_reset),
      .frame_i(SLICED ? frame_left_i : frame_end_o),
      .tile_i(SLICED ? tile_left_i : pixel_taken && m_tlast_o),
      .irq_o,
      .clear_o(clear_counters),
      .increments_i(increments)
  );
  logic unused;
  assign unused = &{1'b0, table_index, table_word, event_test, event_hidden_set, event_hidden, event_hidden_windows, slices_busy_i, tile_left_i, frame_left_i};
  `FASTSPLAT_ASSERT(no_beat_while_wiping, !(wiping_q && s_tready_o))
  `FASTSPLAT_ASSERT(pixel_beat_not_empty, !m_tvalid_o || m_tkeep_o[0])

  fastsplat_parameters u_parameters ();
endmodule
