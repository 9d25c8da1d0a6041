// SPDX-License-Identifier: Apache-2.0
// Check on arbitrary beats (docs/microarchitecture.md, "Check"; docs/stream.md, "Rules by number"), written again from
// the pages and put inside stream_check by prove_control.sh. The input is arbitrary, held or not; decode, the units
// behind it, enable and soft resets are free. Up to the first refusal beats pass in order, once and unchanged. Then
// none passes, but open sheets and tiles are closed. Passed beats satisfy the stream invariants.
localparam int CB = fastsplat_pkg::COLOUR_BITS;
localparam int P = fastsplat_pkg::LANES;
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

`ifdef F_FEW_BEATS
// For covers, where z3 must find a beat: one good beat of each kind, and one illegal beat.
(* anyseq *) logic [3:0] f_which;
logic [fastsplat_pkg::BEAT_BITS-1:0] f_few;
always @* begin
  case (f_which)
    4'd0: f_few = {32'd1, 32'h00020002, fastsplat_pkg::HASH_HIGH, fastsplat_pkg::HASH_LOW, 32'h31535346, 32'h00020046};
    4'd1: f_few = {64'd0, 32'd4, 32'd1, 32'd0, 32'h0000004C};
    4'd2: f_few = {64'd0, 32'(fastsplat_pkg::RADIAL_ENTRIES), 64'd0, 32'h0000014C};
    4'd3: f_few = {64'd0, 32'(fastsplat_pkg::SEGMENTS + 1), 64'd0, 32'h0000024C};
    4'd4: f_few = '0;
    4'd5: f_few = {32'd0, 32'h00020002, 96'd0, 32'h00000054};
    4'd6: f_few = {160'd0, 32'h00000053};
    4'd7: f_few = {160'd0, 32'h00000050};
    4'd8: f_few = {128'd0, 32'd1, 32'h00000050};
    4'd9: f_few = {32'd0, 32'h00010001, 96'd0, 32'h00000043};
    4'd10: f_few = {160'd0, 32'h00000073};
    4'd11: f_few = {96'd0, 32'd1, 32'd0, 32'h00000073};
    4'd12: f_few = {160'd0, 32'h00000074};
    4'd13: f_few = {96'd0, 32'd1, 32'd0, 32'h00000074};
    4'd14: f_few = {160'd0, 32'h00000066};
    default: f_few = '1;
  endcase
  assume (data_i == f_few);
end
`endif

// What decode's proof assumes.
logic f_passed_valid, f_passed_ready, f_passed_payload, f_passed_aborted;
logic [fastsplat_pkg::BEAT_BITS-1:0] f_passed_data;
logic [COL-1:0] f_passed_extent;
assign f_passed_valid = valid_o;
assign f_passed_ready = ready_i;
assign f_passed_data = data_o;
assign f_passed_payload = payload_o;
assign f_passed_aborted = aborted_o;
assign f_passed_extent = extent_o;
`define F_INVARIANT(ALWAYS) assert (ALWAYS)
`include "stream_invariants.svh"

// The beats that were taken and did not pass yet: the elder is checked (M-check-1).
logic f_next_q, f_have_q;
logic [fastsplat_pkg::BEAT_BITS-1:0] f_next_beat_q, f_beat_q;
logic [31:0] f_w0, f_w1, f_w2, f_w3, f_w4, f_w5, f_w6, f_w7;
assign {f_w7, f_w6, f_w5, f_w4, f_w3, f_w2, f_w1, f_w0} = f_beat_q;

// What passed since the last reset. The frame: 0 none, 1 begun, 2 in a tile, 3 in a sheet.
logic [1:0] f_place_q;
logic f_tile_q;          // a tile was begun
logic [31:0] f_number_q; // beats of the frame
logic [31:0] f_image_q, f_tiles_q, f_of_tile_q, f_of_sheet_q, f_sheets_q, f_splats_q, f_tags_q;
logic [fastsplat_pkg::RLUT_SETS-1:0] f_sets_q;
logic f_radial_q, f_factor_q;
logic [7:0] f_table_q;
logic [31:0] f_left_q, f_before_q;  // words to come; the word before them, or the largest

