// The one place that loses bits (docs/numerics.md, section 1; cmodel/narrow.hpp). Combinational.
//
// value_i is unsigned with SHIFT fraction bits more than word_o (fewer when negative). Overflow saturates.
//   ROUND 0: TRN, towards minus infinity     ROUND 1: RND, nearest, halves up
//   UNIT  0: U format, largest word all ones UNIT  1: One format, largest word 1.0 = 2^(OUT_BITS-1)
`include "fault.svh"

module narrow #(
    parameter int IN_BITS  = 8,
    parameter int SHIFT    = 4,
    parameter int OUT_BITS = 4,
    parameter int ROUND    = 1,
    parameter int UNIT     = 0
) (
    input  logic [ IN_BITS-1:0] value_i,
    output logic [OUT_BITS-1:0] word_o,
    output logic                overflow_o
);
  localparam int LEFT = (SHIFT < 0) ? -SHIFT : 0;
  localparam int RIGHT = (SHIFT > 0) ? SHIFT : 0;
  localparam int WIDE = ((IN_BITS + LEFT > OUT_BITS + RIGHT) ? IN_BITS + LEFT : OUT_BITS + RIGHT) + 1;
  localparam logic [WIDE-1:0] ONE = 1;
  localparam logic [WIDE-1:0] HALF = (ROUND != 0 && RIGHT > 0) ? ONE << (RIGHT - 1) : '0;
  localparam logic [WIDE-1:0] LARGEST = (UNIT != 0) ? ONE << (OUT_BITS - 1) : (ONE << OUT_BITS) - ONE;

  logic [WIDE-1:0] value, rounded;
  assign value = WIDE'(value_i) << LEFT;
  assign rounded = (value + (`FASTSPLAT_FAULT(ROUND_TRN) ? '0 : HALF)) >> RIGHT;
  assign overflow_o = rounded > LARGEST;
  assign word_o = (overflow_o && !`FASTSPLAT_FAULT(NO_SATURATION)) ? LARGEST[OUT_BITS-1:0] : rounded[OUT_BITS-1:0];
endmodule
