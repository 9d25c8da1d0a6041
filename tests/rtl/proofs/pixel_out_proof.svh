// SPDX-License-Identifier: Apache-2.0
// The beats of pixel out (docs/microarchitecture.md, "Pixel out"), put inside pixel_out by prove_units.sh. Every pixel
// of a tile of any size is sent once, in order, with the right keep, last and words, marked if the tile was cut short,
// in the page's cycles, for any behaviour of the sink. Each row of the picture is requested once.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

// The tile holds still; so does the picture. One block of it, any, is looked at.
(* anyconst *) logic [SIDE-1:0] f_width, f_height;
(* anyconst *) logic [1:0] f_mode;
(* anyconst *) logic [AB-1:0] f_block;
(* anyconst *) logic [P*4*DB-1:0] f_upper, f_lower;  // its rows
localparam int F_SIDE = P * fastsplat_pkg::BLOCKS_X;
logic [AB-1:0] f_read_q;  // outputs of the picture memories
always @* begin
  assume (f_width >= 1 && f_width <= SIDE'(F_SIDE) && f_height >= 1 && f_height <= SIDE'(F_SIDE));
  assume (width_i == f_width && height_i == f_height && mode_i == f_mode);
  if (f_read_q == f_block)
    assume (picture_i == ((picture_row_o[0] ? f_upper : '0) | (picture_row_o[1] ? f_lower : '0)));
end
always @(posedge clk_i) if (picture_re_o) f_read_q <= picture_addr_o;

// The beat that is due: its first pixel, whether the tile is under way, and cycles since it began (2: beats are due).
logic f_active_q, f_marked_q;
logic [1:0] f_age_q;
logic [SIDE-1:0] f_x_q, f_y_q;
logic f_last, f_next_last;
logic [SIDE-1:0] f_next_x, f_next_y, f_after_x, f_after_y;
assign f_last = f_x_q + SIDE'(P) >= f_width && f_y_q + SIDE'(1) == f_height;
assign f_next_x = f_x_q + SIDE'(P) >= f_width ? '0 : f_x_q + SIDE'(P);
assign f_next_y = f_x_q + SIDE'(P) >= f_width ? f_y_q + SIDE'(1) : f_y_q;
assign f_next_last = f_next_x + SIDE'(P) >= f_width && f_next_y + SIDE'(1) == f_height;
assign f_after_x = f_next_x + SIDE'(P) >= f_width ? '0 : f_next_x + SIDE'(P);
assign f_after_y = f_next_x + SIDE'(P) >= f_width ? f_next_y + SIDE'(1) : f_next_y;
function automatic logic [AB-1:0] f_block_of(input logic [SIDE-1:0] x, input logic [SIDE-1:0] y);
  f_block_of = AB'((y / SIDE'(P)) * SIDE'(fastsplat_pkg::BLOCKS_X) + x / SIDE'(P));
endfunction

