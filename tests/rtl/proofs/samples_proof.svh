// SPDX-License-Identifier: Apache-2.0
// The loop of every sample (docs/microarchitecture.md, "Every sample" and "Hazard"), written again from the page and put inside
// compositor by prove_samples.sh: in tiles of every sample each pixel has the value that it has if samples are composited one after
// another. A sample gives its pixel a new, arbitrary state. It is composited over the state of the sample before it, however many
// cycles lie between the two, or over the picture's. The proof follows one arbitrary pixel. Reading the word that is being written
// returns an arbitrary value.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);
(* anyconst *) logic [AB-1:0] f_block;
(* anyconst *) logic [fastsplat_pkg::LANE_LOG2-1:0] f_g, f_h;  // its bank's column and row
always @* assume (32'(f_block) < NB);

// The lane's signals, and what its memory holds (tied to the memories' probes by the script).
logic [4*DB-1:0] f_memory0, f_memory1, f_memory2, f_memory3, f_memory, f_seen, f_k4, f_made, f_lane, f_sent, f_chosen, f_past;
logic f_after_2, f_after_3, f_after_4;
always @* begin
  f_memory = f_h ? (f_g ? f_memory3 : f_memory2) : (f_g ? f_memory1 : f_memory0);
  f_seen = (f_h ? (f_g ? picture[3] : picture[2]) : (f_g ? picture[1] : picture[0])) ^ transparent;
  f_k4 = f_h ? (f_g ? state_k4_q[3] : state_k4_q[2]) : (f_g ? state_k4_q[1] : state_k4_q[0]);
  f_lane = f_h ? (f_g ? states[3] : states[2]) : (f_g ? states[1] : states[0]);
  f_made = f_h ? (f_g ? gen_lane[3].next : gen_lane[2].next) : (f_g ? gen_lane[1].next : gen_lane[0].next);
  f_chosen = f_h ? (f_g ? gen_lane[3].sample_state : gen_lane[2].sample_state) : (f_g ? gen_lane[1].sample_state : gen_lane[0].sample_state);
  f_past = f_h ? (f_g ? gen_lane[3].gen_forward.past_q : gen_lane[2].gen_forward.past_q) : (f_g ? gen_lane[1].gen_forward.past_q : gen_lane[0].gen_forward.past_q);
  f_after_2 = sample_forward_2[{f_h, f_g}];
  f_after_3 = sample_forward_3[{f_h, f_g}];
  f_after_4 = sample_forward_4[{f_h, f_g}];
  f_sent = f_g ? picture_o[4*DB+:4*DB] : picture_o[0+:4*DB];
end

// What rides along in sample_places, k2 to k6 (tied by the script): each bank's own block (M-sample-2).
localparam int F_BLK = fastsplat_pkg::BLK_BITS;
logic [P*F_BLK-1:0] f_column2, f_column3, f_column4, f_column5, f_column6, f_row2, f_row3, f_row4, f_row5, f_row6;
logic [P-1:0] f_in_x2, f_in_x3, f_in_x4, f_in_x5, f_in_x6, f_in_y2, f_in_y3, f_in_y4, f_in_y5, f_in_y6;
function automatic logic f_here(input logic [P*F_BLK-1:0] column, row, input logic [P-1:0] in_x, in_y);
  f_here = 32'(column[f_g*F_BLK+:F_BLK]) == 32'(f_block) % BX && 32'(row[f_h*F_BLK+:F_BLK]) == 32'(f_block) / BX && in_x[f_g] && in_y[f_h];
endfunction

// Samples of the pixel on their way, by stage: a window's place is known in k1. 7: a cycle behind k6.
logic [6:1] f_way_q, f_mine;
logic [7:2] f_mine_q;
assign f_mine = {f_mine_q[6:2], f_way_q[1] && f_here(sample_column_i, sample_row_i, sample_inside_x_i, sample_inside_y_i)};
// The pixel: what the samples up to k5 have made of it.
logic f_known_q, f_read_q, f_shown_q, f_again_q;
logic [4*DB-1:0] f_state_q, f_blank, f_due_q, f_lane_q, f_made_q;
logic f_stepped_q;
logic [1:0] f_mode_q;
assign f_blank = {DB'(1) << fastsplat_pkg::TRANS_FRAC, (3 * DB)'(0)};
logic f_out;
assign f_out = picture_re_i && picture_addr_i == f_block;
always @(posedge clk_i) begin
  f_way_q <= rst_ni ? {f_way_q[5:1], sample_valid_i} : '0;
  f_mine_q <= rst_ni ? f_mine : '0;
  if (f_mine[5]) f_state_q <= f_made;
  f_read_q <= rst_ni && f_out;
  if (f_way_q[2] || picture_re_i) begin
    f_shown_q <= f_out;
    f_again_q <= f_out && f_read_q && picture_row_i[f_h];
    f_due_q <= f_state_q;
  end
  if ((f_read_q && picture_row_i[f_h]) || (wipe_i && wipe_addr_i == f_block)) f_state_q <= f_blank;
  if (wipe_i && wipe_addr_i == f_block) f_known_q <= 1'b1;
  f_lane_q <= f_lane;
  f_made_q <= f_made;
  f_stepped_q <= valid_q[5];
  f_mode_q <= mode_i;
  if (!rst_ni) f_known_q <= 1'b0;
  if (!rst_ni) f_shown_q <= 1'b0;
end

// Assumed of other parts: the walk picks nothing (no block was marked); a lane shows in k5 what it has in k6
// (composite_lane_proof.svh), and holds it without a sample; all is still while the picture is wiped or sent; a window
// waits if it lies over that of the cycle before (stream_decode_proof.svh).
always @* begin
  assume (every_sample_i);
  if (rst_ni) begin
    assume (!issue && walk_idle);
    assume (mode_i != 2'd2 && mode_i == f_mode_q);
    assume (!f_started || f_lane == (f_stepped_q ? f_made_q : f_lane_q));
    assume (!picture_re_i || idle_o);
    assume (!(picture_re_i && sample_valid_i));
    assume (!(wipe_i && (sample_valid_i || picture_re_i || f_way_q != '0 || f_read_q || sent_q)));
    assume (f_known_q || !(sample_valid_i || picture_re_i));
    assume (!(f_mine[1] && f_mine[2]));  // The wait.
    assume (!(sent_q && sample_valid_i));
    assume (!f_again_q || !picture_row_i[f_h]);  // no row twice
  end
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // What a sample is put over, as if it were alone with those before it: they have all left k5, for none of them is in it (M-hazard-1).
    assert (!f_mine[4] || f_k4 == f_state_q);
    assert (!f_mine[4] || !f_mine[5]);
    // What pixel out is shown.
    assert (!(f_shown_q && picture_row_i == P'(1) << f_h) || f_sent == f_due_q);
    // In its cycle (M-sample-3).
    assert (tap_valid_o == f_way_q[6] && event_valid_o == f_way_q[6]);
    assert (idle_o == (f_way_q == '0));

    // For induction.
    assert (valid_q == f_way_q && (!(f_way_q[6] || (f_way_q[3] && forward_q)) || inside_y_q == '0));
    for (int s = 2; s <= 6; s++) assert (!f_mine[s] || f_way_q[s]);
    assert (!f_way_q[2] || f_mine[2] == f_here(f_column2, f_row2, f_in_x2, f_in_y2));
    assert (!f_way_q[3] || f_mine[3] == f_here(f_column3, f_row3, f_in_x3, f_in_y3));
    assert (!f_way_q[4] || f_mine[4] == f_here(f_column4, f_row4, f_in_x4, f_in_y4));
    assert (!f_way_q[5] || f_mine[5] == f_here(f_column5, f_row5, f_in_x5, f_in_y5));
    assert (!f_way_q[6] || f_mine[6] == f_here(f_column6, f_row6, f_in_x6, f_in_y6));
    // Of the samples before it that are on their way the latest counts (M-hazard-2); what none of them has met is in the memory.
    assert (!f_mine[3] || (f_after_2 == f_mine[5] && f_after_3 == f_mine[6] && f_after_4 == f_mine_q[7]));
    assert (!(f_mine[3] && f_mine_q[7:5] != '0) || f_chosen == (f_mine[5] ? f_made : f_state_q));
    assert (!(f_mine[3] && f_mine_q[7:5] == '0) || f_seen == f_state_q);
    assert (!f_mine_q[7] || f_past == f_state_q);
    for (int s = 2; s <= 6; s++) assert (!(f_mine_q[s] && f_mine_q[s+1]));
    assert (!f_mine[6] || f_lane == f_state_q);
    assert (f_known_q || !(f_way_q != '0 || sent_q || f_shown_q));
    assert (!f_read_q || (sent_q && sent_addr_q == f_block));
    assert (!(sent_q && sent_addr_q == f_block) || f_read_q);
    assert (!(sent_q && f_way_q != '0));
    assert (!(f_shown_q && !f_again_q) || f_seen == f_due_q);
    assert (!f_known_q || f_mine[6] || f_memory == (f_state_q ^ f_blank));
    cover (f_mine[4] && f_mine[6] && f_k4 != f_blank);
    cover (f_mine == 6'b101010);
    cover (f_mine[2] && f_mine[5] && f_k4 != f_blank);
    cover (f_mine[2] && f_mine[6]);
    cover (f_read_q && f_sent != f_blank);
  end
end
