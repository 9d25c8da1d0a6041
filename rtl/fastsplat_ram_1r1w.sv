// SPDX-License-Identifier: Apache-2.0
// Memory with one registered read port and one write port. The output keeps its word until the next read. A read of the
// word being written returns an undefined value that nothing may depend on. All memories of the device are instances of
// it. A vendor's macro with self-test and error correction can replace it by BITS and WORDS; these get no cycle of their
// own (docs/integration.md, "Memories").
module fastsplat_ram_1r1w #(
    parameter int BITS  = 8,
    parameter int WORDS = 16,
    parameter int ADDR  = 4
) (
    input  logic            clk_i,
    input  logic            re_i,
    input  logic [ADDR-1:0] raddr_i,
    output logic [BITS-1:0] rdata_o,
    input  logic            we_i,
    input  logic [ADDR-1:0] waddr_i,
    input  logic [BITS-1:0] wdata_i
`ifdef FASTSPLAT_PROOF
    ,
    input  logic [ADDR-1:0] probe_addr_i,
    output logic [BITS-1:0] probe_o
`endif
);
  (* no_rw_check *)
  logic [BITS-1:0] mem[0:WORDS-1];
  always_ff @(posedge clk_i) begin
    if (we_i) mem[waddr_i] <= wdata_i;
`ifdef FASTSPLAT_PROOF
    if (re_i) rdata_o <= (we_i && waddr_i == raddr_i) ? garbage : mem[raddr_i];
`else
    if (re_i) rdata_o <= mem[raddr_i];
`endif
  end
`ifdef FASTSPLAT_PROOF
  (* anyseq *) logic [BITS-1:0] garbage;
  assign probe_o = mem[probe_addr_i];
`endif
endmodule