always @(posedge clk_i) begin
  if (start_i) begin
    f_active_q <= 1'b1;
    f_marked_q <= aborted_i;
    f_age_q <= '0;
    f_x_q <= '0;
    f_y_q <= '0;
  end else if (f_active_q) begin
    if (f_age_q != 2'd2) f_age_q <= f_age_q + 2'd1;
    if (valid_o && ready_i) begin
      f_x_q <= f_next_x;
      f_y_q <= f_next_y;
      if (f_last) f_active_q <= 1'b0;
    end
  end
  if (!rst_ni) f_active_q <= 1'b0;
end

// Any row of the block: each that lies in the tile is sent once, so that the compositor leaves a blank picture.
(* anyconst *) logic [LB-1:0] f_h;
logic f_fresh_q, f_sent_q, f_any_q, f_sending, f_inside;
logic [SIDE-1:0] f_row_x, f_row_y, f_r1_x, f_r1_y;
assign f_row_x = SIDE'(f_block % fastsplat_pkg::BLOCKS_X) * SIDE'(P);
assign f_row_y = SIDE'(f_block / fastsplat_pkg::BLOCKS_X) * SIDE'(P) + SIDE'(f_h);
assign f_inside = f_row_x < f_width && f_row_y < f_height;
assign f_r1_x = valid_r2_q ? f_next_x : f_x_q;
assign f_r1_y = valid_r2_q ? f_next_y : f_y_q;
assign f_sending = f_fresh_q && f_read_q == f_block && picture_row_o[f_h];
always @(posedge clk_i) begin
  f_fresh_q <= rst_ni && picture_re_o;
  if (f_sending) f_sent_q <= 1'b1;
  if (start_i) f_sent_q <= 1'b0;
  f_any_q <= rst_ni && (f_any_q || start_i);
end

logic [P*4*DB-1:0] f_row;
assign f_row = f_y_q[0] ? f_lower : f_upper;
logic f_keep_right;
always @* begin
  f_keep_right = 1'b1;
  for (int g = 0; g < P; g++) if (keep_o[g] != (f_x_q + SIDE'(g) < f_width)) f_keep_right = 1'b0;
end

always @(posedge clk_i) begin
  if (f_started && rst_ni) begin
    // The specification. At rest from the cycle after the last beat was taken (M-pixel-5); a beat from E+3 on, and in each cycle after one
    // was taken (M-pixel-2); each of the picture's beats (M-pixel-1) in its place (M-port-5), also behind beats that waited (M-pixel-4).
    assert (idle_o == !f_active_q);
    assert (valid_o == (f_active_q && f_age_q == 2'd2));
    assert (!valid_o || last_o == f_last);  // M-pixel-6, M-port-7
    assert (!valid_o || f_keep_right);  // M-pixel-6, M-port-6
    assert (!valid_o || aborted_o == f_marked_q);  // at its start, on all of its beats (M-check-9)
    assert (!(f_sending && f_sent_q));
    assert (!(idle_o && f_any_q) || f_sent_q == f_inside);
    // Where the stages stand, for induction.
    assert (f_any_q || !f_active_q);
    assert (!f_active_q || aborted_o == f_marked_q);
    assert (!f_fresh_q || valid_r1_q);
    if (f_active_q && f_age_q == 2'd0) assert (!f_sent_q);
    if (f_active_q && f_age_q != 2'd0 && !valid_r1_q) assert (f_sent_q == f_inside);
    if (valid_r1_q)
      assert (f_sent_q == (f_inside && (f_row_y < f_r1_y || (f_row_y == f_r1_y && (f_row_x < f_r1_x || (f_row_x == f_r1_x && !f_fresh_q))))));
    assert (f_age_q != 2'd3 || !f_active_q);
    assert (!f_active_q || (f_x_q < f_width && f_y_q < f_height && f_x_q[0] == 1'b0));
    assert (f_active_q || !(running_q || valid_r1_q || valid_r2_q));
    if (f_active_q && f_age_q == 2'd0) assert (running_q && !valid_r1_q && !valid_r2_q && x_q == '0 && y_q == '0 && f_x_q == '0 && f_y_q == '0);
    if (f_active_q && f_age_q == 2'd1) begin
      assert (valid_r1_q && !valid_r2_q && running_q == !f_last && f_x_q == '0 && f_y_q == '0);
      assert (!running_q || (x_q == f_next_x && y_q == f_next_y));
    end
    if (f_active_q && f_age_q == 2'd2) begin
      assert (valid_r2_q && valid_r1_q == !f_last && running_q == (!f_last && !f_next_last));
      assert (!running_q || (x_q == f_after_x && y_q == f_after_y));
    end
    if (valid_r1_q) begin
      assert (x_r1_q == (valid_r2_q ? f_next_x : f_x_q) && row_r1_q == (valid_r2_q ? f_next_y[0] : f_y_q[0]));
      assert (last_r1_q == (valid_r2_q ? f_next_last : f_last));
      assert (f_read_q == (valid_r2_q ? f_block_of(f_next_x, f_next_y) : f_block_of(f_x_q, f_y_q)));
    end
    cover (valid_o && last_o && f_y_q == SIDE'(2) && f_width == SIDE'(3) && ready_i);
    cover (valid_o && last_o && f_marked_q && !aborted_i && (f_x_q != '0 || f_y_q != '0));
    cover (valid_o && !ready_i && f_block_of(f_x_q, f_y_q) == f_block && data_o != '0);
  end
end
// Words of the block that is looked at (N-7-2); each narrowed as proved of `narrow`.
for (genvar g = 0; g < P; g++) begin : gen_f_pixel
  for (genvar c = 0; c < 4; c++) begin : gen_f_channel
    logic [DB-1:0] f_word;
    logic [TB-1:0] f_shown;
    logic [PB:0] f_pixel;
    assign f_word = f_row[(4*g+c)*DB+:DB];
    assign f_shown = (c == 3) ? (TB'(1) << TF) - f_word[TB-1:0] : f_word[TB-1:0];
    assign f_pixel = f_mode == 2'd2 ? narrow_sum(f_word[SB-1:0]) : narrow_composited(f_shown);
    always @(posedge clk_i) begin
      if (f_started && rst_ni && valid_o && f_block_of(f_x_q, f_y_q) == f_block) begin
        assert (data_o[g*128+c*32+:32] == 32'(f_pixel[PB-1:0]));  // M-port-5
        assert (saturated_o[4*g+c] == (keep_o[g] && f_pixel[PB]));
      end
    end
  end
end
