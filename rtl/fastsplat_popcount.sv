// SPDX-License-Identifier: Apache-2.0
// Unit "popcount": the number of bits set in a word, in two cycles: partial sums of 16 bits each, then their sum.
// `clear_i` drops what is on its way (docs/microarchitecture.md, M-register-13).
module fastsplat_popcount #(
    parameter int BITS = 16
) (
    input  logic            clk_i,
    input  logic            rst_ni,
    input  logic            clear_i,
    input  logic [BITS-1:0] bits_i,
    output logic [15:0]     count_o
);
  localparam int PARTS = (BITS + 15) / 16;
  logic [16*PARTS-1:0] bits;
  logic [4:0] part_q[0:PARTS-1];
  logic [15:0] sum;
  assign bits = (16 * PARTS)'(bits_i);
  for (genvar p = 0; p < PARTS; p++) begin : gen_part
    logic [15:0] word;  // Icarus 11 counts a part select wrongly
    assign word = bits[16*p+:16];
    always_ff @(posedge clk_i) part_q[p] <= rst_ni ? 5'($countones(word)) : '0;
  end
  always_comb begin
    sum = '0;
    for (int p = 0; p < PARTS; p++) sum = sum + 16'(part_q[p]);
  end
  always_ff @(posedge clk_i) count_o <= (rst_ni && !clear_i) ? sum : '0;
endmodule
