// SPDX-License-Identifier: Apache-2.0
// The live sheets of densities: a ring of three parts of one channel each, and what the pixels of a block need of them
// (docs/microarchitecture.md, "Densities"; cmodel/classify/density_ring.hpp). A block is read in five cycles: the
// blocks above, left, right and below, then itself, of all three sheets. It is processed slice by slice while the next
// one is read.
// A part's word is valid only where the block's bit is set, so memories are never wiped.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_density_ring (
    input  logic                                clk_i,
    input  logic                                rst_ni,
    // copy: a block that the sheet buffer reads in this cycle; its words a cycle later
    input  logic                                copy_i,
    input  logic [1:0]                          part_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0] copy_block_i,
    input  logic [fastsplat_pkg::BANKS*fastsplat_pkg::SHEET_BITS-1:0] copy_words_i,
    input  logic [2:0]                          clear_i,
    // gather
    input  logic [4:0]                          step_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0] block_i,
    input  logic                                behind_i,
    output logic                                load_o,   // pulse: slices begin in the next cycle
    // d0: a slice
    output logic                                valid_o,
    output logic [fastsplat_pkg::SLICE_BITS-1:0] slice_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0] block_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES*fastsplat_pkg::SHEET_BITS-1:0] here_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES*fastsplat_pkg::SHEET_BITS-1:0] left_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES*fastsplat_pkg::SHEET_BITS-1:0] right_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES*fastsplat_pkg::SHEET_BITS-1:0] above_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES*fastsplat_pkg::SHEET_BITS-1:0] below_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES*fastsplat_pkg::SHEET_BITS-1:0] before_o,
    output logic [fastsplat_pkg::COMPOSITE_LANES*fastsplat_pkg::SHEET_BITS-1:0] behind_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int C = fastsplat_pkg::COMPOSITE_LANES;
  localparam int R = fastsplat_pkg::SLICES;
  localparam int LB = fastsplat_pkg::SLICE_BITS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int NB = fastsplat_pkg::BLOCKS;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int SB = fastsplat_pkg::SHEET_BITS;

  // ---- which block is read: at the edges of the tile's memory the block itself replaces a missing neighbour
  logic [AB-1:0] address, column;
  assign column = block_i & AB'(BX - 1);
  always_comb begin
    address = block_i;
    if (step_i[0] && block_i >= AB'(BX)) address = block_i - AB'(BX);
    if (step_i[1] && column != '0) address = block_i - AB'(1);
    if (step_i[2] && column != AB'(BX - 1)) address = block_i + AB'(1);
    if (step_i[3] && (AB + 1)'(block_i) + (AB + 1)'(BX) < (AB + 1)'(NB)) address = block_i + AB'(BX);
  end

  // ---- parts: which blocks they hold; the one that waits is `here`
  logic [1:0] here, ahead, here_q, before_q, behind_q;
  logic [2:0] there_q;
  logic copy_q;
  logic [1:0] part_q;
  logic [AB-1:0] copy_block_q;
  assign here = (part_i == 2'd0) ? 2'd2 : part_i - 2'd1;
  assign ahead = (here == 2'd0) ? 2'd2 : here - 2'd1;
  for (genvar s = 0; s < 3; s++) begin : gen_held
    logic [NB-1:0] held_q;
    always_ff @(posedge clk_i) begin
      there_q[s] <= held_q[address] && !(part_i == 2'(s) && !behind_i && !`FASTSPLAT_FAULT(POST_BEHIND));
      if (copy_i && part_i == 2'(s)) held_q[copy_block_i] <= 1'b1;
      if (clear_i[s]) held_q <= '0;
      // A sheet's last block may be copied in the cycle in which another part is cleared, never its own.
    end
    `FASTSPLAT_ASSERT(copied_part_stays, !(copy_i && part_i == 2'(s) && clear_i[s]))
  end

  // ---- memories and their outputs
  logic [4:0] got_q;  // steps
  logic [AB-1:0] got_block_q;
  always_ff @(posedge clk_i) begin
    copy_q <= copy_i;
    part_q <= part_i;
    copy_block_q <= copy_block_i;
    here_q <= here;
    before_q <= ahead;
    behind_q <= part_i;
    got_q <= step_i;
    got_block_q <= block_i;
    if (!rst_ni) begin
      copy_q <= 1'b0;
      got_q <= '0;
    end
  end
  function automatic logic [SB-1:0] of_part(input logic [1:0] part, input logic [SB-1:0] word_0, input logic [SB-1:0] word_1,
                                            input logic [SB-1:0] word_2);
    of_part = (part == 2'd0) ? word_0 : (part == 2'd1) ? word_1 : word_2;
  endfunction
  logic [SB-1:0] got_here[0:P*P-1], got_before[0:P*P-1], got_behind[0:P*P-1];
  for (genvar b = 0; b < P * P; b++) begin : gen_bank
    logic [SB-1:0] words[0:2], counted[0:2];
    for (genvar s = 0; s < 3; s++) begin : gen_part
      fastsplat_ram_1r1w #(.BITS(SB), .WORDS(NB), .ADDR(AB)) u_ram (
          .clk_i,
          .re_i(step_i != '0),
          .raddr_i(address),
          .rdata_o(words[s]),
          .we_i(copy_q && part_q == 2'(s)),
          .waddr_i(copy_block_q),
          .wdata_i(copy_words_i[b*SB+:SB])
      );
      assign counted[s] = there_q[s] ? words[s] : '0;
    end
    assign got_here[b] = of_part(here_q, counted[0], counted[1], counted[2]);
    assign got_before[b] = of_part(before_q, counted[0], counted[1], counted[2]);
    assign got_behind[b] = of_part(behind_q, counted[0], counted[1], counted[2]);
  end

  // ---- the block with a pixel of its neighbours on each side
  logic [SB-1:0] above_q[0:P-1], left_q[0:P-1], right_q[0:P-1], below_q[0:P-1];
  logic [SB-1:0] here_w[0:P*P-1], before_w[0:P*P-1], behind_w[0:P*P-1];
  logic [SB-1:0] above_w[0:P-1], left_w[0:P-1], right_w[0:P-1], below_w[0:P-1];
  logic [AB-1:0] block_w;
  logic valid_q;
  logic [LB-1:0] slice_q;
  always_ff @(posedge clk_i) begin
    for (int n = 0; n < P; n++) begin
      if (got_q[0]) above_q[n] <= got_here[(P-1)*P+n];
      if (got_q[1]) left_q[n] <= got_here[n*P+P-1];
      if (got_q[2]) right_q[n] <= got_here[n*P];
      if (got_q[3]) below_q[n] <= got_here[n];
    end
    if (got_q[4]) begin
      for (int b = 0; b < P * P; b++) begin
        here_w[b] <= got_here[b];
        before_w[b] <= got_before[b];
        behind_w[b] <= got_behind[b];
      end
      for (int n = 0; n < P; n++) begin
        above_w[n] <= above_q[n];
        left_w[n] <= left_q[n];
        right_w[n] <= right_q[n];
        below_w[n] <= below_q[n];
      end
      block_w <= got_block_q;
    end
    valid_q <= got_q[4] || (valid_q && slice_q != LB'(R - 1));
    slice_q <= (got_q[4] || !valid_q) ? '0 : slice_q + LB'(1);
    if (!rst_ni) valid_q <= 1'b0;
  end
  assign load_o = got_q[4];
  assign valid_o = valid_q;
  assign slice_o = (R == 1) ? '0 : slice_q;
  assign block_o = block_w;

  // By lane: in slice r, lane c works on bank C r + c.
  logic [SB-1:0] west[0:P*P-1], east[0:P*P-1], north[0:P*P-1], south[0:P*P-1];
  for (genvar h = 0; h < P; h++) begin : gen_row
    for (genvar g = 0; g < P; g++) begin : gen_column
      localparam int B = h * P + g;
      if (g == 0) begin : gen_west
        assign west[B] = left_w[h];
      end else begin : gen_inner_west
        assign west[B] = here_w[B-1];
      end
      if (g == P - 1) begin : gen_east
        assign east[B] = right_w[h];
      end else begin : gen_inner_east
        assign east[B] = here_w[B+1];
      end
      if (h == 0) begin : gen_north
        assign north[B] = `FASTSPLAT_FAULT(POST_HALO) ? here_w[B] : above_w[g];
      end else begin : gen_inner_north
        assign north[B] = here_w[B-P];
      end
      if (h == P - 1) begin : gen_south
        assign south[B] = below_w[g];
      end else begin : gen_inner_south
        assign south[B] = here_w[B+P];
      end
    end
  end
  always_comb begin
    {here_o, left_o, right_o, above_o, below_o, before_o, behind_o} = '0;
    for (int r = 0; r < R; r++) begin
      if (R == 1 || slice_q == LB'(r)) begin
        for (int c = 0; c < C; c++) begin
          here_o[c*SB+:SB] = here_w[r*C+c];
          left_o[c*SB+:SB] = west[r*C+c];
          right_o[c*SB+:SB] = east[r*C+c];
          above_o[c*SB+:SB] = north[r*C+c];
          below_o[c*SB+:SB] = south[r*C+c];
          before_o[c*SB+:SB] = before_w[r*C+c];
          behind_o[c*SB+:SB] = behind_w[r*C+c];
        end
      end
    end
  end
  `FASTSPLAT_ASSERT(slices_are_through, !got_q[4] || !valid_q || slice_q == LB'(R - 1))
  `FASTSPLAT_ASSERT(one_step_at_a_time, $onehot0(step_i))
endmodule
