// SPDX-License-Identifier: Apache-2.0
// Configuration and status registers behind AXI4-Lite (docs/microarchitecture.md, "Registers"). A read takes its
// address in cycle c, reads the register in c+1 and answers in c+2. A write takes address and data together and answers
// in the next cycle. Counters count an event in the third cycle after it.
`include "assertions.svh"

module fastsplat_csr (
    input  logic        clk_i,
    input  logic        rst_ni,
    // AXI4-Lite
    input  logic        awvalid_i,
    output logic        awready_o,
    input  logic [11:0] awaddr_i,
    input  logic        wvalid_i,
    output logic        wready_o,
    input  logic [31:0] wdata_i,
    output logic        bvalid_o,
    input  logic        bready_i,
    output logic [1:0]  bresp_o,
    input  logic        arvalid_i,
    output logic        arready_o,
    input  logic [11:0] araddr_i,
    output logic        rvalid_o,
    input  logic        rready_i,
    output logic [31:0] rdata_o,
    output logic [1:0]  rresp_o,
    // status
    input  logic        busy_i,
    input  logic        error_i,
    input  logic [7:0]  error_rule_i,
    input  logic [7:0]  error_opcode_i,
    input  logic [31:0] error_beat_i,
    // soft reset, a pulse; interrupt: a frame or a tile has left, a beat was refused
    output logic        reset_o,
    input  logic        frame_i,
    input  logic        tile_i,
    output logic        irq_o,
    // increments, one 16-bit field a counter; clear also drops those on their way
    output logic        clear_o,
    input  logic [16*fastsplat_pkg::COUNTERS-1:0] increments_i
);
  localparam int N = fastsplat_pkg::COUNTERS;
  localparam logic [1:0] OKAY = 2'b00, SLVERR = 2'b10;

  logic write;
  assign write = awvalid_i && wvalid_i && !bvalid_o;
  assign awready_o = write;
  assign wready_o = write;
  assign clear_o = write && awaddr_i == fastsplat_pkg::REG_CONTROL && wdata_i[0];
  assign reset_o = write && awaddr_i == fastsplat_pkg::REG_CONTROL && wdata_i[1];

  logic unused;
  assign unused = &{1'b0, wdata_i};

  localparam int CB = fastsplat_pkg::COUNTER_BITS;
  logic [CB-1:0] counter_q[0:N-1];
  for (genvar n = 0; n < N; n++) begin : gen_counter
    always_ff @(posedge clk_i) begin
      if (!rst_ni || clear_o) counter_q[n] <= '0;
      else counter_q[n] <= counter_q[n] + CB'(increments_i[16*n+:16]);
    end
  end

  // Interrupts: error, tile, frame. An event in the cycle in which its bit is cleared stays.
  logic [2:0] irq_q, irq_mask_q;
  logic error_q;
  always_ff @(posedge clk_i) begin
    error_q <= error_i;
    irq_q <= (irq_q & ~((write && awaddr_i == fastsplat_pkg::REG_IRQ) ? wdata_i[2:0] : 3'd0)) | {error_i && !error_q, tile_i, frame_i};
    if (write && awaddr_i == fastsplat_pkg::REG_IRQ_MASK) irq_mask_q <= wdata_i[2:0];
    irq_o <= (irq_q & irq_mask_q) != '0;
    if (!rst_ni) begin
      error_q <= 1'b0;
      irq_q <= '0;
      irq_mask_q <= '0;
      irq_o <= 1'b0;
    end
  end
  logic writable;
  assign writable = awaddr_i == fastsplat_pkg::REG_CONTROL || awaddr_i == fastsplat_pkg::REG_IRQ || awaddr_i == fastsplat_pkg::REG_IRQ_MASK;

  // The counter's number is known before the counters are read.
  logic reading_q;
  logic [11:0] address_q, number;
  logic [N-1:0] chosen_q;
  assign number = (araddr_i - fastsplat_pkg::REG_COUNTERS) >> 3;
  assign arready_o = !reading_q && !rvalid_o;
  always_ff @(posedge clk_i) begin
    reading_q <= rst_ni && arvalid_i && arready_o;
    address_q <= araddr_i;
    for (int n = 0; n < N; n++) chosen_q[n] <= araddr_i >= fastsplat_pkg::REG_COUNTERS && number == 12'(n) && araddr_i[1:0] == 2'b00;
  end
  // The two words of a counter are of one moment: reading the low one keeps the high one.
  logic [63:0] counter;
  logic [31:0] high_q;
  always_comb begin
    counter = '0;
    for (int n = 0; n < N; n++) if (chosen_q[n]) counter = counter | 64'(counter_q[n]);
  end

  always_ff @(posedge clk_i) begin
    if (reading_q) begin
      rvalid_o <= 1'b1;
      rdata_o <= '0;
      rresp_o <= OKAY;
      case (address_q)
        fastsplat_pkg::REG_MAGIC: rdata_o <= fastsplat_pkg::STREAM_MAGIC;
        fastsplat_pkg::REG_VERSION: rdata_o <= 32'(fastsplat_pkg::STREAM_VERSION);
        fastsplat_pkg::REG_HASH_LOW: rdata_o <= fastsplat_pkg::HASH_LOW;
        fastsplat_pkg::REG_HASH_HIGH: rdata_o <= fastsplat_pkg::HASH_HIGH;
        fastsplat_pkg::REG_STATUS: rdata_o <= {30'd0, error_i, busy_i};
        fastsplat_pkg::REG_CONTROL: rdata_o <= '0;
        fastsplat_pkg::REG_ERROR: rdata_o <= {16'd0, error_opcode_i, error_rule_i};
        fastsplat_pkg::REG_ERROR_BEAT: rdata_o <= error_beat_i;
        fastsplat_pkg::REG_IRQ: rdata_o <= 32'(irq_q);
        fastsplat_pkg::REG_IRQ_MASK: rdata_o <= 32'(irq_mask_q);
        fastsplat_pkg::REG_CAP_TILE: rdata_o <= fastsplat_pkg::CAP_TILE;
        fastsplat_pkg::REG_CAP_LANES: rdata_o <= fastsplat_pkg::CAP_LANES;
        fastsplat_pkg::REG_CAP_RLUT: rdata_o <= fastsplat_pkg::CAP_RLUT;
        fastsplat_pkg::REG_CAP_TABLES: rdata_o <= fastsplat_pkg::CAP_TABLES;
        fastsplat_pkg::REG_CAP_SPLAT: rdata_o <= fastsplat_pkg::CAP_SPLAT;
        fastsplat_pkg::REG_CAP_WEIGHT: rdata_o <= fastsplat_pkg::CAP_WEIGHT;
        fastsplat_pkg::REG_CAP_SHEET: rdata_o <= fastsplat_pkg::CAP_SHEET;
        fastsplat_pkg::REG_CAP_PIXEL: rdata_o <= fastsplat_pkg::CAP_PIXEL;
        fastsplat_pkg::REG_CAP_FEATURES: rdata_o <= fastsplat_pkg::CAP_FEATURES;
        fastsplat_pkg::REG_CAP_COMPOSITE: rdata_o <= fastsplat_pkg::CAP_COMPOSITE;
        fastsplat_pkg::REG_CAP_FREEZE: rdata_o <= fastsplat_pkg::CAP_FREEZE;
        fastsplat_pkg::REG_CAP_ROUNDING: rdata_o <= fastsplat_pkg::CAP_ROUNDING;
        default: begin
          if (chosen_q == '0) begin
            rresp_o <= SLVERR;
          end else begin
            rdata_o <= address_q[2] ? high_q : counter[31:0];
            if (!address_q[2]) high_q <= counter[63:32];
          end
        end
      endcase
    end else if (rready_i) begin
      rvalid_o <= 1'b0;
    end
    if (write) begin
      bvalid_o <= 1'b1;
      bresp_o <= writable ? OKAY : SLVERR;
    end else if (bready_i) begin
      bvalid_o <= 1'b0;
    end
    if (!rst_ni) begin
      rvalid_o <= 1'b0;
      bvalid_o <= 1'b0;
      high_q <= '0;
    end
  end
  `FASTSPLAT_ASSERT_HELD(read_held, rvalid_o && !rready_i, rvalid_o, {rdata_o, rresp_o})
  `FASTSPLAT_ASSERT_HELD(write_answer_held, bvalid_o && !bready_i, bvalid_o, bresp_o)
endmodule