// The rules: S-reader-4; the first that is broken, S-rule-1; of table words only one, S-rule-2.
logic [7:0] f_rule;
logic [39:0] f_pixels, f_columns;  // E and Ea of the radius in w2
assign f_pixels = (40'(f_w2) * 40'd2 + 40'(fastsplat_pkg::PHASES - 1)) / 40'(fastsplat_pkg::PHASES);
assign f_columns = (f_pixels + 40'(P - 1)) / 40'(P) * 40'(P);
logic f_known, f_order, f_unnamed, f_words_bad, f_table_bad, f_tile_bad, f_range_bad;
logic [31:0] f_word, f_word_before, f_word_most;
always @* begin
  f_word_most = f_table_q == 8'd0 ? fastsplat_pkg::RLUT_WORD_MOST
                : f_table_q == 8'd1 ? (32'd1 << fastsplat_pkg::WEIGHT_BITS) - 32'd1 : 32'd1 << (fastsplat_pkg::FACTOR_BITS - 1);
  f_words_bad = 1'b0;
  f_word_before = f_before_q;
  for (int i = 0; i < 8; i++) begin
    f_word = f_beat_q[32*i+:32];
    if (32'(i) >= f_left_q) begin
      if (f_word != '0) f_words_bad = 1'b1;
    end else begin
      if (f_word > f_word_most || (f_table_q == 8'd2 && f_word > f_word_before)) f_words_bad = 1'b1;
      f_word_before = f_word;
    end
  end
  case (f_w0[15:8])
    8'd0: f_table_bad = !(f_w1 < fastsplat_pkg::RLUT_SETS && f_w2 >= 32'd1 && f_w4 % 32'(P) == '0 &&
                          40'(f_w4) + f_columns <= 40'(fastsplat_pkg::RLUT_COLUMNS) && 40'(f_w3) == f_columns * 40'(fastsplat_pkg::PHASES));
    8'd1: f_table_bad = !(f_w1 == '0 && f_w2 == '0 && f_w4 == '0 && f_w3 == 32'(fastsplat_pkg::RADIAL_ENTRIES));
    8'd2: f_table_bad = !(f_w1 == '0 && f_w2 == '0 && f_w4 == '0 && f_w3 == 32'(fastsplat_pkg::SEGMENTS + 1));
    default: f_table_bad = 1'b1;
  endcase
  f_tile_bad = f_w0[11:8] > 4'd2 || f_w1 >= f_tiles_q || f_w4[15:0] < 16'd1 || f_w4[15:0] > 16'(fastsplat_pkg::TILE_WIDTH) ||
               f_w4[31:16] < 16'd1 || f_w4[31:16] > 16'(fastsplat_pkg::TILE_HEIGHT) ||
               33'(f_w2) + 33'(f_w4[15:0]) > 33'(f_image_q[15:0]) || 33'(f_w3) + 33'(f_w4[31:16]) > 33'(f_image_q[31:16]);
  // x + 2^(b-1) is in 0..2^b - 1; b: bits of a position.
  f_range_bad = f_w2 + (32'd1 << (fastsplat_pkg::POS_BITS - 1)) >= (32'd1 << fastsplat_pkg::POS_BITS) ||
                f_w3 + (32'd1 << (fastsplat_pkg::POS_BITS - 1)) >= (32'd1 << fastsplat_pkg::POS_BITS) ||
                32'(f_w4[15:0]) >= (32'd1 << CB) || 32'(f_w4[31:16]) >= (32'd1 << CB) ||
                32'(f_w5[15:0]) >= (32'd1 << CB) || 32'(f_w5[31:16]) >= (32'd1 << CB);
  f_known = 1'b1;
  f_order = 1'b0;
  f_unnamed = 1'b0;
  case (f_w0[7:0])
    // S-grammar-1, S-record-3.
    8'h46: {f_order, f_unnamed} = {f_place_q == 2'd0, f_w0[15:8] != '0};
    8'h4C: {f_order, f_unnamed} = {f_place_q == 2'd1 && !f_tile_q, f_w0[31:16] != '0 || f_w5 != '0};
    8'h54: {f_order, f_unnamed} = {f_place_q == 2'd1, f_w0[31:12] != '0 || f_w5 != '0};
    8'h66: {f_order, f_unnamed} = {f_place_q == 2'd1, f_w0[31:8] != '0 || f_w4 != '0 || f_w5 != '0};
    8'h53: {f_order, f_unnamed} = {f_place_q == 2'd2, f_w0[31:8] != '0 || {f_w2, f_w3, f_w4, f_w5} != '0};
    8'h74: {f_order, f_unnamed} = {f_place_q == 2'd2, f_w0[31:8] != '0 || {f_w3, f_w4, f_w5} != '0};
    8'h50: {f_order, f_unnamed} = {f_place_q == 2'd3, f_w0[31:16] != '0};
    8'h43: {f_order, f_unnamed} = {f_place_q == 2'd3, f_w0[31:8] != '0};
    8'h73: {f_order, f_unnamed} = {f_place_q == 2'd3, f_w0[31:8] != '0 || {f_w3, f_w4, f_w5} != '0};
    default: f_known = 1'b0;
  endcase
  if ({f_w6, f_w7} != '0) f_unnamed = 1'b1;  // no record has fields there
  f_rule = 8'd0;
  if (f_left_q != '0) f_rule = f_words_bad ? 8'd8 : 8'd0;
  else if (!f_known) f_rule = 8'd1;
  else if (!f_order) f_rule = 8'd2;
  else if (f_unnamed) f_rule = 8'd3;
  else if (f_w0[7:0] == 8'h46) begin
    if (f_w1 != 32'h31535346 || f_w0[31:16] != 16'd2) f_rule = 8'd4;
    else if ({f_w3, f_w2} != {fastsplat_pkg::HASH_HIGH, fastsplat_pkg::HASH_LOW}) f_rule = 8'd5;
    else if (f_w4[15:0] < 16'd1 || f_w4[31:16] < 16'd1) f_rule = 8'd6;
  end else if (f_w0[7:0] == 8'h4C) f_rule = f_table_bad ? 8'd7 : 8'd0;
  else if (f_w0[7:0] == 8'h54) f_rule = !(f_radial_q && f_factor_q) ? 8'd9 : f_tile_bad ? 8'd10 : 8'd0;
  else if (f_w0[7:0] == 8'h53) f_rule = f_sheets_q != '0 && f_w1 <= f_of_sheet_q ? 8'd11 : 8'd0;
  else if (f_w0[7:0] == 8'h50)
    f_rule = !(f_w0[15:8] < fastsplat_pkg::RLUT_SETS && f_sets_q[f_w0[8+:fastsplat_pkg::SET_BITS]]) ? 8'd12
             : f_range_bad ? 8'd13 : f_w1 != f_tags_q ? 8'd14 : 8'd0;
  else if (f_w0[7:0] == 8'h43) f_rule = f_w4[15:0] < 16'd1 || f_w4[31:16] < 16'd1 ? 8'd15 : 8'd0;
  else if (f_w0[7:0] == 8'h73) f_rule = f_w1 != f_of_sheet_q ? 8'd16 : f_w2 != f_splats_q ? 8'd17 : 8'd0;
  else if (f_w0[7:0] == 8'h74) f_rule = f_w1 != f_of_tile_q ? 8'd16 : f_w2 != f_sheets_q ? 8'd17 : 8'd0;
end

// What is offered to decode: the beat; or, after a refusal or for a soft reset, what closes what is open (M-check-8, M-check-10).
logic f_error_q, f_soft_q, f_stop, f_offers, f_closes, f_passes, f_moves;
logic [7:0] f_error_rule_q, f_error_opcode_q;
logic [31:0] f_error_number_q;
assign f_stop = f_error_q || (f_soft_q && !f_have_q && !f_next_q);
assign f_offers = f_have_q && f_rule == 8'd0;
assign f_closes = f_stop && f_place_q >= 2'd2;
assign f_passes = f_offers && ready_i;
assign f_moves = f_next_q && (!f_have_q || ready_i);  // even behind a beat that is refused (M-check-3)

always @(posedge clk_i) begin
  if (f_passes) f_have_q <= 1'b0;
  if (f_moves) begin
    f_next_q <= 1'b0;
    f_have_q <= 1'b1;
    f_beat_q <= f_next_beat_q;
  end
  if (valid_i && ready_o && !f_error_q) begin
    f_next_q <= 1'b1;
    f_next_beat_q <= data_i;
  end
  // Refused in its first cycle here, whatever decode does (M-check-5), and reported from the next one on (M-check-6); both registers are
  // emptied, and nothing comes into them any more (M-check-7).
  if (f_have_q && f_rule != 8'd0) begin
    f_next_q <= 1'b0;
    f_have_q <= 1'b0;
    f_error_q <= 1'b1;
    f_error_rule_q <= f_rule;
    f_error_opcode_q <= f_beat_q[7:0];
    f_error_number_q <= f_number_q;
  end
  if (f_closes && ready_i) f_place_q <= f_place_q - 2'd1;
  if (f_passes) begin
    f_number_q <= f_number_q + 32'd1;
    if (f_left_q != '0) begin
      f_left_q <= f_left_q > 32'd8 ? f_left_q - 32'd8 : '0;
      f_before_q <= f_w7;
      if (f_left_q <= 32'd8 && f_table_q == 8'd1) f_radial_q <= 1'b1;
      if (f_left_q <= 32'd8 && f_table_q == 8'd2) f_factor_q <= 1'b1;
    end else begin
      case (f_w0[7:0])
        8'h46: begin
          f_place_q <= 2'd1;
          f_tile_q <= 1'b0;
          f_image_q <= f_w4;
          f_tiles_q <= f_w5;
          f_sets_q <= '0;
          f_radial_q <= 1'b0;
          f_factor_q <= 1'b0;
        end
        8'h4C: begin
          f_table_q <= f_w0[15:8];
          f_left_q <= f_w3;
          f_before_q <= '1;
          if (f_w0[15:8] == 8'd0) f_sets_q[f_w1[fastsplat_pkg::SET_BITS-1:0]] <= 1'b1;
        end
        8'h54: begin
          f_place_q <= 2'd2;
          f_tile_q <= 1'b1;
          f_of_tile_q <= f_w1;
          f_sheets_q <= '0;
          f_tags_q <= '0;
        end
        8'h53: begin
          f_place_q <= 2'd3;
          f_of_sheet_q <= f_w1;
          f_sheets_q <= f_sheets_q + 32'd1;
          f_splats_q <= '0;
        end
        8'h50: begin
          f_tags_q <= f_tags_q + 32'd1;
          f_splats_q <= f_splats_q + 32'd1;
        end
        8'h73: f_place_q <= 2'd2;
        8'h74: f_place_q <= 2'd1;
        8'h66: begin
          f_place_q <= 2'd0;
          f_number_q <= '0;
        end
        default: ;
      endcase
    end
  end
  // A soft reset lasts until nothing is here or open, and all behind is at rest; then all is as after a reset (M-check-10, M-check-11).
  if (reset_i) f_soft_q <= 1'b1;
  else if (f_soft_q && f_stop && !f_closes && idle_i) f_soft_q <= 1'b0;
  if (!rst_ni || (f_soft_q && !reset_i && f_stop && !f_closes && idle_i)) begin
    f_place_q <= 2'd0;
    f_left_q <= '0;
    f_number_q <= '0;
    f_error_q <= 1'b0;
    f_error_rule_q <= '0;
    f_error_opcode_q <= '0;
    f_error_number_q <= '0;
  end
  if (!rst_ni) begin
    f_next_q <= 1'b0;
    f_have_q <= 1'b0;
    f_soft_q <= 1'b0;
  end
end

// Cycles without ready that check itself causes: one for a refusal; for a soft reset both beats, end_sheet, end_tile
// and its end.
logic [2:0] f_waits_q, f_phase;
always @(posedge clk_i) f_waits_q <= rst_ni && enable_i && ready_i && idle_i && !reset_i && !ready_o ? f_waits_q + 3'(f_waits_q != '1) : '0;
assign f_phase = f_next_q ? 3'd0 : f_have_q ? 3'd1 : f_place_q == 2'd3 ? 3'd2 : f_place_q == 2'd2 ? 3'd3 : 3'd4;
// Ends since the source was stopped: of a sheet, of a tile.
logic [1:0] f_sheet_ends_q, f_tile_ends_q;
always @(posedge clk_i) begin
  if (f_stop && valid_o && ready_i) begin
    if (data_o[7:0] == 8'h73) f_sheet_ends_q <= f_sheet_ends_q + 2'(f_sheet_ends_q != '1);
    else f_tile_ends_q <= f_tile_ends_q + 2'(f_tile_ends_q != '1);
  end
  if (!rst_ni || !f_stop) begin
    f_sheet_ends_q <= '0;
    f_tile_ends_q <= '0;
  end
end

// Counts of the first stage: as if the beat in the second stage had passed, and its own too, if it is not new.
logic f_tile_to_come, f_sheet_to_come, f_next_counted;
logic [31:0] f_tile_to, f_sheet_to, f_sheets_to, f_splats_to, f_tags_to;
logic [31:0] f_tile_on, f_sheet_on, f_sheets_on, f_splats_on, f_tags_on;
logic [31:0] f_n0, f_n1, f_n2;
logic [17:0] f_counts_break;
assign {f_n2, f_n1, f_n0} = f_next_beat_q[95:0];
assign f_next_counted = f_next_q && !next_new_q;
always @* begin
  f_tile_to_come = f_place_q >= 2'd2 || (f_have_q && f_left_q == '0 && f_w0[7:0] == 8'h54);
  f_sheet_to_come = f_place_q == 2'd3 || (f_have_q && f_w0[7:0] == 8'h53);
  {f_tile_to, f_sheet_to, f_sheets_to, f_splats_to, f_tags_to} = {f_of_tile_q, f_of_sheet_q, f_sheets_q, f_splats_q, f_tags_q};
  if (f_have_q) begin
    case (f_w0[7:0])
      8'h54: {f_tile_to, f_sheets_to, f_tags_to} = {f_w1, 64'd0};
      8'h53: {f_sheet_to, f_sheets_to, f_splats_to} = {f_w1, f_sheets_q + 32'd1, 32'd0};
      8'h50, 8'h45: {f_splats_to, f_tags_to} = {f_splats_q + 32'd1, f_tags_q + 32'd1};
      default: ;
    endcase
  end
  {f_tile_on, f_sheet_on, f_sheets_on, f_splats_on, f_tags_on} = {f_tile_to, f_sheet_to, f_sheets_to, f_splats_to, f_tags_to};
  f_counts_break = '0;
  if (f_next_counted) begin
    case (f_n0[7:0])
      8'h54: {f_tile_on, f_sheets_on, f_tags_on} = {f_n1, 64'd0};
      8'h53: {f_sheet_on, f_sheets_on, f_splats_on} = {f_n1, f_sheets_to + 32'd1, 32'd0};
      8'h50, 8'h45: {f_splats_on, f_tags_on} = {f_splats_to + 32'd1, f_tags_to + 32'd1};
      default: ;
    endcase
    f_counts_break[11] = f_n0[7:0] == 8'h53 && f_sheets_to != '0 && f_n1 <= f_sheet_to;
    f_counts_break[14] = (f_n0[7:0] == 8'h50 || f_n0[7:0] == 8'h45) && f_n1 != f_tags_to;
    f_counts_break[16] = (f_n0[7:0] == 8'h73 && f_n1 != f_sheet_to) || (f_n0[7:0] == 8'h74 && f_n1 != f_tile_to);
    f_counts_break[17] = (f_n0[7:0] == 8'h73 && f_n2 != f_splats_to) || (f_n0[7:0] == 8'h74 && f_n2 != f_sheets_to);
  end
end

// What is offered stays.
logic f_held_q;
logic [257:0] f_offered_q;
always @(posedge clk_i) begin
  f_held_q <= rst_ni && valid_o && !ready_i;
  f_offered_q <= {data_o, payload_o, aborted_o};
end

always @* begin
  if (f_started && rst_ni) begin
    // Beats are taken as the page says (M-check-2; after a refusal one a cycle, M-check-7), and pass in order, once, unchanged (M-check-3).
    assert (ready_o == (enable_i && !f_soft_q && (!f_next_q || f_moves || f_error_q)));
    assert (valid_o == (f_offers || f_closes));
    assert (!(f_offers && f_closes));
    assert (!f_offers || (data_o == f_beat_q && payload_o == (f_left_q != '0) && !aborted_o));
    assert (!f_held_q || (valid_o && {data_o, payload_o, aborted_o} == f_offered_q));
    // What closes: end_sheet, then end_tile, each where it is open, and the latter alone marked (M-check-8, M-check-9).
    assert (!f_closes || (data_o[7:0] == (f_place_q == 2'd3 ? 8'h73 : 8'h74) && !payload_o && aborted_o == (f_place_q == 2'd2)));
    assert (f_sheet_ends_q <= 2'd1 && f_tile_ends_q <= 2'd1);
    assert (!(f_stop && valid_o) || (data_o[7:0] == 8'h73 && f_sheet_ends_q == '0 && f_tile_ends_q == '0) ||
            (data_o[7:0] == 8'h74 && f_tile_ends_q == '0));
    // What is reported (M-check-6); busy lasts as long as a soft reset (M-check-13).
    assert (error_o == f_error_q);
    assert (error_rule_o == f_error_rule_q && error_opcode_o == f_error_opcode_q && error_beat_o == f_error_number_q);
    assert (busy_o == (f_next_q || f_have_q || f_closes || f_soft_q));
    // No wait is long.
    assert (f_waits_q <= 3'd5 && (f_soft_q || f_have_q || f_error_q || f_waits_q == '0 || f_place_q == 2'd0));

    // For induction: the registers of check and of the specification say the same.
    assert (beat_valid_q == f_have_q && (!f_have_q || beat_q == f_beat_q));
    assert (next_valid_q == f_next_q && (!f_next_q || next_q == f_next_beat_q));
    assert (!((f_have_q || f_next_q) && f_error_q));
    assert (!next_new_q || f_next_q || f_error_q || f_place_q == 2'd0);
    assert (reset_q == f_soft_q);
    assert (place_q == (f_left_q != '0 ? PlWords : f_place_q == 2'd0 ? PlStart : f_place_q == 2'd1 ? PlTables : f_place_q == 2'd2 ? PlTile : PlSheet));
    assert (f_left_q == '0 || f_place_q == 2'd1);
    assert (f_error_q || beats_q == f_number_q);
    if (f_place_q != 2'd0 && !f_error_q) begin
      assert (tile_seen_q == f_tile_q && image_width_q == f_image_q[15:0] && image_height_q == f_image_q[31:16] && tiles_q == f_tiles_q);
      assert (sets_loaded_q == f_sets_q && radial_loaded_q == f_radial_q && factor_loaded_q == f_factor_q);
    end
    if (!f_error_q && (f_tile_to_come || (f_next_counted && f_n0[7:0] == 8'h54))) begin
      assert (tile_q == f_tile_on && sheets_q == f_sheets_on && tag_q == f_tags_on);
      assert (!f_tile_to_come || (f_sheets_on == '0 && !f_sheet_to_come && !(f_next_counted && f_n0[7:0] == 8'h53)) || (sheet_q == f_sheet_on && splats_q == f_splats_on));
    end
    if (f_next_counted) begin
      assert ((counted_broken_q & ~(f_n0[7:0] == 8'h53 ? 18'd1 << 11 : f_n0[7:0] == 8'h50 || f_n0[7:0] == 8'h45 ? 18'd1 << 14 :
                                    f_n0[7:0] == 8'h73 || f_n0[7:0] == 8'h74 ? 18'd3 << 16 : 18'd0)) == '0);
    end
    if (f_next_counted && f_tile_to_come && !(f_sheets_to == '0 && !f_sheet_to_come && f_n0[7:0] == 8'h73)) assert (counted_broken_q == f_counts_break);
    // What the first stage found: what the rules say once the beat is in its place.
    if (f_have_q) begin
      assert (any_broken_q == ((record_broken_q & ~LATE) != '0) && !record_broken_q[0] && !record_broken_q[2] && !record_broken_q[8] && !record_broken_q[9]);
      assert (record_broken_q[1] == !f_known);
      assert (!f_known || record_broken_q[3] == f_unnamed);
      assert (f_w0[7:0] != 8'h54 || (record_broken_q & ~(18'd1 << 3 | 18'd1 << 10)) == '0);
      assert (record_place_q == (f_w0[7:0] == 8'h46 ? PlStart : f_w0[7:0] == 8'h53 || f_w0[7:0] == 8'h74 ? PlTile :
                                 f_w0[7:0] == 8'h50 || f_w0[7:0] == 8'h45 || f_w0[7:0] == 8'h43 || f_w0[7:0] == 8'h73 ? PlSheet : PlTables));
      assert (f_left_q != '0 || !f_known || !f_order || (f_w0[7:0] == 8'h54 && !(f_radial_q && f_factor_q)) || (broken ? rule : 8'd0) == f_rule);
      assert (f_w0[7:0] != 8'h4C || f_left_q != '0 || f_rule != 8'd0 || 40'(extent_q) == f_columns || f_w0[15:8] != 8'd0);
      for (int i = 0; i < 8; i++) begin
        assert (zero_q[i] == (f_beat_q[32*i+:32] == '0));
        assert (rlut_q[i] == (f_beat_q[32*i+:32] <= fastsplat_pkg::RLUT_WORD_MOST));
        assert (radial_q[i] == (f_beat_q[32*i+:32] <= fastsplat_pkg::RADIAL_WORD_MOST));
        assert (factor_q[i] == (f_beat_q[32*i+:32] <= fastsplat_pkg::FACTOR_WORD_MOST));
        if (i > 0) assert (falls_q[i] == (f_beat_q[32*i+:FB] <= f_beat_q[32*(i-1)+:FB]));
      end
      assert (f_left_q == '0 || f_table_q != 8'd2 || first_words_q || falls_q[0] == (f_beat_q[0+:FB] <= f_before_q[FB-1:0]));
    end
    if (f_left_q != '0 && !f_error_q) begin
      assert (32'(words_left_q) == f_left_q && table_q == f_table_q && f_table_q <= 8'd2 && first_words_q == (f_before_q == '1));
      assert (last_words_q == (f_left_q <= 32'd8));
      for (int i = 0; i < 8; i++) assert (there_q[i] == (f_left_q > 32'(i)));
      if (f_table_q == 8'd2) assert (f_before_q == '1 || f_before_q <= f_word_most);
      assert (word_before_q == (f_have_q ? f_w7[FB-1:0] : f_before_q[FB-1:0]) || (!f_have_q && first_words_q));
    end
    assert (f_passed_place_q == (f_place_q == 2'd3 ? 2'd2 : f_place_q == 2'd2 ? 2'd1 : 2'd0));
    assert (f_place_q == 2'd0 || f_words_left_q == f_left_q);
    assert (f_place_q == 2'd0 || (f_sets_q & ~f_passed_sets_q) == '0);
    assert (f_place_q != 2'd3 || f_sheet_ends_q == '0);
    assert (f_place_q < 2'd2 || f_tile_ends_q == '0);
    assert (!f_soft_q || f_waits_q <= f_phase);
    assert (f_soft_q || !f_have_q || f_waits_q == '0);
    assert (f_soft_q || !f_error_q || f_waits_q <= 3'd1);
    // What lies deeper, a refusal within a sheet, z3 does not reach in minutes; streams that break the rules do.
    cover (f_offers && f_left_q == 32'd1);
  end
end
