// SPDX-License-Identifier: Apache-2.0
// A register slice: a ready/valid channel whose valid, data and ready all come from registers. One transfer a cycle,
// one cycle later (docs/integration.md).
module fastsplat_slice #(
    parameter int BITS = 1
) (
    input  logic            clk_i,
    input  logic            rst_ni,
    input  logic            valid_i,
    output logic            ready_o,
    input  logic [BITS-1:0] data_i,
    output logic            valid_o,
    input  logic            ready_i,
    output logic [BITS-1:0] data_o
);
  logic spare_q;  // a transfer that came while the front one waited
  logic [BITS-1:0] spare_data_q;
  logic taken, moves;
  assign taken = valid_i && ready_o;
  assign moves = !valid_o || ready_i;
  always_ff @(posedge clk_i) begin
    if (moves) begin
      valid_o <= spare_q || taken;
      data_o <= spare_q ? spare_data_q : data_i;
      spare_q <= 1'b0;
    end else if (taken) begin
      spare_q <= 1'b1;
      spare_data_q <= data_i;
    end
    ready_o <= moves || !(spare_q || taken);
    if (!rst_ni) begin
      valid_o <= 1'b0;
      spare_q <= 1'b0;
      ready_o <= 1'b0;
    end
  end
endmodule
