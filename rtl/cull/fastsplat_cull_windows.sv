// SPDX-License-Identifier: Apache-2.0
// Visible windows of a row of windows: they meet a block of the tile that is not opaque (docs/numerics.md, N-6.1-10;
// docs/microarchitecture.md, "Test unit"). A row of windows meets two rows of blocks, a window two columns of them.

module fastsplat_cull_windows (
    input  logic                                       culls_i,  // else all are visible
    input  logic signed [fastsplat_pkg::ORG_BITS-1:0]  x_i,      // the row's first pixel
    input  logic signed [fastsplat_pkg::ORG_BITS-1:0]  y_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]        width_i,  // of the tile
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]        height_i,
    input  logic [fastsplat_pkg::WINDOWS_X-1:0]        there_i,  // existing windows, from the first on
    // the map
    output logic [fastsplat_pkg::BLK_BITS-1:0]         row_o,
    input  logic [fastsplat_pkg::BLOCKS_X-1:0]         row_i,    // opaque blocks of that row
    input  logic [fastsplat_pkg::BLOCKS_X-1:0]         row_below_i,
    output logic [fastsplat_pkg::WINDOWS_X-1:0]        seen_o
);
  localparam int PL = fastsplat_pkg::LANE_LOG2;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;
  localparam int ORG = fastsplat_pkg::ORG_BITS;
  localparam int NW = fastsplat_pkg::WINDOWS_X;

  logic signed [ORG:0] column, row, rows, columns;  // of blocks
  logic between_x, between_y;                       // the window meets a second column, row
  assign column = (ORG + 1)'(x_i) >>> PL;
  assign row = (ORG + 1)'(y_i) >>> PL;
  assign between_x = x_i[PL-1:0] != '0;
  assign between_y = y_i[PL-1:0] != '0;
  assign columns = $signed(((ORG + 1)'(width_i) + (ORG + 1)'(fastsplat_pkg::LANES - 1)) >> PL);
  assign rows = $signed(((ORG + 1)'(height_i) + (ORG + 1)'(fastsplat_pkg::LANES - 1)) >> PL);
  assign row_o = row[fastsplat_pkg::BLK_BITS-1:0];

  logic first_out, second_out;  // the windows miss the tile: in the row of blocks, in the row below
  logic [BX-1:0] seen;          // columns of blocks
  logic [NW-1:0] first, second;  // by window: it meets a visible block in its first column, in the next one
  assign first_out = row < 0 || (ORG + 1)'(y_i) >= $signed((ORG + 1)'(height_i));
  assign second_out = row < -1 || row >= rows - 1 || !between_y;
  always_comb begin
    for (int b = 0; b < BX; b++) seen[b] = (ORG + 1)'(b) < columns && ((!first_out && !row_i[b]) || (!second_out && !row_below_i[b]));
    first = '0;
    second = '0;
    for (int w = 0; w < NW; w++) begin
      for (int b = 0; b < BX; b++) begin
        // In the tile's last column of blocks, windows may begin behind the tile's last pixel.
        if (column + (ORG + 1)'(w) == (ORG + 1)'(b)) first[w] = seen[b] && (SIDE'(b << PL) | SIDE'(x_i[PL-1:0])) < width_i;
        if (column + (ORG + 1)'(w) + (ORG + 1)'(1) == (ORG + 1)'(b)) second[w] = seen[b] && between_x;
      end
      seen_o[w] = there_i[w] && (!culls_i || first[w] || second[w]);
    end
  end
endmodule
