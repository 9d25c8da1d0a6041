// SPDX-License-Identifier: Apache-2.0
// Delays a word by STAGES cycles; 0: a wire.
module fastsplat_delay #(
    parameter int BITS = 1,
    parameter int STAGES = 1
) (
    input  logic            clk_i,
    input  logic            rst_ni,  // clears all stages; tied to 1: no reset
    input  logic [BITS-1:0] data_i,
    output logic [BITS-1:0] data_o
);
  if (STAGES == 0) begin : gen_wire
    assign data_o = data_i;
    logic unused;
    assign unused = &{1'b0, clk_i, rst_ni};
  end else begin : gen_stages
    logic [BITS-1:0] stage_q[0:STAGES-1];
    always_ff @(posedge clk_i) begin
      stage_q[0] <= data_i;
      for (int s = 1; s < STAGES; s++) stage_q[s] <= stage_q[s-1];
      if (!rst_ni) for (int s = 0; s < STAGES; s++) stage_q[s] <= '0;
    end
    assign data_o = stage_q[STAGES-1];
  end
endmodule
