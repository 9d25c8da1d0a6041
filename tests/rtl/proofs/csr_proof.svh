// SPDX-License-Identifier: Apache-2.0
// The whole read and write specification of the registers (docs/microarchitecture.md, "Registers"), written again from the page
// and put inside csr by prove_units.sh. Proved by induction for two counters: more are copies.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

// The accesses that are pending by the page, with their answers; a read's address that was taken a cycle ago.
logic f_taken_q, f_read_q, f_write_q;
logic [11:0] f_address_q;
logic [31:0] f_data_q;
logic [1:0] f_rresp_q, f_bresp_q;
logic [63:0] f_truth_q[0:N-1];  // modulo 2^counters.bits (N-9-7)
logic [31:0] f_high_q;  // of the counter whose low word was read last, at that moment
logic [2:0] f_irq_q, f_mask_q;
logic f_refused_q, f_raised_q;  // error, and whether an unmasked bit was set, a cycle ago

// An access is taken when nothing of the one before is left (M-register-1); a write needs both halves (M-register-2). A read and a write do
// not wait for each other, nor for the device (M-register-4).
logic f_take_read, f_take_write;
assign f_take_read = arvalid_i && !f_taken_q && !f_read_q;
assign f_take_write = awvalid_i && wvalid_i && !f_write_q;

