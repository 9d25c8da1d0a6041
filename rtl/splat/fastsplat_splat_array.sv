// SPDX-License-Identifier: Apache-2.0
// The splat path: one window a cycle, always moving (docs/microarchitecture.md, "Splat path").
// c0 window in -> c1 snapped -> c2 RLUT words -> c3 bank order -> c4 q -> c5 weight -> c6 products = A -> B -> C -> W.
// With interpolated weights i1 and i2 lie between c5 and c6.
`include "assertions.svh"
`include "fault.svh"

module fastsplat_splat_array (
    input  logic                                            clk_i,
    input  logic                                            rst_ni,
    // table load, one word a cycle
    input  logic                                            rlut_we_i,
    input  logic [fastsplat_pkg::PHASE_BITS-1:0]            rlut_wphase_i,
    input  logic [fastsplat_pkg::COL_BITS-1:0]              rlut_wcolumn_i,
    input  logic                                            radial_we_i,
    input  logic [fastsplat_pkg::RADIAL_LOG2:0]             radial_waddr_i,
    input  logic [fastsplat_pkg::TABLE_BITS-1:0]            table_word_i,  // RLUT or radial word
    // tile, held
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]             width_i,
    input  logic [fastsplat_pkg::SIDE_BITS-1:0]             height_i,
    input  logic                                            every_sample_i,  // windows are composited, not summed up
    input  logic                                            densities_i,     // sheets have a halo of one pixel
    // c0
    input  logic                                            valid_i,     // a window
    input  logic                                            last_i,      // an end-of-sheet token; needs no window
    input  logic                                            first_window_i,
    input  logic                                            buffer_i,
    input  logic [31:0]                                     tag_i,
    input  logic signed [fastsplat_pkg::POS_BITS-1:0]       x_i,
    input  logic signed [fastsplat_pkg::POS_BITS-1:0]       y_i,
    input  logic [fastsplat_pkg::RHO_BITS-1:0]              rho_i,
    input  logic [fastsplat_pkg::COL_BITS-1:0]              base_i,
    input  logic [fastsplat_pkg::WINDOW_BITS-1:0]           column_i,    // of the window within the footprint, pixels
    input  logic [fastsplat_pkg::WINDOW_BITS-1:0]           row_i,
    input  logic                                            ellipse_i,
    input  logic [fastsplat_pkg::SHAPE_BITS-1:0]            shape_i,     // {top, left, h, C, B, A}
    input  logic [4*fastsplat_pkg::COLOUR_BITS-1:0]         colour_i,
    // dirty blocks of the window at c3
    output logic                                            dirty_valid_o,
    output logic                                            dirty_buffer_o,
    output logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] dirty_column_o,
    output logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] dirty_row_o,
    output logic [fastsplat_pkg::LANES-1:0]                 dirty_inside_x_o,
    output logic [fastsplat_pkg::LANES-1:0]                 dirty_inside_y_o,
    // c4: the last window of the sheet in this buffer has marked
    output logic                                            marked_o,
    output logic                                            marked_buffer_o,
    // W: the sheet of buffer done_buffer_o is complete
    output logic                                            done_o,
    output logic                                            done_buffer_o,
    // compositor
    input  logic                                            wipe_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]             wipe_addr_i,
    input  logic                                            comp_re_i,
    input  logic                                            comp_buffer_i,
    input  logic [fastsplat_pkg::ADDR_BITS-1:0]             comp_addr_i,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] comp_data_o,
    // every sample: a window at c5; its products and blocks at c6, with tap_inside and tap_weighted
    output logic                                            sample_valid_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] sample_products_o,
    output logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] sample_column_o,
    output logic [fastsplat_pkg::LANES*fastsplat_pkg::BLK_BITS-1:0] sample_row_o,
    // taps
    output logic                                            tap_snap_valid_o,   // c1, first window of a splat
    output logic [31:0]                                     tap_snap_tag_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0]       tap_snap_x_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0]       tap_snap_y_o,
    output logic [fastsplat_pkg::WAY_BITS-1:0]              tap_snap_mx_o,  // phase; of an ellipse X, two's complement
    output logic [fastsplat_pkg::WAY_BITS-1:0]              tap_snap_my_o,
    output logic [1:0]                                      tap_snap_saturated_o,
    output logic                                            tap_window_valid_o,    // c6
    output logic [31:0]                                     tap_window_tag_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0]       tap_window_x_o,
    output logic signed [fastsplat_pkg::ORG_BITS-1:0]       tap_window_y_o,
    output logic [fastsplat_pkg::BANKS*fastsplat_pkg::WEIGHT_BITS-1:0] tap_weights_o,  // by bank
    output logic [fastsplat_pkg::LANES-1:0]                 tap_inside_x_o,        // by bank column and row, c6
    output logic [fastsplat_pkg::LANES-1:0]                 tap_inside_y_o,
    output logic [fastsplat_pkg::BANKS-1:0]                 tap_weighted_o,        // inside, weight > 0, by bank, c6
    output logic [4*fastsplat_pkg::BANKS-1:0]               tap_product_saturated_o,  // weighted, by bank and channel, c6
    output logic                                            tap_sheet_valid_o,     // W
    output logic [31:0]                                     tap_sheet_tag_o,
    output logic [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] tap_sums_o,  // by bank
    output logic [4*fastsplat_pkg::BANKS-1:0]               tap_sheet_saturated_o
);
  localparam int P = fastsplat_pkg::LANES;
  localparam int RB = fastsplat_pkg::RLUT_BITS;
  localparam int BLK = fastsplat_pkg::BLK_BITS;
  localparam int AB = fastsplat_pkg::ADDR_BITS;
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int WB = fastsplat_pkg::WEIGHT_BITS;
  localparam int CB4 = 4 * fastsplat_pkg::COLOUR_BITS;
  localparam int ORG = fastsplat_pkg::ORG_BITS;
  localparam int COL = fastsplat_pkg::COL_BITS;
  localparam int QB = fastsplat_pkg::ELLIPSE_BITS;
  // Numbers of the stages of the weight, of the products, and of W.
  localparam int WEIGHT = 5 + fastsplat_pkg::WEIGHT_DELAY;
  localparam int PRODUCTS = WEIGHT + 1;
  localparam int WRITTEN = PRODUCTS + 3;

  // Radial table: with interpolation word j closes step j-1 (M-weights-2).
  logic radial_we;
  logic [fastsplat_pkg::RADIAL_LOG2-1:0] radial_waddr;
  logic [fastsplat_pkg::RADIAL_BITS-1:0] radial_word;
  if (fastsplat_pkg::INTERPOLATE != 0) begin : gen_steps
    logic [WB-1:0] before_q;
    always_ff @(posedge clk_i) if (radial_we_i) before_q <= table_word_i[WB-1:0];
    assign radial_we = radial_we_i && radial_waddr_i != '0;
    assign radial_waddr = fastsplat_pkg::RADIAL_LOG2'(radial_waddr_i - (fastsplat_pkg::RADIAL_LOG2 + 1)'(1));
    assign radial_word = {before_q, `FASTSPLAT_FAULT(POST_LAST) && radial_waddr == '1 ? before_q : table_word_i[WB-1:0]};
  end else begin : gen_entries
    assign radial_we = radial_we_i;
    assign radial_waddr = radial_waddr_i[fastsplat_pkg::RADIAL_LOG2-1:0];
    assign radial_word = table_word_i[WB-1:0];
    logic unused_index;
    assign unused_index = &{1'b0, radial_waddr_i[fastsplat_pkg::RADIAL_LOG2]};
  end

  // c0, delayed by the ellipse unit's latency.
  logic valid, last, first_window, buffer, ellipse;
  logic [31:0] tag;
  logic signed [fastsplat_pkg::POS_BITS-1:0] x, y;
  logic [fastsplat_pkg::RHO_BITS-1:0] rho;
  logic [COL-1:0] base;
  logic [fastsplat_pkg::WINDOW_BITS-1:0] column, row;
  logic [CB4-1:0] colour;
  fastsplat_delay #(.BITS(2), .STAGES(fastsplat_pkg::ELLIPSE_DELAY)) u_here (
      .clk_i, .rst_ni, .data_i({valid_i, last_i}), .data_o({valid, last})
  );
  fastsplat_delay #(
      .BITS(35 + 2 * fastsplat_pkg::POS_BITS + fastsplat_pkg::RHO_BITS + COL + 2 * fastsplat_pkg::WINDOW_BITS + CB4),
      .STAGES(fastsplat_pkg::ELLIPSE_DELAY)
  ) u_window (
      .clk_i,
      .rst_ni(1'b1),
      .data_i({first_window_i, buffer_i, ellipse_i, tag_i, x_i, y_i, rho_i, base_i, column_i, row_i, colour_i}),
      .data_o({first_window, buffer, ellipse, tag, x, y, rho, base, column, row, colour})
  );

  // Carried along: index = stage (1..9, more with interpolation).
  logic [WRITTEN:1] valid_q, last_q, buffer_q;
  logic first_c1_q;
  logic [31:0] tag_q[1:WRITTEN];
  logic [CB4-1:0] colour_q[1:WEIGHT];
  logic [COL-1:0] column_c1_q, row_c1_q;
  logic signed [ORG-1:0] x_q[2:PRODUCTS], y_q[2:PRODUCTS];

  // c1
  logic signed [ORG-1:0] x_c1, y_c1, circle_x, circle_y;
  logic [fastsplat_pkg::PHASE_BITS-1:0] mx_c1, my_c1;
  logic saturated_x, saturated_y;
  fastsplat_snap u_snap_x (.clk_i, .centre_i(x), .rho_i(rho), .column_i(column[COL-1:0]), .origin_o(circle_x), .phase_o(mx_c1), .saturated_o(saturated_x));
  fastsplat_snap u_snap_y (.clk_i, .centre_i(y), .rho_i(rho), .column_i(row[COL-1:0]), .origin_o(circle_y), .phase_o(my_c1), .saturated_o(saturated_y));

  // An ellipse's own path to c1 and c3.
  logic ellipse_c1, ellipse_c3;
  logic [fastsplat_pkg::WAY_BITS-1:0] way_x_c1, way_y_c1;
  logic [2*P*QB-1:0] ellipse_columns, ellipse_rows;
  logic [P*P*QB-1:0] ellipse_cross;
  logic [P-1:0] second_x, second_y;
  if (fastsplat_pkg::ELLIPSES != 0) begin : gen_ellipse
    localparam int PF = fastsplat_pkg::POS_FRAC;
    logic ellipse_c2;
    logic signed [9:0] left, top;
    logic signed [ORG-1:0] ellipse_x_q, ellipse_y_q;
    logic signed [31:0] way_x_q, way_y_q;
    fastsplat_delay #(.BITS(20), .STAGES(fastsplat_pkg::ELLIPSE_DELAY)) u_corner (
        .clk_i, .rst_ni(1'b1), .data_i(shape_i[74+:20]), .data_o({top, left})
    );
    always_ff @(posedge clk_i) begin
      ellipse_c1 <= ellipse;
      ellipse_c2 <= ellipse_c1;
      ellipse_c3 <= ellipse_c2;
      ellipse_x_q <= ORG'(32'(x) >>> PF) + ORG'(left) + $signed(ORG'(column));
      ellipse_y_q <= ORG'(32'(y) >>> PF) + ORG'(top) + $signed(ORG'(row));
      way_x_q <= (32'(left) <<< PF) - $signed({{(32 - PF) {1'b0}}, x[PF-1:0]});
      way_y_q <= (32'(top) <<< PF) - $signed({{(32 - PF) {1'b0}}, y[PF-1:0]});
    end
    assign x_c1 = ellipse_c1 ? ellipse_x_q : circle_x;
    assign y_c1 = ellipse_c1 ? ellipse_y_q : circle_y;
    assign way_x_c1 = ellipse_c1 ? way_x_q : 32'(mx_c1);
    assign way_y_c1 = ellipse_c1 ? way_y_q : 32'(my_c1);
    fastsplat_ellipse u_ellipse (
        .clk_i,
        .first_i(first_window_i),
        .new_row_i(column_i == '0),
        .densities_i,
        .x_i,
        .y_i,
        .shape_i,
        .columns_o(ellipse_columns),
        .rows_o(ellipse_rows),
        .cross_o(ellipse_cross),
        .second_x_o(second_x),
        .second_y_o(second_y)
    );
  end else begin : gen_circles
    assign {ellipse_c1, ellipse_c3} = '0;
    assign x_c1 = circle_x;
    assign y_c1 = circle_y;
    assign way_x_c1 = mx_c1;
    assign way_y_c1 = my_c1;
    assign ellipse_columns = '0;
    assign ellipse_rows = '0;
    assign ellipse_cross = '0;
    assign second_x = '0;
    assign second_y = '0;
    logic unused;
    assign unused = &{1'b0, ellipse, shape_i};
  end

  // c2
  logic [P*RB-1:0] rlut_x, rlut_y;
  fastsplat_rlut u_rlut_x (
      .clk_i,
      .we_i(rlut_we_i),
      .wphase_i(rlut_wphase_i),
      .wcolumn_i(rlut_wcolumn_i),
      .wdata_i(table_word_i[RB-1:0]),
      .re_i(valid_q[1]),
      .phase_i(`FASTSPLAT_FAULT(SWAPPED_AXES) ? my_c1 : mx_c1),
      .column_i(column_c1_q),
      .words_o(rlut_x)
  );
  fastsplat_rlut u_rlut_y (
      .clk_i,
      .we_i(rlut_we_i),
      .wphase_i(rlut_wphase_i),
      .wcolumn_i(rlut_wcolumn_i),
      .wdata_i(table_word_i[RB-1:0]),
      .re_i(valid_q[1]),
      .phase_i(`FASTSPLAT_FAULT(SWAPPED_AXES) ? mx_c1 : my_c1),
      .column_i(row_c1_q),
      .words_o(rlut_y)
  );

  // c3. A halo moves windows one pixel right and down, and the inside is two pixels longer (M-density-3).
  localparam int SIDE = fastsplat_pkg::SIDE_BITS;
  logic [SIDE-1:0] held_width, held_height;
  logic signed [ORG-1:0] held_x, held_y;
  if (fastsplat_pkg::DENSITIES != 0) begin : gen_rim
    assign held_width = width_i + (densities_i ? SIDE'(2) : '0);
    assign held_height = height_i + (densities_i ? SIDE'(2) : '0);
    assign held_x = x_q[2] + $signed(ORG'({1'b0, densities_i}));
    assign held_y = y_q[2] + $signed(ORG'({1'b0, densities_i}));
  end else begin : gen_no_rim
    assign held_width = width_i;
    assign held_height = height_i;
    assign held_x = x_q[2];
    assign held_y = y_q[2];
    logic unused_rim;
    assign unused_rim = &{1'b0, densities_i};
  end
  logic [P*RB-1:0] columns_c3, rows_c3;
  logic [P*BLK-1:0] block_x_c3, block_y_c3;
  logic [P-1:0] inside_x_c3, inside_y_c3;
  fastsplat_axis u_axis_x (
      .clk_i,
      .valid_i(valid_q[2]),
      .origin_i(held_x),
      .side_i(held_width),
      .words_i(rlut_x),
      .words_o(columns_c3),
      .block_o(block_x_c3),
      .inside_o(inside_x_c3)
  );
  fastsplat_axis u_axis_y (
      .clk_i,
      .valid_i(valid_q[2]),
      .origin_i(held_y),
      .side_i(held_height),
      .words_i(rlut_y),
      .words_o(rows_c3),
      .block_o(block_y_c3),
      .inside_o(inside_y_c3)
  );

  logic summing;  // windows go into sheets
  assign summing = fastsplat_pkg::EVERY_SAMPLE == 0 || !every_sample_i;
  assign dirty_valid_o = valid_q[3] && summing;
  assign dirty_buffer_o = buffer_q[3];
  assign dirty_column_o = block_x_c3;
  assign dirty_row_o = block_y_c3;
  assign dirty_inside_x_o = inside_x_c3;
  assign dirty_inside_y_o = inside_y_c3;

  // A bank's block is its column's and its row's: they ride along by axis.
  logic [P*BLK-1:0] block_x_q[4:PRODUCTS], block_y_q[4:PRODUCTS];
  logic [P-1:0] inside_x_q[4:PRODUCTS], inside_y_q[4:PRODUCTS];
  always_ff @(posedge clk_i) begin
    block_x_q[4] <= block_x_c3;
    block_y_q[4] <= block_y_c3;
    inside_x_q[4] <= inside_x_c3;
    inside_y_q[4] <= inside_y_c3;
    for (int s = 5; s <= PRODUCTS; s++) begin
      block_x_q[s] <= block_x_q[s-1];
      block_y_q[s] <= block_y_q[s-1];
      inside_x_q[s] <= inside_x_q[s-1];
      inside_y_q[s] <= inside_y_q[s-1];
    end
  end
  assign tap_inside_x_o = inside_x_q[PRODUCTS];
  assign tap_inside_y_o = inside_y_q[PRODUCTS];

  logic [WB-1:0] weights[0:P*P-1];
  logic [4*SB-1:0] sums[0:P*P-1];
  for (genvar h = 0; h < P; h++) begin : gen_row
    for (genvar g = 0; g < P; g++) begin : gen_bank
      localparam int B = h * P + g;
      logic [4*SB-1:0] products;
      logic [3:0] saturated;
      // Lanes outside the tile work, too, but are not counted.
      assign tap_weighted_o[B] = inside_x_q[PRODUCTS][g] && inside_y_q[PRODUCTS][h] && weights[B] != '0;
      assign tap_product_saturated_o[4*B+:4] = tap_weighted_o[B] ? saturated : '0;
      fastsplat_lane u_lane (
          .clk_i,
          .we_i(radial_we),
          .waddr_i(radial_waddr),
          .wdata_i(radial_word),
          .valid_i(valid_q[WEIGHT:3]),
          .column_i(columns_c3[g*RB+:RB]),
          .row_i(rows_c3[h*RB+:RB]),
          .ellipse_i(ellipse_c3),
          .ellipse_column_i(second_y[h] ? ellipse_columns[(P+g)*QB+:QB] : ellipse_columns[g*QB+:QB]),
          .ellipse_row_i(second_x[g] ? ellipse_rows[(P+h)*QB+:QB] : ellipse_rows[h*QB+:QB]),
          .ellipse_cross_i(ellipse_cross[B*QB+:QB]),
          .colour_i(colour_q[WEIGHT]),
          .weight_o(weights[B]),
          .products_o(products),
          .saturated_o(saturated)
      );
      fastsplat_sheet_bank u_bank (
          .clk_i,
          .rst_ni,
          .wipe_i,
          .wipe_addr_i,
          .valid_i(valid_q[PRODUCTS] && (summing || `FASTSPLAT_FAULT(SAMPLE_SUMMED)) && inside_x_q[PRODUCTS][g] && inside_y_q[PRODUCTS][h]),
          .buffer_i(buffer_q[PRODUCTS]),
          .addr_i(AB'(block_y_q[PRODUCTS][h*BLK+:BLK]) * AB'(fastsplat_pkg::BLOCKS_X) + AB'(block_x_q[PRODUCTS][g*BLK+:BLK])),
          .products_i(products),
          .sum_o(sums[B]),
          .saturated_o(tap_sheet_saturated_o[4*B+:4]),
          .comp_re_i,
          .comp_buffer_i,
          .comp_addr_i,
          .comp_data_o(comp_data_o[B*4*SB+:4*SB])
      );
      assign sample_products_o[B*4*SB+:4*SB] = (fastsplat_pkg::EVERY_SAMPLE != 0) ? products : '0;
    end
  end
  assign sample_valid_o = valid_q[WEIGHT] && !summing;
  assign sample_column_o = block_x_q[PRODUCTS];
  assign sample_row_o = block_y_q[PRODUCTS];

  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[WRITTEN-1:1], valid};
    last_q <= {last_q[WRITTEN-1:1], last};
    buffer_q <= {buffer_q[WRITTEN-1:1], buffer};
    if (!rst_ni) begin
      valid_q <= '0;
      last_q <= '0;
    end
    first_c1_q <= first_window;
    tag_q[1] <= tag;
    colour_q[1] <= colour;
    column_c1_q <= base + column[COL-1:0];
    row_c1_q <= base + row[COL-1:0];
    x_q[2] <= x_c1;
    y_q[2] <= y_c1;
    for (int s = 2; s <= WRITTEN; s++) tag_q[s] <= tag_q[s-1];
    for (int s = 2; s <= WEIGHT; s++) colour_q[s] <= colour_q[s-1];
    for (int s = 3; s <= PRODUCTS; s++) begin
      x_q[s] <= x_q[s-1];
      y_q[s] <= y_q[s-1];
    end
  end

  assign marked_o = `FASTSPLAT_FAULT(EARLY_SWAP) ? last_q[3] : last_q[4];
  assign marked_buffer_o = `FASTSPLAT_FAULT(EARLY_SWAP) ? buffer_q[3] : buffer_q[4];
  assign done_o = `FASTSPLAT_FAULT(EARLY_SWAP) ? last_q[3] : last_q[WRITTEN];
  assign done_buffer_o = `FASTSPLAT_FAULT(EARLY_SWAP) ? buffer_q[3] : buffer_q[WRITTEN];

  assign tap_snap_valid_o = valid_q[1] && first_c1_q;
  assign tap_snap_tag_o = tag_q[1];
  // A splat's first pixel: that of its first window unless that window is hidden.
  if (fastsplat_pkg::CULL_MAP != 0) begin : gen_corner
    logic signed [ORG-1:0] column_q, row_q;
    always_ff @(posedge clk_i) begin
      column_q <= $signed(ORG'(column));
      row_q <= $signed(ORG'(row));
    end
    assign tap_snap_x_o = x_c1 - column_q;
    assign tap_snap_y_o = y_c1 - row_q;
  end else begin : gen_first
    assign tap_snap_x_o = x_c1;
    assign tap_snap_y_o = y_c1;
  end
  assign tap_snap_mx_o = way_x_c1;
  assign tap_snap_my_o = way_y_c1;
  assign tap_snap_saturated_o = ellipse_c1 ? '0 : {saturated_y, saturated_x};
  assign tap_window_valid_o = valid_q[PRODUCTS];
  assign tap_window_tag_o = tag_q[PRODUCTS];
  assign tap_window_x_o = x_q[PRODUCTS];
  assign tap_window_y_o = y_q[PRODUCTS];
  assign tap_sheet_valid_o = valid_q[WRITTEN] && summing;
  assign tap_sheet_tag_o = tag_q[WRITTEN];
  always_comb begin
    // verilator lint_off WIDTHCONCAT
    tap_weights_o = '0;
    tap_sums_o = '0;
    // verilator lint_on WIDTHCONCAT
    for (int b = 0; b < P * P; b++) begin
      if (valid_q[PRODUCTS]) tap_weights_o[b*WB+:WB] = weights[b];
      if (tap_sheet_valid_o) tap_sums_o[b*4*SB+:4*SB] = sums[b];
    end
  end
  // The compositor never reads or clears a memory that a window is about to write (A to W).
  for (genvar s = PRODUCTS; s <= WRITTEN; s++) begin : gen_owner
    `FASTSPLAT_ASSERT(sheet_has_one_owner, !(comp_re_i && valid_q[s] && summing && buffer_q[s] == comp_buffer_i))
  end
  `FASTSPLAT_ASSERT(nothing_moves_while_wiping, !wipe_i || (!valid_q[PRODUCTS] && !comp_re_i))
endmodule
