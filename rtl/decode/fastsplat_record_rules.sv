// SPDX-License-Identifier: Apache-2.0
// Rules of docs/stream.md that can be checked before a record's place in the grammar is known: all but order, loaded
// and words. Combinational first stage of unit "check" (fastsplat_stream_check.sv). It compares with earlier records,
// each interpreted by its opcode. Where an opcode misleads, rule order is broken here or was before.

module fastsplat_record_rules (
    input  logic [fastsplat_pkg::BEAT_BITS-1:0] beat_i,
    // of begin_frame
    input  logic [15:0]  image_width_i,
    input  logic [15:0]  image_height_i,
    input  logic [31:0]  tiles_i,
    input  logic [fastsplat_pkg::RLUT_SETS-1:0] sets_loaded_i,
    // of the tile and the sheet
    input  logic [31:0]  tile_i,
    input  logic [31:0]  sheet_i,
    input  logic [31:0]  sheets_i,        // begun in the tile
    input  logic [31:0]  splats_i,        // in the sheet
    input  logic [31:0]  tag_i,           // due next
    input  logic         densities_i,     // the tile is of densities
    input  logic [fastsplat_pkg::SHEETS_LOG2:0] scaled_sheets_i,  // described by SHEETS
    output logic [fastsplat_pkg::RULE_END_COUNT:0] broken_o,  // by number of the rule
    output logic [fastsplat_pkg::COL_BITS-1:0] extent_o  // of load_table: the set's, padded to whole windows
);
  localparam int COL = fastsplat_pkg::COL_BITS;
  localparam int CB = fastsplat_pkg::COLOUR_BITS;
  localparam int PB = fastsplat_pkg::POS_BITS;
  localparam int RHO2 = fastsplat_pkg::RHO_BITS + 2;
  localparam int P = fastsplat_pkg::LANES;

  logic [31:0] w0, w1, w2, w3, w4, w5;
  assign {w5, w4, w3, w2, w1, w0} = beat_i[0+:6*32];  // where fields lie
  logic [7:0] opcode;
  assign opcode = w0[7:0];

  logic known;
  logic [fastsplat_pkg::BEAT_BITS-1:0] used;
  always_comb begin
    known = 1'b1;
    used = '0;
    case (opcode)
      fastsplat_pkg::OP_BEGIN_FRAME: used = fastsplat_pkg::USED_BEGIN_FRAME;
      fastsplat_pkg::OP_LOAD_TABLE: used = fastsplat_pkg::USED_LOAD_TABLE;
      fastsplat_pkg::OP_BEGIN_TILE: used = fastsplat_pkg::USED_BEGIN_TILE;
      fastsplat_pkg::OP_BEGIN_SHEET: used = fastsplat_pkg::USED_BEGIN_SHEET;
      fastsplat_pkg::OP_SPLAT: used = fastsplat_pkg::USED_SPLAT;
      fastsplat_pkg::OP_ELLIPSE: begin
        known = fastsplat_pkg::ELLIPSES != 0;
        used = fastsplat_pkg::USED_ELLIPSE;
      end
      fastsplat_pkg::OP_CULL_BLOCK: used = fastsplat_pkg::USED_CULL_BLOCK;
      fastsplat_pkg::OP_END_SHEET: used = fastsplat_pkg::USED_END_SHEET;
      fastsplat_pkg::OP_END_TILE: used = fastsplat_pkg::USED_END_TILE;
      fastsplat_pkg::OP_END_FRAME: used = fastsplat_pkg::USED_END_FRAME;
      default: known = 1'b0;
    endcase
  end

  // ---- load_table: the set's extent, padded to whole windows
  logic [RHO2-1:0] pixels;
  assign pixels = (RHO2'({w2[fastsplat_pkg::RHO_BITS-1:0], 1'b0}) + RHO2'(fastsplat_pkg::PHASES - 1)) >> fastsplat_pkg::PHASE_LOG2;
  assign extent_o = COL'((pixels + RHO2'(P - 1)) >> fastsplat_pkg::LANE_LOG2) << fastsplat_pkg::LANE_LOG2;
  logic table_good, base_good, densities;
  assign densities = fastsplat_pkg::DENSITIES != 0;
  assign base_good = w4[31:COL] == '0 && w4[fastsplat_pkg::LANE_LOG2-1:0] == '0 &&
                     (COL + 1)'(w4[COL-1:0]) + (COL + 1)'(extent_o) <= (COL + 1)'(fastsplat_pkg::RLUT_COLUMNS);
  always_comb begin
    case (w0[15:8])
      fastsplat_pkg::TABLE_RLUT:
      table_good = w1 < 32'(fastsplat_pkg::RLUT_SETS) && w2 != '0 && w2 <= 32'(fastsplat_pkg::RHO_MOST) && base_good &&
                   w3 == 32'(extent_o) << fastsplat_pkg::PHASE_LOG2;
      fastsplat_pkg::TABLE_RADIAL: table_good = w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'(fastsplat_pkg::RADIAL_WORDS);
      fastsplat_pkg::TABLE_FACTOR: table_good = w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'(fastsplat_pkg::SEGMENTS + 1);
      fastsplat_pkg::TABLE_CLASSIFY:
      table_good = densities && w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'(4 << fastsplat_pkg::CLASSIFY_LOG2) + 32'd4;
      fastsplat_pkg::TABLE_ROOT: table_good = densities && w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'd97;
      fastsplat_pkg::TABLE_GLINT: table_good = densities && w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'd129;
      fastsplat_pkg::TABLE_LIGHTING: table_good = densities && w1 == '0 && w2 == '0 && w4 == '0 && w3 == 32'd13;
      fastsplat_pkg::TABLE_SHEETS:
      table_good = densities && w1 == '0 && w2 == '0 && w4 == '0 && !w3[0] && w3 != '0 && w3 <= 32'(2 << fastsplat_pkg::SHEETS_LOG2);
      default: table_good = 1'b0;
    endcase
  end

  logic tile_good, set_good, position_good, ellipse_position_good, colour_good, sides_good;
  logic mode_good, rimmed;  // 4, 5: every sample; 8, 9: densities, two pixels smaller
  assign rimmed = densities && w0[11:9] == 3'd4;
  assign mode_good = w0[11:8] <= 4'd2 || (fastsplat_pkg::EVERY_SAMPLE != 0 && w0[11:9] == 3'd2) || rimmed;
  // x + w <= W is x + w + (2^16 - 1 - W) < 2^16: a carry-save adder makes two numbers of three, then one long carry
  // instead of two.
  logic [15:0] sum_x, carry_x, sum_y, carry_y, unused_x, unused_y;
  logic [1:0] right, bottom;  // of the image: 0 inside
  assign sum_x = w2[15:0] ^ w4[15:0] ^ ~image_width_i;
  assign carry_x = (w2[15:0] & w4[15:0]) | ((w2[15:0] | w4[15:0]) & ~image_width_i);
  assign sum_y = w3[15:0] ^ w4[31:16] ^ ~image_height_i;
  assign carry_y = (w3[15:0] & w4[31:16]) | ((w3[15:0] | w4[31:16]) & ~image_height_i);
  assign {right, unused_x} = 18'(sum_x) + {1'b0, carry_x, 1'b0};
  assign {bottom, unused_y} = 18'(sum_y) + {1'b0, carry_y, 1'b0};
  logic unused;
  assign unused = &{1'b0, unused_x, unused_y, densities_i, scaled_sheets_i};
  logic rim_fits;
  assign rim_fits = !rimmed || (w4[15:0] <= 16'(fastsplat_pkg::TILE_WIDTH - 2) && w4[31:16] <= 16'(fastsplat_pkg::TILE_HEIGHT - 2));
  assign tile_good = mode_good && rim_fits && w1 < tiles_i && w4[15:0] <= 16'(fastsplat_pkg::TILE_WIDTH) &&
                     w4[31:16] <= 16'(fastsplat_pkg::TILE_HEIGHT) && w2[31:16] == '0 && w3[31:16] == '0 &&
                     right == '0 && bottom == '0;
  assign sides_good = w4[15:0] != '0 && w4[31:16] != '0;
  assign set_good = w0[15:8] < 8'(fastsplat_pkg::RLUT_SETS) && sets_loaded_i[w0[8+:fastsplat_pkg::SET_BITS]];
  assign position_good = (w2[31:PB-1] == '0 || w2[31:PB-1] == '1) && (w3[31:PB-1] == '0 || w3[31:PB-1] == '1);
  localparam int EX = (PB > 22) ? PB : 22;  // an ellipse's x and y have 22 bits; a device with wider ones has no ellipses
  assign ellipse_position_good = (w2[EX-1:PB-1] == '0 || w2[EX-1:PB-1] == '1) && (w3[EX-1:PB-1] == '0 || w3[EX-1:PB-1] == '1);
  assign colour_good = (w4[15:0] >> CB) == '0 && (w4[31:16] >> CB) == '0 && (w5[15:0] >> CB) == '0 && (w5[31:16] >> CB) == '0;

  // The source of a device that culls may leave out hidden splats: tags rise, and counts follow them (S-cull-10).
  logic tag_good, count_good;
  if (fastsplat_pkg::CULL_MAP != 0) begin : gen_jumps
    assign tag_good = w1 >= tag_i;
    assign count_good = w2 >= splats_i;
  end else begin : gen_counts
    assign tag_good = w1 == tag_i;
    assign count_good = w2 == splats_i;
  end

  logic unscaled;  // SHEETS does not describe it
  assign unscaled = densities && densities_i && w1 >= 32'(scaled_sheets_i);

  // In parallel, not one after another: the long comparisons are late already.
  logic begin_frame, load_table, begin_tile, begin_sheet, splat, ellipse, cull_block, end_sheet, end_tile;
  assign begin_frame = opcode == fastsplat_pkg::OP_BEGIN_FRAME;
  assign load_table = opcode == fastsplat_pkg::OP_LOAD_TABLE;
  assign begin_tile = opcode == fastsplat_pkg::OP_BEGIN_TILE;
  assign begin_sheet = opcode == fastsplat_pkg::OP_BEGIN_SHEET;
  assign splat = opcode == fastsplat_pkg::OP_SPLAT;
  assign ellipse = opcode == fastsplat_pkg::OP_ELLIPSE;
  assign cull_block = opcode == fastsplat_pkg::OP_CULL_BLOCK;
  assign end_sheet = opcode == fastsplat_pkg::OP_END_SHEET;
  assign end_tile = opcode == fastsplat_pkg::OP_END_TILE;
  always_comb begin
    broken_o = '0;
    broken_o[fastsplat_pkg::RULE_OPCODE] = !known;
    broken_o[fastsplat_pkg::RULE_RESERVED] = (beat_i & ~used) != '0;
    broken_o[fastsplat_pkg::RULE_FORMAT] = begin_frame && (w1 != fastsplat_pkg::STREAM_MAGIC || w0[31:16] != fastsplat_pkg::STREAM_VERSION);
    broken_o[fastsplat_pkg::RULE_CONFIGURATION] = begin_frame && (w2 != fastsplat_pkg::HASH_LOW || w3 != fastsplat_pkg::HASH_HIGH);
    broken_o[fastsplat_pkg::RULE_IMAGE] = begin_frame && !sides_good;
    broken_o[fastsplat_pkg::RULE_TABLE] = load_table && !table_good;
    broken_o[fastsplat_pkg::RULE_TILE] = begin_tile && (!tile_good || !sides_good);
    broken_o[fastsplat_pkg::RULE_SHEET] = begin_sheet && ((sheets_i != '0 && w1 <= sheet_i) || unscaled);
    broken_o[fastsplat_pkg::RULE_SET] = splat && !set_good;
    broken_o[fastsplat_pkg::RULE_RANGE] = (splat && !position_good) || (ellipse && !ellipse_position_good) || ((splat || ellipse) && !colour_good);
    broken_o[fastsplat_pkg::RULE_TAG] = (splat || ellipse) && !tag_good;
    broken_o[fastsplat_pkg::RULE_CULL] = cull_block && !sides_good;
    broken_o[fastsplat_pkg::RULE_END_NUMBER] = (end_sheet && w1 != sheet_i) || (end_tile && w1 != tile_i);
    broken_o[fastsplat_pkg::RULE_END_COUNT] = (end_sheet && !count_good) || (end_tile && w2 != sheets_i);
  end
endmodule
