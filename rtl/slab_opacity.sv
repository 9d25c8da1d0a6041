// Slab opacity of one lane: a pixel's sheet sums become the slab's colour and opacity (docs/numerics.md, section 6;
// cmodel/slab_opacity.hpp). Registers: k2 (table), k3 (factor), k4 (slab). Input k1, output three cycles later.
// In mode 2 (sum) the sums pass through unchanged.
module slab_opacity (
    input  logic                                    clk_i,
    // factor table load: segment start and fall to the next
    input  logic                                    we_i,
    input  logic [fastsplat_pkg::SEG_LOG2-1:0]      waddr_i,
    input  logic [2*fastsplat_pkg::FACTOR_BITS-1:0] wdata_i,  // {start, fall}
    // k1
    input  logic [1:0]                              mode_i,   // held over a tile
    input  logic [4*fastsplat_pkg::SHEET_BITS-1:0]  sums_i,   // R, G, B, tau
    // k4
    output logic [4*fastsplat_pkg::STATE_BITS-1:0]  slab_o,   // One.tf each, or U si.sf in mode 2
    output logic [3:0]                              saturated_o
);
  localparam int SB = fastsplat_pkg::SHEET_BITS;
  localparam int FB = fastsplat_pkg::FACTOR_BITS;
  localparam int REM = fastsplat_pkg::REM_BITS;
  localparam int TB = fastsplat_pkg::TRANS_BITS;
  localparam int DB = fastsplat_pkg::STATE_BITS;

  logic [4*SB-1:0] sums_k2_q, sums_k3_q;
  logic [2*FB-1:0] segment_k2;
  ram_1r1w #(.BITS(2 * FB), .WORDS(fastsplat_pkg::SEGMENTS), .ADDR(fastsplat_pkg::SEG_LOG2)) u_factor (
      .clk_i,
      .re_i(1'b1),
      .raddr_i(sums_i[3*SB+REM+:fastsplat_pkg::SEG_LOG2]),
      .rdata_o(segment_k2),
      .we_i,
      .waddr_i,
      .wdata_i
  );

  // k2: interpolate
  logic [FB+REM-1:0] slope;
  logic [FB-1:0] fall, factor_k3_q;
  logic fall_overflow;
  assign slope = (FB + REM)'(segment_k2[FB-1:0]) * (FB + REM)'(sums_k2_q[3*SB+:REM]);
  narrow #(.IN_BITS(FB + REM), .SHIFT(REM), .OUT_BITS(FB), .ROUND(1), .UNIT(1)) u_fall (
      .value_i(slope),
      .word_o(fall),
      .overflow_o(fall_overflow)
  );

  // k3: scale, or only round in additive mode
  logic [3:0] saturated_q;
  logic [4*DB-1:0] slab_q;
  for (genvar c = 0; c < 4; c++) begin : gen_channel
    logic [SB+FB-1:0] product;
    logic [TB-1:0] exponential, additive;
    logic exponential_overflow, additive_overflow;
    assign product = (SB + FB)'(sums_k3_q[c*SB+:SB]) * (SB + FB)'(factor_k3_q);
    narrow #(
        .IN_BITS(SB + FB),
        .SHIFT(fastsplat_pkg::SHEET_FRAC + fastsplat_pkg::FACTOR_FRAC - fastsplat_pkg::TRANS_FRAC),
        .OUT_BITS(TB),
        .ROUND(1),
        .UNIT(1)
    ) u_exponential (
        .value_i(product),
        .word_o(exponential),
        .overflow_o(exponential_overflow)
    );
    narrow #(
        .IN_BITS(SB),
        .SHIFT(fastsplat_pkg::SHEET_FRAC - fastsplat_pkg::TRANS_FRAC),
        .OUT_BITS(TB),
        .ROUND(1),
        .UNIT(1)
    ) u_additive (
        .value_i(sums_k3_q[c*SB+:SB]),
        .word_o(additive),
        .overflow_o(additive_overflow)
    );
    always_ff @(posedge clk_i) begin
      case (mode_i)
        2'd0: begin
          slab_q[c*DB+:DB] <= DB'(exponential);
          saturated_q[c] <= exponential_overflow;
        end
        2'd1: begin
          slab_q[c*DB+:DB] <= DB'(additive);
          saturated_q[c] <= additive_overflow;
        end
        default: begin
          slab_q[c*DB+:DB] <= DB'(sums_k3_q[c*SB+:SB]);
          saturated_q[c] <= 1'b0;
        end
      endcase
    end
  end

  always_ff @(posedge clk_i) begin
    sums_k2_q <= sums_i;
    sums_k3_q <= sums_k2_q;
    factor_k3_q <= segment_k2[2*FB-1:FB] - fall;
  end
  assign slab_o = slab_q;
  assign saturated_o = saturated_q;
  logic unused;
  assign unused = &{1'b0, fall_overflow};
endmodule
