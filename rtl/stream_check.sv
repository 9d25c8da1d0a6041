// Unit "check": judges each beat before decode sees it, by every rule of docs/stream.md that a device can judge
// (cmodel/stream_decode.hpp, StreamScope::Subset; cmodel/stream_rules.hpp). One beat register in front of decode's.
// A beat that breaks a rule is not passed on, nor is any after it: rule, opcode and number of the beat stay in registers, and
// a tile that is open is ended by an end_sheet and an end_tile of the device's own, so that its picture goes out, marked, and
// all memories are left as a tile leaves them. A soft reset does the same, and then waits for a begin_frame.
`include "assertions.svh"

module stream_check (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  logic         enable_i,        // 0 while memories are wiped after reset
    // stream in
    input  logic         valid_i,
    output logic         ready_o,
    input  logic [191:0] data_i,
    // to decode
    output logic         valid_o,
    input  logic         ready_i,
    output logic [191:0] data_o,
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
  localparam int CB = fastsplat_pkg::COLOUR_BITS;
  localparam int PB = fastsplat_pkg::POS_BITS;
  localparam int WB = fastsplat_pkg::WORDS_BITS;
  localparam int RHO2 = fastsplat_pkg::RHO_BITS + 2;
  localparam int P = fastsplat_pkg::LANES;
  localparam logic [7:0] TABLE_RLUT = 8'd0, TABLE_RADIAL = 8'd1, TABLE_FACTOR = 8'd2;

  logic beat_valid_q;
  logic [191:0] beat_q;
  logic [31:0] w0, w1, w2, w3, w4, w5;
  assign {w5, w4, w3, w2, w1, w0} = beat_q;
  logic [7:0] opcode;
  assign opcode = w0[7:0];

  // Where in the grammar the beat stands.
  typedef enum logic [2:0] {PlStart, PlTables, PlWords, PlTile, PlSheet} place_e;
  place_e place_q;
  logic tile_seen_q;  // tables come before the first tile
  logic [31:0] beats_q;  // before this one, since begin_frame
  // of begin_frame
  logic [15:0] image_width_q, image_height_q;
  logic [31:0] tiles_q;
  // of the tile, of the sheet
  logic [31:0] tile_q, sheets_q, sheet_q, splats_q, tag_q;
  // tables
  logic [fastsplat_pkg::RLUT_SETS-1:0] sets_loaded_q;
  logic radial_loaded_q, factor_loaded_q;
  logic [7:0] table_q;
  logic [WB-1:0] words_left_q;
  logic [31:0] words_most_q;
  logic [fastsplat_pkg::FACTOR_BITS-1:0] factor_q;  // the word before

  // ---- load_table: the set's extent, padded to whole windows
  logic [RHO2-1:0] pixels;
  logic [COL-1:0] extent;
  assign pixels = (RHO2'({w2[fastsplat_pkg::RHO_BITS-1:0], 1'b0}) + RHO2'(fastsplat_pkg::PHASES - 1)) >> fastsplat_pkg::PHASE_LOG2;
  assign extent = COL'((pixels + RHO2'(P - 1)) >> fastsplat_pkg::LANE_LOG2) << fastsplat_pkg::LANE_LOG2;
  logic table_good, base_good;
  assign base_good = w4[31:COL] == '0 && w4[fastsplat_pkg::LANE_LOG2-1:0] == '0 &&
                     (COL + 1)'(w4[COL-1:0]) + (COL + 1)'(extent) <= (COL + 1)'(fastsplat_pkg::RLUT_COLUMNS);
  always_comb begin
    case (w0[15:8])
      TABLE_RLUT:
      table_good = w1 < 32'(fastsplat_pkg::RLUT_SETS) && w2 != '0 && w2 <= 32'(fastsplat_pkg::RHO_MOST) && base_good &&
                   w3 == 32'(extent) << fastsplat_pkg::PHASE_LOG2;
      TABLE_RADIAL: table_good = w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'(fastsplat_pkg::RADIAL_ENTRIES);
      TABLE_FACTOR: table_good = w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'(fastsplat_pkg::SEGMENTS + 1);
      default: table_good = 1'b0;
    endcase
  end

  // ---- words of a table: in range, those of FACTOR never rising, 0 behind the last
  logic words_good;
  logic [fastsplat_pkg::FACTOR_BITS-1:0] factor_word[0:6];
  assign factor_word[0] = factor_q;
  logic [5:0] word_good;
  for (genvar i = 0; i < 6; i++) begin : gen_word
    logic [31:0] word;
    logic there;
    assign word = beat_q[32*i+:32];
    assign there = words_left_q > WB'(i);
    assign factor_word[i+1] = word[fastsplat_pkg::FACTOR_BITS-1:0];
    assign word_good[i] = there ? word <= words_most_q && (table_q != TABLE_FACTOR || factor_word[i+1] <= factor_word[i]) : word == '0;
  end
  assign words_good = &word_good;

  // ---- the other records
  logic known, in_order;
  logic [191:0] used;
  always_comb begin
    known = 1'b1;
    in_order = 1'b0;
    used = '0;
    case (opcode)
      fastsplat_pkg::OP_BEGIN_FRAME: begin
        in_order = place_q == PlStart;
        used = fastsplat_pkg::USED_BEGIN_FRAME;
      end
      fastsplat_pkg::OP_LOAD_TABLE: begin
        in_order = place_q == PlTables && !tile_seen_q;
        used = fastsplat_pkg::USED_LOAD_TABLE;
      end
      fastsplat_pkg::OP_BEGIN_TILE: begin
        in_order = place_q == PlTables;
        used = fastsplat_pkg::USED_BEGIN_TILE;
      end
      fastsplat_pkg::OP_BEGIN_SHEET: begin
        in_order = place_q == PlTile;
        used = fastsplat_pkg::USED_BEGIN_SHEET;
      end
      fastsplat_pkg::OP_SPLAT: begin
        in_order = place_q == PlSheet;
        used = fastsplat_pkg::USED_SPLAT;
      end
      fastsplat_pkg::OP_CULL_BLOCK: begin
        in_order = place_q == PlSheet;
        used = fastsplat_pkg::USED_CULL_BLOCK;
      end
      fastsplat_pkg::OP_END_SHEET: begin
        in_order = place_q == PlSheet;
        used = fastsplat_pkg::USED_END_SHEET;
      end
      fastsplat_pkg::OP_END_TILE: begin
        in_order = place_q == PlTile;
        used = fastsplat_pkg::USED_END_TILE;
      end
      fastsplat_pkg::OP_END_FRAME: begin
        in_order = place_q == PlTables;
        used = fastsplat_pkg::USED_END_FRAME;
      end
      default: known = 1'b0;
    endcase
  end

  logic tile_good, set_good, position_good, colour_good;
  assign tile_good = w0[9:8] != 2'd3 && w1 < tiles_q && w4[15:0] != '0 && w4[15:0] <= 16'(fastsplat_pkg::TILE_WIDTH) &&
                     w4[31:16] != '0 && w4[31:16] <= 16'(fastsplat_pkg::TILE_HEIGHT) && w2[31:16] == '0 && w3[31:16] == '0 &&
                     17'(w2[15:0]) + 17'(w4[15:0]) <= 17'(image_width_q) && 17'(w3[15:0]) + 17'(w4[31:16]) <= 17'(image_height_q);
  assign set_good = w0[15:8] < 8'(fastsplat_pkg::RLUT_SETS) && sets_loaded_q[w0[8+:fastsplat_pkg::SET_BITS]];
  assign position_good = (w2[31:PB-1] == '0 || w2[31:PB-1] == '1) && (w3[31:PB-1] == '0 || w3[31:PB-1] == '1);
  assign colour_good = (w4[15:0] >> CB) == '0 && (w4[31:16] >> CB) == '0 && (w5[15:0] >> CB) == '0 && (w5[31:16] >> CB) == '0;

  // ---- the verdict: the first rule that is broken
  logic [7:0] rule;
  always_comb begin
    rule = fastsplat_pkg::RULE_NONE;
    if (place_q == PlWords) begin
      if (!words_good) rule = fastsplat_pkg::RULE_WORDS;
    end else if (!known) begin
      rule = fastsplat_pkg::RULE_OPCODE;
    end else if (!in_order) begin
      rule = fastsplat_pkg::RULE_ORDER;
    end else if ((beat_q & ~used) != '0) begin
      rule = fastsplat_pkg::RULE_RESERVED;
    end else begin
      case (opcode)
        fastsplat_pkg::OP_BEGIN_FRAME:
        if (w1 != fastsplat_pkg::STREAM_MAGIC || w0[31:16] != fastsplat_pkg::STREAM_VERSION) rule = fastsplat_pkg::RULE_FORMAT;
        else if (w2 != fastsplat_pkg::HASH_LOW || w3 != fastsplat_pkg::HASH_HIGH) rule = fastsplat_pkg::RULE_CONFIGURATION;
        else if (w4[15:0] == '0 || w4[31:16] == '0) rule = fastsplat_pkg::RULE_IMAGE;
        fastsplat_pkg::OP_LOAD_TABLE: if (!table_good) rule = fastsplat_pkg::RULE_TABLE;
        fastsplat_pkg::OP_BEGIN_TILE:
        if (!radial_loaded_q || !factor_loaded_q) rule = fastsplat_pkg::RULE_LOADED;
        else if (!tile_good) rule = fastsplat_pkg::RULE_TILE;
        fastsplat_pkg::OP_BEGIN_SHEET: if (sheets_q != '0 && w1 <= sheet_q) rule = fastsplat_pkg::RULE_SHEET;
        fastsplat_pkg::OP_SPLAT:
        if (!set_good) rule = fastsplat_pkg::RULE_SET;
        else if (!position_good || !colour_good) rule = fastsplat_pkg::RULE_RANGE;
        else if (w1 != tag_q) rule = fastsplat_pkg::RULE_TAG;
        fastsplat_pkg::OP_CULL_BLOCK: if (w4[15:0] == '0 || w4[31:16] == '0) rule = fastsplat_pkg::RULE_CULL;
        fastsplat_pkg::OP_END_SHEET:
        if (w1 != sheet_q) rule = fastsplat_pkg::RULE_END_NUMBER;
        else if (w2 != splats_q) rule = fastsplat_pkg::RULE_END_COUNT;
        fastsplat_pkg::OP_END_TILE:
        if (w1 != tile_q) rule = fastsplat_pkg::RULE_END_NUMBER;
        else if (w2 != sheets_q) rule = fastsplat_pkg::RULE_END_COUNT;
        default: ;
      endcase
    end
  end

  // ---- passing on, or ending what is open
  logic reset_q, stopped, refused, moves, ends;
  assign stopped = error_o || (reset_q && !beat_valid_q);  // a beat that is here is judged still
  assign refused = beat_valid_q && !stopped && rule != fastsplat_pkg::RULE_NONE;
  assign moves = beat_valid_q && !stopped && rule == fastsplat_pkg::RULE_NONE && ready_i;
  assign ends = stopped && (place_q == PlTile || place_q == PlSheet);
  assign ready_o = enable_i && !reset_q && (!beat_valid_q || moves || error_o);
  assign valid_o = ends || (beat_valid_q && !stopped && rule == fastsplat_pkg::RULE_NONE);
  assign data_o = {beat_q[191:8], !ends ? opcode : (place_q == PlSheet) ? fastsplat_pkg::OP_END_SHEET : fastsplat_pkg::OP_END_TILE};
  assign payload_o = !ends && place_q == PlWords;
  assign aborted_o = ends && place_q == PlTile;
  assign busy_o = beat_valid_q || ends || reset_q;

  always_ff @(posedge clk_i) begin
    if (moves) beat_valid_q <= 1'b0;  // nothing need come after it: a soft reset takes none
    if (ready_o && !error_o) begin  // after a refusal all is swallowed
      beat_valid_q <= valid_i;
      beat_q <= data_i;
    end
    if (refused) begin
      beat_valid_q <= 1'b0;
      error_o <= 1'b1;
      error_rule_o <= rule;
      error_opcode_o <= opcode;
      error_beat_o <= beats_q;
    end
    if (ends && ready_i) place_q <= (place_q == PlSheet) ? PlTile : PlTables;

    if (moves) begin
      beats_q <= beats_q + 32'd1;
      if (place_q == PlWords) begin
        words_left_q <= words_left_q - WB'(6);
        factor_q <= factor_word[6];
        if (words_left_q <= WB'(6)) begin
          place_q <= PlTables;
          if (table_q == TABLE_RADIAL) radial_loaded_q <= 1'b1;
          if (table_q == TABLE_FACTOR) factor_loaded_q <= 1'b1;
        end
      end else begin
        case (opcode)
          fastsplat_pkg::OP_BEGIN_FRAME: begin
            place_q <= PlTables;
            tile_seen_q <= 1'b0;
            sets_loaded_q <= '0;
            radial_loaded_q <= 1'b0;
            factor_loaded_q <= 1'b0;
            {image_height_q, image_width_q} <= w4;
            tiles_q <= w5;
          end
          fastsplat_pkg::OP_LOAD_TABLE: begin
            place_q <= PlWords;
            table_q <= w0[15:8];
            words_left_q <= w3[WB-1:0];
            words_most_q <= (w0[15:8] == TABLE_RLUT) ? fastsplat_pkg::RLUT_WORD_MOST
                            : (w0[15:8] == TABLE_RADIAL) ? fastsplat_pkg::RADIAL_WORD_MOST : fastsplat_pkg::FACTOR_WORD_MOST;
            factor_q <= '1;
            extent_o <= extent;
            // Its words follow before anything else does.
            if (w0[15:8] == TABLE_RLUT) sets_loaded_q[w1[fastsplat_pkg::SET_BITS-1:0]] <= 1'b1;
          end
          fastsplat_pkg::OP_BEGIN_TILE: begin
            place_q <= PlTile;
            tile_seen_q <= 1'b1;
            tile_q <= w1;
            sheets_q <= '0;
            tag_q <= '0;
          end
          fastsplat_pkg::OP_BEGIN_SHEET: begin
            place_q <= PlSheet;
            sheet_q <= w1;
            sheets_q <= sheets_q + 32'd1;
            splats_q <= '0;
          end
          fastsplat_pkg::OP_SPLAT: begin
            tag_q <= tag_q + 32'd1;
            splats_q <= splats_q + 32'd1;
          end
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

    if (reset_i) reset_q <= 1'b1;
    else if (reset_q && stopped && !ends && idle_i) begin
      reset_q <= 1'b0;
      place_q <= PlStart;
      beats_q <= '0;
      error_o <= 1'b0;
      error_rule_o <= fastsplat_pkg::RULE_NONE;
      error_opcode_o <= '0;
      error_beat_o <= '0;
    end
    if (!rst_ni) begin
      beat_valid_q <= 1'b0;
      place_q <= PlStart;
      beats_q <= '0;
      reset_q <= 1'b0;
      error_o <= 1'b0;
      error_rule_o <= fastsplat_pkg::RULE_NONE;
      error_opcode_o <= '0;
      error_beat_o <= '0;
    end
  end
  `FASTSPLAT_ASSUME_HELD(input_held, valid_i && !ready_o, valid_i, data_i)
  `FASTSPLAT_ASSERT_HELD(judged_beat_held, valid_o && !ready_i, valid_o, {data_o, payload_o, aborted_o})
  `FASTSPLAT_ASSERT(refused_beat_stays_out, !(refused && valid_o))
  `FASTSPLAT_COVER(sheet_is_ended, ends && place_q == PlSheet)
endmodule
