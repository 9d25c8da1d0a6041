// SPDX-License-Identifier: Apache-2.0
// Stream invariants: properties of the beats that check passes to decode, for any source. Asserted in
// stream_check_proof.svh, assumed in stream_decode_proof.svh (F_INVARIANT). The including file defines the signals
// between the two: f_passed_valid and so on. The grammar as decode sees it: 0 in the frame, 1 in a tile, 2 in a sheet.
logic [1:0] f_passed_place_q;
logic [31:0] f_words_left_q;  // of the table announced last
logic [fastsplat_pkg::RLUT_SETS-1:0] f_passed_sets_q;
logic [7:0] f_passed_opcode;
assign f_passed_opcode = f_passed_data[7:0];

// Ea of a radius set with the radius rho, in words of COL bits: 2 rho / K rounded up to pixels, then to windows.
function automatic logic [COL-1:0] f_padded(input logic [fastsplat_pkg::RHO_BITS-1:0] rho);
  f_padded = COL'(((32'(rho) * 32'd2 + 32'(fastsplat_pkg::PHASES - 1)) / 32'(fastsplat_pkg::PHASES) + 32'(P - 1)) / 32'(P) * 32'(P));
endfunction
// A set's columns lie in the RLUT.
localparam logic [fastsplat_pkg::RHO_BITS-1:0] F_RHO = fastsplat_pkg::RHO_BITS'(fastsplat_pkg::RLUT_COLUMNS * fastsplat_pkg::PHASES / 2);

always @(posedge clk_i) begin
  if (f_passed_valid && f_passed_ready) begin
    if (f_passed_payload) begin
      f_words_left_q <= f_words_left_q > 32'd8 ? f_words_left_q - 32'd8 : '0;
    end else begin
      case (f_passed_opcode)
        8'h46: f_words_left_q <= '0;  // a soft reset cut the table short
        8'h4C: begin
          f_words_left_q <= f_passed_data[127:96];
          if (f_passed_data[15:8] == 8'd0) f_passed_sets_q[f_passed_data[32+:fastsplat_pkg::SET_BITS]] <= 1'b1;
        end
        8'h54: f_passed_place_q <= 2'd1;
        8'h53: f_passed_place_q <= 2'd2;
        8'h73: f_passed_place_q <= 2'd1;
        8'h74: f_passed_place_q <= 2'd0;
        default: ;
      endcase
    end
  end
  if (!rst_ni) begin
    f_passed_place_q <= '0;
    f_words_left_q <= '0;
    f_passed_sets_q <= '0;
  end
end

// The extent is there when decode carries out the header, a cycle after it was passed.
logic f_set_passed_q;
logic [fastsplat_pkg::RHO_BITS-1:0] f_rho_passed_q;
always @(posedge clk_i) begin
  f_set_passed_q <= rst_ni && f_passed_valid && f_passed_ready && !f_passed_payload && f_passed_opcode == 8'h4C && f_passed_data[15:8] == 8'd0;
  f_rho_passed_q <= f_passed_data[64+:fastsplat_pkg::RHO_BITS];
end

always @* begin
  if (f_started && rst_ni) begin
    if (f_set_passed_q) `F_INVARIANT(f_passed_extent == f_padded(f_rho_passed_q));
    if (f_passed_valid) begin
      if (f_passed_payload) begin
        // Payload as announced.
        `F_INVARIANT(f_passed_place_q == 2'd0 && f_words_left_q != '0 && !f_passed_aborted);
      end else begin
        `F_INVARIANT(f_words_left_q == '0 || f_passed_opcode == 8'h46);
        `F_INVARIANT(!f_passed_aborted || f_passed_opcode == 8'h74);
        case (f_passed_opcode)
          8'h46, 8'h4C, 8'h54, 8'h66: `F_INVARIANT(f_passed_place_q == 2'd0);
          8'h53, 8'h74: `F_INVARIANT(f_passed_place_q == 2'd1);
          8'h50, 8'h43, 8'h73: `F_INVARIANT(f_passed_place_q == 2'd2);
          default: `F_INVARIANT(1'b0);
        endcase
        if (f_passed_opcode == 8'h4C) begin
          `F_INVARIANT(f_passed_data[127:96] != '0 && f_passed_data[15:8] <= 8'd2);
          if (f_passed_data[15:8] == 8'd0) begin
            `F_INVARIANT(f_passed_data[63:32] < fastsplat_pkg::RLUT_SETS);
            `F_INVARIANT(f_passed_data[64+:fastsplat_pkg::RHO_BITS] != '0 && f_passed_data[64+:fastsplat_pkg::RHO_BITS] <= F_RHO);
            `F_INVARIANT(f_passed_data[127:96] == 32'(f_padded(f_passed_data[64+:fastsplat_pkg::RHO_BITS])) * 32'(fastsplat_pkg::PHASES));
          end
        end
        if (f_passed_opcode == 8'h50)
          `F_INVARIANT(f_passed_data[15:8] < fastsplat_pkg::RLUT_SETS && f_passed_sets_q[f_passed_data[8+:fastsplat_pkg::SET_BITS]]);
      end
    end
  end
end
