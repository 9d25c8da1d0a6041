// Assertions of the device, for modules with clk_i and rst_ni. Verilator checks them in every simulation, Yosys with
// -formal proves them; elsewhere (synthesis) they vanish. A failing one prints its name.
//
//   FASTSPLAT_ASSERT(NAME, ALWAYS)            holds in every cycle outside reset
//   FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN)     when IF holds, THEN holds a cycle later; THEN may use $past and $stable. That
//                                             IF held at all is cover point NAME_met
//   FASTSPLAT_ASSUME(NAME, ALWAYS) and FASTSPLAT_ASSUME_NEXT(NAME, IF, THEN)
//                                             demands on the outside: asserted in simulation, assumed in proofs
//   FASTSPLAT_COVER(NAME, SOMETIMES)          must have happened once
//   FASTSPLAT_INIT(NAME, LEGAL, TEXT, A, B)   parameters: refused at elaboration with TEXT, which formats A and B
`ifndef FASTSPLAT_ASSERTIONS_SVH
`define FASTSPLAT_ASSERTIONS_SVH

`ifdef VERILATOR

`define FASTSPLAT_ASSERT(NAME, ALWAYS) \
  NAME: assert property (@(posedge clk_i) disable iff (!rst_ni) (ALWAYS)) else $error(`"NAME`");
`define FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN) \
  NAME: assert property (@(posedge clk_i) disable iff (!rst_ni) (rst_ni && (IF)) |=> (THEN)) else $error(`"NAME`"); \
  NAME``_met: cover property (@(posedge clk_i) disable iff (!rst_ni) (IF));
`define FASTSPLAT_ASSUME(NAME, ALWAYS) `FASTSPLAT_ASSERT(NAME, ALWAYS)
`define FASTSPLAT_ASSUME_NEXT(NAME, IF, THEN) `FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN)
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
`define FASTSPLAT_ASSUME(NAME, ALWAYS) \
  always @(posedge clk_i) if (rst_ni) assume (ALWAYS);
`define FASTSPLAT_ASSUME_NEXT(NAME, IF, THEN) \
  logic NAME``_before_q; \
  initial NAME``_before_q = 1'b0; \
  always @(posedge clk_i) begin \
    NAME``_before_q <= rst_ni && (IF); \
    if (rst_ni && NAME``_before_q) assume (THEN); \
  end
`define FASTSPLAT_COVER(NAME, SOMETIMES) \
  always @(posedge clk_i) if (rst_ni) cover (SOMETIMES);
`else
`define FASTSPLAT_ASSERT(NAME, ALWAYS)
`define FASTSPLAT_ASSERT_NEXT(NAME, IF, THEN)
`define FASTSPLAT_ASSUME(NAME, ALWAYS)
`define FASTSPLAT_ASSUME_NEXT(NAME, IF, THEN)
`define FASTSPLAT_COVER(NAME, SOMETIMES)
`endif

// Yosys has no formatted elaboration errors: it prints the text, then misses the module.
`define FASTSPLAT_INIT(NAME, LEGAL, TEXT, A, B) \
  if (!(LEGAL)) begin : gen_illegal_``NAME \
    initial begin $display(TEXT, A, B); end \
    illegal_parameter_``NAME u_illegal (); \
  end

`endif
`endif
