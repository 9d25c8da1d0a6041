// SPDX-License-Identifier: Apache-2.0
// The map of opaque cull cells and its two tables (docs/numerics.md, section 6.1; docs/microarchitecture.md, "Map";
// cmodel/cull/cull_unit.hpp, cmodel/cycles/cull_pipe.hpp). Sheet j of a tile has table j mod 2. What the compositor
// writes while a table is built belongs to the next sheet (M-cull-13). So each table has its own copy of the block map,
// taken when its sheet left k6. Pixels that a sheet terminated are kept by j mod 2 and merged as the table is built.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_cull_map (
    input  logic                                        clk_i,
    input  logic                                        rst_ni,
    // tile: begun, ended; whether it is culled; its sides
    input  logic                                        tile_begin_i,
    input  logic                                        tile_end_i,
    input  logic                                        culls_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]         width_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]         height_i,
    // k6 of a block's last slice: pixels terminated or outside the tile; whether one in the tile is newly terminated
    input  logic                                        block_valid_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]         block_i,
    input  logic [fastsplat_pkg::BANKS-1:0]             frozen_i,
    input  logic                                        changed_i,
    input  logic                                        finish_i,  // k0: a sheet's last pick
    // the picture's words are blanked: after reset, and behind pixel out
    input  logic                                        blank_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]         blank_addr_i,
    output logic                                        whole_o,   // a sheet's table is whole from the next cycle on
    // a rectangle of cells; a cycle later the number of opaque cells in it
    input  logic                                        re_i,
    input  logic                                        sheet_i,   // j mod 2
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    i0_i,
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    i1_i,
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    j0_i,
    input  logic [fastsplat_pkg::CULL_CELL_BITS-1:0]    j1_i,
    output logic [fastsplat_pkg::CULL_BITS-1:0]         count_o,
    // a row of windows: opaque blocks of a row of blocks and of the row below
    input  logic                                        row_sheet_i,
    input  logic [fastsplat_pkg::BLK_BITS-1:0]          row_i,
    output logic [fastsplat_pkg::BLOCKS_X-1:0]          row_o,
    output logic [fastsplat_pkg::BLOCKS_X-1:0]          row_below_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int PL = fastsplat_pkg::LANE_LOG2;
  localparam int BX = fastsplat_pkg::BLOCKS_X;
  localparam int BXL = $clog2(BX);
  localparam int BY = fastsplat_pkg::BLOCKS_Y;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int RB = fastsplat_pkg::BLK_BITS;
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;
  localparam int K = fastsplat_pkg::CULL_WORDS;
  localparam int NC = fastsplat_pkg::CULL_CHUNKS;
  localparam int NL = $clog2(NC);
  localparam int B = fastsplat_pkg::CULL_BITS;
  localparam int TA = fastsplat_pkg::CULL_ADDR_BITS;
  localparam bit PIXELS = fastsplat_pkg::CULL_MAP == 2;
  localparam int WR = PIXELS ? RB + PL : RB;  // a row of cells
  localparam int AW = AB + WR;  // a row of cells has more bits than its block's address, or fewer

  // ---- current block map
  logic parity_q;  // of the sheet in k6
  logic [BX-1:0] column_bit;
  logic opaque, came;  // the block is opaque; it made a cell opaque
  logic [RB-1:0] block_row;
  assign block_row = RB'(block_i >> BXL);
  assign opaque = frozen_i == '1;
  assign came = block_valid_i && culls_i && changed_i && (PIXELS || opaque);
  assign column_bit = BX'(1) << (block_i & AB'(BX - 1));

  // ---- copies of the map, by row: two cycles after k6 of a sheet's last pick. The next sheet's first block is in k6
  // two cycles later.
  logic [7:1] finish_q;
  logic [BX-1:0] copy[0:2*BY-1];
  for (genvar r = 0; r < BY; r++) begin : gen_row
    logic [BX-1:0] row_q;
    always_ff @(posedge clk_i) begin
      if (block_valid_i && culls_i && opaque && block_row == RB'(r)) row_q <= row_q | column_bit;
      if (!rst_ni || (tile_begin_i && !`FASTSPLAT_FAULT(CULL_STALE_MAP))) row_q <= '0;
    end
    for (genvar p = 0; p < 2; p++) begin : gen_copy
      logic [BX-1:0] copy_q;
      always_ff @(posedge clk_i) begin
        if (finish_q[7] && parity_q != 1'(p)) copy_q <= row_q;  // of the sheet before
        if (!rst_ni || tile_begin_i) copy_q <= '0;
      end
      assign copy[p*BY+r] = copy_q;
    end
  end
  always_comb begin
    row_o = '0;
    row_below_o = '0;
    for (int r = 0; r < BY; r++) begin
      if (row_i == RB'(r)) row_o = row_o | (row_sheet_i ? copy[BY+r] : copy[r]);
      if (row_i + RB'(1) == RB'(r)) row_below_o = row_below_o | (row_sheet_i ? copy[BY+r] : copy[r]);
    end
  end

  // ---- first row of blocks from which a table has to be built
  logic sheet_came_q, any_q;  // a cell became opaque: of this sheet, of the tile
  logic [RB-1:0] sheet_row_q, sheet_row, left_row, other_row;
  logic sheet_came, left_any;
  logic [1:0] built_q;  // by table: built in this tile
  logic [1:0] old_q;  // by table: rows from old_row_q on are out of date
  logic [RB-1:0] old_row_q[0:1];
  assign sheet_came = sheet_came_q || came;
  assign sheet_row = sheet_came_q ? sheet_row_q : block_row;  // blocks come row by row
  // of the table of the sheet that leaves k6
  assign left_any = (any_q || sheet_came) && (old_q[parity_q] || sheet_came);
  assign left_row = (old_q[parity_q] && (!sheet_came || old_row_q[parity_q] <= sheet_row)) ? old_row_q[parity_q] : sheet_row;
  assign other_row = (old_q[!parity_q] && old_row_q[!parity_q] <= sheet_row) ? old_row_q[!parity_q] : sheet_row;

  // ---- building: a row of cells, or P of them, a cycle. b0 counts cycles; b1 has the map's bits and the words above
  logic leaves;  // k6 of a sheet's last pick
  logic work_q, table_q, waits_q, waits_any_q, last, start, start_waiting;
  logic [RB-1:0] waits_row_q;
  logic [WR-1:0] row_q, last_row;
  logic [BXL:0] chunk_q, chunks;
  logic [SIDE-1:0] rows, columns;
  assign rows = (height_i + SIDE'(P - 1)) >> PL;
  assign columns = (width_i + SIDE'(P - 1)) >> PL;
  assign chunks = PIXELS ? (BXL + 1)'(columns) : (BXL + 1)'(1);
  assign last_row = PIXELS ? WR'((rows << PL) - SIDE'(1)) : WR'(rows - SIDE'(1));
  logic unused_columns;
  assign unused_columns = &{1'b0, columns};
  assign leaves = finish_q[6] && culls_i;
  assign last = work_q && row_q == last_row && chunk_q == chunks - (BXL + 1)'(1);
  // A sheet that leaves while another table is built waits; there is never a third.
  assign start = leaves && left_any && (!work_q || last);
  assign start_waiting = waits_q && waits_any_q && last;
  assign whole_o = last || (leaves && !left_any && !work_q) || (waits_q && !waits_any_q && !work_q);

  always_ff @(posedge clk_i) begin
    finish_q <= {finish_q[6:1], finish_i};
    if (came) begin
      sheet_came_q <= 1'b1;
      if (!sheet_came_q) sheet_row_q <= block_row;
    end
    if (leaves) begin
      parity_q <= !parity_q;
      sheet_came_q <= 1'b0;
      any_q <= any_q || sheet_came;
      if (any_q || sheet_came) old_q[parity_q] <= 1'b0;
      if (sheet_came) begin
        old_q[!parity_q] <= 1'b1;
        old_row_q[!parity_q] <= other_row;
      end
    end

    if (work_q) begin
      chunk_q <= chunk_q + (BXL + 1)'(1);
      if (chunk_q == chunks - (BXL + 1)'(1)) begin
        chunk_q <= '0;
        row_q <= row_q + WR'(1);
      end
      if (last) work_q <= 1'b0;
    end
    if (waits_q && !work_q) waits_q <= 1'b0;
    if (leaves && work_q && !(left_any && last)) begin
      waits_q <= 1'b1;
      waits_any_q <= left_any;
      waits_row_q <= left_row;
    end
    if (start || start_waiting) begin
      work_q <= 1'b1;
      table_q <= start ? parity_q : !parity_q;
      chunk_q <= '0;
      row_q <= (start ? WR'(left_row) : WR'(waits_row_q)) << (PIXELS ? PL : 0);
      waits_q <= 1'b0;
      built_q[start ? parity_q : !parity_q] <= 1'b1;
    end
    if (!rst_ni || tile_begin_i || tile_end_i) begin
      finish_q <= '0;
      parity_q <= 1'b0;
      sheet_came_q <= 1'b0;
      any_q <= 1'b0;
      built_q <= '0;
      old_q <= 2'b11;  // all rows of both tables
      old_row_q[0] <= '0;
      old_row_q[1] <= '0;
      work_q <= 1'b0;
      waits_q <= 1'b0;
    end
  end

  // b1
  logic b1_valid_q, b1_table_q, b1_first_q, b1_begin_q, begun_q;
  logic [TA-1:0] b1_addr_q;
  logic [WR-1:0] b1_row_q;
  logic [K-1:0] bits;
  logic [B-1:0] count_q;
  logic [K*B-1:0] above, above_0, above_1, sums, sums_q;
  logic [TA-1:0] address;
  assign address = (TA'(row_q) << NL) | ((NC > 1) ? TA'(chunk_q) : '0);
  always_comb begin
    // Where a row is one memory word of the tile, the row above was written in this cycle and is still in sums_q.
    above = (b1_row_q == '0) ? '0 : (chunks == (BXL + 1)'(1) && !b1_begin_q) ? sums_q : b1_table_q ? above_1 : above_0;
    sums = '0;
    for (int k = 0; k < K; k++) begin
      sums[k*B+:B] = above[k*B+:B] + (b1_first_q ? '0 : count_q);
      for (int l = 0; l < K; l++) if (l <= k) sums[k*B+:B] = sums[k*B+:B] + B'(bits[l]);
    end
  end
  always_ff @(posedge clk_i) begin
    b1_valid_q <= work_q && rst_ni;
    b1_table_q <= table_q;
    b1_addr_q <= address;
    b1_row_q <= row_q;
    b1_first_q <= chunk_q == '0;
    b1_begin_q <= !begun_q;  // a build begins: sums_q is not the row above
    begun_q <= work_q && !last;
    if (b1_valid_q) begin
      sums_q <= sums;
      count_q <= sums[(K-1)*B+:B] - above[(K-1)*B+:B];
    end
  end
  logic [B-1:0] count_0, count_1;
  logic sheet_q;
  always_ff @(posedge clk_i) if (re_i) sheet_q <= sheet_i;
  assign count_o = !built_q[sheet_q] ? '0 : sheet_q ? count_1 : count_0;
  fastsplat_cull_table u_table_0 (
      .clk_i,
      .build_re_i(work_q && !table_q),
      .build_raddr_i(address - TA'(NC)),
      .build_o(above_0),
      .we_i(b1_valid_q && !b1_table_q),
      .waddr_i(b1_addr_q),
      .wdata_i(sums),
      .re_i(re_i && !sheet_i),
      .i0_i,
      .i1_i,
      .j0_i,
      .j1_i,
      .count_o(count_0)
  );
  fastsplat_cull_table u_table_1 (
      .clk_i,
      .build_re_i(work_q && table_q),
      .build_raddr_i(address - TA'(NC)),
      .build_o(above_1),
      .we_i(b1_valid_q && b1_table_q),
      .waddr_i(b1_addr_q),
      .wdata_i(sums),
      .re_i(re_i && sheet_i),
      .i0_i,
      .i1_i,
      .j0_i,
      .j1_i,
      .count_o(count_1)
  );

  // ---- the map's bits of b1
  if (PIXELS) begin : gen_pixels
    logic [AB-1:0] blocks_above;  // rows of blocks
    assign blocks_above = AB'(AW'(row_q) >> PL);
    fastsplat_cull_pixels u_pixels (
        .clk_i,
        .blank_i,
        .blank_addr_i,
        .frozen_valid_i(block_valid_i && culls_i),
        .frozen_sheet_i(parity_q),
        .frozen_block_i(block_i),
        .frozen_i,
        .re_i(work_q),
        .sheet_i(table_q),
        .block_i((blocks_above << BXL) | AB'(chunk_q)),
        .line_i(row_q[PL-1:0]),
        .bits_o(bits)
    );
  end else begin : gen_blocks
    always_comb begin
      bits = '0;
      for (int r = 0; r < BY; r++) if (b1_row_q == WR'(r)) bits = bits | (b1_table_q ? copy[BY+r] : copy[r]);
    end
    logic unused;
    assign unused = &{1'b0, blank_i, blank_addr_i};
  end
  `FASTSPLAT_ASSERT(no_third_table, !(leaves && waits_q))
  `FASTSPLAT_ASSERT(no_test_while_built, !(re_i && work_q && table_q == sheet_i))
endmodule
