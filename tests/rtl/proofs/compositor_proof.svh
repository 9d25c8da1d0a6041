// The compositor's pipe and its picture (docs/microarchitecture.md, "Pipe" and "Pixel out"), written again from the page and put
// inside compositor by prove_control.sh: what is picked in k0 is written in k6; a word of the picture has one writer, is read as
// it was written last, and is blank behind the wipe and behind pixel out. One word is looked at: any. The walk and the arithmetic
// say what they will, and reading the word that is being written gives anything.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);
(* anyconst *) logic [AB-1:0] f_block;
(* anyconst *) logic [fastsplat_pkg::LANE_LOG2-1:0] f_g, f_h;  // its lane's column and row
always @* assume (32'(f_block) < NB);

// What is picked in k0 is written in k6.
logic [6:1] f_way_q;
logic [AB-1:0] f_at_q[1:6];
always @(posedge clk_i) begin
  f_way_q <= {f_way_q[5:1], sheet_re_o};
  f_at_q[1] <= sheet_addr_o;
  for (int s = 2; s <= 6; s++) f_at_q[s] <= f_at_q[s-1];
  if (!rst_ni) f_way_q <= '0;
end

// The word's place in the picture, and whether it lies in the tile.
localparam int FS = SIDE + AB + 2;
logic [FS-1:0] f_x, f_y;
assign f_x = FS'(f_block % BX) * FS'(P) + FS'(f_g);
assign f_y = FS'(f_block / BX) * FS'(P) + FS'(f_h);

// The lane's signals, and what its memory holds (tied to the memories' probes by the script).
logic [4*DB-1:0] f_memory0, f_memory1, f_memory2, f_memory3, f_memory, f_seen, f_k4, f_new, f_lane, f_sent;
always @* begin
  f_memory = f_h ? (f_g ? f_memory3 : f_memory2) : (f_g ? f_memory1 : f_memory0);
  f_seen = f_h ? (f_g ? picture[3] : picture[2]) : (f_g ? picture[1] : picture[0]);
  f_seen = f_seen ^ transparent;
  f_k4 = f_h ? (f_g ? state_k4_q[3] : state_k4_q[2]) : (f_g ? state_k4_q[1] : state_k4_q[0]);
  f_lane = f_h ? (f_g ? states[3] : states[2]) : (f_g ? states[1] : states[0]);
  f_new = f_h ? (f_g ? tap_state_o[12*DB+:4*DB] : tap_state_o[8*DB+:4*DB]) : (f_g ? tap_state_o[4*DB+:4*DB] : tap_state_o[0+:4*DB]);
  f_sent = f_g ? picture_o[4*DB+:4*DB] : picture_o[0+:4*DB];
end

// The word, as the page has it: unknown until wiped, then blank or a state.
logic f_known_q, f_blank_q, f_read_q, f_write;
logic [4*DB-1:0] f_state_q, f_blank, f_word;
assign f_blank = mode_i == 2'd2 ? '0 : {DB'(1) << fastsplat_pkg::TRANS_FRAC, (3 * DB)'(0)};
assign f_word = f_blank_q ? f_blank : f_state_q;
assign f_write = f_way_q[6] && f_at_q[6] == f_block && f_y < FS'(height_i);
// Reads of it: by the pipe, which has in k4 what was written up to k2; by pixel out, and what that saw holds until the next read.
logic f_pipe, f_out, f_pipe_q, f_shown_q, f_again_q;
logic [4*DB-1:0] f_expect_q, f_due_q, f_lane_q;
logic f_holds_q;
assign f_pipe = f_way_q[3] && f_at_q[3] == f_block;
assign f_out = picture_re_i && picture_addr_i == f_block;
logic [1:0] f_mode_q;
logic [SIDE-1:0] f_width_q, f_height_q;
always @(posedge clk_i) begin
  f_read_q <= rst_ni && f_out;
  f_pipe_q <= rst_ni && f_pipe;
  if (f_way_q[3]) f_expect_q <= f_word;
  if (f_way_q[2] || picture_re_i) begin
    f_shown_q <= f_out;
    f_again_q <= f_out && f_read_q && picture_row_i[f_h];
    f_due_q <= f_word;
  end
  f_lane_q <= f_lane;
  f_holds_q <= f_started && !valid_q[5];
  if (f_write) begin
    f_state_q <= f_new;
    f_blank_q <= 1'b0;
  end
  if (f_read_q && picture_row_i[f_h]) f_blank_q <= 1'b1;
  if (wipe_i && wipe_addr_i == f_block) begin
    f_blank_q <= 1'b1;
    f_known_q <= 1'b1;
  end
  f_mode_q <= mode_i;
  f_width_q <= width_i;
  f_height_q <= height_i;
  if (!rst_ni) f_known_q <= 1'b0;
  if (!rst_ni) f_shown_q <= 1'b0;
end

// What dirty_map_proof.svh, composite_lane_proof.svh, pixel_out_proof.svh and core_proof.svh have: a block comes back four cycles
// later at the earliest, and then no other came between; a lane holds what it has without a block; all is still while the picture is wiped or sent; pixel out sends no row twice; a tile has one mode and size, and begins when the
// one before it was sent.
always @* begin
  if (rst_ni) begin
    assume (!(sheet_re_o && walk_idle));
    for (int s = 1; s <= 3; s++) assume (!(sheet_re_o && sheet_addr_o == f_block && f_way_q[s] && f_at_q[s] == f_block));
    assume (!(sheet_re_o && sheet_addr_o == f_block && f_way_q[4] && f_at_q[4] == f_block && f_way_q[3:1] != '0));
    assume (!f_holds_q || f_lane == f_lane_q);
    assume (!picture_re_i || idle_o);
    assume (!(wipe_i && (sheet_re_o || picture_re_i || f_way_q != '0 || f_read_q || sent_q)));
    assume (f_known_q || !(sheet_re_o || picture_re_i));
    assume (!f_again_q || !picture_row_i[f_h]);
    if (f_started && !(f_known_q && f_blank_q && idle_o && !sheet_re_o && !picture_re_i && picture_row_i == '0))
      assume (!f_known_q || (mode_i == f_mode_q && width_i == f_width_q && height_i == f_height_q));
    if (mode_i != f_mode_q) assume (!f_shown_q && f_way_q == '0);
  end
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    assert (sheet_re_o == issue && sheet_addr_o == pick && free_o == finish && tap_sheet_o == finish && free_buffer_o == sheet_buffer_o);
    assert (idle_o == (walk_idle && f_way_q == '0));
    // Through the pipe.
    assert (tap_valid_o == f_way_q[6]);
    assert (!tap_valid_o || tap_block_o == f_at_q[6]);
    assert (!(tap_valid_o && tap_block_o == f_block) || (tap_inside_x_o[f_g] == (f_x < FS'(width_i)) && tap_inside_y_o[f_h] == (f_y < FS'(height_i))));
    // The picture: as written last.
    assert (!f_pipe_q || f_k4 == f_expect_q);
    assert (!(f_shown_q && picture_row_i == P'(1) << f_h) || f_sent == f_due_q);

    // For induction.
    assert (valid_q == f_way_q);
    for (int s = 1; s <= 6; s++) assert (!f_way_q[s] || addr_q[s] == f_at_q[s]);
    assert (!f_known_q || f_memory == (f_blank_q ? '0 : f_state_q ^ f_blank));
    assert (f_known_q || !(f_way_q != '0 || sent_q || f_shown_q));
    assert (!f_read_q || (sent_q && sent_addr_q == f_block));
    assert (!(sent_q && sent_addr_q == f_block) || f_read_q);
    assert (!(f_shown_q && !f_again_q) || f_seen == f_due_q);
    assert (!f_pipe || ((forward_q && tap_inside_y_o[f_h]) ? f_lane : f_seen) == f_word);
    assert (!(sent_q && f_way_q != '0));
    for (int s = 1; s <= 6; s++) begin
      for (int t = 1; t <= 3; t++) if (s + t <= 6) assert (!(f_way_q[s] && f_way_q[s+t] && f_at_q[s] == f_block && f_at_q[s+t] == f_block));
    end
    for (int s = 1; s <= 2; s++) assert (!(f_way_q[s] && f_way_q[s+4] && f_at_q[s] == f_block && f_at_q[s+4] == f_block && ((f_way_q >> s) & 6'd7) != '0));
    cover (f_pipe && forward_q && tap_inside_y_o[f_h]);
    cover (f_pipe_q && f_expect_q != f_blank && f_expect_q != '0);
    cover (f_read_q && picture_row_i[f_h] && !f_blank_q && f_again_q == 1'b0);
    cover (f_pipe && f_way_q[6] && f_at_q[6] != f_block && !f_blank_q);
  end
end
