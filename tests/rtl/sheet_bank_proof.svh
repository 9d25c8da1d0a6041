// SPDX-License-Identifier: Apache-2.0
// Proof of a sheet bank's forwarding, read inside sheet_bank under FASTSPLAT_PROOF. For any one word, the sum shown at
// W is the saturated sum of all products sent to it since it was last cleared. This holds for every order of addresses,
// every gap between them (M-forward-3) and every word that a colliding read returns (M-forward-1).

// Assumed of the array (proved in proofs/core_proof.svh): memories are wiped first, each word once, before anything
// moves. The compositor touches only memories that no window is on its way to.
logic started = 1'b0, known = 1'b0, moved = 1'b0, in_reset = 1'b1;
always @(posedge clk_i) begin
  started <= 1'b1;
  in_reset <= !rst_ni;
  if (!started) assume (!rst_ni);
  if (!rst_ni) known <= 1'b0;
  else if (wipe_i && wipe_addr_i == any_addr) known <= 1'b1;
  if (rst_ni && (!known || wipe_i)) assume (!valid_i && !comp_re_i);
  moved <= rst_ni && (moved || valid_i || comp_re_i);
  if (rst_ni && wipe_i) assume (!moved && !comp_clear_q && !(known && wipe_addr_i == any_addr));
end
always @* begin
  if (comp_re_i) begin
    assume (!(valid_i && buffer_i == comp_buffer_i));
    assume (!(valid_b_q && buffer_b_q == comp_buffer_i));
    assume (!(valid_c_q && buffer_c_q == comp_buffer_i));
    assume (!(valid_w_q && buffer_w_q == comp_buffer_i));
  end
  if (comp_clear_q) assume (!(valid_i && buffer_i == comp_buffer_q));
end

// The word's true value (N-5-3): products are added when they leave C, in one cycle, without a pipeline (M-forward-2). Of one buffer and
// one address (M-forward-4); the compositor clears behind itself (M-walk-3), as the wipe does (M-reset-4).
logic [4*SB-1:0] truth, truth_next;
logic at_c, at_w;
assign at_c = valid_c_q && buffer_c_q == any_buffer && addr_c_q == any_addr;
assign at_w = valid_w_q && buffer_w_q == any_buffer && addr_w_q == any_addr;
for (genvar t = 0; t < 4; t++) begin : gen_truth
  logic [SB:0] total;
  assign total = {1'b0, truth[t*SB+:SB]} + {1'b0, gen_channel[t].products_c_q};
  assign truth_next[t*SB+:SB] = total[SB] ? '1 : total[SB-1:0];
end
always @(posedge clk_i) begin
  if (at_c) truth <= truth_next;
  if (comp_clear_q && comp_buffer_q == any_buffer && comp_addr_q == any_addr) truth <= '0;
  if (wipe_i && wipe_addr_i == any_addr) truth <= '0;
end

logic [4*SB-1:0] memory_word;
assign memory_word = any_buffer ? probe[1] : probe[0];
`FASTSPLAT_ASSERT(sum_is_complete, !(started && known && at_w) || sum_w == truth)
// For induction: a word that is not on its way is in the memory, and no word is on its way before the memories are
// wiped.
`FASTSPLAT_ASSERT(memory_is_complete, !(started && known && !at_w) || memory_word == truth)
`FASTSPLAT_ASSERT(empty_until_wiped, !started || known || in_reset || !(valid_b_q || valid_c_q || valid_w_q || comp_clear_q))
`FASTSPLAT_COVER(forwarded_from_both, known && at_w && at_c && hit_w && hit_h)
