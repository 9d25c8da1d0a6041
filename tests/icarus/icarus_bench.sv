// SPDX-License-Identifier: Apache-2.0
// Plays recorded streams to the device in a four-state simulator and writes its outputs to a file; tests/icarus checks
// them. All of the device is unknown at power-up. Once a reset was released, no signal that decides a transfer and no
// transferred value may be unknown: every cycle is checked.
//
//   +beats=FILE    a beat a line, hexadecimal, w7 first (docs/stream.md)         +beat_count=N   its lines
//   +ready=FILE    a bit a line: LENGTH cycles of each pattern, one after the other (docs/verify.md, "Patterns")
//   +pattern_count=N
//   +plays=FILE    a play a line, decimal: RESET BEATS LINGER INPUT READY: reset for RESET cycles, then BEATS beats by the
//                  patterns INPUT and READY; then LINGER cycles more, or, if LINGER is -1, until the device is at rest.
//                  A play that lingers starts a register read and a write and does not take their answers
//
// Writes one line each:  power NAMES=VALUES before the first reset; pixels PLAY LAST KEEP DATA; counter PLAY NUMBER HIGH LOW;
// played PLAY CYCLES; and errors: unknown PLAY CYCLE NAME, stray PLAY CYCLE NAME, hangs PLAY CYCLE.
module icarus_bench;
  localparam int P = fastsplat_pkg::LANES;
  localparam int BEAT_BITS = fastsplat_pkg::BEAT_BITS;
  localparam int LENGTH = 32768;  // of a pattern
  localparam int PATTERNS = 16;
  localparam int MOST_BEATS = 65536;
  localparam int TIMEOUT = 20000;  // cycles without a transfer

  logic clk_i, rst_ni;
  logic s_tvalid_i, s_tready_o;
  logic [BEAT_BITS-1:0] s_tdata_i;
  logic m_tvalid_o, m_tready_i, m_tlast_o, m_tuser_o, irq_o;
  logic [P*128-1:0] m_tdata_o;
  logic [P-1:0] m_tkeep_o;
  logic awvalid_i, awready_o, wvalid_i, wready_o, bvalid_o, bready_i, arvalid_i, arready_o, rvalid_o, rready_i;
  logic [11:0] awaddr_i, araddr_i;
  logic [31:0] wdata_i, rdata_o;
  logic [1:0] bresp_o, rresp_o;
  logic verdict_valid_o, verdict_hidden_o;
  logic [31:0] verdict_tag_o;
  logic tap_snap_valid_o, tap_window_valid_o, tap_sheet_valid_o, tap_composite_valid_o, tap_sheet_done_o, error_o;
  logic [31:0] tap_snap_tag_o, tap_window_tag_o, tap_sheet_tag_o, tap_tile_o;
  logic signed [fastsplat_pkg::ORG_BITS-1:0] tap_snap_x_o, tap_snap_y_o, tap_window_x_o, tap_window_y_o;
  logic [fastsplat_pkg::WAY_BITS-1:0] tap_snap_mx_o, tap_snap_my_o;
  logic [fastsplat_pkg::BANKS*fastsplat_pkg::WEIGHT_BITS-1:0] tap_weights_o;
  logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] tap_sums_o;
  logic [fastsplat_pkg::ADDR_BITS-1:0] tap_composite_block_o;
  logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] tap_state_o;
  logic tap_tile_left_o, tap_beat_held_o, tap_beat_taken_o;
  fastsplat_dut u_dut (.*);

  logic [BEAT_BITS-1:0] beats[0:MOST_BEATS-1];
  logic ready_bits[0:PATTERNS*LENGTH-1];
  int play, cycle, idle, sent, to_send, input_pattern, ready_pattern, beat_count, pattern_count;
  logic offering;

  task automatic wrong(input [8*24-1:0] kind, input [8*24-1:0] name);
    $display("%0s %0d %0d %0s", kind, play, cycle, name);
  endtask

  // Transfers are decided by known values, and carry known values.
  task automatic look;
    if (^{s_tready_o, error_o, irq_o, verdict_valid_o} === 1'bx) wrong("unknown", "s_tready, error, irq");
    if (m_tvalid_o === 1'bx) wrong("unknown", "m_tvalid");
    if (^{awready_o, wready_o, bvalid_o, arready_o, rvalid_o} === 1'bx) wrong("unknown", "register handshake");
    if (^{tap_snap_valid_o, tap_window_valid_o, tap_sheet_valid_o, tap_composite_valid_o, tap_sheet_done_o} === 1'bx)
      wrong("unknown", "tap valid");
    if (m_tvalid_o === 1'b1) begin
      if (^{m_tlast_o, m_tuser_o, m_tkeep_o} === 1'bx) wrong("unknown", "m_tlast, m_tuser, m_tkeep");
      for (int g = 0; g < P; g++)
        if (m_tkeep_o[g] === 1'b1 && ^m_tdata_o[g*128+:128] === 1'bx) wrong("unknown", "m_tdata");
    end
    if (rvalid_o === 1'b1 && ^{rdata_o, rresp_o} === 1'bx) wrong("unknown", "rdata, rresp");
    if (bvalid_o === 1'b1 && ^bresp_o === 1'bx) wrong("unknown", "bresp");
    if (tap_snap_valid_o === 1'b1 &&
        ^{tap_snap_tag_o, tap_snap_x_o, tap_snap_y_o, tap_snap_mx_o, tap_snap_my_o} === 1'bx) wrong("unknown", "tap snap");
    if (tap_window_valid_o === 1'b1 && ^{tap_window_tag_o, tap_window_x_o, tap_window_y_o, tap_weights_o} === 1'bx)
      wrong("unknown", "tap footprint");
    if (tap_composite_valid_o === 1'b1 && ^tap_composite_block_o === 1'bx) wrong("unknown", "tap composite");
    if (cycle == 0 && {m_tvalid_o, rvalid_o, bvalid_o, error_o} !== 4'b0000) wrong("stray", "answer out of reset");
  endtask

  task automatic edge_of_clock;
    #5 clk_i = 1'b1;
    #5 clk_i = 1'b0;
  endtask

  // One cycle outside reset. All inputs of the device change at its beginning and are read before the edge (M-port-3).
  task automatic step;
    offering = sent < to_send && (offering || ready_bits[input_pattern*LENGTH+cycle%LENGTH]);
    s_tvalid_i = offering;
    s_tdata_i = beats[sent];  // w0 in the lowest bits (M-port-4)
    m_tready_i = ready_bits[ready_pattern*LENGTH+cycle%LENGTH];
    #1 look;
    idle = idle + 1;
    if (offering && s_tready_o === 1'b1) begin
      sent = sent + 1;
      offering = 1'b0;
      idle = 0;
    end
    if (m_tvalid_o === 1'b1 && m_tready_i) begin
      $display("pixels %0d %b %b %h", play, m_tlast_o, m_tkeep_o, m_tdata_o);
      idle = 0;
    end
    if (idle > TIMEOUT) begin
      $display("hangs %0d %0d", play, cycle);
      $finish(0);
    end
    edge_of_clock;
    cycle = cycle + 1;
  endtask

  logic [31:0] word;
  task automatic read_register(input logic [11:0] address);
    araddr_i = address;
    arvalid_i = 1'b1;
    #1 while (arready_o !== 1'b1) step;
    step;
    arvalid_i = 1'b0;
    if (rvalid_o !== 1'b0) wrong("stray", "register answered too early");
    step;
    word = rdata_o;
    if (rvalid_o !== 1'b1 || rresp_o !== 2'b00) wrong("stray", "register not answered");
    step;
  endtask

  logic [31:0] high;
  task automatic rest;
    read_register(fastsplat_pkg::REG_STATUS);
    while (word[0] !== 1'b0) read_register(fastsplat_pkg::REG_STATUS);
    for (int i = 0; i < 16; i++) step;
    for (int n = 0; n < fastsplat_pkg::COUNTERS; n++) begin
      read_register(fastsplat_pkg::REG_COUNTERS + 12'(8 * n + 4));
      high = word;
      read_register(fastsplat_pkg::REG_COUNTERS + 12'(8 * n));
      $display("counter %0d %0d %h %h", play, n, high, word);
    end
  endtask

  int file, reset_cycles, linger;
  string beats_file, ready_file, plays_file;
  initial begin
    if (!$value$plusargs("beats=%s", beats_file) || !$value$plusargs("beat_count=%d", beat_count) ||
        !$value$plusargs("ready=%s", ready_file) || !$value$plusargs("pattern_count=%d", pattern_count) ||
        !$value$plusargs("plays=%s", plays_file)) begin
      $display("stray 0 0 missing plusarg");
      $finish(0);
    end
    $readmemh(beats_file, beats, 0, beat_count - 1);
    $readmemb(ready_file, ready_bits, 0, pattern_count * LENGTH - 1);
    clk_i = 1'b0;
    rst_ni = 1'b0;
    {s_tvalid_i, m_tready_i, awvalid_i, wvalid_i, arvalid_i, offering} = '0;
    {bready_i, rready_i} = 2'b11;
    {s_tdata_i, awaddr_i, wdata_i, araddr_i} = '0;
    #1 $display("power s_tready=%b m_tvalid=%b bvalid=%b rvalid=%b error=%b", s_tready_o, m_tvalid_o, bvalid_o, rvalid_o, error_o);
    file = $fopen(plays_file, "r");
    play = 0;
    while ($fscanf(file, "%d %d %d %d %d", reset_cycles, to_send, linger, input_pattern, ready_pattern) == 5) begin
      rst_ni = 1'b0;
      // Beats that wait at reset keep waiting: a beat of this play, and a sink that may be ready.
      s_tvalid_i = play % 2 == 1;
      s_tdata_i = beats[0];
      m_tready_i = play % 3 == 1;
      for (int i = 0; i < reset_cycles; i++) begin
        // While it is low nothing is offered and nothing answered; its first cycle is that of the next play.
        if (i > 0 && {m_tvalid_o, rvalid_o, bvalid_o, error_o} !== 4'b0000) wrong("stray", "answer in reset");
        #1 edge_of_clock;
      end
      {awvalid_i, wvalid_i, arvalid_i} = '0;
      {bready_i, rready_i} = 2'b11;
      rst_ni = 1'b1;
      {cycle, idle, sent} = '0;
      offering = s_tvalid_i;  // and so it stays until it is taken
      if (linger >= 0) begin
        {awvalid_i, wvalid_i, arvalid_i} = '1;
        {bready_i, rready_i} = '0;
      end
      while (sent < to_send) step;
      for (int i = 0; i < linger; i++) step;
      if (linger < 0) rest;
      $display("played %0d %0d", play, cycle);
      play = play + 1;
    end
    $finish(0);
  end
endmodule
