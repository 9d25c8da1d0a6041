// SPDX-License-Identifier: Apache-2.0
// The passive checker of libfastsplat for SystemVerilog (docs/capi.md): imports of fastsplat.h and fastsplat_dpi.h.
// Read fastsplat_pkg, the package of the device's configuration, first. Every int result is a status: 0 is success,
// else fastsplat_last_error() has the reason.
package fastsplat_dpi_pkg;
  localparam int API_MAJOR = 3;  // of fastsplat_api_version() >> 16

  import "DPI-C" function int unsigned fastsplat_api_version();
  import "DPI-C" function string fastsplat_last_error();

  // null if the configuration is unknown or not the device's.
  import "DPI-C" function chandle fastsplat_dpi_checker(
    input string config_name, input longint unsigned hash, input string input_pattern, input string output_pattern,
    input longint unsigned seed);
  import "DPI-C" function int fastsplat_checker_destroy(input chandle judge);
  import "DPI-C" function int fastsplat_checker_reset(input chandle judge);
  import "DPI-C" function int fastsplat_checker_start(input chandle judge, input longint unsigned first_beat);
  import "DPI-C" function int fastsplat_checker_stopped(input chandle judge, output int stopped);
  import "DPI-C" function string fastsplat_checker_first_mismatch(input chandle judge);
  import "DPI-C" function string fastsplat_checker_summary(input chandle judge);

  // The device's outputs and taken beats, in the order of its cycles, within a cycle in this order; tile: tap_tile_o.
  import "DPI-C" function int fastsplat_dpi_snap(
    input chandle judge, input longint unsigned cycle, input int unsigned tile, input int unsigned tag,
    input int unsigned x, input int unsigned y, input int unsigned mx, input int unsigned my);
  import "DPI-C" function int fastsplat_dpi_sheet(
    input chandle judge, input longint unsigned cycle, input int unsigned tile, input int unsigned tag,
    input bit [fastsplat_pkg::BANKS*4*fastsplat_pkg::SHEET_BITS-1:0] sums, input int unsigned words);
  import "DPI-C" function int fastsplat_dpi_window(
    input chandle judge, input longint unsigned cycle, input int unsigned tile, input int unsigned tag,
    input int unsigned x, input int unsigned y, input bit [fastsplat_pkg::BANKS*fastsplat_pkg::WEIGHT_BITS-1:0] weights,
    input int unsigned words);
  import "DPI-C" function int fastsplat_dpi_composite(
    input chandle judge, input longint unsigned cycle, input int unsigned tile, input int unsigned block,
    input bit [fastsplat_pkg::BANKS*4*fastsplat_pkg::STATE_BITS-1:0] state, input int unsigned words);
  import "DPI-C" function int fastsplat_dpi_sheet_done(input chandle judge, input longint unsigned cycle);
  import "DPI-C" function int fastsplat_dpi_pixels(
    input chandle judge, input longint unsigned cycle, input int unsigned tile,
    input bit [fastsplat_pkg::LANES*128-1:0] pixels, input int unsigned words, input int unsigned keep, input int last,
    input int cut);
  import "DPI-C" function int fastsplat_dpi_verdict(
    input chandle judge, input longint unsigned cycle, input int unsigned tag, input int hidden);
  import "DPI-C" function int fastsplat_dpi_took(input chandle judge, input bit [fastsplat_pkg::BEAT_BITS-1:0] beat);

  // The device has come to rest; 0 is a pass. Counter n at bits 64 n and up.
  import "DPI-C" function int fastsplat_dpi_finish(
    input chandle judge, input bit [64*fastsplat_pkg::COUNTERS-1:0] counters, input int unsigned words);

  // In which cycles a side of a channel is ready (docs/verify.md, "Patterns").
  import "DPI-C" function int fastsplat_pattern_create(
    input string text, input longint unsigned seed, output chandle pattern);
  import "DPI-C" function int fastsplat_pattern_at(
    input chandle pattern, input longint unsigned cycle, output int ready);

  // Number of 32-bit words of a vector.
  function automatic int unsigned words_of(input int unsigned bits);
    return (bits + 32'd31) / 32'd32;
  endfunction

  localparam longint unsigned HASH = {fastsplat_pkg::HASH_HIGH, fastsplat_pkg::HASH_LOW};
endpackage
