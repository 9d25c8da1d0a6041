// SPDX-License-Identifier: Apache-2.0
// Unit "densities": between the sheet buffers and the compositor of a device that classifies by pixel
// (docs/numerics.md, section 6.2; docs/microarchitecture.md, "Densities"). A finished sheet is copied into the ring.
// The sheet that waited there now has both neighbours. It goes through the pixel stage, COMPOSITE_LANES pixels a cycle,
// to the compositor, as the sums of a sheet of colours.
`include "assertions.svh"

module fastsplat_densities (
    input  logic        clk_i,
    input  logic        rst_ni,
    // tables, a word a cycle
    input  logic        table_we_i,
    input  logic [7:0]  table_i,
    input  logic [31:0] table_index_i,
    input  logic [31:0] table_word_i,
    // image and tile, held
    input  logic [63:0] place_i,  // {image height, width, tile y, x}
    // copy, k0 of the sheet buffers' side: a dirty block, the last of the sheet, its number; sums a cycle later
    input  logic                                copy_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0] copy_block_i,
    input  logic                                finish_i,
    input  logic [31:0]                         number_i,
    input  logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] sheet_data_i,
    input  logic                                flush_i,
    output logic                                hold_o,
    output logic                                free_o,    // pulse: the sheet copied last now waits
    output logic                                idle_o,
    // to the compositor: a slice in k0, its sums in k1
    output logic                                valid_o,
    output logic [fastsplat_pkg::SLICE_BITS-1:0] slice_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0] block_o,
    output logic                                done_o,    // pulse: the sheet's last slice, or a sheet without slices
    output logic [fastsplat_pkg::COMPOSITE_LANES*4*fastsplat_pkg::SHEET_BITS-1:0] sums_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int C = fastsplat_pkg::COMPOSITE_LANES;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int LB = fastsplat_pkg::SLICE_BITS;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int BXL = $clog2(BX);
  localparam int STAGES = fastsplat_pkg::DENSITY_STAGES;  // d1 to the sums

  logic [1:0] part;
  logic [2:0] clear;
  logic [4:0] step;
  logic [AB-1:0] walked_block;
  logic behind, last, waiting, unused_gather;
  logic [31:0] sheet;
  fastsplat_density_walk u_walk (
      .clk_i,
      .rst_ni,
      .copy_i,
      .copy_block_i,
      .finish_i,
      .number_i,
      .flush_i,
      .hold_o,
      .free_o,
      .part_o(part),
      .clear_o(clear),
      .gather_o(unused_gather),
      .step_o(step),
      .block_o(walked_block),
      .behind_o(behind),
      .sheet_o(sheet),
      .last_o(last),
      .waiting_o(waiting)
  );

  logic [P*P*SB-1:0] copied;
  for (genvar b = 0; b < P * P; b++) begin : gen_bank
    assign copied[b*SB+:SB] = sheet_data_i[b*4*SB+3*SB+:SB];
  end
  logic load, slice_valid;
  logic [LB-1:0] slice;
  logic [AB-1:0] block;
  logic [C*SB-1:0] here, left, right, above, below, words_before, words_behind;
  fastsplat_density_ring u_ring (
      .clk_i,
      .rst_ni,
      .copy_i,
      .part_i(part),
      .copy_block_i,
      .copy_words_i(copied),
      .clear_i(clear),
      .step_i(step),
      .block_i(walked_block),
      .behind_i(behind),
      .load_o(load),
      .valid_o(slice_valid),
      .slice_o(slice),
      .block_o(block),
      .here_o(here),
      .left_o(left),
      .right_o(right),
      .above_o(above),
      .below_o(below),
      .before_o(words_before),
      .behind_o(words_behind)
  );

  logic [5:0] segment_we;
  logic [fastsplat_pkg::DENSITY_ADDR-1:0] segment;
  logic [2*fastsplat_pkg::DENSITY_WORD-1:0] segment_word;
  logic [13*32-1:0] lighting;
  logic [31:0] scales, per_floor, floor_d14;
  fastsplat_classify_tables u_tables (
      .clk_i,
      .we_i(table_we_i),
      .table_i,
      .index_i(table_index_i),
      .word_i(table_word_i),
      .segment_we_o(segment_we),
      .segment_o(segment),
      .segment_word_o(segment_word),
      .lighting_o(lighting),
      .sheet_re_i(load),
      .sheet_i(sheet[fastsplat_pkg::SHEETS_LOG2-1:0]),
      .scales_o(scales),
      .floor_o(per_floor)
  );
  fastsplat_delay #(.BITS(32), .STAGES(14)) u_floor (.clk_i, .rst_ni(1'b1), .data_i(per_floor), .data_o(floor_d14));

  // Column and row 0 are the halo.
  localparam int BANK = 2 * fastsplat_pkg::LANE_LOG2;
  logic [15:0] block_x, block_y;
  logic [AB-1:0] column, row;
  assign column = block & AB'(BX - 1);
  assign row = block >> BXL;
  assign block_x = place_i[15:0] + (16'(column) << fastsplat_pkg::LANE_LOG2) - 16'd1;
  assign block_y = place_i[31:16] + (16'(row) << fastsplat_pkg::LANE_LOG2) - 16'd1;
  for (genvar c = 0; c < C; c++) begin : gen_lane
    // Bank C r + c: its column, and its row in the block.
    logic [BANK-1:0] bank;
    logic [fastsplat_pkg::LANE_LOG2-1:0] bank_x, bank_y;
    assign bank = BANK'(32'(slice) * C + c);
    assign {bank_y, bank_x} = bank;
    fastsplat_classify_lane u_lane (
        .clk_i,
        .segment_we_i(segment_we),
        .segment_i(segment),
        .segment_word_i(segment_word),
        .lighting_i(lighting),
        .image_width_i(place_i[47:32]),
        .image_height_i(place_i[63:48]),
        .scales_i(scales),
        .floor_i(floor_d14),
        .here_i(here[c*SB+:SB]),
        .left_i(left[c*SB+:SB]),
        .right_i(right[c*SB+:SB]),
        .above_i(above[c*SB+:SB]),
        .below_i(below[c*SB+:SB]),
        .before_i(words_before[c*SB+:SB]),
        .behind_i(words_behind[c*SB+:SB]),
        .x_i(block_x + 16'(bank_x)),
        .y_i(block_y + 16'(bank_y)),
        .sums_o(sums_o[c*4*SB+:4*SB])
    );
  end

  // Parallel to the lanes; k0 is the stage before the sums.
  fastsplat_delay #(.BITS(1), .STAGES(STAGES - 1)) u_valid (.clk_i, .rst_ni, .data_i(slice_valid), .data_o(valid_o));
  fastsplat_delay #(.BITS(AB + LB), .STAGES(STAGES - 1)) u_place (
      .clk_i, .rst_ni(1'b1), .data_i({block, slice}), .data_o({block_o, slice_o})
  );

  // At rest: no sheet waits, is walked or comes in, and done_o of the last one was three cycles ago.
  localparam int LATE = fastsplat_pkg::DENSITY_LATE;  // from the walk's last cycle to the last slice in k0
  logic [LATE:1] done_q;
  logic active, still_q, still_q2;
  assign done_o = done_q[LATE];
  assign active = waiting || finish_i || done_q != '0;
  assign idle_o = still_q2;
  always_ff @(posedge clk_i) begin
    done_q <= {done_q[LATE-1:1], last};
    still_q <= !active;
    still_q2 <= still_q && !active;
    if (!rst_ni) begin
      done_q <= '0;
      still_q <= 1'b1;
      still_q2 <= 1'b1;
    end
  end
  logic unused;
  assign unused = &{1'b0, unused_gather, sheet_data_i, sheet};
  `FASTSPLAT_ASSERT(walk_ends_with_its_last_slice, !(valid_o && done_o) || slice_o == LB'(fastsplat_pkg::SLICES - 1))
endmodule
