// SPDX-License-Identifier: Apache-2.0
// Unit "check": checks each beat before decode sees it, by every rule of docs/stream.md that a device checks
// (cmodel/decode/stream_decode.hpp, StreamScope::Subset; cmodel/stream/stream_rules.hpp). Two beat registers in front
// of decode's: long comparisons in the first stage, the beat's place in the grammar in the second.
// The first illegal beat and all later ones are dropped. Its rule, opcode and number stay in registers. An open tile is
// ended by an end_sheet and an end_tile of the device's own: its picture goes out, marked, and all memories are left as
// after any tile. A soft reset does the same, then waits for a begin_frame.
`include "assertions.svh"

module fastsplat_stream_check (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  logic         enable_i,        // 0 while memories are wiped after reset
    // stream in
    input  logic         valid_i,
    output logic         ready_o,
    input  logic [fastsplat_pkg::BEAT_BITS-1:0] data_i,
    // to decode
    output logic         valid_o,
    input  logic         ready_i,
    output logic [fastsplat_pkg::BEAT_BITS-1:0] data_o,
    output logic         payload_o,       // words of the table announced last
    output logic         aborted_o,       // end_tile of the device's own
    output logic [fastsplat_pkg::COL_BITS-1:0] extent_o,  // padded extent of the set announced last
    // soft reset
    input  logic         reset_i,         // pulse
    input  logic         idle_i,          // behind this unit all is at rest
    output logic         busy_o,          // a beat is here or taken back, a tile is being ended, or a soft reset under way
    // the first refusal since reset
    output logic         error_o,
    output logic [7:0]   error_rule_o,
    output logic [7:0]   error_opcode_o,
    output logic [31:0]  error_beat_o
);
  localparam int COL = fastsplat_pkg::COL_BITS;
  localparam int FB = fastsplat_pkg::FACTOR_BITS;
  localparam int WB = fastsplat_pkg::WORDS_BITS;
  localparam int RULES = fastsplat_pkg::RULE_END_COUNT;
  // Rules checked against counts of earlier beats.
  localparam logic [RULES:0] COUNTED = (RULES + 1)'(1) << fastsplat_pkg::RULE_SHEET | (RULES + 1)'(1) << fastsplat_pkg::RULE_TAG |
                                       (RULES + 1)'(1) << fastsplat_pkg::RULE_END_NUMBER | (RULES + 1)'(1) << fastsplat_pkg::RULE_END_COUNT;
  // Rules that compare magnitudes, not only equality, with words that are variable or sums.
  localparam logic [RULES:0] LATE = (RULES + 1)'(1) << fastsplat_pkg::RULE_TABLE | (RULES + 1)'(1) << fastsplat_pkg::RULE_TILE |
                                    (RULES + 1)'(1) << fastsplat_pkg::RULE_SHEET;

  // Where in the grammar the beat stands.
  typedef enum logic [2:0] {PlStart, PlTables, PlWords, PlTile, PlSheet} place_e;

  // ---- first stage: what can be checked before the beat's place is known. Numbers and counts are of earlier records.
  // Table words are taken for records, too: harmless, because they lie outside tiles, and begin_tile and begin_sheet
  // start anew. A beat is counted in its first cycle here, without a handshake; the verdict of the counts is kept while
  // it waits.
  logic next_valid_q, next_moves, next_new_q;
  logic [fastsplat_pkg::BEAT_BITS-1:0] next_q;
  logic [31:0] n1;
  logic [7:0] next_opcode;
  assign next_opcode = next_q[7:0];
  assign n1 = next_q[63:32];
  logic [31:0] tile_q, sheets_q, sheet_q, splats_q, tag_q;
  logic densities_q;
  logic [FB-1:0] word_before_q;
  // of begin_frame and load_table, which never directly precede a beat that uses them
  logic [15:0] image_width_q, image_height_q;
  logic [31:0] tiles_q;
  logic [fastsplat_pkg::RLUT_SETS-1:0] sets_loaded_q;
  logic [fastsplat_pkg::SHEETS_LOG2:0] scaled_sheets_q;

  logic [RULES:0] next_broken, found_broken, counted_broken_q;
  assign next_broken = next_new_q ? found_broken : (found_broken & ~COUNTED) | counted_broken_q;
  logic [COL-1:0] next_extent;
  fastsplat_record_rules u_record (
      .beat_i(next_q),
      .image_width_i(image_width_q),
      .image_height_i(image_height_q),
      .tiles_i(tiles_q),
      .sets_loaded_i(sets_loaded_q),
      .tile_i(tile_q),
      .sheet_i(sheet_q),
      .sheets_i(sheets_q),
      .splats_i(splats_q),
      .tag_i(tag_q),
      .densities_i(densities_q),
      .scaled_sheets_i(scaled_sheets_q),
      .broken_o(found_broken),
      .extent_o(next_extent)
  );
  logic [fastsplat_pkg::BEAT_WORDS-1:0] next_zero, next_rlut, next_radial, next_factor, next_falls;
  logic [fastsplat_pkg::BEAT_WORDS-1:0] next_classify, next_root, next_glint, next_vectors, next_tilts, next_sheets;
  fastsplat_word_rules u_words (
      .beat_i(next_q),
      .before_i(word_before_q),
      .zero_o(next_zero),
      .rlut_o(next_rlut),
      .radial_o(next_radial),
      .factor_o(next_factor),
      .falls_o(next_falls),
      .classify_o(next_classify),
      .root_o(next_root),
      .glint_o(next_glint),
      .vectors_o(next_vectors),
      .tilts_o(next_tilts),
      .sheets_o(next_sheets)
  );
  place_e next_place;  // where the record is allowed
  always_comb begin
    case (next_opcode)
      fastsplat_pkg::OP_BEGIN_FRAME: next_place = PlStart;
      fastsplat_pkg::OP_BEGIN_SHEET, fastsplat_pkg::OP_END_TILE: next_place = PlTile;
      fastsplat_pkg::OP_SPLAT, fastsplat_pkg::OP_ELLIPSE, fastsplat_pkg::OP_CULL_BLOCK, fastsplat_pkg::OP_END_SHEET: next_place = PlSheet;
      default: next_place = PlTables;
    endcase
  end
  logic [31:0] left_out;  // hidden splats that the source left out before this record
  if (fastsplat_pkg::CULL_MAP != 0) begin : gen_left_out
    assign left_out = (next_opcode == fastsplat_pkg::OP_END_SHEET) ? next_q[95:64] - splats_q : n1 - tag_q;
  end else begin : gen_none_left_out
    assign left_out = '0;
  end
  always_ff @(posedge clk_i) begin
    if (next_moves) word_before_q <= next_q[32*(fastsplat_pkg::BEAT_WORDS-1)+:FB];
    next_new_q <= ready_o && valid_i;
    if (next_new_q) begin
      counted_broken_q <= found_broken & COUNTED;
      case (next_opcode)
        fastsplat_pkg::OP_BEGIN_TILE: begin
          tile_q <= n1;
          densities_q <= next_q[11];
          sheets_q <= '0;
          tag_q <= '0;
        end
        fastsplat_pkg::OP_BEGIN_SHEET: begin
          sheet_q <= n1;
          sheets_q <= sheets_q + 32'd1;
          splats_q <= '0;
        end
        fastsplat_pkg::OP_SPLAT, fastsplat_pkg::OP_ELLIPSE: begin
          tag_q <= tag_q + 32'd1 + left_out;
          splats_q <= splats_q + 32'd1 + left_out;
        end
        fastsplat_pkg::OP_END_SHEET: tag_q <= tag_q + left_out;
        default: ;
      endcase
    end
  end

  // ---- second stage: its place, and the verdict
  logic beat_valid_q;
  logic [fastsplat_pkg::BEAT_BITS-1:0] beat_q;
  logic [7:0] opcode;
  logic [RULES:0] record_broken_q;  // by number of the rule
  logic any_broken_q;               // of any but those of LATE
  place_e record_place_q;
  logic [fastsplat_pkg::BEAT_WORDS-1:0] zero_q, rlut_q, radial_q, factor_q, falls_q;
  logic [COL-1:0] extent_q;
  assign opcode = beat_q[7:0];
  always_ff @(posedge clk_i) begin
    if (next_moves) begin
      beat_q <= next_q;
      record_broken_q <= next_broken;
      any_broken_q <= (next_broken & ~LATE) != '0;
      record_place_q <= next_place;
      extent_q <= next_extent;
      zero_q <= next_zero;
      rlut_q <= next_rlut;
      radial_q <= next_radial;
      factor_q <= next_factor;
      falls_q <= next_falls;
    end
  end

  place_e place_q;
  logic tile_seen_q;  // tables come before the first tile
  logic [31:0] beats_q;  // before this one, since begin_frame
  logic radial_loaded_q, factor_loaded_q;
  logic [7:0] table_q;
  logic [WB-1:0] words_left_q, words_left_next;
  logic [fastsplat_pkg::BEAT_WORDS-1:0] there_q;   // which words of the next beat are the table's
  logic last_words_q;    // it has the last of them
  logic first_words_q;   // the beat before it holds no words
  assign words_left_next = (place_q == PlWords) ? words_left_q - WB'(fastsplat_pkg::BEAT_WORDS) : beat_q[96+:WB];

  logic leaves;
  // Tables of densities: which are loaded; which words are legal for the one being loaded.
  logic [fastsplat_pkg::BEAT_WORDS-1:0] density_good;
  logic densities_loaded;
  if (fastsplat_pkg::DENSITIES != 0) begin : gen_densities
    logic [fastsplat_pkg::BEAT_WORDS-1:0] classify_q, root_q, glint_q, vectors_q, tilts_q, sheets_good_q;
    logic [4:0] loaded_q;
    always_ff @(posedge clk_i) begin
      if (next_moves) begin
        classify_q <= next_classify;
        root_q <= next_root;
        glint_q <= next_glint;
        vectors_q <= next_vectors;
        tilts_q <= next_tilts;
        sheets_good_q <= next_sheets;
      end
      if (leaves && place_q == PlWords && last_words_q && table_q > fastsplat_pkg::TABLE_FACTOR)
        loaded_q[3'(table_q - fastsplat_pkg::TABLE_CLASSIFY)] <= 1'b1;
      if (leaves && place_q != PlWords && opcode == fastsplat_pkg::OP_BEGIN_FRAME) loaded_q <= '0;
      if (leaves && place_q != PlWords && opcode == fastsplat_pkg::OP_LOAD_TABLE && beat_q[15:8] == fastsplat_pkg::TABLE_SHEETS)
        scaled_sheets_q <= beat_q[97+:fastsplat_pkg::SHEETS_LOG2+1];
    end
    always_comb begin
      case (table_q)
        fastsplat_pkg::TABLE_CLASSIFY: density_good = classify_q;
        fastsplat_pkg::TABLE_ROOT: density_good = root_q;
        fastsplat_pkg::TABLE_GLINT: density_good = glint_q;
        fastsplat_pkg::TABLE_LIGHTING: density_good = first_words_q ? vectors_q : tilts_q;
        default: density_good = sheets_good_q;
      endcase
    end
    assign densities_loaded = beat_q[11:9] != 3'd4 || loaded_q == '1;
  end else begin : gen_colours
    assign density_good = '0;
    assign densities_loaded = 1'b1;
    assign scaled_sheets_q = '0;
    logic unused_words;
    assign unused_words = &{1'b0, next_classify, next_root, next_glint, next_vectors, next_tilts, next_sheets};
  end

  logic in_order, loaded, is_tile;
  assign is_tile = opcode == fastsplat_pkg::OP_BEGIN_TILE;
  assign in_order = place_q == record_place_q && !(tile_seen_q && opcode == fastsplat_pkg::OP_LOAD_TABLE);
  assign loaded = radial_loaded_q && factor_loaded_q && densities_loaded;
  logic [fastsplat_pkg::BEAT_WORDS-1:0] word_good;
  for (genvar i = 0; i < fastsplat_pkg::BEAT_WORDS; i++) begin : gen_word
    logic of_table;
    assign of_table = (table_q == fastsplat_pkg::TABLE_RLUT) ? rlut_q[i] : (table_q == fastsplat_pkg::TABLE_RADIAL) ? radial_q[i]
                      : (fastsplat_pkg::DENSITIES != 0 && table_q != fastsplat_pkg::TABLE_FACTOR) ? density_good[i]
                      : factor_q[i] && (falls_q[i] || (i == 0 && first_words_q));
    assign word_good[i] = there_q[i] ? of_table : zero_q[i];
  end
  // broken: any rule, early, because a handshake waits for it. rule: the first of them, for the register.
  logic broken;
  logic [RULES:0] rules_broken;
  logic [7:0] rule;
  assign broken = (place_q == PlWords) ? word_good != '1 : any_broken_q || (record_broken_q & LATE) != '0 || !in_order || (is_tile && !loaded);
  always_comb begin
    rules_broken = '0;
    if (place_q == PlWords) begin
      rules_broken[fastsplat_pkg::RULE_WORDS] = 1'b1;
    end else begin
      rules_broken = record_broken_q;
      rules_broken[fastsplat_pkg::RULE_ORDER] = !in_order;
      rules_broken[fastsplat_pkg::RULE_LOADED] = is_tile && !loaded;
    end
    rule = 8'(fastsplat_pkg::RULE_NONE);
    for (int n = RULES; n > 0; n--) if (rules_broken[n]) rule = 8'(n);
  end

  // ---- passing on, or ending what is open
  // No register's enable waits for the verdict: where decode is ready a beat leaves and the next one follows, legal or
  // not. A refusal empties both registers. Other registers written in that cycle do no harm: the next begin_frame
  // starts anew.
  logic reset_q, stopped, judged, refused, ends;
  assign stopped = error_o || (reset_q && !next_valid_q && !beat_valid_q);  // beats already here are still checked
  assign judged = beat_valid_q && !error_o;
  assign refused = judged && broken;
  assign leaves = judged && ready_i;
  assign ends = stopped && (place_q == PlTile || place_q == PlSheet);
  assign next_moves = next_valid_q && !error_o && (!beat_valid_q || leaves);
  assign ready_o = enable_i && !reset_q && (!next_valid_q || next_moves || error_o);
  assign valid_o = ends || (judged && !broken);
  assign data_o = {beat_q[fastsplat_pkg::BEAT_BITS-1:8], !ends ? opcode : (place_q == PlSheet) ? fastsplat_pkg::OP_END_SHEET : fastsplat_pkg::OP_END_TILE};
  assign payload_o = !ends && place_q == PlWords;
  assign aborted_o = ends && place_q == PlTile;
  assign busy_o = next_valid_q || beat_valid_q || ends || reset_q;

  always_ff @(posedge clk_i) begin
    if (next_moves) next_valid_q <= 1'b0;  // no beat need follow: a soft reset takes none
    if (ready_o && !error_o) begin  // after a refusal all beats are dropped
      next_valid_q <= valid_i;
      next_q <= data_i;
    end
    if (leaves) beat_valid_q <= 1'b0;
    if (next_moves) beat_valid_q <= 1'b1;
    if (ends && ready_i) place_q <= (place_q == PlSheet) ? PlTile : PlTables;

    if (leaves) begin
      beats_q <= beats_q + 32'd1;
      words_left_q <= words_left_next;
      for (int i = 0; i < fastsplat_pkg::BEAT_WORDS; i++) there_q[i] <= words_left_next > WB'(i);
      last_words_q <= words_left_next <= WB'(fastsplat_pkg::BEAT_WORDS);
      first_words_q <= place_q != PlWords;
      if (place_q == PlWords) begin
        if (last_words_q) begin
          place_q <= PlTables;
          if (table_q == fastsplat_pkg::TABLE_RADIAL) radial_loaded_q <= 1'b1;
          if (table_q == fastsplat_pkg::TABLE_FACTOR) factor_loaded_q <= 1'b1;
        end
      end else begin
        case (opcode)
          fastsplat_pkg::OP_BEGIN_FRAME: begin
            place_q <= PlTables;
            tile_seen_q <= 1'b0;
            sets_loaded_q <= '0;
            radial_loaded_q <= 1'b0;
            factor_loaded_q <= 1'b0;
            {image_height_q, image_width_q} <= beat_q[159:128];
            tiles_q <= beat_q[191:160];
          end
          fastsplat_pkg::OP_LOAD_TABLE: begin
            place_q <= PlWords;
            table_q <= beat_q[15:8];
            extent_o <= extent_q;
            // Its words follow directly.
            if (beat_q[15:8] == fastsplat_pkg::TABLE_RLUT) sets_loaded_q[beat_q[32+:fastsplat_pkg::SET_BITS]] <= 1'b1;
          end
          fastsplat_pkg::OP_BEGIN_TILE: begin
            place_q <= PlTile;
            tile_seen_q <= 1'b1;
          end
          fastsplat_pkg::OP_BEGIN_SHEET: place_q <= PlSheet;
          fastsplat_pkg::OP_END_SHEET: place_q <= PlTile;
          fastsplat_pkg::OP_END_TILE: place_q <= PlTables;
          fastsplat_pkg::OP_END_FRAME: begin
            place_q <= PlStart;
            beats_q <= '0;
          end
          default: ;
        endcase
      end
    end
    if (refused) begin
      next_valid_q <= 1'b0;
      beat_valid_q <= 1'b0;
      place_q <= place_q;  // keeps what is open: it has to be ended
      error_o <= 1'b1;
      error_rule_o <= rule;
      error_opcode_o <= opcode;
      error_beat_o <= beats_q;
    end

    if (reset_i) reset_q <= 1'b1;
    else if (reset_q && stopped && !ends && idle_i) begin
      reset_q <= 1'b0;
      place_q <= PlStart;
      beats_q <= '0;
      error_o <= 1'b0;
      error_rule_o <= 8'(fastsplat_pkg::RULE_NONE);
      error_opcode_o <= '0;
      error_beat_o <= '0;
    end
    if (!rst_ni) begin
      next_valid_q <= 1'b0;
      beat_valid_q <= 1'b0;
      place_q <= PlStart;
      beats_q <= '0;
      reset_q <= 1'b0;
      error_o <= 1'b0;
      error_rule_o <= 8'(fastsplat_pkg::RULE_NONE);
      error_opcode_o <= '0;
      error_beat_o <= '0;
    end
  end
  // A soft reset forgets an offered beat (fastsplat_top drops it).
  `FASTSPLAT_ASSUME_HELD(input_held, valid_i && !ready_o && !reset_i && !reset_q, valid_i, data_i)
  `FASTSPLAT_ASSERT_HELD(judged_beat_held, valid_o && !ready_i, valid_o, {data_o, payload_o, aborted_o})
  `FASTSPLAT_ASSERT(refused_beat_stays_out, !(refused && valid_o))
  `FASTSPLAT_COVER(sheet_is_ended, ends && place_q == PlSheet)
endmodule
