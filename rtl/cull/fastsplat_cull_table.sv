// SPDX-License-Identifier: Apache-2.0
// One of the two summed-area tables of opaque cull cells, and the four words of a rectangle (docs/numerics.md, N-6.1-5;
// cmodel/cull/cull_table.hpp). A memory word holds WORDS words of the table. The words of row 0 and column 0 are 0 and
// not stored.
`include "fault.svh"

module fastsplat_cull_table (
    input  logic                                        clk_i,
    // building: a memory word of row `row`, 0 for A(.,1); read a cycle before
    input  logic                                        build_re_i,
    input  logic [fastsplat_pkg::CULL_ADDR_BITS-1:0]    build_raddr_i,
    output logic [fastsplat_pkg::CULL_WORDS*fastsplat_pkg::CULL_BITS-1:0] build_o,
    input  logic                                        we_i,
    input  logic [fastsplat_pkg::CULL_ADDR_BITS-1:0]    waddr_i,
    input  logic [fastsplat_pkg::CULL_WORDS*fastsplat_pkg::CULL_BITS-1:0] wdata_i,
    // a rectangle of cells i0..i1-1, j0..j1-1, not while this table is built
    input  logic                                        re_i,
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    i0_i,
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    i1_i,
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    j0_i,
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    j1_i,
    // a cycle later: opaque cells in it
    output logic [fastsplat_pkg::CULL_BITS-1:0]         count_o
);
  localparam int K = fastsplat_pkg::CULL_WORDS;
  localparam int KL = $clog2(K);
  localparam int NC = fastsplat_pkg::CULL_CHUNKS;
  localparam int NL = $clog2(NC);
  localparam int B = fastsplat_pkg::CULL_BITS;
  localparam int CB = fastsplat_pkg::CULL_CELL_BITS;
  localparam int AB = fastsplat_pkg::CULL_ADDR_BITS;

  // Corner c is column i0 (even c) or i1, row j0 (c < 2) or j1. Where a row is one memory word, one memory gives both
  // columns.
  localparam int COPIES = (NC > 1) ? 4 : 2;
  logic [K*B-1:0] rows[0:COPIES-1];
  logic [B-1:0] words[0:3];
  for (genvar m = 0; m < COPIES; m++) begin : gen_copy
    localparam bit FIRST = m == 0;
    localparam bit RIGHT = COPIES == 2 || m % 2 == 1;
    localparam bit BELOW = (COPIES == 2) ? m == 1 : m >= 2;
    logic [CB-1:0] i, j;
    logic [AB-1:0] address;
    logic [K*B-1:0] row;
    assign i = (RIGHT ? i1_i : i0_i) - CB'(1);
    assign j = (BELOW ? j1_i : j0_i) - CB'(1);
    logic unused;
    assign unused = &{1'b0, i, j};
    assign address = (AB'(j) << NL) | ((NC > 1) ? AB'(i) >> KL : '0);
    fastsplat_ram_1r1w #(.BITS(K * B), .WORDS(fastsplat_pkg::CULL_ROWS * NC), .ADDR(AB)) u_words (
        .clk_i,
        .re_i((FIRST && build_re_i) || re_i),
        .raddr_i((FIRST && build_re_i) ? build_raddr_i : address),
        .rdata_o(row),
        .we_i,
        .waddr_i,
        .wdata_i
    );
    assign rows[m] = row;
  end
  assign build_o = rows[0];

  for (genvar c = 0; c < 4; c++) begin : gen_corner
    logic none_q;  // row or column 0
    logic [CB-1:0] i, j, i_q;
    assign i = (c % 2 == 1) ? i1_i : i0_i;
    assign j = (c >= 2) ? j1_i : j0_i;
    always_ff @(posedge clk_i) begin
      if (re_i) begin
        none_q <= i == '0 || j == '0;
        i_q <= i - CB'(1) + ((c == 1 && `FASTSPLAT_FAULT(CULL_CORNER)) ? CB'(1) : '0);
      end
    end
    logic [B-1:0] word;  // of this corner alone: blocks that read and write one array wake each other in event-driven simulators
    always_comb begin
      word = '0;
      for (int k = 0; k < K; k++) begin
        if (!none_q && (i_q & CB'(K - 1)) == CB'(k)) word = word | rows[(COPIES == 2) ? c / 2 : c][k*B+:B];
      end
    end
    assign words[c] = word;
  end
  assign count_o = words[3] - words[2] - words[1] + words[0];
endmodule
