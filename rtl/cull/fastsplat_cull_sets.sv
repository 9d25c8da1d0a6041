// SPDX-License-Identifier: Apache-2.0
// Cull groups announced by cull_block records; decides whether a splat belongs to a hidden one
// (docs/microarchitecture.md, M-cull-15; cmodel/cull/cull_sets.hpp). Tags decide, because a source need not send hidden
// splats. The unit keeps the visible groups, oldest first, and the tag up to which groups were announced. A splat
// before that tag and in none of these groups is hidden.
// A group can be announced and a splat taken in every cycle. The oldest group lies in a register. The newest of the
// others lies in another one, because the memory has it two cycles later.
`include "assertions.svh"

module fastsplat_cull_sets (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        clear_i,   // a tile begins
    input  logic [31:0] tag_i,     // of the group's first splat, or of the splat
    // a cull group of at least one splat
    input  logic        push_i,
    input  logic [31:0] splats_i,
    input  logic        hidden_i,
    // a splat came
    input  logic        splat_i,
    output logic        hidden_o   // the splat that comes belongs to a hidden group
);
  localparam int AB = fastsplat_pkg::CULL_SETS_BITS;

  logic [31:0] announced_q;  // tag behind the announced groups
  logic valid_q;
  logic [31:0] first_q, last_q;  // tags of the oldest group
  logic [AB:0] behind_q;  // groups behind it, in the memory
  logic [AB-1:0] read_q, read_next, end_q;  // of those
  logic [63:0] newest_q, stored, second, set;
  logic seen, ends, pops, stores;
  assign set = {tag_i, tag_i + splats_i - 32'd1};
  assign seen = push_i && !hidden_i;
  assign ends = splat_i && valid_q && tag_i == last_q;
  assign pops = ends && behind_q != '0;
  assign stores = seen && valid_q && !(ends && behind_q == '0);
  assign read_next = read_q + AB'(pops);
  assign second = (behind_q == (AB + 1)'(1)) ? newest_q : stored;
  fastsplat_ram_1r1w #(.BITS(64), .WORDS(1 << AB), .ADDR(AB)) u_sets (
      .clk_i,
      .re_i(1'b1),
      .raddr_i(read_next),
      .rdata_o(stored),
      .we_i(stores),
      .waddr_i(end_q),
      .wdata_i(set)
  );
  // Differences of tags, below 0 or not.
  logic [31:0] past_announced, past_first;
  assign past_announced = tag_i - announced_q;
  assign past_first = tag_i - first_q;
  assign hidden_o = past_announced[31] && (!valid_q || past_first[31]);
  logic unused;
  assign unused = &{1'b0, past_announced, past_first};

  always_ff @(posedge clk_i) begin
    read_q <= read_next;
    behind_q <= behind_q + (AB + 1)'(stores) - (AB + 1)'(pops);
    if (push_i) announced_q <= tag_i + splats_i;
    if (stores) begin
      newest_q <= set;
      end_q <= end_q + AB'(1);
    end
    if (pops) {first_q, last_q} <= second;
    else if (seen && !stores) {first_q, last_q} <= set;
    valid_q <= (valid_q && !(ends && !pops)) || seen;
    if (!rst_ni || clear_i) begin
      announced_q <= '0;
      valid_q <= 1'b0;
      behind_q <= '0;
      read_q <= '0;
      end_q <= '0;
    end
  end
  `FASTSPLAT_ASSERT(oldest_set_in_front, valid_q || behind_q == '0)
endmodule
