// SPDX-License-Identifier: Apache-2.0
// Decode on a stream (docs/microarchitecture.md, "Stream side"; docs/stream.md), written again from the pages and put
// inside stream_decode by prove_control.sh. No beat is lost, doubled or out of order. Each record stays in the register
// for its time, every window of a splat is issued once, every word of a table goes to its place.
logic f_started = 1'b0;
always @(posedge clk_i) f_started <= 1'b1;
always @* if (!f_started) assume (!rst_ni);

// What comes is what check passes: stream_check_proof.svh.
logic f_passed_valid, f_passed_ready, f_passed_payload, f_passed_aborted;
logic [fastsplat_pkg::BEAT_BITS-1:0] f_passed_data;
logic [COL-1:0] f_passed_extent;
assign f_passed_valid = valid_i;
assign f_passed_ready = ready_o;
assign f_passed_data = data_i;
assign f_passed_payload = payload_i;
assign f_passed_aborted = aborted_i;
assign f_passed_extent = extent_i;
`define F_INVARIANT(ALWAYS) assume (ALWAYS)
`include "stream_invariants.svh"

`ifdef F_FEW_BEATS
// To see a fault of the wait a source and a compositor that are always ready will do.
always @* if (f_started) assume (rst_ni && valid_i && !aborted_i && tile_idle_i && !free_i);
`endif

// The beat in the register.
logic f_have_q, f_payload_q, f_aborted_q;
logic [fastsplat_pkg::BEAT_BITS-1:0] f_beat_q;
logic f_done;
always @(posedge clk_i) begin
  if (valid_i && ready_o) begin
    f_have_q <= 1'b1;
    f_beat_q <= data_i;
    f_payload_q <= payload_i;
    f_aborted_q <= aborted_i;
  end else if (f_done) f_have_q <= 1'b0;
  if (!rst_ni) f_have_q <= 1'b0;
end
logic [7:0] f_opcode;
assign f_opcode = f_beat_q[7:0];

// Where the records that were carried out lead to: 0 in the frame, 1 in a tile, 2 in a sheet. A table's words are payload.
logic [1:0] f_place_q;
logic [31:0] f_left_q;      // words of the table to come (S-record-2)
logic [31:0] f_index_q;     // of the next one
logic [7:0] f_table_q;
logic [COL-1:0] f_base_q, f_padded_q;

// Radius sets.
logic [fastsplat_pkg::RLUT_SETS-1:0] f_loaded_q;
logic [fastsplat_pkg::RHO_BITS-1:0] f_rho_q[0:fastsplat_pkg::RLUT_SETS-1];
logic [COL-1:0] f_first_q[0:fastsplat_pkg::RLUT_SETS-1];

