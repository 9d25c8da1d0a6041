// Sets of splats that cull_block records announced and whose splats are still to come, oldest first (docs/stream.md, cull_block;
// cmodel/cull_sets.hpp). A set can be announced and a splat taken in every cycle: the oldest set lies in a register; of those behind it
// the newest lies in another one, for the memory has it two cycles later.
`include "assertions.svh"

module fastsplat_cull_sets (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        clear_i,   // a tile begins
    // a set of at least one splat
    input  logic        push_i,
    input  logic [31:0] splats_i,
    input  logic        hidden_i,
    // a splat came: it is the oldest set's, if there is one
    input  logic        splat_i,
    output logic        hidden_o   // the splat that comes belongs to a hidden set
);
  localparam int AB = fastsplat_pkg::CULL_SETS_BITS;

  logic valid_q, hidden_q;
  logic [31:0] left_q;  // splats of the oldest set
  logic [AB:0] behind_q;  // sets behind it, in the memory
  logic [AB-1:0] first_q, first_next, end_q;  // of those
  logic [32:0] newest_q, stored, second;
  logic ends, pops, stores;
  assign ends = splat_i && valid_q && left_q == 32'd1;
  assign pops = ends && behind_q != '0;
  assign stores = push_i && valid_q && !(ends && behind_q == '0);
  assign first_next = first_q + AB'(pops);
  assign second = (behind_q == (AB + 1)'(1)) ? newest_q : stored;
  fastsplat_ram_1r1w #(.BITS(33), .WORDS(1 << AB), .ADDR(AB)) u_sets (
      .clk_i,
      .re_i(1'b1),
      .raddr_i(first_next),
      .rdata_o(stored),
      .we_i(stores),
      .waddr_i(end_q),
      .wdata_i({hidden_i, splats_i})
  );
  assign hidden_o = valid_q && hidden_q;

  always_ff @(posedge clk_i) begin
    first_q <= first_next;
    behind_q <= behind_q + (AB + 1)'(stores) - (AB + 1)'(pops);
    if (stores) begin
      newest_q <= {hidden_i, splats_i};
      end_q <= end_q + AB'(1);
    end
    if (splat_i && valid_q) left_q <= left_q - 32'd1;
    if (pops) {hidden_q, left_q} <= second;
    else if (push_i && !stores) {hidden_q, left_q} <= {hidden_i, splats_i};
    valid_q <= (valid_q && !(ends && !pops)) || push_i;
    if (!rst_ni || clear_i) begin
      valid_q <= 1'b0;
      behind_q <= '0;
      first_q <= '0;
      end_q <= '0;
    end
  end
  `FASTSPLAT_ASSERT(oldest_set_in_front, valid_q || behind_q == '0)
  `FASTSPLAT_ASSERT(set_has_splats, !valid_q || left_q != '0)
  `FASTSPLAT_COVER(set_behind_another, pops)
endmodule
