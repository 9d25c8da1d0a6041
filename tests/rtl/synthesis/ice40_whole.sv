// SPDX-License-Identifier: Apache-2.0
// The whole device on an iCE40 package of 206 pins: beats come in by a shift register and pixels leave by another; registers are at
// pins of their own, a 12-bit address and 32-bit words each way. Taps are left open. Not part of the device.
module ice40_whole (
    input  logic        clk_i,
    input  logic        rst_ni,
    input  logic        bit_i,
    input  logic        s_tvalid_i,
    input  logic        m_tready_i,
    output logic        s_tready_o,
    output logic        m_tvalid_o,
    output logic        m_tlast_o,
    output logic        m_tuser_o,
    output logic        bit_o,
    output logic        error_o,
    output logic        irq_o,
    input  logic        awvalid_i,
    output logic        awready_o,
    input  logic [11:0] awaddr_i,
    input  logic        wvalid_i,
    output logic        wready_o,
    input  logic [31:0] wdata_i,
    output logic        bvalid_o,
    input  logic        bready_i,
    output logic [1:0]  bresp_o,
    input  logic        arvalid_i,
    output logic        arready_o,
    input  logic [11:0] araddr_i,
    output logic        rvalid_o,
    input  logic        rready_i,
    output logic [31:0] rdata_o,
    output logic [1:0]  rresp_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int PB = fastsplat_pkg::PIXEL_BITS;
  localparam int BB = fastsplat_pkg::BEAT_BITS;
  logic [BB-1:0] beat_q;
  logic [P*128-1:0] pixels;
  logic [P-1:0] keep;
  logic [P*4*PB+P-1:0] words, out_q;
  for (genvar g = 0; g < P * 4; g++) begin : gen_word
    assign words[g*PB+:PB] = pixels[g*32+:PB];
  end
  assign words[P*4*PB+:P] = keep;
  always_ff @(posedge clk_i) begin
    beat_q <= {beat_q[BB-2:0], bit_i};
    out_q <= (m_tvalid_o && m_tready_i) ? words : {1'b0, out_q[P*4*PB+P-1:1]};
  end
  assign bit_o = out_q[0];
  fastsplat_core u_core (
      .clk_i, .rst_ni, .s_tvalid_i, .s_tready_o, .s_tdata_i(beat_q), .m_tvalid_o, .m_tready_i, .m_tdata_o(pixels), .m_tkeep_o(keep),
      .m_tlast_o, .m_tuser_o, .awvalid_i, .awready_o, .awaddr_i, .wvalid_i, .wready_o, .wdata_i, .bvalid_o, .bready_i, .bresp_o,
      .arvalid_i, .arready_o, .araddr_i, .rvalid_o, .rready_i, .rdata_o, .rresp_o, .error_o, .irq_o,
      .slices_busy_i(1'b0), .tile_left_i(1'b0), .frame_left_i(1'b0)
  );
endmodule
