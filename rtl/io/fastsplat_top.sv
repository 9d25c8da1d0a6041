// SPDX-License-Identifier: Apache-2.0
// The device as a block of a system: AXI4-Stream in and out and AXI4-Lite under the names that packagers look for,
// register slices on both streams, no taps (docs/integration.md). fastsplat_core does the work.
module fastsplat_top (
    input  logic         aclk,
    input  logic         aresetn,  // synchronous
    // beats of docs/stream.md
    input  logic         s_axis_tvalid,
    output logic         s_axis_tready,
    input  logic [fastsplat_pkg::BEAT_BITS-1:0] s_axis_tdata,
    // P pixels of a row: R, G, B, A of 32 bits each; tuser: the tile was cut short
    output logic         m_axis_tvalid,
    input  logic         m_axis_tready,
    output logic [fastsplat_pkg::LANES*128-1:0] m_axis_tdata,
    output logic [fastsplat_pkg::LANES*16-1:0]  m_axis_tkeep,
    output logic         m_axis_tlast,
    output logic         m_axis_tuser,
    // registers
    input  logic         s_axil_awvalid,
    output logic         s_axil_awready,
    input  logic [11:0]  s_axil_awaddr,
    input  logic [2:0]   s_axil_awprot,
    input  logic         s_axil_wvalid,
    output logic         s_axil_wready,
    input  logic [31:0]  s_axil_wdata,
    input  logic [3:0]   s_axil_wstrb,  // all four, or the write answers SLVERR
    output logic         s_axil_bvalid,
    input  logic         s_axil_bready,
    output logic [1:0]   s_axil_bresp,
    input  logic         s_axil_arvalid,
    output logic         s_axil_arready,
    input  logic [11:0]  s_axil_araddr,
    input  logic [2:0]   s_axil_arprot,
    output logic         s_axil_rvalid,
    input  logic         s_axil_rready,
    output logic [31:0]  s_axil_rdata,
    output logic [1:0]   s_axil_rresp,
    // culling: a pulse for each cull_block, for the source of the stream
    output logic         verdict_valid_o,
    output logic [31:0]  verdict_tag_o,
    output logic         verdict_hidden_o,
    output logic         irq
);
  localparam int P = fastsplat_pkg::LANES;
  localparam logic [11:0] NOWHERE = 12'hffc;  // an address that has no register

  logic beat_valid, beat_ready;
  logic [fastsplat_pkg::BEAT_BITS-1:0] beat;
  fastsplat_slice #(.BITS(fastsplat_pkg::BEAT_BITS)) u_beats (
      .clk_i(aclk),
      .rst_ni(aresetn),
      .valid_i(s_axis_tvalid),
      .ready_o(s_axis_tready),
      .data_i(s_axis_tdata),
      .valid_o(beat_valid),
      .ready_i(beat_ready),
      .data_o(beat)
  );

  // A reset drops the frame, but a source may not withdraw an offered beat. So beats are dropped while the host says so
  // (CONTROL.DROP), then up to the next begin_frame.
  logic drops_q, seeks_q, begins, core_valid, core_ready, writes_control;
  logic [11:0] write_address;
  assign begins = beat[7:0] == fastsplat_pkg::OP_BEGIN_FRAME && beat[63:32] == fastsplat_pkg::STREAM_MAGIC;
  assign core_valid = beat_valid && !drops_q && (!seeks_q || begins);
  assign beat_ready = core_ready || drops_q || (seeks_q && !begins);
  assign write_address = (s_axil_wstrb == 4'hf) ? s_axil_awaddr : NOWHERE;
  assign writes_control = s_axil_awvalid && s_axil_awready && write_address == fastsplat_pkg::REG_CONTROL;
  always_ff @(posedge aclk) begin
    if (core_valid && core_ready) seeks_q <= 1'b0;
    if (writes_control) drops_q <= s_axil_wdata[2:1] == 2'b11;
    if (!aresetn || (writes_control && s_axil_wdata[1])) seeks_q <= 1'b1;
    if (!aresetn) drops_q <= 1'b0;
  end

  logic pixels_valid, pixels_ready, last, aborted;
  logic [P*128-1:0] pixels;
  logic [P-1:0] keep, keep_q;
  fastsplat_slice #(.BITS(P*128+P+2)) u_pixels (
      .clk_i(aclk),
      .rst_ni(aresetn),
      .valid_i(pixels_valid),
      .ready_o(pixels_ready),
      .data_i({pixels, keep, last, aborted}),
      .valid_o(m_axis_tvalid),
      .ready_i(m_axis_tready),
      .data_o({m_axis_tdata, keep_q, m_axis_tlast, m_axis_tuser})
  );
  for (genvar g = 0; g < P; g++) begin : gen_keep
    assign m_axis_tkeep[16*g+:16] = {16{keep_q[g]}};
  end

  // BUSY and interrupts wait for the sink. A frame has left when the sink has taken the tiles that lay in the slice at its end.
  logic frame_end, tile_left, frame_left;
  logic [1:0] tiles_q, tiles;  // in the slice
  logic [2:0] ends_q;          // bit n: a frame's end waits for n tiles
  assign tile_left = m_axis_tvalid && m_axis_tready && m_axis_tlast;
  assign tiles = tiles_q - 2'(tile_left);
  assign frame_left = ends_q[0];
  always_ff @(posedge aclk) begin
    tiles_q <= tiles + 2'(pixels_valid && pixels_ready && last);
    ends_q <= (tile_left ? ends_q >> 1 : {ends_q[2:1], 1'b0}) | (3'(frame_end) << tiles);
    if (!aresetn) begin
      tiles_q <= '0;
      ends_q <= '0;
    end
  end

  // Taps are left open; so is error_o, which is in STATUS and an interrupt.
  // verilator lint_off PINMISSING
  fastsplat_core #(.SLICED(1'b1)) u_core (
      .clk_i(aclk),
      .rst_ni(aresetn),
      .s_tvalid_i(core_valid),
      .s_tready_o(core_ready),
      .s_tdata_i(beat),
      .m_tvalid_o(pixels_valid),
      .m_tready_i(pixels_ready),
      .m_tdata_o(pixels),
      .m_tkeep_o(keep),
      .m_tlast_o(last),
      .m_tuser_o(aborted),
      .awvalid_i(s_axil_awvalid),
      .awready_o(s_axil_awready),
      .awaddr_i(write_address),
      .wvalid_i(s_axil_wvalid),
      .wready_o(s_axil_wready),
      .wdata_i(s_axil_wdata),
      .bvalid_o(s_axil_bvalid),
      .bready_i(s_axil_bready),
      .bresp_o(s_axil_bresp),
      .arvalid_i(s_axil_arvalid),
      .arready_o(s_axil_arready),
      .araddr_i(s_axil_araddr),
      .rvalid_o(s_axil_rvalid),
      .rready_i(s_axil_rready),
      .rdata_o(s_axil_rdata),
      .rresp_o(s_axil_rresp),
      .verdict_valid_o,
      .verdict_tag_o,
      .verdict_hidden_o,
      .irq_o(irq),
      .frame_end_o(frame_end),
      .slices_busy_i(core_valid || m_axis_tvalid),
      .tile_left_i(tile_left),
      .frame_left_i(frame_left)
  );
  // verilator lint_on PINMISSING
  logic unused;
  assign unused = &{1'b0, s_axil_awprot, s_axil_arprot};
endmodule
