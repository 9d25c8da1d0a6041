// SPDX-License-Identifier: Apache-2.0
// Plays a conformance vector (docs/stream.md, "Vectors") to fastsplat_top and prints its transcript, for check.py.
//
//   +vector=FILE   docs/vectors/NAME.txt; the device is built for its configuration
//
// The source always offers a beat and the sink always takes one: then the cycles are those of the vector.
module bench;
  import fastsplat_pkg::*;
  localparam int P = LANES, MOST_BEATS = 1024, TIMEOUT = 100000;

  logic aclk = 1'b0, aresetn = 1'b0, valid = 1'b0, ready, out_valid, out_last, answer = 1'b0, answer_ready, answer_valid;
  logic [BEAT_BITS-1:0] data = '0, word, beats[0:MOST_BEATS-1];
  logic [P*128-1:0] pixels, kept;
  logic [P*16-1:0] keep;
  logic [P-1:0] lanes;
  logic [11:0] address = '0;
  logic [31:0] answered, high;
  logic quiet = 1'b0;
  logic [8*256-1:0] file_name, kind, rest;
  int file, count = 0, idle = 0, at, unused;

  always #5 aclk = ~aclk;

  fastsplat_top u_top (
      .aclk(aclk), .aresetn(aresetn), .s_axis_tvalid(valid), .s_axis_tready(ready), .s_axis_tdata(data),
      .m_axis_tvalid(out_valid), .m_axis_tready(1'b1), .m_axis_tdata(pixels), .m_axis_tkeep(keep),
      .m_axis_tlast(out_last), .m_axis_tuser(), .s_axil_awvalid(1'b0), .s_axil_awready(), .s_axil_awaddr(12'd0),
      .s_axil_awprot(3'd0), .s_axil_wvalid(1'b0), .s_axil_wready(), .s_axil_wdata(32'd0), .s_axil_wstrb(4'd0),
      .s_axil_bvalid(), .s_axil_bready(1'b1), .s_axil_bresp(), .s_axil_arvalid(answer), .s_axil_arready(answer_ready),
      .s_axil_araddr(address), .s_axil_arprot(3'd0), .s_axil_rvalid(answer_valid), .s_axil_rready(1'b1),
      .s_axil_rdata(answered), .s_axil_rresp(), .verdict_valid_o(), .verdict_tag_o(), .verdict_hidden_o(), .irq()
  );

  // One cycle: inputs change at its beginning; outputs are read before the edge.
  task automatic step;
    for (int lane = 0; lane < P; lane++) begin
      lanes[lane] = keep[16*lane];
      kept[128*lane+:128] = pixels[128*lane+:128] & {128{keep[16*lane]}};
    end
    if (out_valid && !quiet) $display("pixel %0d %0h %0h", out_last, lanes, kept);
    idle = (valid && ready) || out_valid ? 0 : idle + 1;
    if (idle > TIMEOUT) begin
      $display("hangs");
      $finish;
    end
    @(posedge aclk);
    #1;
  endtask

  task automatic send(input logic [BEAT_BITS-1:0] beat);
    valid = 1'b1;
    data = beat;
    #1 while (!ready) step;
    step;
    valid = 1'b0;
  endtask

  task automatic read(input logic [11:0] from);
    address = from;
    answer = 1'b1;
    #1 while (!answer_ready) step;
    step;
    answer = 1'b0;
    while (!answer_valid) step;
  endtask

  // Until the device is at rest; the last beat is a few cycles on its way.
  task automatic settle;
    repeat (16) step;
    read(REG_STATUS);
    while (answered[0]) begin
      step;
      read(REG_STATUS);
    end
    step;
  endtask

  task automatic reset;
    aresetn = 1'b0;
    repeat (4) @(posedge aclk);
    #1 aresetn = 1'b1;
  endtask

  initial begin
    if (!$value$plusargs("vector=%s", file_name)) $fatal(1, "no +vector=FILE");
    file = $fopen(file_name, "r");
    if (file == 0) $fatal(1, "cannot read %0s", file_name);
    reset;
    while ($fscanf(file, "%s", kind) == 1) begin
      if (kind == "beat") begin
        unused = $fscanf(file, "%h", word);
        beats[count] = word;
        send(word);
        count++;
      end
      unused = $fgets(rest, file);
    end
    settle;
    for (int n = 0; n < COUNTERS; n++) begin
      read(REG_COUNTERS + 12'(8 * n));
      word = BEAT_BITS'(answered);
      step;
      read(REG_COUNTERS + 12'(8 * n + 4));
      word[63:32] = answered;
      step;
      $display("counter %0d %0d", n, word[63:0]);
    end
    // Each refused beat behind the first beats of the stream.
    quiet = 1'b1;
    unused = $rewind(file);
    while ($fscanf(file, "%s", kind) == 1) begin
      if (kind == "refuse") begin
        unused = $fscanf(file, "%d %h", at, word);
        reset;
        for (int i = 0; i < at; i++) send(beats[i]);
        send(word);
        settle;
        read(REG_ERROR);
        high = answered;
        step;
        read(REG_ERROR_BEAT);
        $display("refused %0d %0d", high[7:0], answered);
        step;
      end
      unused = $fgets(rest, file);
    end
    $finish;
  end
endmodule