// M-register-3, M-register-5
logic [31:0] f_word;
logic f_known;
always @* begin
  f_word = '0;
  f_known = 1'b1;
  if (f_address_q == 12'h000) f_word = 32'h31535346;
  else if (f_address_q == 12'h004) f_word = 32'd2;
  else if (f_address_q == 12'h008) f_word = fastsplat_pkg::HASH_LOW;
  else if (f_address_q == 12'h00C) f_word = fastsplat_pkg::HASH_HIGH;
  else if (f_address_q == 12'h010) f_word = {30'd0, error_i, busy_i};
  else if (f_address_q == 12'h014) f_word = '0;
  else if (f_address_q == 12'h018) f_word = {16'd0, error_opcode_i, error_rule_i};
  else if (f_address_q == 12'h01C) f_word = error_beat_i;
  else if (f_address_q == 12'h020) f_word = {29'd0, f_irq_q};
  else if (f_address_q == 12'h024) f_word = {29'd0, f_mask_q};
  else if (f_address_q == 12'h040) f_word = {16'(fastsplat_pkg::TILE_HEIGHT), 16'(fastsplat_pkg::TILE_WIDTH)};
  else if (f_address_q == 12'h044) f_word = {16'(fastsplat_pkg::RLUT_SETS), 16'(fastsplat_pkg::LANES)};
  else if (f_address_q == 12'h048) f_word = {16'(fastsplat_pkg::PHASES), 16'(fastsplat_pkg::RLUT_COLUMNS)};
  else if (f_address_q == 12'h04C) f_word = {16'(fastsplat_pkg::SEGMENTS), 16'(fastsplat_pkg::RADIAL_ENTRIES)};
  else if (f_address_q == 12'h050) f_word = {8'd0, 8'(fastsplat_pkg::COLOUR_BITS), 8'(fastsplat_pkg::POS_FRAC), 8'(fastsplat_pkg::POS_INT)};
  // Of these the package has the sum of two fields: they are the configuration's.
  else if (f_address_q == 12'h054) f_word = fastsplat_pkg::CAP_WEIGHT;
  else if (f_address_q == 12'h058) f_word = fastsplat_pkg::CAP_SHEET;
  else if (f_address_q == 12'h05C) f_word = fastsplat_pkg::CAP_PIXEL;
  else if (f_address_q == 12'h060) f_word = fastsplat_pkg::CAP_FEATURES;
  else if (f_address_q == 12'h064) f_word = fastsplat_pkg::CAP_COMPOSITE;
  else if (f_address_q == 12'h068) f_word = fastsplat_pkg::CAP_FREEZE;
  else if (f_address_q == 12'h06C) f_word = fastsplat_pkg::CAP_ROUNDING;
  else if (f_address_q == 12'h080) f_word = f_truth_q[0][31:0];
  else if (f_address_q == 12'h084) f_word = f_high_q;
  else if (f_address_q == 12'h088) f_word = f_truth_q[1][31:0];
  else if (f_address_q == 12'h08C) f_word = f_high_q;
  else f_known = 1'b0;
end

always @(posedge clk_i) begin
  f_taken_q <= f_take_read;
  if (f_take_read) f_address_q <= araddr_i;
  if (f_taken_q) begin
    f_read_q <= 1'b1;
    f_data_q <= f_word;
    f_rresp_q <= f_known ? 2'd0 : 2'd2;  // M-register-3, M-port-10
    // M-register-9
    if (f_address_q == 12'h080) f_high_q <= f_truth_q[0][63:32];
    if (f_address_q == 12'h088) f_high_q <= f_truth_q[1][63:32];
  end else if (rready_i) f_read_q <= 1'b0;
  if (f_take_write) begin
    f_write_q <= 1'b1;
    // M-register-3, M-port-10
    f_bresp_q <= awaddr_i == 12'h014 || awaddr_i == 12'h020 || awaddr_i == 12'h024 ? 2'd0 : 2'd2;
    if (awaddr_i == 12'h020) f_irq_q <= f_irq_q & ~wdata_i[2:0];
    if (awaddr_i == 12'h024) f_mask_q <= wdata_i[2:0];
  end else if (bready_i) f_write_q <= 1'b0;
  // Events in the cycle of a write stay (M-register-7).
  if (frame_i) f_irq_q[0] <= 1'b1;
  if (tile_i) f_irq_q[1] <= 1'b1;
  if (error_i && !f_refused_q) f_irq_q[2] <= 1'b1;
  f_refused_q <= error_i;
  f_raised_q <= (f_irq_q[0] && f_mask_q[0]) || (f_irq_q[1] && f_mask_q[1]) || (f_irq_q[2] && f_mask_q[2]);
  // Modulo 2^counters.bits (M-register-11). A clear counts what comes with it neither before nor after (M-register-13).
  for (int n = 0; n < N; n++) f_truth_q[n] <= 64'(CB'(f_truth_q[n] + 64'(increments_i[16*n+:16])));
  if (f_take_write && awaddr_i == 12'h014 && wdata_i[0]) for (int n = 0; n < N; n++) f_truth_q[n] <= '0;
  // Pending and offered accesses are lost (M-reset-3). A soft reset clears nothing here (M-check-12).
  if (!rst_ni) begin
    f_taken_q <= 1'b0;
    f_read_q <= 1'b0;
    f_write_q <= 1'b0;
    f_high_q <= '0;  // M-register-9
    f_irq_q <= '0;
    f_mask_q <= '0;
    f_refused_q <= 1'b0;
    f_raised_q <= 1'b0;
    for (int n = 0; n < N; n++) f_truth_q[n] <= '0;
  end
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // Reads (M-register-1), writes (M-register-2), interrupt (M-register-5, M-port-11), CONTROL (M-register-6).
    assert (rvalid_o == f_read_q);
    assert (bvalid_o == f_write_q);
    assert (arready_o == (!f_taken_q && !f_read_q));
    assert (awready_o == f_take_write && wready_o == f_take_write);
    assert (!f_read_q || (rdata_o == f_data_q && rresp_o == f_rresp_q));
    assert (!f_write_q || bresp_o == f_bresp_q);
    assert (irq_o == f_raised_q);
    assert (clear_o == (f_take_write && awaddr_i == 12'h014 && wdata_i[0]));
    assert (reset_o == (f_take_write && awaddr_i == 12'h014 && wdata_i[1]));
    // For induction.
    assert (reading_q == f_taken_q && !(f_taken_q && f_read_q));
    if (f_taken_q) begin
      assert (address_q == f_address_q);
      for (int n = 0; n < N; n++) assert (chosen_q[n] == (f_address_q == 12'(128 + 8 * n) || f_address_q == 12'(132 + 8 * n)));
    end
    for (int n = 0; n < N; n++) assert (64'(counter_q[n]) == f_truth_q[n]);
    assert (high_q == f_high_q && irq_q == f_irq_q && irq_mask_q == f_mask_q && error_q == f_refused_q);
    cover (rvalid_o && bvalid_o && !rready_i && !bready_i);
    if (CB > 17) cover (rvalid_o && rdata_o == 32'd70000 && rresp_o == 2'd0);
    cover (rvalid_o && rresp_o == 2'd2);
    cover (irq_o && f_irq_q == '0);  // cleared a cycle ago
    cover (f_take_write && awaddr_i == 12'h020 && wdata_i[2:0] == 3'd7 && f_irq_q == 3'd7 && tile_i);
    cover (clear_o && counter_q[0] != '0 && increments_i[15:0] != '0);
  end
end
