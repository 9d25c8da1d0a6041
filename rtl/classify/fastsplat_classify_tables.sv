// SPDX-License-Identifier: Apache-2.0
// Loads the tables of densities (docs/numerics.md, section 6.2; cmodel/classify/classify_tables.hpp): writes words as
// segments into the lanes, keeps LIGHTING in registers and reads one sheet's words of SHEETS.
module fastsplat_classify_tables (
    input  logic        clk_i,
    // load: one word a cycle
    input  logic        we_i,
    input  logic [7:0]  table_i,
    input  logic [31:0] index_i,
    input  logic [31:0] word_i,
    // segments: which of R, G, B, tau, ROOT, GLINT is written, at which address: {entry, the next one}
    output logic [5:0]  segment_we_o,
    output logic [fastsplat_pkg::DENSITY_ADDR-1:0]    segment_o,
    output logic [2*fastsplat_pkg::DENSITY_WORD-1:0]  segment_word_o,
    // LIGHTING, word 0 in the lowest bits
    output logic [13*32-1:0] lighting_o,
    // SHEETS: the words of a sheet, a cycle later
    input  logic        sheet_re_i,
    input  logic [fastsplat_pkg::SHEETS_LOG2-1:0] sheet_i,
    output logic [31:0] scales_o,
    output logic [31:0] floor_o
);
  localparam int WORD = fastsplat_pkg::DENSITY_WORD;
  localparam int ADDR = fastsplat_pkg::DENSITY_ADDR;

  // An entry closes the segment before it. CLASSIFY has four channels in turn.
  logic of_classify, of_root, of_glint;
  logic [1:0] channel;
  logic [ADDR:0] entry;
  logic [WORD-1:0] before_q[0:3];
  assign of_classify = we_i && table_i == fastsplat_pkg::TABLE_CLASSIFY;
  assign of_root = we_i && table_i == fastsplat_pkg::TABLE_ROOT;
  assign of_glint = we_i && table_i == fastsplat_pkg::TABLE_GLINT;
  assign channel = of_classify ? index_i[1:0] : '0;
  assign entry = of_classify ? index_i[2+:ADDR+1] : index_i[ADDR:0];
  assign segment_o = ADDR'(entry - (ADDR + 1)'(1));
  assign segment_word_o = {before_q[channel], word_i[WORD-1:0]};
  assign segment_we_o = (entry == '0) ? '0 : {of_glint, of_root, {3'b000, of_classify} << channel};
  always_ff @(posedge clk_i) if (of_classify || of_root || of_glint) before_q[channel] <= word_i[WORD-1:0];

  always_ff @(posedge clk_i)
    if (we_i && table_i == fastsplat_pkg::TABLE_LIGHTING)
      for (int n = 0; n < 13; n++) if (index_i == 32'(n)) lighting_o[32*n+:32] <= word_i;

  localparam int SHEETS = fastsplat_pkg::SHEETS_LOG2;
  logic [31:0] scales_q;
  always_ff @(posedge clk_i) if (!index_i[0]) scales_q <= word_i;
  fastsplat_ram_1r1w #(.BITS(64), .WORDS(1 << SHEETS), .ADDR(SHEETS)) u_sheets (
      .clk_i,
      .re_i(sheet_re_i),
      .raddr_i(sheet_i),
      .rdata_o({floor_o, scales_o}),
      .we_i(we_i && table_i == fastsplat_pkg::TABLE_SHEETS && index_i[0]),
      .waddr_i(index_i[1+:SHEETS]),
      .wdata_i({word_i, scales_q})
  );
endmodule
