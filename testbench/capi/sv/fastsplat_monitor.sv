// SPDX-License-Identifier: Apache-2.0
// The passive checker beside a device: samples its ports at every rising edge and reports them to the checker. Bind it
// to the device, or put it beside it in a bench; it drives nothing. A reset of the device begins a new stream.
module fastsplat_monitor (
    input logic         clk_i,
    input logic         rst_ni,
    input logic         s_tvalid_i,
    input logic         s_tready_o,
    input logic [fastsplat_pkg::BEAT_BITS-1:0] s_tdata_i,
    input logic         m_tvalid_o,
    input logic         m_tready_i,
    input logic [fastsplat_pkg::LANES*128-1:0] m_tdata_o,
    input logic [fastsplat_pkg::LANES-1:0] m_tkeep_o,
    input logic         m_tlast_o,
    input logic         m_tuser_o,
    input logic         verdict_valid_o,
    input logic [31:0]  verdict_tag_o,
    input logic         verdict_hidden_o,
    input logic [31:0]  tap_tile_o,
    input logic         tap_snap_valid_o,
    input logic [31:0]  tap_snap_tag_o,
    input logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_snap_x_o,
    input logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_snap_y_o,
    input logic [fastsplat_pkg::WAY_BITS-1:0] tap_snap_mx_o,
    input logic [fastsplat_pkg::WAY_BITS-1:0] tap_snap_my_o,
    input logic         tap_window_valid_o,
    input logic [31:0]  tap_window_tag_o,
    input logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_window_x_o,
    input logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_window_y_o,
    input logic [fastsplat_pkg::BANKS*fastsplat_pkg::WEIGHT_BITS-1:0] tap_weights_o,
    input logic         tap_sheet_valid_o,
    input logic [31:0]  tap_sheet_tag_o,
    input logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] tap_sums_o,
    input logic         tap_composite_valid_o,
    input logic [fastsplat_pkg::ADDR_BITS-1:0] tap_composite_block_o,
    input logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] tap_state_o,
    input logic         tap_sheet_done_o
);
  import fastsplat_dpi_pkg::*;

  chandle judge = null;            // set by open(); until then nothing is reported
  longint unsigned cycle = 0;        // since reset was released
  bit reported = 0;                  // something was reported since reset
  int unsigned refused = 0;          // calls that the checker refused: the bench or the stream is wrong

  // False, with the reason printed, if the checker cannot be created.
  function automatic bit open(input string config_name, input string input_pattern, input string output_pattern,
                              input longint unsigned seed);
    if (fastsplat_api_version() >> 16 != API_MAJOR) begin
      $display("fastsplat_monitor: libfastsplat has another version of its interface than fastsplat_dpi_pkg");
      return 0;
    end
    judge = fastsplat_dpi_checker(config_name, HASH, input_pattern, output_pattern, seed);
    if (judge == null) $display("fastsplat_monitor: %s", fastsplat_last_error());
    return judge != null;
  endfunction

  function automatic void report(input int status);
    if (status == 0) return;
    if (refused == 0) $display("fastsplat_monitor: cycle %0d: %s", cycle, fastsplat_last_error());
    refused = refused + 1;
  endfunction

  always @(posedge clk_i) begin
    if (!rst_ni) begin
      cycle = 0;
      if (reported) report(fastsplat_checker_reset(judge));
      reported = 0;
    end else begin
      if (judge != null && refused == 0) begin
        if (tap_snap_valid_o)
          report(fastsplat_dpi_snap(judge, cycle, tap_tile_o, tap_snap_tag_o, 32'(tap_snap_x_o), 32'(tap_snap_y_o),
                                  32'(tap_snap_mx_o), 32'(tap_snap_my_o)));
        if (tap_sheet_valid_o)
          report(fastsplat_dpi_sheet(judge, cycle, tap_tile_o, tap_sheet_tag_o, tap_sums_o, words_of($bits(tap_sums_o))));
        if (tap_window_valid_o)
          report(fastsplat_dpi_window(judge, cycle, tap_tile_o, tap_window_tag_o, 32'(tap_window_x_o), 32'(tap_window_y_o),
                                    tap_weights_o, words_of($bits(tap_weights_o))));
        if (tap_composite_valid_o)
          report(fastsplat_dpi_composite(judge, cycle, tap_tile_o, 32'(tap_composite_block_o), tap_state_o,
                                       words_of($bits(tap_state_o))));
        if (tap_sheet_done_o) report(fastsplat_dpi_sheet_done(judge, cycle));
        if (m_tvalid_o && m_tready_i)
          report(fastsplat_dpi_pixels(judge, cycle, tap_tile_o, m_tdata_o, words_of($bits(m_tdata_o)), 32'(m_tkeep_o),
                                    int'(m_tlast_o), int'(m_tuser_o)));
        if (verdict_valid_o) report(fastsplat_dpi_verdict(judge, cycle, verdict_tag_o, int'(verdict_hidden_o)));
        if (s_tvalid_i && s_tready_o) begin
          report(fastsplat_dpi_took(judge, s_tdata_i));
          reported = 1;
        end
      end
      cycle = cycle + 1;
    end
  end
endmodule
