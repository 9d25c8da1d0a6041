// SPDX-License-Identifier: Apache-2.0
// An example bench: streams a file of beats through fastsplat_core and checks every tap, pixel, counter and cycle inside
// the simulation, by fastsplat_monitor. Needs no C++ of its own (docs/capi.md, "SystemVerilog").
//
//   +beats=FILE    the stream, a beat of 64 hex digits a line: beats.hex of `fastsplat stream vectors`
//   +config=NAME   its configuration, built-in or a TOML file; must be the device's
//   +input=PATTERN +output=PATTERN +seed=S   when beats are offered and pixels taken; always, always, 1
//   +fault=N       plants a fault: a line of testbench/faults/faults.def, in a build with FASTSPLAT_FAULT_SELECT;
//                  a fault that is not detected is a FAIL
//
// Prints PASS or FAIL with the checker's summary and the first mismatch; ends by $finish, or $fatal when it failed.
module fastsplat_bench;
  import fastsplat_dpi_pkg::*;

  localparam int DIGITS = fastsplat_pkg::BEAT_BITS / 4;
  localparam int TIMEOUT = 1 << 20;  // cycles without a transfer

  bit clk_i = 0;
  always #5 clk_i = ~clk_i;

  logic rst_ni = 0;
  logic s_tvalid_i = 0, s_tready_o;
  logic [fastsplat_pkg::BEAT_BITS-1:0] s_tdata_i = '0;
  logic m_tvalid_o, m_tready_i = 0, m_tlast_o;
  logic [fastsplat_pkg::LANES*128-1:0] m_tdata_o;
  logic [fastsplat_pkg::LANES-1:0] m_tkeep_o;
  logic arvalid_i = 0, arready_o, rvalid_o;
  logic [11:0] araddr_i = '0;
  logic [31:0] rdata_o;
  logic error_o;

  fastsplat_core u_core (
      .clk_i, .rst_ni, .s_tvalid_i, .s_tready_o, .s_tdata_i, .m_tvalid_o, .m_tready_i, .m_tdata_o, .m_tkeep_o, .m_tlast_o,
      .awvalid_i(1'b0), .awready_o(), .awaddr_i('0), .wvalid_i(1'b0), .wready_o(), .wdata_i('0), .bvalid_o(), .bready_i(1'b1),
      .bresp_o(), .arvalid_i, .arready_o, .araddr_i, .rvalid_o, .rready_i(1'b1), .rdata_o, .rresp_o(),
      .tap_snap_valid_o(), .tap_snap_tag_o(), .tap_snap_x_o(), .tap_snap_y_o(), .tap_snap_mx_o(), .tap_snap_my_o(),
      .tap_window_valid_o(), .tap_window_tag_o(), .tap_window_x_o(), .tap_window_y_o(), .tap_weights_o(),
      .tap_sheet_valid_o(), .tap_sheet_tag_o(), .tap_sums_o(), .tap_composite_valid_o(), .tap_composite_block_o(),
      .tap_state_o(), .tap_tile_o(), .tap_sheet_done_o(), .error_o, .irq_o(), .m_tuser_o(), .verdict_valid_o(), .verdict_tag_o(), .verdict_hidden_o(),
      .frame_end_o(), .slices_busy_i(1'b0), .tile_left_i(1'b0), .frame_left_i(1'b0)
  );

  // The ports of the device by name: nothing to connect.
  bind fastsplat_core fastsplat_monitor u_monitor (.*);

  string beats_file, config_name = "tiny", input_pattern = "always", output_pattern = "always";
  longint unsigned seed = 1, cycle = 0;
  chandle source = null, sink = null;
  int fault = 0;

  task automatic fail(input string why);
    $display("FAIL: %s", why);
    $fatal(1, "the device under test failed");
  endtask

  function automatic bit ready_now(input chandle pattern);
    int now;
    return fastsplat_pattern_at(pattern, cycle, now) == 0 && now != 0;
  endfunction

  // One cycle: its inputs are set after the edge before it; true if the offered beat is taken in it.
  task automatic tick(input bit offered, output bit taken);
    s_tvalid_i = offered;
    m_tready_i = ready_now(sink);
    #1 taken = offered && s_tready_o;  // ready answers within the cycle
    @(posedge clk_i);
    #1 cycle = cycle + 1;
    if (error_o) fail("the device refused the stream");
  endtask

  task automatic send(input bit [fastsplat_pkg::BEAT_BITS-1:0] beat);
    bit offered = 0, taken = 0;
    s_tdata_i = beat;
    for (int waited = 0; !taken; waited++) begin
      offered = offered || ready_now(source);
      tick(offered, taken);
      if (waited > TIMEOUT) fail("the device hangs: no beat taken");
    end
  endtask

  task automatic read(input logic [11:0] address, output logic [31:0] word);
    bit ready = 0, unused;
    araddr_i = address;
    arvalid_i = 1;
    while (!ready) begin
      ready = arready_o;
      tick(0, unused);
    end
    arvalid_i = 0;
    while (!rvalid_o) tick(0, unused);
    word = rdata_o;
    tick(0, unused);
  endtask

  // Waits until the device is not busy and the last taps are out.
  task automatic rest;
    logic [31:0] status = 1;
    bit unused;
    for (int waited = 0; status[0]; waited++) begin
      read(fastsplat_pkg::REG_STATUS, status);
      if (waited > TIMEOUT) fail("the device does not come to rest");
    end
    for (int i = 0; i < 16; i++) tick(0, unused);
  endtask

  initial begin
    int file, line = 0;
    string first, why, text, rest_of_line;
    bit [fastsplat_pkg::BEAT_BITS-1:0] beat;
    bit [64*fastsplat_pkg::COUNTERS-1:0] counters;
    if (!$value$plusargs("beats=%s", beats_file)) fail("no +beats=FILE");
    if ($value$plusargs("config=%s", config_name)) $display("config %s", config_name);
    if ($value$plusargs("input=%s", input_pattern)) $display("input %s", input_pattern);
    if ($value$plusargs("output=%s", output_pattern)) $display("output %s", output_pattern);
    if ($value$plusargs("seed=%s", text)) begin
      if ($sscanf(text, "%d%s", seed, rest_of_line) != 1) fail({"+seed: no number: ", text});
      $display("seed %0d", seed);
    end
    if ($value$plusargs("fault=%s", text)) begin
      if ($sscanf(text, "%d%s", fault, rest_of_line) != 1) fail({"+fault: no number: ", text});
      $display("fault %0d", fault);
    end
`ifdef FASTSPLAT_FAULT_SELECT
    if (fault < 0 || fault > fastsplat_fault_pkg::FAULTS) fail($sformatf("no fault %0d: 1 to %0d, or 0 for none", fault, fastsplat_fault_pkg::FAULTS));
    fastsplat_fault_pkg::selected = fault;
`else
    if (fault != 0) fail("+fault needs a build with FASTSPLAT_FAULT_SELECT");
`endif
    if (fastsplat_pattern_create(input_pattern, 2 * seed, source) != 0 ||
        fastsplat_pattern_create(output_pattern, 2 * seed + 1, sink) != 0) fail(fastsplat_last_error());
    if (!u_core.u_monitor.open(config_name, input_pattern, output_pattern, seed)) fail("no checker");
    if (fastsplat_checker_start(u_core.u_monitor.judge, 0) != 0) fail(fastsplat_last_error());

    repeat (4) @(posedge clk_i);
    #1 rst_ni = 1;
    file = $fopen(beats_file, "r");
    if (file == 0) fail({"cannot read ", beats_file});
    while ($fgets(text, file) != 0) begin
      line++;
      // Only a line end may follow the digits.
      if ($sscanf(text, "%h%s", beat, rest_of_line) != 1 || text.getc(DIGITS - 1) <= " " || text.getc(DIGITS) > " ")
        fail($sformatf("%s, line %0d: no beat of %0d hex digits", beats_file, line, DIGITS));
      send(beat);
    end
    $fclose(file);
    rest();
    for (int n = 0; n < fastsplat_pkg::COUNTERS; n++) begin
      read(fastsplat_pkg::REG_COUNTERS + 12'(8 * n), counters[64*n+:32]);
      read(fastsplat_pkg::REG_COUNTERS + 12'(8 * n + 4), counters[64*n+32+:32]);
    end
    if (u_core.u_monitor.refused != 0) fail("the checker refused what it was told");
    if (fastsplat_dpi_finish(u_core.u_monitor.judge, counters, words_of($bits(counters))) != 0) begin
      why = fastsplat_last_error();  // incomplete stream: neither mismatch nor verdict
      first = fastsplat_checker_first_mismatch(u_core.u_monitor.judge);
      if (first != "") $display("first mismatch: %s", first);
      else $display("%s", why);
      fail(fastsplat_checker_summary(u_core.u_monitor.judge));
    end
    if (fault != 0) fail($sformatf("fault %0d was not seen", fault));  // or the device lacks the part that it breaks
    $display("PASS: %s", fastsplat_checker_summary(u_core.u_monitor.judge));
    $finish;
  end
endmodule