// Time in the register: what a beat still needs, this cycle included (M-decode-2).
logic f_payload, f_splat, f_waits;
logic [2:0] f_word_q;  // of the beat
logic [COL-1:0] f_x_q, f_y_q, f_ea;  // the window that is due
logic f_last_x, f_last_y;
assign f_ea = f_padded(f_rho_q[f_beat_q[8+:fastsplat_pkg::SET_BITS]]);
assign f_payload = f_have_q && f_payload_q;
assign f_splat = f_have_q && !f_payload && f_opcode == 8'h50;
assign f_last_x = f_x_q + COL'(P) == f_ea;
assign f_last_y = f_y_q + COL'(P) == f_ea;
logic [1:0] f_busy_q;
logic f_buffer_q;
// Every sample: a record's first window waits a cycle if it lies over the window that was issued in the cycle before (M-hazard-3).
logic f_every_q, f_over, f_issue;
logic signed [31:0] f_column, f_row, f_was_column_q, f_was_row_q;  // the window's first pixel
function automatic logic signed [31:0] f_first_pixel(input logic signed [fastsplat_pkg::POS_BITS-1:0] centre, input logic [fastsplat_pkg::RHO_BITS-1:0] rho);
  logic signed [31:0] grid;  // steps of 1/K, halves up
  grid = (32'(centre) + 32'sd1 * (1 << fastsplat_pkg::SHIFT_SNAP) / 2) >>> fastsplat_pkg::SHIFT_SNAP;
  if (grid >= 1 << (fastsplat_pkg::POS_INT + fastsplat_pkg::PHASE_LOG2 - 1)) grid = (1 << (fastsplat_pkg::POS_INT + fastsplat_pkg::PHASE_LOG2 - 1)) - 1;
  f_first_pixel = ((grid - $signed(32'(rho))) >>> fastsplat_pkg::PHASE_LOG2) + 32'sd1;
endfunction
function automatic logic f_beside(input logic signed [31:0] a, b);
  f_beside = a - b >= $signed(32'(P)) || b - a >= $signed(32'(P));
endfunction
assign f_column = f_first_pixel(f_beat_q[64+:fastsplat_pkg::POS_BITS], f_rho_q[f_beat_q[8+:fastsplat_pkg::SET_BITS]]) + $signed(32'(f_x_q));
assign f_row = f_first_pixel(f_beat_q[96+:fastsplat_pkg::POS_BITS], f_rho_q[f_beat_q[8+:fastsplat_pkg::SET_BITS]]) + $signed(32'(f_y_q));
assign f_over = fastsplat_pkg::EVERY_SAMPLE != 0 && f_every_q && f_splat && f_was_splat_q && f_x_q == '0 && f_y_q == '0 &&
                !f_beside(f_column, f_was_column_q) && !f_beside(f_row, f_was_row_q);
assign f_issue = f_splat && !f_over;
assign f_waits = f_opcode == 8'h53 ? f_busy_q[f_buffer_q] :
                 (f_opcode == 8'h54 || f_opcode == 8'h74) && !(tile_idle_i && f_busy_q == 2'd0);
assign f_done = f_have_q && (f_payload ? f_left_q == 32'd1 || f_word_q == 3'd7 : f_splat ? f_last_x && f_last_y && !f_over : !f_waits);

// Any window of the splat: how often it was issued.
(* anyconst *) logic [COL-1:0] f_any_x, f_any_y;
logic [1:0] f_seen_q, f_seen;
assign f_seen = f_seen_q + 2'(f_issue && f_x_q == f_any_x && f_y_q == f_any_y);

always @(posedge clk_i) begin
  if (f_have_q) begin
    if (f_payload) begin
      f_left_q <= f_left_q - 32'd1;
      f_index_q <= f_index_q + 32'd1;
      f_word_q <= f_word_q == 3'd7 || f_left_q == 32'd1 ? 3'd0 : f_word_q + 3'd1;
    end else if (f_done) begin
      case (f_opcode)
        8'h46: f_left_q <= '0;  // a soft reset cut a table short
        8'h4C: begin
          f_left_q <= f_beat_q[127:96];
          f_index_q <= '0;
          f_word_q <= '0;
          f_table_q <= f_beat_q[15:8];
          f_base_q <= f_beat_q[128+:COL];
          f_padded_q <= f_padded(f_beat_q[64+:fastsplat_pkg::RHO_BITS]);
          if (f_beat_q[15:8] == 8'd0) begin
            f_loaded_q[f_beat_q[32+:fastsplat_pkg::SET_BITS]] <= 1'b1;
            f_rho_q[f_beat_q[32+:fastsplat_pkg::SET_BITS]] <= f_beat_q[64+:fastsplat_pkg::RHO_BITS];
            f_first_q[f_beat_q[32+:fastsplat_pkg::SET_BITS]] <= f_beat_q[128+:COL];
          end
        end
        8'h54: begin
          f_place_q <= 2'd1;
          f_every_q <= f_beat_q[10];
        end
        8'h53: f_place_q <= 2'd2;
        8'h73: f_place_q <= 2'd1;
        8'h74: f_place_q <= 2'd0;
        default: ;
      endcase
    end
    if (f_issue) begin
      f_x_q <= f_last_x ? '0 : f_x_q + COL'(P);
      if (f_last_x) f_y_q <= f_last_y ? '0 : f_y_q + COL'(P);
      f_seen_q <= f_done ? 2'd0 : f_seen;
    end
  end
  // Buffers: taken in turn (M-decode-4), given back by the compositor (M-decode-5).
  if (free_i) f_busy_q[free_buffer_i] <= 1'b0;
  if (f_done && !f_payload && f_opcode == 8'h53) f_busy_q[f_buffer_q] <= 1'b1;
  if (f_done && !f_payload && f_opcode == 8'h73) f_buffer_q <= !f_buffer_q;
  if (!rst_ni) begin
    f_place_q <= '0;
    f_left_q <= '0;
    f_x_q <= '0;
    f_y_q <= '0;
    f_seen_q <= '0;
    f_busy_q <= '0;
    f_buffer_q <= 1'b0;
    f_every_q <= 1'b0;
    f_loaded_q <= '0;
  end
end
// A buffer that comes back was out, and the open sheet's buffer does not: prove_core.sh.
always @* begin
  if (free_i) assume (f_busy_q[free_buffer_i] && !(f_place_q == 2'd2 && free_buffer_i == f_buffer_q));
end

// A window a cycle after its issue.
logic f_was_splat_q, f_was_end_q, f_was_buffer_q;
logic [COL-1:0] f_was_x_q, f_was_y_q, f_was_first_q;
logic [fastsplat_pkg::RHO_BITS-1:0] f_was_rho_q;
logic [fastsplat_pkg::BEAT_BITS-1:0] f_was_q;
always @(posedge clk_i) begin
  f_was_splat_q <= f_issue && rst_ni;
  f_was_end_q <= f_done && !f_payload && f_opcode == 8'h73 && rst_ni;
  f_was_buffer_q <= f_buffer_q;
  f_was_rho_q <= f_rho_q[f_beat_q[8+:fastsplat_pkg::SET_BITS]];
  f_was_first_q <= f_first_q[f_beat_q[8+:fastsplat_pkg::SET_BITS]];
  f_was_column_q <= f_column;
  f_was_row_q <= f_row;
  f_was_x_q <= f_x_q;
  f_was_y_q <= f_y_q;
  f_was_q <= f_beat_q;
end

// Places as the register of every sample has them (tied by prove_samples.sh).
logic signed [fastsplat_pkg::ORG_BITS-1:0] f_x_here, f_y_here, f_x_last, f_y_last;
logic f_fresh;

logic f_now;  // outside reset
assign f_now = f_started && rst_ni;
always @(posedge clk_i) begin
  if (f_now) begin
    // Beats: taken in order (M-decode-1), each carried out once, after its time (M-decode-2).
    assert (ready_o == (!f_have_q || f_done));
    assert (beat_valid_q == f_have_q);
    assert (!f_have_q || beat_q == f_beat_q);
    assert (tile_begin == (f_done && !f_payload && f_opcode == 8'h54));
    assert (tile_end_o == (f_done && !f_payload && f_opcode == 8'h74));
    assert (event_splat_o == (f_done && f_splat));
    assert (event_cull_o == (f_done && !f_payload && f_opcode == 8'h43));
    assert (!tile_end_o || tile_aborted_o == f_aborted_q);
    assert (frame_end_o == (f_done && !f_payload && f_opcode == 8'h66));
    assert (tile_open_o == (f_place_q != 2'd0));
    // Waits, and their causes.
    assert (stall_input_o == !f_have_q);
    assert (stall_table_o == (f_have_q && f_payload));
    assert (stall_buffer_o == (f_have_q && !f_payload && f_opcode == 8'h53 && f_waits));
    assert (stall_tile_o == (f_have_q && !f_payload && f_opcode != 8'h53 && f_waits));
    assert (stall_hazard_o == f_over);
    // No two windows of every sample that follow one another share a pixel (M-hazard-3).
    if (f_issue && f_was_splat_q && f_every_q && fastsplat_pkg::EVERY_SAMPLE != 0)
      assert (f_beside(f_column, f_was_column_q) || f_beside(f_row, f_was_row_q));
    // Windows.
    assert (window_valid_o == f_was_splat_q);
    assert (window_last_o == f_was_end_q);
    if (window_valid_o || window_last_o) assert (window_buffer_o == f_was_buffer_q);
    if (window_valid_o) begin
      assert (window_column_o == f_was_x_q && window_row_o == f_was_y_q);
      assert (window_first_o == (f_was_x_q == '0 && f_was_y_q == '0));
      assert (window_tag_o == f_was_q[63:32]);
      assert (window_x_o == f_was_q[64+:fastsplat_pkg::POS_BITS] && window_y_o == f_was_q[96+:fastsplat_pkg::POS_BITS]);
      assert (window_colour_o == {f_was_q[176+:CB], f_was_q[160+:CB], f_was_q[144+:CB], f_was_q[128+:CB]});
      assert (window_rho_o == f_was_rho_q && window_base_o == f_was_first_q);
    end
    // Each window of a splat once.
    if (f_done && f_splat && f_any_x < f_ea && f_any_y < f_ea && f_any_x % COL'(P) == '0 && f_any_y % COL'(P) == '0)
      assert (f_seen == 2'd1);
    // Table words.
    assert (rlut_we_o == (f_have_q && f_payload && f_table_q == 8'd0));
    assert (radial_we_o == (f_have_q && f_payload && f_table_q == 8'd1));
    assert (factor_we_o == (f_have_q && f_payload && f_table_q == 8'd2));
    if (rlut_we_o || radial_we_o || factor_we_o) begin
      assert (table_index_o == f_index_q);
      assert (table_word_o == f_beat_q[32*f_word_q+:32]);
    end
    if (rlut_we_o) begin
      assert (32'(rlut_wphase_o) * 32'(f_padded_q) + 32'(table_column_q) == f_index_q && table_column_q < f_padded_q);
      assert (rlut_wcolumn_o == f_base_q + table_column_q);
    end

    // For induction: the registers of decode and of the specification say the same.
    assert (!f_have_q || (payload_q == f_payload_q && aborted_q == f_aborted_q));
    // The beat in the register satisfies the stream invariants, and lies between the beats passed and those carried
    // out.
    if (f_payload) begin
      assert (f_place_q == 2'd0 && f_left_q != '0);
      assert (f_words_left_q == (f_left_q > 32'd8 - 32'(f_word_q) ? f_left_q - (32'd8 - 32'(f_word_q)) : '0));
    end else if (f_have_q) begin
      if (f_opcode == 8'h46 || f_opcode == 8'h4C || f_opcode == 8'h54 || f_opcode == 8'h66) assert (f_place_q == 2'd0);
      if (f_opcode == 8'h53 || f_opcode == 8'h74) assert (f_place_q == 2'd1);
      if (f_opcode == 8'h50 || f_opcode == 8'h43 || f_opcode == 8'h73) assert (f_place_q == 2'd2);
      assert (f_opcode == 8'h46 || f_left_q == '0);
      assert (f_words_left_q == (f_opcode == 8'h4C ? f_beat_q[127:96] : '0));
      if (f_opcode == 8'h4C) begin
        assert (f_beat_q[127:96] != '0 && f_beat_q[15:8] <= 8'd2);
        assert (f_set_passed_q == (f_beat_q[15:8] == 8'd0));
        if (f_beat_q[15:8] == 8'd0) begin
          assert (f_beat_q[63:32] < fastsplat_pkg::RLUT_SETS && f_rho_passed_q == f_beat_q[64+:fastsplat_pkg::RHO_BITS]);
          assert (f_rho_passed_q != '0 && f_rho_passed_q <= F_RHO);
          assert (f_beat_q[127:96] == 32'(f_padded(f_rho_passed_q)) * 32'(fastsplat_pkg::PHASES));
        end
      end
      if (f_opcode == 8'h50) assert (f_beat_q[15:8] < fastsplat_pkg::RLUT_SETS && f_loaded_q[f_beat_q[8+:fastsplat_pkg::SET_BITS]]);
    end else begin
      assert (f_words_left_q == f_left_q && (f_left_q == '0 || f_word_q == '0));
    end
    assert (f_passed_place_q == (!f_have_q || f_payload ? f_place_q : f_opcode == 8'h53 ? 2'd2 : f_opcode == 8'h54 || f_opcode == 8'h73 ? 2'd1
                                 : f_opcode == 8'h74 ? 2'd0 : f_place_q));
    for (int n = 0; n < fastsplat_pkg::RLUT_SETS; n++)
      assert (f_passed_sets_q[n] == (f_loaded_q[n] || (f_have_q && !f_payload && f_opcode == 8'h4C && f_beat_q[15:8] == 8'd0 && f_beat_q[63:32] == 32'(n))));
    if (f_left_q != '0) begin
      assert (f_place_q == 2'd0);
      assert (index_q == f_index_q && left_q + 32'd1 == f_left_q && last_word_q == (f_left_q == 32'd1) && word_in_beat_q == f_word_q);
      assert (table_q == f_table_q && f_table_q <= 8'd2);
      assert (table_base_q == f_base_q);
      if (f_table_q == 8'd0) begin
        assert (table_extent_q == f_padded_q);
        assert (f_padded_q != '0 && f_padded_q <= COL'(fastsplat_pkg::RLUT_COLUMNS) && table_column_q < f_padded_q);
        assert (32'(table_phase_q) * 32'(f_padded_q) + 32'(table_column_q) == f_index_q);
        assert (f_left_q + f_index_q == 32'(f_padded_q) * 32'(fastsplat_pkg::PHASES));
      end
    end
    if (fastsplat_pkg::EVERY_SAMPLE != 0) begin
      assert (f_place_q == 2'd0 || every_sample_o == f_every_q);
      assert (!(f_splat && f_was_splat_q && !f_fresh) || f_x_q != '0 || f_y_q != '0);
      if (f_splat) assert (32'(f_x_here) + $signed(32'(f_x_q)) == f_column && 32'(f_y_here) + $signed(32'(f_y_q)) == f_row);
      if (f_was_splat_q) assert (32'(f_x_last) == f_was_column_q && 32'(f_y_last) == f_was_row_q);
      if (f_splat && f_fresh) assert (f_x_q == '0 && f_y_q == '0);
      // Windows of one record: to the right, or the next row.
      if (f_issue && f_was_splat_q && (f_x_q != '0 || f_y_q != '0)) assert (f_beside(f_column, f_was_column_q) || f_beside(f_row, f_was_row_q));
    end
    assert (busy_q == f_busy_q && buffer_q == f_buffer_q);
    assert (column_q == f_x_q && row_q == f_y_q);
    if (f_place_q == 2'd2) assert (f_busy_q[f_buffer_q]);
    for (int n = 0; n < fastsplat_pkg::RLUT_SETS; n++)
      if (f_loaded_q[n]) begin
        assert (rho_q[n] == f_rho_q[n] && base_q[n] == f_first_q[n] && extent_q[n] == f_padded(f_rho_q[n]) && single_q[n] == (extent_q[n] <= COL'(P)));
        assert (f_rho_q[n] != '0 && f_rho_q[n] <= F_RHO);
      end
    if (f_x_q != '0 || f_y_q != '0) assert (f_splat);
    if (f_splat) begin
      assert (f_x_q < f_ea && f_y_q < f_ea && f_x_q % COL'(P) == '0 && f_y_q % COL'(P) == '0);
      if (f_any_x < f_ea && f_any_y < f_ea && f_any_x % COL'(P) == '0 && f_any_y % COL'(P) == '0)
        assert (f_seen_q == 2'(f_any_y < f_y_q || (f_any_y == f_y_q && f_any_x < f_x_q)));
    end
    if (!f_splat) assert (f_seen_q == '0);
    cover (f_done && f_splat && f_x_q == COL'(P) && f_y_q == COL'(P));
    cover (f_have_q && f_opcode == 8'h53 && !f_payload && f_waits && f_busy_q == 2'b11);
    cover (f_done && f_payload && f_index_q == 32'd9);
    cover (f_done && !f_payload && f_opcode == 8'h46 && f_left_q != '0);
    cover (tile_end_o && tile_aborted_o);
    if (fastsplat_pkg::EVERY_SAMPLE != 0) cover (f_over && f_last_x && f_column < 0);
  end
end
