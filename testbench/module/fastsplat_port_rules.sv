// SPDX-License-Identifier: Apache-2.0
// Requirements of AXI4-Stream and AXI4-Lite on fastsplat_top's ports, and of docs/integration.md on its pixels: checked
// in every simulation.
`include "assertions.svh"

module fastsplat_port_rules (
    input logic clk_i,
    input logic rst_ni,
    input logic s_tvalid_i,
    input logic s_tready_o,
    input logic [fastsplat_pkg::BEAT_BITS-1:0] s_tdata_i,
    input logic m_tvalid_o,
    input logic m_tready_i,
    input logic [fastsplat_pkg::LANES*128-1:0] m_tdata_o,
    input logic [fastsplat_pkg::LANES*16-1:0] m_tkeep_i,
    input logic m_tlast_o,
    input logic m_tuser_o,
    input logic awvalid_i,
    input logic awready_o,
    input logic wvalid_i,
    input logic wready_o,
    input logic bvalid_o,
    input logic bready_i,
    input logic [1:0] bresp_o,
    input logic arvalid_i,
    input logic arready_o,
    input logic rvalid_o,
    input logic rready_i,
    input logic [31:0] rdata_o,
    input logic [1:0] rresp_o
);
  localparam int P = fastsplat_pkg::LANES;
  // An offered transfer does not change until it is taken.
  `FASTSPLAT_ASSUME_HELD(beat_held, s_tvalid_i && !s_tready_o, s_tvalid_i, s_tdata_i)
  `FASTSPLAT_ASSERT_HELD(pixels_held, m_tvalid_o && !m_tready_i, m_tvalid_o, {m_tdata_o, m_tkeep_i, m_tlast_o, m_tuser_o})
  `FASTSPLAT_ASSERT_HELD(write_response_held, bvalid_o && !bready_i, bvalid_o, bresp_o)
  `FASTSPLAT_ASSERT_HELD(read_response_held, rvalid_o && !rready_i, rvalid_o, {rdata_o, rresp_o})

  // Bytes are kept by whole pixels, from the leftmost on; all beats of a tile carry the same mark.
  logic [P-1:0] kept;
  logic [16*P-1:0] whole;
  logic in_tile_q, marked_q;
  for (genvar g = 0; g < P; g++) begin : gen_kept
    assign kept[g] = m_tkeep_i[16*g];
    assign whole[16*g+:16] = {16{kept[g]}};
  end
  always_ff @(posedge clk_i) begin
    if (m_tvalid_o && m_tready_i) begin
      in_tile_q <= !m_tlast_o;
      marked_q <= m_tuser_o;
    end
    if (!rst_ni) in_tile_q <= 1'b0;
  end
  `FASTSPLAT_ASSERT(pixels_kept_whole, !m_tvalid_o || (m_tkeep_i == whole && kept[0] && (kept & (kept + P'(1))) == '0))
  `FASTSPLAT_ASSERT(tile_marked_throughout, !m_tvalid_o || !in_tile_q || m_tuser_o == marked_q)

  // A write takes address and data together; each access has one response, OKAY or SLVERR, and comes before it.
  logic writing_q, reading_q;
  always_ff @(posedge clk_i) begin
    writing_q <= (awvalid_i && awready_o) || (writing_q && !(bvalid_o && bready_i));
    reading_q <= (arvalid_i && arready_o) || (reading_q && !(rvalid_o && rready_i));
    if (!rst_ni) begin
      writing_q <= 1'b0;
      reading_q <= 1'b0;
    end
  end
  `FASTSPLAT_ASSERT(write_taken_whole, (awvalid_i && awready_o) == (wvalid_i && wready_o))
  `FASTSPLAT_ASSERT(one_response_per_write, (!bvalid_o || writing_q) && !(writing_q && awvalid_i && awready_o))
  `FASTSPLAT_ASSERT(one_response_per_read, (!rvalid_o || reading_q) && !(reading_q && arvalid_i && arready_o))
  `FASTSPLAT_ASSERT(known_response, !(bvalid_o && bresp_o[0]) && !(rvalid_o && rresp_o[0]))
endmodule
