// SPDX-License-Identifier: Apache-2.0
// The fetch master on the memory's port (docs/microarchitecture.md, "Fetch"), put inside fastsplat_fetch by
// prove_fetch.sh; the assertions of the module are proved with it. Its queues are proved separately: here their outputs
// are free, but they are never overfilled.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

// The memory answers its requests: as many beats, as many bursts; the last beat of all ends the last burst.
logic [DB-1:0] f_due_q;   // beats of bursts that were requested, and have not come
logic [DB-1:0] f_owed;    // of them, the requested ones; bursts likewise
logic [OB-1:0] f_asked;
assign f_owed = f_due_q - (m_axi_arvalid ? DB'(m_axi_arlen) + DB'(1) : DB'(0));
assign f_asked = outstanding_q - OB'(m_axi_arvalid);
always @* begin
  assume (!m_axi_rvalid || f_owed != '0);
  assume (!m_axi_rvalid || f_asked != OB'(1) || m_axi_rlast == (f_owed == DB'(1)));
  assume (!m_axi_rvalid || f_owed != DB'(1) || f_asked == OB'(1));
  assume (!m_axi_rvalid || burst_known);
  // Queues: show nothing that they do not hold, and a beat until it is taken.
  assume (!has_beat || unsent_q != '0);
  assume (!judged_valid || unjudged_q != '0);
  assume (!f_waits_q || (has_beat && sending_set == f_set_q));
end
logic f_waits_q, f_set_q;
initial f_waits_q = 1'b0;
always @(posedge clk_i) begin
  f_waits_q <= rst_ni && has_beat && !sends;
  f_set_q <= sending_set;
end
always @(posedge clk_i) begin
  f_due_q <= f_due_q + (issue ? DB'(burst) : '0) - DB'(m_axi_rvalid);
  if (!rst_ni) f_due_q <= '0;
end

// Of any run its beats are asked for once and in order (M-fetch-1): the next burst begins where the one before ended.
logic f_any_q;
logic [AB-1:0] f_next_q;
always @(posedge clk_i) begin
  if (issue) f_next_q <= address_q + (AB'(burst) << BEAT_LOG2);
  f_any_q <= rst_ni && run_valid_q && issue && !ends_run;
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // The specification: room for every beat (M-fetch-14), no more bursts than may be (M-fetch-15), no more sets unchecked (M-fetch-16), no
    // burst that is empty or runs over its run, none for a hidden set (M-fetch-3).
    assert (!arrives || unsent_q < DB'(1 << DEPTH_LOG2));
    assert (outstanding_q <= OB'(OUTSTANDING));
    assert (unjudged_q <= (JUDGED_LOG2 + 1)'(1 << JUDGED_LOG2));
    assert (!issue || (burst != '0 && 32'(burst) <= left_q));
    assert (!f_any_q || (run_valid_q && address_q == f_next_q));
    assert (!(verdict_valid && verdict_hidden && judged_counted && !last_set) || !run_put);
    // Where all of it is, for induction.
    assert ((f_asked == '0) == (f_owed == '0));
    assert (!m_axi_arvalid || (outstanding_q != '0 && f_due_q >= DB'(m_axi_arlen) + DB'(1)));
    assert ((DB + 2)'(room_q) + (DB + 2)'(f_due_q) + (DB + 2)'(unsent_q) <= (DB + 2)'(1 << DEPTH_LOG2));
    assert (!run_valid_q || left_q != '0);
    assert (phase_q == PhNone || counted_q == (splats_q != '0));
    assert ((address_q[BEAT_LOG2-1:0] == '0 && body_q[BEAT_LOG2-1:0] == '0) || phase_q == PhNone);
    cover (m_axi_arvalid && !m_axi_arready && outstanding_q == OB'(OUTSTANDING));
    cover (sends && unsent_q == DB'(1) && phase_q == PhRuns);
    cover (error == VERDICT && !busy);
    cover (judged_full && has_beat && sending_set && !m_axis_tvalid);
  end
end
