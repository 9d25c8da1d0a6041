// SPDX-License-Identifier: Apache-2.0
// The device as it ships, as a testbench sees it: fastsplat_top under the port names of fastsplat_core, with its taps and error_o looked up
// inside it (docs/verify.md). A byte of TKEEP is a bit here; writes have all strobes.

module fastsplat_dut (
    input  logic         clk_i,
    input  logic         rst_ni,
    input  logic         s_tvalid_i,
    output logic         s_tready_o,
    input  logic [fastsplat_pkg::BEAT_BITS-1:0] s_tdata_i,
    output logic         m_tvalid_o,
    input  logic         m_tready_i,
    output logic [fastsplat_pkg::LANES*128-1:0] m_tdata_o,
    output logic [fastsplat_pkg::LANES-1:0] m_tkeep_o,
    output logic         m_tlast_o,
    output logic         m_tuser_o,
    output logic         verdict_valid_o,
    output logic [31:0]  verdict_tag_o,
    output logic         verdict_hidden_o,
    input  logic         awvalid_i,
    output logic         awready_o,
    input  logic [11:0]  awaddr_i,
    input  logic         wvalid_i,
    output logic         wready_o,
    input  logic [31:0]  wdata_i,
    output logic         bvalid_o,
    input  logic         bready_i,
    output logic [1:0]   bresp_o,
    input  logic         arvalid_i,
    output logic         arready_o,
    input  logic [11:0]  araddr_i,
    output logic         rvalid_o,
    input  logic         rready_i,
    output logic [31:0]  rdata_o,
    output logic [1:0]   rresp_o,
    output logic         tap_snap_valid_o,
    output logic [31:0]  tap_snap_tag_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_snap_x_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_snap_y_o,
    output logic [fastsplat_pkg::WAY_BITS-1:0] tap_snap_mx_o,
    output logic [fastsplat_pkg::WAY_BITS-1:0] tap_snap_my_o,
    output logic         tap_window_valid_o,
    output logic [31:0]  tap_window_tag_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_window_x_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_window_y_o,
    output logic [fastsplat_pkg::BANKS*fastsplat_pkg::WEIGHT_BITS-1:0] tap_weights_o,
    output logic         tap_sheet_valid_o,
    output logic [31:0]  tap_sheet_tag_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] tap_sums_o,
    output logic         tap_composite_valid_o,
    output logic [fastsplat_pkg::ADDR_BITS-1:0] tap_composite_block_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] tap_state_o,
    output logic [31:0]  tap_tile_o,
    output logic         tap_sheet_done_o,
    output logic         error_o,
    output logic         irq_o,
    // of the slices: the core's last pixels of a tile pass into the output's; the input's holds a beat for the core, which the core takes
    output logic         tap_tile_left_o,
    output logic         tap_beat_held_o,
    output logic         tap_beat_taken_o
);
  localparam int P = fastsplat_pkg::LANES;
  logic [16*P-1:0] keep;
  for (genvar g = 0; g < P; g++) begin : gen_keep
    assign m_tkeep_o[g] = keep[16*g];
  end

  fastsplat_top u_top (
      .aclk(clk_i),
      .aresetn(rst_ni),
      .s_axis_tvalid(s_tvalid_i),
      .s_axis_tready(s_tready_o),
      .s_axis_tdata(s_tdata_i),
      .m_axis_tvalid(m_tvalid_o),
      .m_axis_tready(m_tready_i),
      .m_axis_tdata(m_tdata_o),
      .m_axis_tkeep(keep),
      .m_axis_tlast(m_tlast_o),
      .m_axis_tuser(m_tuser_o),
      .s_axil_awvalid(awvalid_i),
      .s_axil_awready(awready_o),
      .s_axil_awaddr(awaddr_i),
      .s_axil_awprot(3'd0),
      .s_axil_wvalid(wvalid_i),
      .s_axil_wready(wready_o),
      .s_axil_wdata(wdata_i),
      .s_axil_wstrb(4'hf),
      .s_axil_bvalid(bvalid_o),
      .s_axil_bready(bready_i),
      .s_axil_bresp(bresp_o),
      .s_axil_arvalid(arvalid_i),
      .s_axil_arready(arready_o),
      .s_axil_araddr(araddr_i),
      .s_axil_arprot(3'd0),
      .s_axil_rvalid(rvalid_o),
      .s_axil_rready(rready_i),
      .s_axil_rdata(rdata_o),
      .s_axil_rresp(rresp_o),
      .verdict_valid_o,
      .verdict_tag_o,
      .verdict_hidden_o,
      .irq(irq_o)
  );
  assign error_o = u_top.u_core.error_o;
  assign tap_snap_valid_o = u_top.u_core.tap_snap_valid_o;
  assign tap_snap_tag_o = u_top.u_core.tap_snap_tag_o;
  assign tap_snap_x_o = u_top.u_core.tap_snap_x_o;
  assign tap_snap_y_o = u_top.u_core.tap_snap_y_o;
  assign tap_snap_mx_o = u_top.u_core.tap_snap_mx_o;
  assign tap_snap_my_o = u_top.u_core.tap_snap_my_o;
  assign tap_window_valid_o = u_top.u_core.tap_window_valid_o;
  assign tap_window_tag_o = u_top.u_core.tap_window_tag_o;
  assign tap_window_x_o = u_top.u_core.tap_window_x_o;
  assign tap_window_y_o = u_top.u_core.tap_window_y_o;
  assign tap_weights_o = u_top.u_core.tap_weights_o;
  assign tap_sheet_valid_o = u_top.u_core.tap_sheet_valid_o;
  assign tap_sheet_tag_o = u_top.u_core.tap_sheet_tag_o;
  assign tap_sums_o = u_top.u_core.tap_sums_o;
  assign tap_composite_valid_o = u_top.u_core.tap_composite_valid_o;
  assign tap_composite_block_o = u_top.u_core.tap_composite_block_o;
  assign tap_state_o = u_top.u_core.tap_state_o;
  assign tap_tile_o = u_top.u_core.tap_tile_o;
  assign tap_sheet_done_o = u_top.u_core.tap_sheet_done_o;
  assign tap_tile_left_o = u_top.u_core.m_tvalid_o && u_top.u_core.m_tready_i && u_top.u_core.m_tlast_o;
  assign tap_beat_held_o = u_top.core_valid;
  assign tap_beat_taken_o = u_top.core_valid && u_top.core_ready;

  fastsplat_port_rules u_rules (
      .clk_i, .rst_ni, .s_tvalid_i, .s_tready_o, .s_tdata_i, .m_tvalid_o, .m_tready_i, .m_tdata_o, .m_tkeep_i(keep), .m_tlast_o, .m_tuser_o,
      .awvalid_i, .awready_o, .wvalid_i, .wready_o, .bvalid_o, .bready_i, .bresp_o,
      .arvalid_i, .arready_o, .rvalid_o, .rready_i, .rdata_o, .rresp_o
  );
endmodule
