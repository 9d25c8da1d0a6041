// SPDX-License-Identifier: Apache-2.0
// A table with linear interpolation (docs/numerics.md, N-6.2-7; cmodel/classify/classify_unit.hpp, Lines). A memory
// word holds an entry and the next one.
// Registers: memory -> product -> value, three cycles after the index.
module fastsplat_classify_line #(
    parameter int BITS  = 8,
    parameter int WORDS = 16,  // segments
    parameter int ADDR  = 4,
    parameter int REST  = 1    // a segment is 2^REST long
) (
    input  logic              clk_i,
    input  logic              we_i,
    input  logic [ADDR-1:0]   waddr_i,
    input  logic [2*BITS-1:0] wdata_i,  // {entry, the next one}
    input  logic [ADDR-1:0]   index_i,
    input  logic [REST:0]     rest_i,   // 0..2^REST
    output logic [BITS-1:0]   value_o
);
  localparam int FALL = BITS + REST + 3;
  localparam logic signed [FALL-1:0] HALF = (FALL'(1) << REST) >> 1;
  logic [2*BITS-1:0] segment;
  logic [REST:0] rest_q;
  logic [BITS-1:0] entry_q;
  logic signed [BITS:0] difference;
  logic signed [FALL-1:0] fall_q;
  fastsplat_ram_1r1w #(.BITS(2 * BITS), .WORDS(WORDS), .ADDR(ADDR)) u_ram (
      .clk_i, .re_i(1'b1), .raddr_i(index_i), .rdata_o(segment), .we_i, .waddr_i, .wdata_i
  );
  assign difference = $signed({1'b0, segment[BITS+:BITS]}) - $signed({1'b0, segment[BITS-1:0]});
  always_ff @(posedge clk_i) begin
    rest_q <= rest_i;
    entry_q <= segment[BITS+:BITS];
    fall_q <= FALL'(difference) * $signed(FALL'({1'b0, rest_q}));
    value_o <= entry_q - BITS'((fall_q + HALF) >>> REST);
  end
endmodule
