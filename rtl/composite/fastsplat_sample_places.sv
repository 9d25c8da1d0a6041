// SPDX-License-Identifier: Apache-2.0
// Every sample: where the windows in the compositor's pipe lie in the picture, and which of their pixels are needed
// again before they are written (docs/microarchitecture.md, M-hazard-1). A window meets every bank once. A bank's block
// is that of its column and of its row, so places are carried and compared by axis.
// Read in k2, written in k6: a pixel of a window 2, 3 or 4 cycles ago is forwarded into k4. Distance 1 does not occur:
// decode waits.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_sample_places (
    input  logic                                                    clk_i,
    input  logic                                                    rst_ni,   // for the assertions
    input  logic [6:2]                                              valid_i,  // stages of the pipe that hold a window: k2 to k6
    // k1
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] column_i,  // by bank column: column of blocks
    input  logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] row_i,
    input  logic [fastsplat_pkg::LANES-1:0]                         inside_x_i,  // the tile
    input  logic [fastsplat_pkg::LANES-1:0]                         inside_y_i,
    input  logic [fastsplat_pkg::BANKS-1:0]                         weighted_i,  // inside, weight > 0
    // by bank: k2
    output logic [fastsplat_pkg::BANKS*fastsplat_pkg::ADDR_BITS-1:0] raddr_o,
    // k3: the pixel is that of the window 2, 3, 4 cycles ago
    output logic [fastsplat_pkg::BANKS-1:0]                         forward_2_o,
    output logic [fastsplat_pkg::BANKS-1:0]                         forward_3_o,
    output logic [fastsplat_pkg::BANKS-1:0]                         forward_4_o,
    // k6
    output logic [fastsplat_pkg::BANKS*fastsplat_pkg::ADDR_BITS-1:0] waddr_o,
    output logic [fastsplat_pkg::BANKS-1:0]                         written_o,
    output logic [fastsplat_pkg::BANKS-1:0]                         weighted_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int BLK = fastsplat_pkg::BLK_BITS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int BXL = $clog2(fastsplat_pkg::BLOCKS_X);

  logic [P*BLK-1:0] column_q[2:6], row_q[2:6];
  logic [P-1:0] inside_x_q[2:6], inside_y_q[2:6];
  logic [P*P-1:0] weighted_q[2:6];
  always_ff @(posedge clk_i) begin
    column_q[2] <= column_i;
    row_q[2] <= row_i;
    inside_x_q[2] <= inside_x_i;
    inside_y_q[2] <= inside_y_i;
    weighted_q[2] <= weighted_i;
    for (int s = 3; s <= 6; s++) begin
      column_q[s] <= column_q[s-1];
      row_q[s] <= row_q[s-1];
      inside_x_q[s] <= inside_x_q[s-1];
      inside_y_q[s] <= inside_y_q[s-1];
      weighted_q[s] <= weighted_q[s-1];
    end
  end
  assign weighted_o = `FASTSPLAT_FAULT(SAMPLE_WEIGHTLESS) ? written_o : weighted_q[6];

  // k2 against k3 to k6: same column, same row of pixels as the window 1 to 4 cycles ago.
  logic [P-1:0] same_x[1:4], same_y[1:4], same_x_q[2:4], same_y_q[2:4];
  for (genvar d = 1; d <= 4; d++) begin : gen_distance
    for (genvar g = 0; g < P; g++) begin : gen_axis
      assign same_x[d][g] = valid_i[2+d] && (inside_x_q[2+d][g] || (d > 1 && `FASTSPLAT_FAULT(SAMPLE_EDGE))) && column_q[2+d][g*BLK+:BLK] == column_q[2][g*BLK+:BLK];
      assign same_y[d][g] = valid_i[2+d] && inside_y_q[2+d][g] && row_q[2+d][g*BLK+:BLK] == row_q[2][g*BLK+:BLK];
    end
  end
  always_ff @(posedge clk_i) begin
    for (int d = 2; d <= 4; d++) begin
      same_x_q[d] <= same_x[d];
      same_y_q[d] <= same_y[d];
    end
  end

  for (genvar h = 0; h < P; h++) begin : gen_row
    for (genvar g = 0; g < P; g++) begin : gen_bank
      localparam int B = h * P + g;
      assign raddr_o[B*AB+:AB] = (AB'(row_q[2][(`FASTSPLAT_FAULT(SAMPLE_ROW) ? 0 : h)*BLK+:BLK]) << BXL) | AB'(column_q[2][g*BLK+:BLK]);
      assign waddr_o[B*AB+:AB] = (AB'(row_q[6][h*BLK+:BLK]) << BXL) | AB'(column_q[6][g*BLK+:BLK]);
      assign written_o[B] = valid_i[6] && inside_x_q[6][g] && inside_y_q[6][h];
      assign forward_2_o[B] = same_x_q[2][g] && same_y_q[2][h] && !`FASTSPLAT_FAULT(SAMPLE_FORWARD_2);
      assign forward_3_o[B] = same_x_q[3][g] && same_y_q[3][h] && !`FASTSPLAT_FAULT(SAMPLE_FORWARD_3);
      assign forward_4_o[B] = same_x_q[4][g] && same_y_q[4][h] && !`FASTSPLAT_FAULT(SAMPLE_FORWARD_4);
    end
  end
  `FASTSPLAT_ASSERT(samples_apart, !valid_i[2] || (same_x[1] & inside_x_q[2]) == '0 || (same_y[1] & inside_y_q[2]) == '0)
  `FASTSPLAT_COVER(sample_met_after_2, valid_i[3] && forward_2_o != '0)
  `FASTSPLAT_COVER(sample_met_after_3, valid_i[3] && forward_3_o != '0)
  `FASTSPLAT_COVER(sample_met_after_4, valid_i[3] && forward_4_o != '0)
endmodule
