// The one place that loses bits (docs/numerics.md, section 1; cmodel/narrow.hpp). A function, not a module: called under an
// enable it costs nothing, in gates or in simulation, while there is nothing to narrow.
//
//   FASTSPLAT_NARROW(NAME, IN_BITS, SHIFT, OUT_BITS, ROUND, UNIT)
//                               declares function NAME(value), which returns {overflow, word}
//
// The value is unsigned with SHIFT fraction bits more than the word (fewer when negative). Overflow saturates.
//   ROUND 0: TRN, towards minus infinity     ROUND 1: RND, nearest, halves up
//   UNIT  0: U format, largest word all ones UNIT  1: One format, largest word 1.0 = 2^(OUT_BITS-1)
`ifndef FASTSPLAT_NARROW_SVH
`define FASTSPLAT_NARROW_SVH
`include "fault.svh"

`define FASTSPLAT_NARROW(NAME, IN_BITS, SHIFT, OUT_BITS, ROUND, UNIT) \
  localparam int NAME``_LEFT = ((SHIFT) < 0) ? -(SHIFT) : 0; \
  localparam int NAME``_RIGHT = ((SHIFT) > 0) ? (SHIFT) : 0; \
  localparam int NAME``_WIDE = (((IN_BITS) + NAME``_LEFT > (OUT_BITS) + NAME``_RIGHT) ? (IN_BITS) + NAME``_LEFT : (OUT_BITS) + NAME``_RIGHT) + 1; \
  localparam logic [NAME``_WIDE-1:0] NAME``_ONE = 1; \
  localparam logic [NAME``_WIDE-1:0] NAME``_HALF = ((ROUND) != 0 && NAME``_RIGHT > 0) ? NAME``_ONE << (NAME``_RIGHT - 1) : '0; \
  localparam logic [NAME``_WIDE-1:0] NAME``_LARGEST = ((UNIT) != 0) ? NAME``_ONE << ((OUT_BITS) - 1) : (NAME``_ONE << (OUT_BITS)) - NAME``_ONE; \
  function automatic logic [(OUT_BITS):0] NAME(input logic [(IN_BITS)-1:0] value); \
    logic [NAME``_WIDE-1:0] rounded; \
    logic overflow; \
    rounded = ((NAME``_WIDE'(value) << NAME``_LEFT) + (`FASTSPLAT_FAULT(ROUND_TRN) ? '0 : NAME``_HALF)) >> NAME``_RIGHT; \
    overflow = rounded > NAME``_LARGEST; \
    NAME = {overflow, (overflow && !`FASTSPLAT_FAULT(NO_SATURATION)) ? NAME``_LARGEST[(OUT_BITS)-1:0] : rounded[(OUT_BITS)-1:0]}; \
  endfunction
`endif
