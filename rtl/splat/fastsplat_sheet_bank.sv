// SPDX-License-Identifier: Apache-2.0
// One bank of the sheet buffer: two memories, read-modify-write at one word a cycle with forwarding, whatever the
// addresses. The compositor reads and clears the other memory meanwhile (docs/numerics.md, section 5;
// cmodel/splat/sheet_buffer.hpp).
//
// Splat side: A (c6: read issued) -> B (c7: base chosen) -> C (c8: sum) -> W (c9: written). A word needed again 1, 2 or
// 3 cycles later is not in the memory yet. Distance 1 is forwarded into C, distances 2 (in W) and 3 (just written; the
// read met the write) into B (M-forward-2).
`include "assertions.svh"
`include "fault.svh"
`include "narrow.svh"
module fastsplat_sheet_bank (
    input  logic                                   clk_i,
    input  logic                                   rst_ni,
    // clear walk after reset: writes zero to both memories
    input  logic                                   wipe_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]    wipe_addr_i,
    // A
    input  logic                                   valid_i,
    input  logic                                   buffer_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]    addr_i,
    input  logic [4*fastsplat_pkg::SHEET_BITS-1:0] products_i,
    // W
    output logic [4*fastsplat_pkg::SHEET_BITS-1:0] sum_o,
    output logic [3:0]                             saturated_o,
    // compositor: read address, data a cycle later, then cleared
    input  logic                                   comp_re_i,
    input  logic                                   comp_buffer_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]    comp_addr_i,
    output logic [4*fastsplat_pkg::SHEET_BITS-1:0] comp_data_o
);
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;

  logic valid_b_q, valid_c_q, valid_w_q, valid_h_q;
  logic buffer_b_q, buffer_c_q, buffer_w_q, buffer_h_q;
  logic [AB-1:0] addr_b_q, addr_c_q, addr_w_q, addr_h_q;
  logic forward_c_q;
  logic [4*SB-1:0] sum_w;
  `FASTSPLAT_NARROW(narrow_sum, SB + 1, SB, SUM)

`ifdef FASTSPLAT_PROOF
  (* anyconst *) logic any_buffer;
  (* anyconst *) logic [AB-1:0] any_addr;
  logic [4*SB-1:0] probe[0:1];
`endif

  // Memories
  logic comp_clear_q, comp_buffer_q;
  logic [AB-1:0] comp_addr_q;
  logic [4*SB-1:0] rdata[0:1];
  for (genvar m = 0; m < 2; m++) begin : gen_memory
    logic re, we, mine, clear, comp_mine;  // comp: the compositor reads this one
    logic [AB-1:0] raddr, waddr;
    logic [4*SB-1:0] wdata;
    assign mine = valid_w_q && buffer_w_q == 1'(m);
    assign clear = comp_clear_q && comp_buffer_q == 1'(m) && !(`FASTSPLAT_FAULT(MISSED_CLEAR) && comp_addr_q[0]);
    assign comp_mine = comp_re_i && comp_buffer_i == 1'(m);
    assign re = comp_mine || (valid_i && buffer_i == 1'(m));
    assign we = (wipe_i && !`FASTSPLAT_FAULT(MISSED_WIPE)) || clear || mine;
    assign waddr = wipe_i ? wipe_addr_i : clear ? comp_addr_q : addr_w_q;
    assign wdata = (wipe_i || clear) ? '0 : sum_w;
    assign raddr = comp_mine ? comp_addr_i : addr_i;
    fastsplat_ram_1r1w #(.BITS(4 * SB), .WORDS(fastsplat_pkg::BLOCKS), .ADDR(AB)) u_ram (
        .clk_i,
        .re_i(re),
        .raddr_i(raddr),
        .rdata_o(rdata[m]),
        .we_i(we),
        .waddr_i(waddr),
        .wdata_i(wdata)
`ifdef FASTSPLAT_PROOF
        ,
        .probe_addr_i(any_addr),
        .probe_o(probe[m])
`endif
    );
  end
  assign comp_data_o = comp_buffer_q ? rdata[1] : rdata[0];

  // Forwarding decisions of B. A bank's word is {buffer, address}.
  logic hit_c, hit_w, hit_h;
  assign hit_c = valid_b_q && valid_c_q && {buffer_c_q, addr_c_q} == {buffer_b_q, addr_b_q};
  assign hit_w = valid_w_q && {buffer_w_q, addr_w_q} == {buffer_b_q, addr_b_q};
  assign hit_h = valid_h_q && (buffer_h_q == buffer_b_q || `FASTSPLAT_FAULT(FORWARD_BUFFER)) && addr_h_q == addr_b_q;
  logic [4*SB-1:0] memory_b;
  assign memory_b = buffer_b_q ? rdata[1] : rdata[0];

  // By channel; a sum is {overflow, word}. C is the only loop.
  for (genvar c = 0; c < 4; c++) begin : gen_channel
    logic [SB-1:0] products_b_q, products_c_q, base_c_q, sum_h_q, base_c;
    logic [SB:0] sum_w_q;
    assign base_c = (forward_c_q && !`FASTSPLAT_FAULT(FORWARD_1)) ? sum_w_q[SB-1:0] : base_c_q;
    always_ff @(posedge clk_i) begin
      products_b_q <= products_i[c*SB+:SB];
      products_c_q <= products_b_q;
      base_c_q <= (hit_w && !`FASTSPLAT_FAULT(FORWARD_2)) ? sum_w_q[SB-1:0] :
                  (hit_h && !`FASTSPLAT_FAULT(FORWARD_3)) ? sum_h_q : memory_b[c*SB+:SB];
      sum_w_q <= narrow_sum({1'b0, base_c} + {1'b0, products_c_q});
      sum_h_q <= sum_w_q[SB-1:0];
    end
    assign sum_w[c*SB+:SB] = sum_w_q[SB-1:0];
    assign saturated_o[c] = valid_w_q && sum_w_q[SB];
  end

  always_ff @(posedge clk_i) begin
    valid_b_q <= valid_i;
    valid_c_q <= valid_b_q;
    valid_w_q <= valid_c_q;
    valid_h_q <= valid_w_q;
    if (!rst_ni) begin
      valid_b_q <= 1'b0;
      valid_c_q <= 1'b0;
      valid_w_q <= 1'b0;
      valid_h_q <= 1'b0;
      comp_clear_q <= 1'b0;
    end else begin
      comp_clear_q <= comp_re_i;
    end
    buffer_b_q <= buffer_i;
    buffer_c_q <= buffer_b_q;
    buffer_w_q <= buffer_c_q;
    buffer_h_q <= buffer_w_q;
    addr_b_q <= addr_i;
    addr_c_q <= addr_b_q;
    addr_w_q <= addr_c_q;
    addr_h_q <= addr_w_q;
    forward_c_q <= hit_c;
    comp_buffer_q <= comp_buffer_i;
    comp_addr_q <= comp_addr_i;
  end
  assign sum_o = sum_w;
`ifdef FASTSPLAT_PROOF
`include "sheet_bank_proof.svh"
`endif
endmodule
