// SPDX-License-Identifier: Apache-2.0
// Terminated pixels of a tile, by block, for the tables of pixels. Those found by even and by odd sheets are kept apart
// until the sheet's own table is built (docs/microarchitecture.md, M-cull-13). So a table shows what its sheet left
// behind, whatever the next one terminates meanwhile.

module fastsplat_cull_pixels (
    input  logic                                clk_i,
    // a block becomes blank
    input  logic                                blank_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0] blank_addr_i,
    // k6: all terminated pixels of a block
    input  logic                                frozen_valid_i,
    input  logic                                frozen_sheet_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0] frozen_block_i,
    input  logic [fastsplat_pkg::BANKS-1:0]     frozen_i,
    // building: a row of a block; its pixels a cycle later
    input  logic                                re_i,
    input  logic                                sheet_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0] block_i,
    input  logic [fastsplat_pkg::LANE_LOG2-1:0] line_i,
    output logic [fastsplat_pkg::LANES-1:0]     bits_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int PP = fastsplat_pkg::BANKS;
  localparam int NB = fastsplat_pkg::BLOCKS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;

  logic [PP-1:0] earlier, stored, fresh[0:1], frozen;
  logic put_q, sheet_q;  // the block's last row: all of it is merged
  // A table that waited starts right behind the other one and may begin with the block being merged: its word is
  // forwarded.
  logic passed_q;
  logic [PP-1:0] passed_word_q;
  logic [AB-1:0] block_q;
  logic [fastsplat_pkg::LANE_LOG2-1:0] line_q;
  always_ff @(posedge clk_i) begin
    put_q <= re_i && line_i == '1;
    sheet_q <= sheet_i;
    block_q <= block_i;
    line_q <= line_i;
    passed_q <= put_q && block_i == block_q;
    passed_word_q <= frozen;
  end
  assign stored = passed_q ? passed_word_q : earlier;
  assign frozen = stored | (sheet_q ? fresh[1] : fresh[0]);
  assign bits_o = frozen[line_q*P+:P];
  fastsplat_ram_1r1w #(.BITS(PP), .WORDS(NB), .ADDR(AB)) u_before (
      .clk_i,
      .re_i,
      .raddr_i(block_i),
      .rdata_o(earlier),
      .we_i(blank_i || put_q),
      .waddr_i(blank_i ? blank_addr_i : block_q),
      .wdata_i(blank_i ? '0 : frozen)
  );
  for (genvar s = 0; s < 2; s++) begin : gen_sheet
    logic found;
    logic [PP-1:0] pixels;
    assign found = frozen_valid_i && frozen_sheet_i == 1'(s);
    fastsplat_ram_1r1w #(.BITS(PP), .WORDS(NB), .ADDR(AB)) u_fresh (
        .clk_i,
        .re_i,
        .raddr_i(block_i),
        .rdata_o(pixels),
        .we_i(blank_i || found),
        .waddr_i(blank_i ? blank_addr_i : frozen_block_i),
        .wdata_i(blank_i ? '0 : frozen_i)
    );
    assign fresh[s] = pixels;
  end
endmodule
