// SPDX-License-Identifier: Apache-2.0
// Assertions of the device, for modules with clk_i and rst_ni. Verilator checks them in every simulation, Yosys with
// -formal proves them; elsewhere (synthesis) they vanish. A failing one prints its name.
//
//   FASTSPLAT_ASSERT(NAME, ALWAYS)            holds in every cycle outside reset
//   FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN)     when IF holds, THEN holds a cycle later. That IF held at all is cover point
//                                             NAME_met
//   FASTSPLAT_ASSERT_HELD(NAME, IF, THEN, VALUE)
//                                             the same, and a cycle later VALUE is what it was
//   FASTSPLAT_ASSUME..., with any of these endings
//                                             demands on the outside: asserted in simulation, assumed in proofs
//   FASTSPLAT_COVER(NAME, SOMETIMES)          must have happened once
//   FASTSPLAT_INIT(NAME, LEGAL, TEXT, A, B)   parameters: refused at elaboration with TEXT, which formats A and B
`ifndef FASTSPLAT_ASSERTIONS_SVH
`define FASTSPLAT_ASSERTIONS_SVH

`ifdef VERILATOR

// Immediate assertions at the clock edge, on the values that flip-flops sample. An equivalent concurrent property makes the
// simulator copy every operand on both clock edges: a tenth of a small device's run time.
`define FASTSPLAT_ASSERT(NAME, ALWAYS) \
  always_ff @(posedge clk_i) NAME: assert (!rst_ni || (ALWAYS)) else $error(`"NAME`");
`define FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN) \
  logic NAME``_before_q; \
  always_ff @(posedge clk_i) begin \
    NAME``_before_q <= rst_ni && (IF); \
    NAME: assert (!rst_ni || !NAME``_before_q || (THEN)) else $error(`"NAME`"); \
  end \
  NAME``_met: cover property (@(posedge clk_i) disable iff (!rst_ni) (IF));
`define FASTSPLAT_ASSERT_HELD(NAME, IF, THEN, VALUE) \
  logic [$bits(VALUE)-1:0] NAME``_value_q; \
  always_ff @(posedge clk_i) NAME``_value_q <= VALUE; \
  `FASTSPLAT_ASSERT_NEXT(NAME, IF, (THEN) && NAME``_value_q == VALUE)
`define FASTSPLAT_ASSUME(NAME, ALWAYS) `FASTSPLAT_ASSERT(NAME, ALWAYS)
`define FASTSPLAT_ASSUME_NEXT(NAME, IF, THEN) `FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN)
`define FASTSPLAT_ASSUME_HELD(NAME, IF, THEN, VALUE) `FASTSPLAT_ASSERT_HELD(NAME, IF, THEN, VALUE)
`define FASTSPLAT_COVER(NAME, SOMETIMES) \
  NAME: cover property (@(posedge clk_i) disable iff (!rst_ni) (SOMETIMES));
`define FASTSPLAT_INIT(NAME, LEGAL, TEXT, A, B) \
  if (!(LEGAL)) begin : gen_illegal_``NAME \
    $fatal(1, TEXT, A, B); \
  end

`else  // Yosys and others

`ifdef FORMAL
`define FASTSPLAT_ASSERT(NAME, ALWAYS) \
  always @(posedge clk_i) if (rst_ni) assert (ALWAYS);
`define FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN) \
  logic NAME``_before_q; \
  initial NAME``_before_q = 1'b0; \
  always @(posedge clk_i) begin \
    NAME``_before_q <= rst_ni && (IF); \
    if (rst_ni && NAME``_before_q) assert (THEN); \
  end
`define FASTSPLAT_ASSERT_HELD(NAME, IF, THEN, VALUE) \
  logic [$bits(VALUE)-1:0] NAME``_value_q; \
  always @(posedge clk_i) NAME``_value_q <= VALUE; \
  `FASTSPLAT_ASSERT_NEXT(NAME, IF, (THEN) && NAME``_value_q == VALUE)
`define FASTSPLAT_ASSUME(NAME, ALWAYS) \
  always @(posedge clk_i) if (rst_ni) assume (ALWAYS);
`define FASTSPLAT_ASSUME_NEXT(NAME, IF, THEN) \
  logic NAME``_before_q; \
  initial NAME``_before_q = 1'b0; \
  always @(posedge clk_i) begin \
    NAME``_before_q <= rst_ni && (IF); \
    if (rst_ni && NAME``_before_q) assume (THEN); \
  end
`define FASTSPLAT_ASSUME_HELD(NAME, IF, THEN, VALUE) \
  logic [$bits(VALUE)-1:0] NAME``_value_q; \
  always @(posedge clk_i) NAME``_value_q <= VALUE; \
  `FASTSPLAT_ASSUME_NEXT(NAME, IF, (THEN) && NAME``_value_q == VALUE)
`define FASTSPLAT_COVER(NAME, SOMETIMES) \
  always @(posedge clk_i) if (rst_ni) cover (SOMETIMES);
`else
`define FASTSPLAT_ASSERT(NAME, ALWAYS)
`define FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN)
`define FASTSPLAT_ASSERT_HELD(NAME, IF, THEN, VALUE)
`define FASTSPLAT_ASSUME(NAME, ALWAYS)
`define FASTSPLAT_ASSUME_NEXT(NAME, IF, THEN)
`define FASTSPLAT_ASSUME_HELD(NAME, IF, THEN, VALUE)
`define FASTSPLAT_COVER(NAME, SOMETIMES)
`endif

// Yosys has no formatted elaboration errors: it prints the text, then reports a missing module.
`define FASTSPLAT_INIT(NAME, LEGAL, TEXT, A, B) \
  if (!(LEGAL)) begin : gen_illegal_``NAME \
    initial begin $display(TEXT, A, B); end \
    illegal_parameter_``NAME u_illegal (); \
  end

`endif
`endif
