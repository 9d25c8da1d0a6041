// SPDX-License-Identifier: Apache-2.0
// The device on an iCE40 package of 206 pins: beats come in by a shift register, pixels leave by another. Registers and taps are
// left open, so that synthesis takes them out; what is measured is what renders. Not part of the device.
module ice40_wrap (
    input  logic clk_i,
    input  logic rst_ni,
    input  logic bit_i,
    input  logic s_tvalid_i,
    input  logic m_tready_i,
    output logic s_tready_o,
    output logic m_tvalid_o,
    output logic m_tlast_o,
    output logic bit_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int PB = fastsplat_pkg::PIXEL_BITS;
  logic [fastsplat_pkg::BEAT_BITS-1:0] beat_q;
  logic [P*128-1:0] pixels;
  logic [P-1:0] keep;
  logic [P*4*PB+P-1:0] words, out_q;
  logic ready, valid, last;
  for (genvar g = 0; g < P * 4; g++) begin : gen_word
    assign words[g*PB+:PB] = pixels[g*32+:PB];
  end
  assign words[P*4*PB+:P] = keep;
  // A register at every pin: paths inside are the device's.
  logic rst_q, s_valid_q, m_ready_q;
  always_ff @(posedge clk_i) begin
    rst_q <= rst_ni;
    s_valid_q <= s_tvalid_i;
    m_ready_q <= m_tready_i;
    beat_q <= {beat_q[fastsplat_pkg::BEAT_BITS-2:0], bit_i};
    out_q <= (valid && m_ready_q) ? words : {1'b0, out_q[P*4*PB+P-1:1]};
    s_tready_o <= ready;
    m_tvalid_o <= valid;
    m_tlast_o <= last;
  end
  assign bit_o = out_q[0];
  fastsplat_core u_core (
      .clk_i,
      .rst_ni(rst_q),
      .s_tvalid_i(s_valid_q),
      .s_tready_o(ready),
      .s_tdata_i(beat_q),
      .m_tvalid_o(valid),
      .m_tready_i(m_ready_q),
      .m_tdata_o(pixels),
      .m_tkeep_o(keep),
      .m_tlast_o(last),
      .awvalid_i(1'b0),
      .awaddr_i('0),
      .wvalid_i(1'b0),
      .wdata_i('0),
      .bready_i(1'b1),
      .arvalid_i(1'b0),
      .araddr_i('0),
      .rready_i(1'b1)
  );
endmodule
