// SPDX-License-Identifier: Apache-2.0
// Unit "cull": four registers between check and decode, in which cull groups and splats are tested
// (docs/microarchitecture.md, "Test unit"; cmodel/cycles/cull_pipe.hpp, cmodel/model.cpp).
// Registers: t0 beat, its centre on the grid -> t1 rectangle, clipped to the tile, in cells -> t2 the table's words ->
// t3 verdict.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_cull_test (
    input  logic                                       clk_i,
    input  logic                                       rst_ni,
    // legal beats
    input  logic                                       valid_i,
    output logic                                       ready_o,
    input  logic [fastsplat_pkg::BEAT_BITS-1:0]        data_i,
    input  logic                                       payload_i,
    input  logic                                       aborted_i,
    input  logic [fastsplat_pkg::COL_BITS-1:0]         extent_i,  // padded extent of the set announced last; of the beat in t0
    // to decode
    output logic                                       valid_o,
    input  logic                                       ready_i,
    output logic [fastsplat_pkg::BEAT_BITS-1:0]        data_o,
    output logic                                       payload_o,
    output logic                                       aborted_o,
    output logic [fastsplat_pkg::COL_BITS-1:0]         extent_o,  // of the beat in t3
    output logic                                       swallowed_o,  // a splat of a hidden group
    output logic                                       hidden_o,     // a splat that is hidden itself
    output logic                                       culls_o,      // its tile is culled
    output logic                                       sheet_o,      // its sheet's number in the tile, modulo 2
    output logic signed [fastsplat_pkg::ORG_BITS-1:0]  x_o,          // a splat's first pixel
    output logic signed [fastsplat_pkg::ORG_BITS-1:0]  y_o,
    // the map
    input  logic                                       tile_begin_i,  // carried out in decode
    input  logic                                       whole_i,       // a sheet's table is whole from the next cycle on
    output logic                                       re_o,
    output logic                                       re_sheet_o,
    output logic [fastsplat_pkg::CULL_CELL_BITS-1:0]   i0_o,
    output logic [fastsplat_pkg::CULL_CELL_BITS-1:0]   i1_o,
    output logic [fastsplat_pkg::CULL_CELL_BITS-1:0]   j0_o,
    output logic [fastsplat_pkg::CULL_CELL_BITS-1:0]   j1_o,
    input  logic [fastsplat_pkg::CULL_BITS-1:0]        count_i,       // a cycle after re_o
    // to the source: for each cull_block, in its first cycle in t3
    output logic                                       verdict_valid_o,
    output logic [31:0]                                verdict_tag_o,
    output logic                                       verdict_hidden_o,
    // status
    output logic                                       idle_o,        // no beat is here
    output logic                                       event_test_o,  // the beat that goes to decode was tested
    output logic                                       event_hidden_set_o
);
  localparam int BITS = fastsplat_pkg::BEAT_BITS;
  localparam int COL = fastsplat_pkg::COL_BITS;
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;
  localparam int ORG = fastsplat_pkg::ORG_BITS;
  localparam int PB = fastsplat_pkg::POS_BITS;
  localparam int SET = fastsplat_pkg::SET_BITS;
  localparam int CB = fastsplat_pkg::CULL_CELL_BITS;
  localparam int UL = fastsplat_pkg::CULL_CELL_LOG2;
  localparam int TB = fastsplat_pkg::CULL_BITS;
  localparam int XB = (ORG > 32 ? ORG : 32) + 2;  // sums of a rectangle's corner and side

  // ---- carried with the beat, by register
  logic [3:0] valid_q;
  logic [BITS-1:0] beat_q[0:3];
  logic [3:0] payload_q, aborted_q;
  logic [COL-1:0] extent_q[1:3];
  logic [3:1] test_q, culls_q, sheet_q;
  logic [3:0] moves;  // the register's beat, to the next one
  logic holds;
  assign moves[3] = valid_q[3] && ready_i;
  assign moves[2] = valid_q[2] && (!valid_q[3] || ready_i);
  assign moves[1] = valid_q[1] && (valid_q[3:2] != '1 || ready_i);
  assign moves[0] = valid_q[0] && (valid_q[3:1] != '1 || ready_i) && !holds;
  assign ready_o = !valid_q[0] || moves[0];
  assign idle_o = valid_q == '0;

  logic [7:0] opcode;  // t0
  logic is_set, is_ellipse, is_splat;  // splat: a circle or an ellipse
  assign opcode = beat_q[0][7:0];
  assign is_set = opcode == fastsplat_pkg::OP_CULL_BLOCK;
  assign is_ellipse = fastsplat_pkg::ELLIPSES != 0 && opcode == fastsplat_pkg::OP_ELLIPSE;
  assign is_splat = opcode == fastsplat_pkg::OP_SPLAT || is_ellipse;

  // ---- t0: where in the frame the beat stands
  logic [fastsplat_pkg::RHO_BITS-1:0] rho_q[0:fastsplat_pkg::RLUT_SETS-1];
  logic [COL-1:0] padded_q[0:fastsplat_pkg::RLUT_SETS-1];
  logic [SIDE-1:0] width_q, height_q;
  logic tile_culls_q, mapped_q;    // mapped: the sheet is not one of the tile's first two
  logic [1:0] begun_q, whole_q;    // begin_sheets of the tile that left t0, and whole tables, modulo 4
  logic second_q;                  // there were two, or more
  logic begins_sheet;
  assign begins_sheet = !payload_q[0] && opcode == fastsplat_pkg::OP_BEGIN_SHEET;
  // When a third begin_sheet is here, the tile's begin_tile was carried out: four records lie between them.
  assign holds = begins_sheet && tile_culls_q && second_q && begun_q - whole_q == 2'd2;
  always_ff @(posedge clk_i) begin
    if (whole_i) whole_q <= whole_q + 2'd1;
    if (tile_begin_i) whole_q <= '0;
    if (moves[0] && !payload_q[0]) begin
      case (opcode)
        fastsplat_pkg::OP_LOAD_TABLE: begin
          if (beat_q[0][15:8] == fastsplat_pkg::TABLE_RLUT) begin
            rho_q[beat_q[0][32+:SET]] <= beat_q[0][64+:fastsplat_pkg::RHO_BITS];
            padded_q[beat_q[0][32+:SET]] <= extent_i;
          end
        end
        fastsplat_pkg::OP_BEGIN_TILE: begin
          width_q <= beat_q[0][128+:SIDE];
          height_q <= beat_q[0][144+:SIDE];
          tile_culls_q <= beat_q[0][11:8] < 4'd2;
          begun_q <= '0;
          second_q <= 1'b0;
          mapped_q <= 1'b0;
        end
        fastsplat_pkg::OP_BEGIN_SHEET: begin
          begun_q <= begun_q + 2'd1;
          second_q <= second_q || begun_q == 2'd1;
          mapped_q <= second_q;
        end
        default: ;
      endcase
    end
    if (!rst_ni) begin
      tile_culls_q <= 1'b0;
      whole_q <= '0;
    end
  end

  // ---- t0: a splat's first pixel, snapped on its way in
  logic fresh_q;
  logic [fastsplat_pkg::RHO_BITS-1:0] rho_in;
  logic signed [ORG-1:0] snapped_x, snapped_y, corner_x, corner_y, held_x_q, held_y_q, x, y;
  logic [fastsplat_pkg::PHASE_BITS-1:0] phase_x, phase_y;
  logic saturated_x, saturated_y;
  localparam logic [COL-1:0] NO_COLUMN = '0;
  assign rho_in = rho_q[data_i[8+:SET]];
  fastsplat_snap u_snap_x (.clk_i, .centre_i(data_i[64+:PB]), .rho_i(rho_in), .column_i(NO_COLUMN), .origin_o(snapped_x), .phase_o(phase_x), .saturated_o(saturated_x));
  fastsplat_snap u_snap_y (.clk_i, .centre_i(data_i[96+:PB]), .rho_i(rho_in), .column_i(NO_COLUMN), .origin_o(snapped_y), .phase_o(phase_y), .saturated_o(saturated_y));
  // An ellipse's is in its record, relative to the pixel of its centre.
  if (fastsplat_pkg::ELLIPSES != 0) begin : gen_ellipse
    localparam int PF = fastsplat_pkg::POS_FRAC;
    logic signed [PB-1:0] centre_x, centre_y;
    assign centre_x = data_i[64+:PB];
    assign centre_y = data_i[96+:PB];
    always_ff @(posedge clk_i) begin
      corner_x <= ORG'(32'(centre_x) >>> PF) + (`FASTSPLAT_FAULT(CULL_ELLIPSE) ? '0 : ORG'($signed(data_i[214+:10])));
      corner_y <= ORG'(32'(centre_y) >>> PF) + ORG'($signed(data_i[246+:10]));
    end
  end else begin : gen_circles
    assign {corner_x, corner_y} = '0;
  end
  assign x = !fresh_q ? held_x_q : is_ellipse ? corner_x : snapped_x;
  assign y = !fresh_q ? held_y_q : is_ellipse ? corner_y : snapped_y;
  always_ff @(posedge clk_i) begin
    fresh_q <= ready_o;
    held_x_q <= x;
    held_y_q <= y;
  end

  // ---- t0 to t1: the rectangle, clipped, in cells
  logic signed [XB-1:0] left, right, top, bottom, width, height;
  logic [COL-1:0] padded;
  logic [15:0] side_x, side_y;  // pixels
  logic [SIDE-1:0] x0, x1, y0, y1;
  assign padded = padded_q[beat_q[0][8+:SET]];
  assign left = is_set ? XB'($signed(beat_q[0][64+:32])) : XB'(x);
  assign top = is_set ? XB'($signed(beat_q[0][96+:32])) : XB'(y);
  assign side_x = is_set ? beat_q[0][128+:16] : is_ellipse ? (16'(beat_q[0][86+:5]) + 16'd1) << fastsplat_pkg::LANE_LOG2 : 16'(padded);
  assign side_y = is_set ? beat_q[0][144+:16] : is_ellipse ? (16'(beat_q[0][91+:5]) + 16'd1) << fastsplat_pkg::LANE_LOG2 : 16'(padded);
  assign right = left + $signed(XB'(side_x));
  assign bottom = top + $signed(XB'(side_y));
  assign width = $signed(XB'(width_q));
  assign height = $signed(XB'(height_q));
  assign x0 = left[XB-1] ? '0 : left[SIDE-1:0];
  assign y0 = top[XB-1] ? '0 : top[SIDE-1:0];
  assign x1 = (right > width) ? width_q : right[SIDE-1:0];
  assign y1 = (bottom > height) ? height_q : bottom[SIDE-1:0];
  logic empty_q, t1_mapped_q;
  logic signed [ORG-1:0] x_q[1:3], y_q[1:3];
  logic [CB-1:0] i0_q, i1_q, j0_q, j1_q;
  always_ff @(posedge clk_i) begin
    if (moves[0]) begin
      empty_q <= right <= 0 || bottom <= 0 || left >= width || top >= height;
      i0_q <= CB'(x0 >> UL);
      j0_q <= CB'(y0 >> UL);
      i1_q <= CB'((x1 + SIDE'((1 << UL) - 1)) >> UL);
      j1_q <= CB'((y1 + SIDE'((1 << UL) - 1)) >> UL);
      t1_mapped_q <= mapped_q;
    end
  end
  assign {i0_o, i1_o, j0_o, j1_o} = {i0_q, i1_q, j0_q, j1_q};
  assign re_o = moves[1] && test_q[1] && t1_mapped_q && !empty_q;
  assign re_sheet_o = sheet_q[1] != `FASTSPLAT_FAULT(CULL_NEWER_MAP);

  // ---- t2: all cells of the rectangle are opaque; t3
  logic t2_empty_q, t2_mapped_q, hidden_q, new_q;
  logic [TB-1:0] area_q;
  always_ff @(posedge clk_i) begin
    if (moves[1]) begin
      t2_empty_q <= empty_q;
      t2_mapped_q <= t1_mapped_q;
      area_q <= (TB'(i1_q) - TB'(i0_q)) * (TB'(j1_q) - TB'(j0_q));
    end
    if (moves[2]) hidden_q <= test_q[2] && (t2_empty_q || (t2_mapped_q && count_i == area_q));
    new_q <= moves[2];
  end

  always_ff @(posedge clk_i) begin
    valid_q <= (valid_q & ~moves) | {moves[2:0], 1'b0};
    if (ready_o) begin
      valid_q[0] <= valid_i;
      beat_q[0] <= data_i;
      payload_q[0] <= payload_i;
      aborted_q[0] <= aborted_i;
    end
    if (moves[0]) begin
      extent_q[1] <= extent_i;
      culls_q[1] <= tile_culls_q;
      sheet_q[1] <= !begun_q[0];  // begin_sheet counted itself
      test_q[1] <= tile_culls_q && !payload_q[0] && (is_set || is_splat);
      x_q[1] <= x;
      y_q[1] <= y;
    end
    for (int s = 1; s <= 3; s++) begin
      if (moves[s-1]) begin
        beat_q[s] <= beat_q[s-1];
        payload_q[s] <= payload_q[s-1];
        aborted_q[s] <= aborted_q[s-1];
      end
    end
    for (int s = 2; s <= 3; s++) begin
      if (moves[s-1]) begin
        extent_q[s] <= extent_q[s-1];
        culls_q[s] <= culls_q[s-1];
        sheet_q[s] <= sheet_q[s-1];
        test_q[s] <= test_q[s-1];
        x_q[s] <= x_q[s-1];
        y_q[s] <= y_q[s-1];
      end
    end
    if (!rst_ni) valid_q <= '0;
  end

  // ---- t3: which cull group a splat belongs to
  logic of_set, of_splat, set_hidden;
  assign of_set = test_q[3] && data_o[7:0] == fastsplat_pkg::OP_CULL_BLOCK;
  assign of_splat = test_q[3] && !of_set;
  fastsplat_cull_sets u_sets (
      .clk_i,
      .rst_ni,
      .clear_i(moves[3] && !payload_o && data_o[7:0] == fastsplat_pkg::OP_BEGIN_TILE),
      .push_i(moves[3] && of_set && data_o[160+:32] != '0),
      .tag_i(data_o[32+:32]),
      .splats_i(data_o[160+:32]),
      .hidden_i(hidden_q),
      .splat_i(moves[3] && of_splat),
      .hidden_o(set_hidden)
  );
  assign valid_o = valid_q[3];
  assign data_o = beat_q[3];
  assign payload_o = payload_q[3];
  assign aborted_o = aborted_q[3];
  assign extent_o = extent_q[3];
  assign culls_o = culls_q[3];
  assign sheet_o = sheet_q[3];
  assign x_o = x_q[3];
  assign y_o = y_q[3];
  assign swallowed_o = of_splat && set_hidden;
  assign hidden_o = of_splat && hidden_q;
  assign verdict_valid_o = valid_q[3] && new_q && !payload_o && data_o[7:0] == fastsplat_pkg::OP_CULL_BLOCK;
  assign verdict_tag_o = data_o[63:32];
  assign verdict_hidden_o = hidden_q;
  assign event_test_o = moves[3] && (of_set || (of_splat && !set_hidden));
  assign event_hidden_set_o = moves[3] && of_set && hidden_q;
  logic unused;
  assign unused = &{1'b0, phase_x, phase_y, saturated_x, saturated_y, left, right, top, bottom};

  `FASTSPLAT_ASSERT_HELD(tested_beat_held, valid_o && !ready_i, valid_o, {data_o, payload_o, aborted_o, swallowed_o, hidden_o})
  `FASTSPLAT_ASSERT(tables_two_behind, !(begins_sheet && valid_q[0] && tile_culls_q && second_q) || begun_q - whole_q != 2'd3)
endmodule
