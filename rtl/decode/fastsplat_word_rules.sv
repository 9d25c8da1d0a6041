// SPDX-License-Identifier: Apache-2.0
// For each word of a beat: which tables it is legal in (docs/stream.md, rule 8), if the beat is table words.
// Combinational first stage of unit "check" (fastsplat_stream_check.sv). The second stage knows the table and the
// number of its words.

module fastsplat_word_rules (
    input  logic [fastsplat_pkg::BEAT_BITS-1:0] beat_i,
    input  logic [fastsplat_pkg::FACTOR_BITS-1:0] before_i,  // the last word of the beat before
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] zero_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] rlut_o,     // a word of RLUT, RADIAL, FACTOR
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] radial_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] factor_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] falls_o,    // no larger than the word before
    // a word of CLASSIFY, ROOT, GLINT, of LIGHTING in its first beat and in its second, of SHEETS
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] classify_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] root_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] glint_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] vectors_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] tilts_o,
    output logic [fastsplat_pkg::BEAT_WORDS-1:0] sheets_o
);
  localparam int FB = fastsplat_pkg::FACTOR_BITS;
  // word <= most: a constant, 2^n or 2^n - 1, which cost no comparison.
  function automatic logic at_most(input logic [31:0] word, input logic [31:0] most);
    if ((most & (most + 32'd1)) == '0) at_most = (word & ~most) == '0;
    else at_most = (word & ~(most | (most - 32'd1))) == '0 && ((word & most) == '0 || (word & (most - 32'd1)) == '0);
  endfunction

  for (genvar i = 0; i < fastsplat_pkg::BEAT_WORDS; i++) begin : gen_word
    logic [31:0] word;
    logic [FB-1:0] previous;
    assign word = beat_i[32*i+:32];
    if (i == 0) begin : gen_first
      assign previous = before_i;
    end else begin : gen_other
      assign previous = beat_i[32*(i-1)+:FB];
    end
    assign zero_o[i] = word == '0;
    assign rlut_o[i] = at_most(word, fastsplat_pkg::RLUT_WORD_MOST);
    assign radial_o[i] = at_most(word, fastsplat_pkg::RADIAL_WORD_MOST);
    assign factor_o[i] = at_most(word, fastsplat_pkg::FACTOR_WORD_MOST);
    assign falls_o[i] = word[FB-1:0] <= previous;
    if (fastsplat_pkg::DENSITIES != 0) begin : gen_densities
      logic vector;  // -2^14..2^14
      assign vector = word[31:14] == '0 || word[31:14] == '1 || word == 32'h4000;
      assign classify_o[i] = at_most(word, (i % 4 == 3) ? fastsplat_pkg::DENSITY_WORD_MOST : 32'h4000);
      assign root_o[i] = at_most(word, 32'h4000);
      assign glint_o[i] = at_most(word, 32'h1000);
      assign vectors_o[i] = (i < 6) ? vector : word[31:16] == '0;
      assign tilts_o[i] = i > 0 || word[31:16] == '0;
      assign sheets_o[i] = i % 2 == 1 || (at_most(32'(word[15:0]), 32'h1000) && at_most(32'(word[31:16]), 32'h1000));
    end else begin : gen_colours
      assign {classify_o[i], root_o[i], glint_o[i], vectors_o[i], tilts_o[i], sheets_o[i]} = '0;
    end
  end
endmodule
