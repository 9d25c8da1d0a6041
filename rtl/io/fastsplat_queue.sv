// SPDX-License-Identifier: Apache-2.0
// A queue over a memory: one word in and one out a cycle. A word put in cycle t is shown from t+2 on, or from the cycle
// after the one before it was taken (docs/microarchitecture.md, "Fetch"). Holds at least WORDS words; the writer makes
// sure that there is room.
`include "assertions.svh"

module fastsplat_queue #(
    parameter int BITS = 8,
    parameter int LOG2 = 4  // log2 of WORDS
) (
    input  logic            clk_i,
    input  logic            rst_ni,
    input  logic            clear_i,  // empties the queue; what is put in this cycle is dropped, too
    input  logic            put_i,
    input  logic [BITS-1:0] data_i,
    output logic            valid_o,
    input  logic            take_i,
    output logic [BITS-1:0] data_o
);
  localparam int WORDS = 1 << LOG2;

  // put_q - read_q: words in the memory that were not read. shown_q: one was, and was not taken; it is the memory's output.
  logic [LOG2:0] put_q, read_q;
  logic shown_q, read;
  assign valid_o = shown_q;
  assign read = put_q != read_q && (!shown_q || take_i);

  fastsplat_ram_1r1w #(
      .BITS(BITS),
      .WORDS(WORDS),
      .ADDR(LOG2)
  ) u_words (
      .clk_i(clk_i),
      .re_i(read),
      .raddr_i(read_q[LOG2-1:0]),
      .rdata_o(data_o),
      .we_i(put_i),
      .waddr_i(put_q[LOG2-1:0]),
      .wdata_i(data_i)
  );

  always_ff @(posedge clk_i) begin
    if (put_i) put_q <= put_q + (LOG2 + 1)'(1);
    if (read) read_q <= read_q + (LOG2 + 1)'(1);
    shown_q <= read || (shown_q && !take_i);
    if (!rst_ni || clear_i) begin
      put_q <= '0;
      read_q <= '0;
      shown_q <= 1'b0;
    end
  end
  `FASTSPLAT_ASSUME(queue_has_room, !put_i || put_q - read_q != (LOG2 + 1)'(WORDS))
  `FASTSPLAT_ASSERT_HELD(queue_shows_until_taken, valid_o && !take_i && !clear_i, valid_o, data_o)
endmodule
