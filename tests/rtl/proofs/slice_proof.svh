// SPDX-License-Identifier: Apache-2.0
// A register slice (M-top-1, M-top-2), put inside fastsplat_slice by prove_fetch.sh. Its beats come out in order,
// offered from the next cycle on and held until taken. It takes a beat whenever it holds at most one, except in the
// first cycle after a reset.
logic f_started = 1'b0, f_reset_q;
always @(posedge clk_i) f_started <= 1'b1;
always @(posedge clk_i) f_reset_q <= !rst_ni;
always @* if (!f_started) assume (!rst_ni);

// How many it holds; the proof follows one arbitrary beat: f_behind_q while another is in front of it.
logic [1:0] f_count_q;
logic f_followed_q, f_behind_q, f_gives;
(* anyseq *) logic f_follow;
logic [BITS-1:0] f_data_q;
assign f_gives = valid_o && ready_i;
always @(posedge clk_i) begin
  f_count_q <= f_count_q + 2'(taken) - 2'(f_gives);
  if (f_gives) begin
    if (!f_behind_q) f_followed_q <= 1'b0;
    f_behind_q <= 1'b0;
  end
  if (taken && f_follow && !f_followed_q) begin
    f_followed_q <= 1'b1;
    f_behind_q <= valid_o && !f_gives;
    f_data_q <= data_i;
  end
  if (!rst_ni) begin
    f_count_q <= '0;
    f_followed_q <= 1'b0;
    f_behind_q <= 1'b0;
  end
end
// Held: what was offered and not taken is offered still.
logic f_waited_q;
logic [BITS-1:0] f_offered_q;
always @(posedge clk_i) begin
  f_waited_q <= rst_ni && valid_o && !ready_i;
  f_offered_q <= data_o;
end
always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    assert (valid_o == (f_count_q != 0));
    assert (ready_o == (f_count_q < 2'd2 && !f_reset_q));
    assert (!f_followed_q || f_behind_q || (valid_o && data_o == f_data_q));
    assert (!f_waited_q || (valid_o && data_o == f_offered_q));
    // The places of the followed beat, for induction.
    assert (f_count_q == 2'(valid_o) + 2'(spare_q));
    assert (!f_followed_q || !f_behind_q || (f_count_q == 2'd2 && spare_data_q == f_data_q));
    cover (f_followed_q && f_behind_q && f_gives);
    cover (taken && f_gives && f_count_q == 2'd1);
  end
end
