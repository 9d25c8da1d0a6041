// SPDX-License-Identifier: Apache-2.0
// Functions of libfastsplat that SystemVerilog needs beside fastsplat.h: no structures, and vector ports as DPI-C
// passes them (32-bit words, least significant first). testbench/capi/sv/fastsplat_dpi_pkg.sv imports them.
#pragma once

#include "fastsplat.h"

#ifdef __cplusplus
extern "C" {
#endif

/// Creates a checker of a whole stream. `config`: a built-in configuration or a TOML file, which must have the hash
/// that the device was built with. `input`, `output`, `seed`: as in fastsplat_checker_options; verdicts are shown. On
/// failure NULL, with fastsplat_last_error().
FASTSPLAT_API void* fastsplat_dpi_checker(const char* config, uint64_t hash, const char* input, const char* output,
                                          uint64_t seed);

/// Reports a beat that was taken, 256 bits.
FASTSPLAT_API fastsplat_status fastsplat_dpi_took(void* checker, const uint32_t* beat);

// Report what a port shows (fastsplat_shown, with all values given). `words`: the vector; `tile`: tap_tile_o.
FASTSPLAT_API fastsplat_status fastsplat_dpi_snap(void* checker, uint64_t cycle, uint32_t tile, uint32_t tag,
                                                  uint32_t x, uint32_t y, uint32_t mx, uint32_t my);
FASTSPLAT_API fastsplat_status fastsplat_dpi_sheet(void* checker, uint64_t cycle, uint32_t tile, uint32_t tag,
                                                   const uint32_t* sums, uint32_t words);
FASTSPLAT_API fastsplat_status fastsplat_dpi_window(void* checker, uint64_t cycle, uint32_t tile, uint32_t tag,
                                                    uint32_t x, uint32_t y, const uint32_t* weights, uint32_t words);
FASTSPLAT_API fastsplat_status fastsplat_dpi_composite(void* checker, uint64_t cycle, uint32_t tile, uint32_t block,
                                                       const uint32_t* state, uint32_t words);
FASTSPLAT_API fastsplat_status fastsplat_dpi_sheet_done(void* checker, uint64_t cycle);
FASTSPLAT_API fastsplat_status fastsplat_dpi_pixels(void* checker, uint64_t cycle, uint32_t tile,
                                                    const uint32_t* pixels, uint32_t words, uint32_t keep, int32_t last,
                                                    int32_t cut);
FASTSPLAT_API fastsplat_status fastsplat_dpi_verdict(void* checker, uint64_t cycle, uint32_t tag, int32_t hidden);

/// fastsplat_checker_finish with `words`/2 counters, each two words, the low one first.
FASTSPLAT_API fastsplat_status fastsplat_dpi_finish(void* checker, const uint32_t* counters, uint32_t words);

#ifdef __cplusplus
}
#endif
