// The whole read and write specification of the registers (docs/microarchitecture.md, "Registers"), written again from the page
// and put inside csr by prove_units.sh. Proved by induction for two counters: more are copies.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

// What the page says is pending, and with what answer.
logic f_read_q, f_write_q;
logic [31:0] f_data_q;
logic [1:0] f_rresp_q, f_bresp_q;
logic [63:0] f_truth_q[0:N-1];

// An access is taken when its answer's place is empty; a write needs both halves.
logic f_take_read, f_take_write;
assign f_take_read = arvalid_i && !f_read_q;
assign f_take_write = awvalid_i && wvalid_i && !f_write_q;

logic [31:0] f_word;
logic f_known;
always @* begin
  f_word = '0;
  f_known = 1'b1;
  if (araddr_i == 12'h000) f_word = 32'h31535346;
  else if (araddr_i == 12'h004) f_word = 32'd1;
  else if (araddr_i == 12'h008) f_word = fastsplat_pkg::HASH_LOW;
  else if (araddr_i == 12'h00C) f_word = fastsplat_pkg::HASH_HIGH;
  else if (araddr_i == 12'h010) f_word = {16'd0, error_opcode_i, 6'd0, error_i, busy_i};
  else if (araddr_i == 12'h014) f_word = '0;
  else if (araddr_i == 12'h080) f_word = f_truth_q[0][31:0];
  else if (araddr_i == 12'h084) f_word = f_truth_q[0][63:32];
  else if (araddr_i == 12'h088) f_word = f_truth_q[1][31:0];
  else if (araddr_i == 12'h08C) f_word = f_truth_q[1][63:32];
  else f_known = 1'b0;
end

always @(posedge clk_i) begin
  if (f_take_read) begin
    f_read_q <= 1'b1;
    f_data_q <= f_word;
    f_rresp_q <= f_known ? 2'd0 : 2'd2;
  end else if (rready_i) f_read_q <= 1'b0;
  if (f_take_write) begin
    f_write_q <= 1'b1;
    f_bresp_q <= awaddr_i == 12'h014 ? 2'd0 : 2'd2;
  end else if (bready_i) f_write_q <= 1'b0;
  // A clear counts what comes with it neither before nor after.
  for (int n = 0; n < N; n++) f_truth_q[n] <= f_truth_q[n] + 64'(increments_i[16*n+:16]);
  if (f_take_write && awaddr_i == 12'h014 && wdata_i[0]) for (int n = 0; n < N; n++) f_truth_q[n] <= '0;
  if (!rst_ni) begin
    f_read_q <= 1'b0;
    f_write_q <= 1'b0;
    for (int n = 0; n < N; n++) f_truth_q[n] <= '0;
  end
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    assert (rvalid_o == f_read_q);
    assert (bvalid_o == f_write_q);
    assert (arready_o == !f_read_q);
    assert (awready_o == f_take_write && wready_o == f_take_write);
    assert (!f_read_q || (rdata_o == f_data_q && rresp_o == f_rresp_q));
    assert (!f_write_q || bresp_o == f_bresp_q);
    for (int n = 0; n < N; n++) assert (counter_q[n] == f_truth_q[n]);
    cover (rvalid_o && bvalid_o && !rready_i && !bready_i);
    cover (rvalid_o && rdata_o == 32'd70000 && rresp_o == 2'd0);
    cover (rvalid_o && rresp_o == 2'd2);
    cover (clear_o && counter_q[0] != '0 && increments_i[15:0] != '0);
  end
end
