// SPDX-License-Identifier: Apache-2.0
// The bench behind `tools/timing`: the fetch master sends a device its beats, pixels wait, registers are read and written, and all
// signals are dumped. Beats and commands are hexadecimal numbers, one a line, in files of the folder in which it runs.
module bench;
  localparam int CYCLES = 1200, LATENCY = 4;
  bit clk_i = 0, rst_ni = 0;
  int now = -3;  // cycles since reset
  always #1 clk_i = !clk_i;
  always @(posedge clk_i) begin
    now <= now + 1;
    rst_ni <= now >= -1;
    if (now == CYCLES) $finish;
  end
  logic [255:0] beats[0:1023];
  logic [159:0] commands[0:7];
  initial begin
    $readmemh("beats.hex", beats);
    $readmemh("commands.hex", commands);
    $dumpfile("wave.vcd");
    $dumpvars(0, bench);
  end

  logic s_tvalid, s_tready, m_tready = 0, verdict_valid, verdict_hidden;
  logic [255:0] s_tdata;
  logic [31:0] verdict_tag;
  logic arvalid = 0, arready, rready = 0, awvalid = 0, awready, wvalid = 0;
  logic [11:0] araddr = fastsplat_pkg::REG_VERSION;
  fastsplat_core u_core (
      .clk_i, .rst_ni, .s_tvalid_i(s_tvalid), .s_tready_o(s_tready), .s_tdata_i(s_tdata), .m_tready_i(m_tready),
      .verdict_valid_o(verdict_valid), .verdict_tag_o(verdict_tag), .verdict_hidden_o(verdict_hidden),
      .arvalid_i(arvalid), .arready_o(arready), .araddr_i(araddr), .rready_i(rready), .awvalid_i(awvalid), .awready_o(awready),
      .awaddr_i(fastsplat_pkg::REG_IRQ_MASK), .wvalid_i(wvalid), .wdata_i(32'd0), .bready_i(1'b1),
      .slices_busy_i(1'b0), .tile_left_i(1'b0), .frame_left_i(1'b0)
  );
  // The sink waits two cycles of five. Two reads, the second of an unknown address, and a write whose data come two cycles late.
  always @(posedge clk_i) begin
    m_tready <= now % 5 > 1;
    if (now == 8) {arvalid, awvalid} <= 2'b11;
    if (now == 10) wvalid <= 1;
    rready <= now > 10;
    if (arvalid && arready) {arvalid, araddr} <= {araddr == fastsplat_pkg::REG_VERSION, 12'hFFC};
    if (awready) {awvalid, wvalid} <= '0;
  end

  // Commands: at once to a device that culls, else when the one before is through.
  int command = 0;
  logic cmd_valid, cmd_ready, ask, answer, last;
  logic [63:0] address;
  logic [7:0] length;
  logic [255:0] data;
  assign cmd_valid = rst_ni && commands[command] != '0 && (fastsplat_pkg::CULL_MAP != 0 || now >= CYCLES / 2 * command);
  fastsplat_fetch u_fetch (
      .aclk(clk_i), .aresetn(rst_ni), .s_axis_cmd_tvalid(cmd_valid), .s_axis_cmd_tready(cmd_ready), .s_axis_cmd_tdata(commands[command]),
      .m_axi_arvalid(ask), .m_axi_arready(1'b1), .m_axi_araddr(address), .m_axi_arlen(length),
      .m_axi_rvalid(answer), .m_axi_rdata(data), .m_axi_rresp(2'b00), .m_axi_rlast(last),
      .m_axis_tvalid(s_tvalid), .m_axis_tready(s_tready), .m_axis_tdata(s_tdata),
      .verdict_valid, .verdict_tag, .verdict_hidden, .stop(1'b0)
  );
  // The regular memory of docs/microarchitecture.md, "Fetch": the cycles in which it answers, the beats, the ends of bursts.
  int due[$], at[$], ends[$], free = 0;
  always @(posedge clk_i) begin
    if (cmd_valid && cmd_ready) command <= command + 1;
    if (rst_ni && ask) begin
      if (free < now + LATENCY) free = now + LATENCY;
      for (int i = 0; i <= int'(length); i++) begin
        due.push_back(free);
        at.push_back(int'(address >> 5) + i);
        ends.push_back(int'(i == int'(length)));
        free = free + 1;
      end
    end
    answer <= due.size() > 0 && due[0] <= now + 1;
    if (due.size() > 0 && due[0] <= now + 1) begin
      data <= beats[at[0]];
      last <= ends[0] != 0;
      void'(due.pop_front());
      void'(at.pop_front());
      void'(ends.pop_front());
    end
  end
endmodule
