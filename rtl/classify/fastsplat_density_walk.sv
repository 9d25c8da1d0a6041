// SPDX-License-Identifier: Apache-2.0
// Walks a sheet of densities block by block (docs/microarchitecture.md, "Densities"; cmodel/classify/density_ring.hpp).
// A finished sheet's dirty blocks are listed while they are copied out of its buffer. Once the next sheet is copied,
// too, the listed blocks are read, STEPS cycles each. The first five cycles address what a block's pixels need; the
// others wait for the pixel stage's lanes.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_density_walk (
    input  logic                                clk_i,
    input  logic                                rst_ni,
    // copy: a dirty block, the sheet's last cycle, its number
    input  logic                                copy_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0] copy_block_i,
    input  logic                                finish_i,
    input  logic [31:0]                         number_i,
    // the tile ends and no sheet is on its way: the one that waits is the last
    input  logic                                flush_i,
    output logic                                hold_o,      // no copy may begin
    output logic                                free_o,      // pulse: the sheet copied last now waits
    // part of the ring copied to; the waiting sheet lies in the part before it, its predecessor before that
    output logic [1:0]                          part_o,
    output logic [2:0]                          clear_o,     // parts that are empty from the next cycle on
    // gather: one step in each of a block's first five cycles, then none
    output logic                                gather_o,
    output logic [4:0]                          step_o,      // one bit each: above, left, right, below, the block itself
    output logic [fastsplat_pkg::ADDR_BITS-1:0] block_o,
    output logic                                behind_o,    // there is a sheet behind this one
    output logic [31:0]                         sheet_o,     // number of the sheet that is walked
    output logic                                last_o,      // pulse: last cycle of a sheet's walk
    output logic                                waiting_o    // a sheet waits, or is walked
);
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int STEPS = fastsplat_pkg::DENSITY_STEPS;
  localparam int CB = $clog2(STEPS);

  // The sheet being copied has list half_q and part part_q, the waiting one the other list and the part before.
  logic waiting_q, half_q;
  logic [1:0] part_q;
  logic [AB:0] copied_q, blocks_q;  // lengths of the two lists
  logic [31:0] copied_number_q, number_q;
  logic starts, last;

  // The walk.
  typedef enum logic [1:0] {StIdle, StFetch, StWalk} state_e;
  state_e state_q;
  logic flushes_q, next_q;
  logic [CB-1:0] step_q;
  logic [AB:0] left_q;
  logic [AB-1:0] index_q;
  logic ends_block, fetches;
  assign starts = (finish_i || (flush_i && state_q == StIdle)) && waiting_q;
  assign ends_block = step_q == CB'(STEPS - 1);
  assign fetches = state_q == StFetch || (state_q == StWalk && ends_block);
  assign last = state_q == StWalk && (left_q == '0 || (left_q == (AB + 1)'(1) && ends_block));

  fastsplat_ram_1r1w #(.BITS(AB), .WORDS(2 << AB), .ADDR(AB + 1)) u_list (
      .clk_i,
      .re_i(fetches),
      .raddr_i({!half_q, index_q}),
      .rdata_o(block_o),
      .we_i(copy_i),
      .waddr_i({half_q, copied_q[AB-1:0]}),
      .wdata_i(copy_block_i)
  );

  // The copied sheet becomes the waiting one. next: it directly follows the one that waited (M-density-9).
  logic advances, next;
  logic [1:0] part_before, part_next;
  assign advances = (finish_i && !waiting_q) || (last && !flushes_q);
  assign next = waiting_q && next_q;
  function automatic logic [1:0] other_part(input logic [1:0] part);  // the one after it
    other_part = (part == 2'd2) ? 2'd0 : part + 2'd1;
  endfunction
  assign part_next = other_part(part_q);
  assign part_before = other_part(part_next);
  always_comb begin
    clear_o = '0;
    if (advances) clear_o = 3'b001 << part_next | ((next || `FASTSPLAT_FAULT(POST_BEFORE)) ? '0 : 3'b001 << part_before);
    if (last && flushes_q) clear_o = '1;
    if (!rst_ni) clear_o = '1;
  end

  always_ff @(posedge clk_i) begin
    if (copy_i) copied_q <= copied_q + (AB + 1)'(1);
    case (state_q)
      StIdle: if (starts) state_q <= StFetch;
      StFetch: begin
        state_q <= StWalk;
        index_q <= AB'(1);
      end
      default: begin
        step_q <= ends_block ? '0 : step_q + CB'(1);
        if (ends_block) begin
          left_q <= left_q - (AB + 1)'(1);
          index_q <= index_q + AB'(1);
        end
        if (last) state_q <= StIdle;
      end
    endcase
    if (starts) begin
      flushes_q <= !finish_i;
      next_q <= finish_i && number_i == number_q + 32'd1;
      copied_number_q <= number_i;
      sheet_o <= number_q;
      left_q <= blocks_q;
      index_q <= '0;
      step_q <= '0;
    end
    if (advances) begin
      waiting_q <= 1'b1;
      half_q <= !half_q;
      part_q <= part_next;
      blocks_q <= copied_q + (AB + 1)'(copy_i);
      number_q <= finish_i ? number_i : copied_number_q;
      copied_q <= '0;
    end
    if (last && flushes_q) waiting_q <= 1'b0;
    if (!rst_ni) begin
      waiting_q <= 1'b0;
      half_q <= 1'b0;
      part_q <= '0;
      copied_q <= '0;
      state_q <= StIdle;
      step_q <= '0;
    end
  end
  assign hold_o = state_q != StIdle;
  assign free_o = advances;
  assign part_o = part_q;
  assign gather_o = state_q == StWalk && left_q != '0;
  for (genvar n = 0; n < 5; n++) begin : gen_step
    assign step_o[n] = gather_o && step_q == CB'(n);
  end
  assign behind_o = next_q && !flushes_q;
  assign last_o = last;
  assign waiting_o = waiting_q || state_q != StIdle;

  `FASTSPLAT_ASSERT(nothing_copied_meanwhile, !(hold_o && (copy_i || finish_i)))
  `FASTSPLAT_ASSERT(list_has_room, !copy_i || copied_q < (AB + 1)'(fastsplat_pkg::BLOCKS))
  `FASTSPLAT_ASSERT(flush_finds_no_copy, !flush_i || hold_o || copied_q == '0)
endmodule
