// Configuration and status registers behind AXI4-Lite (docs/microarchitecture.md, "Registers").
// Reads answer one cycle after the address is taken; writes take address and data together. Counters count an event in
// the third cycle after it.
`include "assertions.svh"

module csr (
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
    input  logic [7:0]  error_opcode_i,
    // increments, one 16-bit field a counter; clear: those on their way are forgotten, too
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

  logic unused;
  assign unused = &{1'b0, wdata_i};

  logic [63:0] counter_q[0:N-1];
  for (genvar n = 0; n < N; n++) begin : gen_counter
    always_ff @(posedge clk_i) begin
      if (!rst_ni || clear_o) counter_q[n] <= '0;
      else counter_q[n] <= counter_q[n] + 64'(increments_i[16*n+:16]);
    end
  end

  logic [11:0] number;
  logic is_counter;
  assign number = (araddr_i - fastsplat_pkg::REG_COUNTERS) >> 3;
  assign is_counter = araddr_i >= fastsplat_pkg::REG_COUNTERS && number < 12'(N) && araddr_i[1:0] == 2'b00;

  assign arready_o = !rvalid_o;
  always_ff @(posedge clk_i) begin
    if (arvalid_i && arready_o) begin
      rvalid_o <= 1'b1;
      rdata_o <= '0;
      rresp_o <= OKAY;
      case (araddr_i)
        fastsplat_pkg::REG_MAGIC: rdata_o <= fastsplat_pkg::STREAM_MAGIC;
        fastsplat_pkg::REG_VERSION: rdata_o <= 32'(fastsplat_pkg::STREAM_VERSION);
        fastsplat_pkg::REG_HASH_LOW: rdata_o <= fastsplat_pkg::HASH_LOW;
        fastsplat_pkg::REG_HASH_HIGH: rdata_o <= fastsplat_pkg::HASH_HIGH;
        fastsplat_pkg::REG_STATUS: rdata_o <= {16'd0, error_opcode_i, 6'd0, error_i, busy_i};
        fastsplat_pkg::REG_CONTROL: rdata_o <= '0;
        default: begin
          if (!is_counter) rresp_o <= SLVERR;
          for (int n = 0; n < N; n++) begin
            if (is_counter && number == 12'(n)) rdata_o <= araddr_i[2] ? counter_q[n][63:32] : counter_q[n][31:0];
          end
        end
      endcase
    end else if (rready_i) begin
      rvalid_o <= 1'b0;
    end
    if (write) begin
      bvalid_o <= 1'b1;
      bresp_o <= (awaddr_i == fastsplat_pkg::REG_CONTROL) ? OKAY : SLVERR;
    end else if (bready_i) begin
      bvalid_o <= 1'b0;
    end
    if (!rst_ni) begin
      rvalid_o <= 1'b0;
      bvalid_o <= 1'b0;
    end
  end
  `FASTSPLAT_ASSERT_HELD(read_held, rvalid_o && !rready_i, rvalid_o, {rdata_o, rresp_o})
  `FASTSPLAT_ASSERT_HELD(write_answer_held, bvalid_o && !bready_i, bvalid_o, bresp_o)
endmodule
