// SPDX-License-Identifier: Apache-2.0
// The one place that loses bits (docs/numerics.md, section 1; cmodel/numbers/narrow.hpp). A function, not a module:
// called under an enable it costs nothing, in gates or in simulation, while there is nothing to narrow.
//
//   FASTSPLAT_NARROW(NAME, IN_BITS, OUT_BITS, SITE)
//                               declares function NAME(value), which returns {overflow, word}
//
// The package, and so cmodel/numbers/sites.cpp, defines what happens at SITE: the value is unsigned with SHIFT_<SITE>
// fraction bits more than the word (fewer when negative). Overflow saturates.
//   ROUND_<SITE>  0: TRN, towards minus infinity  1: RND, nearest, halves up  2: RND_CONV, nearest, halves to even
//   UNIT_<SITE>   0: U format, largest word all ones  1: One format, largest word 1.0 = 2^(OUT_BITS-1)
`ifndef FASTSPLAT_NARROW_SVH
`define FASTSPLAT_NARROW_SVH
`include "fault.svh"

`define FASTSPLAT_NARROW(NAME, IN_BITS, OUT_BITS, SITE) \
  localparam int NAME``_SHIFT = fastsplat_pkg::SHIFT_``SITE; \
  localparam int NAME``_ROUND = fastsplat_pkg::ROUND_``SITE; \
  localparam int NAME``_LEFT = (NAME``_SHIFT < 0) ? -NAME``_SHIFT : 0; \
  localparam int NAME``_RIGHT = (NAME``_SHIFT > 0) ? NAME``_SHIFT : 0; \
  localparam int NAME``_WIDE = (((IN_BITS) + NAME``_LEFT > (OUT_BITS) + NAME``_RIGHT) ? (IN_BITS) + NAME``_LEFT : (OUT_BITS) + NAME``_RIGHT) + 1; \
  localparam logic [NAME``_WIDE-1:0] NAME``_ONE = 1; \
  localparam logic [NAME``_WIDE-1:0] NAME``_EVEN = (NAME``_ROUND == 2 && NAME``_RIGHT > 0) ? NAME``_ONE : '0; \
  localparam logic [NAME``_WIDE-1:0] NAME``_BIAS = (NAME``_ROUND != 0 && NAME``_RIGHT > 0) ? (NAME``_ONE << (NAME``_RIGHT - 1)) - NAME``_EVEN : '0; \
  localparam logic [NAME``_WIDE-1:0] NAME``_LARGEST = (fastsplat_pkg::UNIT_``SITE != 0) ? NAME``_ONE << ((OUT_BITS) - 1) : (NAME``_ONE << (OUT_BITS)) - NAME``_ONE; \
  function automatic logic [(OUT_BITS):0] NAME(input logic [(IN_BITS)-1:0] value); \
    logic [NAME``_WIDE-1:0] wide, bias, rounded; \
    logic overflow; \
    wide = NAME``_WIDE'(value) << NAME``_LEFT; \
    bias = (NAME``_ROUND == 2) ? NAME``_BIAS + ((wide >> NAME``_RIGHT) & NAME``_EVEN) : NAME``_BIAS; \
    rounded = (NAME``_RIGHT == 0) ? wide : (wide + (`FASTSPLAT_FAULT(ROUND_TRN) ? '0 : bias)) >> NAME``_RIGHT; \
    overflow = rounded > NAME``_LARGEST; \
    NAME = {overflow, (overflow && !`FASTSPLAT_FAULT(NO_SATURATION)) ? NAME``_LARGEST[(OUT_BITS)-1:0] : rounded[(OUT_BITS)-1:0]}; \
  endfunction

//   FASTSPLAT_NARROW_SIGNED(NAME, IN_BITS, OUT_BITS, SHIFT)
//                               the same of two's complement, SHIFT bits less: nearest, halves up, saturating; returns the word
`define FASTSPLAT_NARROW_SIGNED(NAME, IN_BITS, OUT_BITS, SHIFT) \
  localparam int NAME``_WIDE = (((IN_BITS) > (OUT_BITS)) ? (IN_BITS) : (OUT_BITS)) + 2; \
  localparam logic signed [NAME``_WIDE-1:0] NAME``_BIAS = (NAME``_WIDE'(1) << (SHIFT)) >> 1; \
  localparam logic signed [NAME``_WIDE-1:0] NAME``_LARGEST = (NAME``_WIDE'(1) << ((OUT_BITS) - 1)) - NAME``_WIDE'(1); \
  function automatic logic signed [(OUT_BITS)-1:0] NAME(input logic signed [(IN_BITS)-1:0] value); \
    logic signed [NAME``_WIDE-1:0] rounded; \
    rounded = (NAME``_WIDE'(value) + NAME``_BIAS) >>> (SHIFT); \
    if (rounded > NAME``_LARGEST) rounded = NAME``_LARGEST; \
    if (rounded < ~NAME``_LARGEST) rounded = ~NAME``_LARGEST; \
    NAME = rounded[(OUT_BITS)-1:0]; \
  endfunction
`endif
