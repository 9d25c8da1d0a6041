// SPDX-License-Identifier: Apache-2.0
// A queue's contents (docs/microarchitecture.md, "Fetch"), put inside fastsplat_queue by prove_fetch.sh. If it never
// holds more than its memory, its words come out in order. Each is shown from the second cycle after it was put, or
// from the cycle after the previous one was taken.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

// The memory, at any address: what is read is what was written there last.
(* anyconst *) logic [LOG2-1:0] f_address;
logic [BITS-1:0] f_word_q, f_read_word_q;
logic f_read_q;
always @(posedge clk_i) begin
  if (put_i && put_q[LOG2-1:0] == f_address) f_word_q <= data_i;
  if (read) begin
    f_read_q <= read_q[LOG2-1:0] == f_address;
    f_read_word_q <= f_word_q;
  end
  if (!rst_ni) f_read_q <= 1'b0;
end
always @* assume (!f_read_q || data_o == f_read_word_q);
// Its output stays until the next read.
logic [BITS-1:0] f_last_q;
logic f_reads_q;
always @(posedge clk_i) begin
  f_last_q <= data_o;
  f_reads_q <= read;
end
always @* assume (!f_started || f_reads_q || data_o == f_last_q);

// How many are in it; one of those put at the address, any, is followed: f_before are in front of it.
localparam int FB = LOG2 + 2;
logic [FB-1:0] f_count_q, f_before_q, f_stored;
logic f_followed_q, f_young_q;
(* anyseq *) logic f_follow;
logic [BITS-1:0] f_data_q;
logic [LOG2:0] f_slot;
logic f_taken;
assign f_taken = take_i && valid_o;
assign f_stored = FB'((LOG2 + 1)'(put_q - read_q));
assign f_slot = read_q + (LOG2 + 1)'(f_before_q - FB'(shown_q));  // where it lies while it is in the memory
always @* assume (!put_i || f_count_q < FB'(WORDS));
always @(posedge clk_i) begin
  f_count_q <= f_count_q + FB'(put_i) - FB'(f_taken);
  f_young_q <= put_i;  // the youngest was put in the cycle before
  if (f_taken) begin
    if (f_before_q == 0) f_followed_q <= 1'b0;
    else f_before_q <= f_before_q - FB'(1);
  end
  if (put_i && f_follow && !f_followed_q && put_q[LOG2-1:0] == f_address) begin
    f_followed_q <= 1'b1;
    f_before_q <= f_count_q - FB'(f_taken);
    f_data_q <= data_i;
  end
  if (!rst_ni || clear_i) begin
    f_count_q <= '0;
    f_followed_q <= 1'b0;
    f_young_q <= 1'b0;
  end
end
always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // The specification: what is put in cycle t is shown from t+2 on, without a gap (M-fetch-7).
    assert (!valid_o || !f_followed_q || f_before_q != 0 || data_o == f_data_q);
    assert (valid_o == (f_count_q > FB'(f_young_q)));
    assert (!put_i || f_stored < FB'(WORDS));
    // Where all of it is, for induction.
    assert (f_count_q == f_stored + FB'(shown_q) && f_count_q <= FB'(WORDS));
    assert (f_stored == 0 || shown_q || (f_stored == 1 && f_young_q));
    assert (!f_young_q || f_stored != 0);
    assert (!f_followed_q || f_before_q < f_count_q);
    if (f_followed_q) begin
      if (f_before_q >= FB'(shown_q)) assert (f_slot[LOG2-1:0] == f_address && f_word_q == f_data_q);
      else assert (f_read_q && f_read_word_q == f_data_q);
    end
    cover (f_followed_q && f_before_q == 0 && f_taken && f_count_q == FB'(WORDS));
    cover (valid_o && !take_i && f_stored != 0);
  end
end
