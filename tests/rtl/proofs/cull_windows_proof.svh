// SPDX-License-Identifier: Apache-2.0
// Which windows of a row can be seen (docs/numerics.md, N-6.1-10), written again pixel by pixel and put inside
// cull_windows by prove_cull.sh: one can be unless each of its pixels in the tile lies in an opaque block. Any map, tile, place.
(* anyconst *) logic [fastsplat_pkg::BLOCKS-1:0] f_map;
localparam int F_P = fastsplat_pkg::LANES;
localparam int F_W = fastsplat_pkg::TILE_WIDTH;
localparam int F_H = fastsplat_pkg::TILE_HEIGHT;
always @* begin
  assume (32'(width_i) >= 1 && 32'(width_i) <= F_W && 32'(height_i) >= 1 && 32'(height_i) <= F_H);
  for (int r = 0; r < fastsplat_pkg::BLOCKS_Y; r++) begin
    if (row_o == fastsplat_pkg::BLK_BITS'(r)) assume (row_i == f_map[r*BX+:BX]);
    if (row_o + fastsplat_pkg::BLK_BITS'(1) == fastsplat_pkg::BLK_BITS'(r)) assume (row_below_i == f_map[r*BX+:BX]);
  end
end
logic signed [31:0] f_x, f_y;
assign f_x = x_i;
assign f_y = y_i;
logic [NW-1:0] f_seen;
always @* begin
  f_seen = '0;
  for (int w = 0; w < NW; w++) begin
    for (int y = 0; y < F_H; y++) begin
      for (int x = 0; x < F_W; x++) begin
        if (x < 32'(width_i) && y < 32'(height_i) && x >= f_x + w * F_P && x < f_x + (w + 1) * F_P && y >= f_y &&
            y < f_y + F_P && !f_map[(y/F_P)*BX+x/F_P])
          f_seen[w] = 1'b1;
      end
    end
  end
end
always @* begin
  // In two rows of the block map, for any row length (M-cull-5).
  assert (seen_o == (there_i & (culls_i ? f_seen : '1)));
  // One of two windows of a tile that ends within a block; a whole row, by an opaque block and the tile's edge.
  cover (culls_i && &there_i && seen_o != '0 && seen_o != '1 && 32'(width_i) % F_P != 0);
  cover (culls_i && &there_i && seen_o == '0 && f_map != '1 && f_y < 0);
  cover (!culls_i && &there_i && &seen_o && &f_map);
end
