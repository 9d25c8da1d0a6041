// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "base/hash_text.hpp"
#include "driver/config/config_file.hpp"
#include "testbench/capi/config_handle.hpp"
#include "testbench/capi/fastsplat_dpi.h"
#include "testbench/capi/guard.hpp"
#include "testbench/capi/handles.hpp"

namespace fastsplat::capi {
namespace {

fastsplat_shown at(std::uint32_t port, std::uint64_t cycle) {
  fastsplat_shown shown{};
  shown.struct_size = sizeof shown;
  shown.port = port;
  shown.cycle = cycle;
  return shown;
}

fastsplat_shown in_tile(std::uint32_t port, std::uint64_t cycle, std::uint32_t tile) {
  fastsplat_shown shown = at(port, cycle);
  shown.given = FASTSPLAT_GIVEN_TILE;
  shown.tile = tile;
  return shown;
}

fastsplat_shown in_tile(std::uint32_t port, std::uint64_t cycle, std::uint32_t tile, const std::uint32_t* vector,
                        std::uint32_t words) {
  fastsplat_shown shown = in_tile(port, cycle, tile);
  shown.word_count = words;
  shown.words = vector;
  return shown;
}

fastsplat_status show(void* checker, const fastsplat_shown& shown) {
  return fastsplat_checker_showed(static_cast<fastsplat_checker*>(checker), &shown);
}

}  // namespace

extern "C" FASTSPLAT_API void* fastsplat_dpi_checker(const char* config, std::uint64_t hash, const char* input,
                                                     const char* output, std::uint64_t seed) {
  void* out = nullptr;
  guarded(__func__, [&](const char* call) -> fastsplat_status {
    fastsplat_config parsed{driver::load_config(require(call, "config", config))};
    if (const auto own = cmodel::config_hash(parsed.config); own != hash) {
      throw_input({.where = config,
                   .what = "the device was built for another configuration",
                   .expected = hash_text(own),
                   .got = hash_text(hash),
                   .fix = "use the configuration of its fastsplat_pkg"});
    }
    const fastsplat_checker_options options{.struct_size = sizeof options,
                                            .scope = FASTSPLAT_WHOLE,
                                            .stop_after = 0,
                                            .input_pattern = require(call, "input", input),
                                            .output_pattern = require(call, "output", output),
                                            .seed = seed,
                                            .verdicts = 1};
    born(&parsed, Kind::Config);
    fastsplat_checker* checker = nullptr;
    const auto status = fastsplat_checker_create(&parsed, &options, &checker);
    bury(call, &parsed, Kind::Config);
    out = checker;
    return status;
  });
  return out;
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_took(void* checker, const std::uint32_t* beat) {
  return fastsplat_checker_took(static_cast<fastsplat_checker*>(checker), beat, 1);
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_snap(void* checker, std::uint64_t cycle, std::uint32_t tile,
                                                             std::uint32_t tag, std::uint32_t x, std::uint32_t y,
                                                             std::uint32_t mx, std::uint32_t my) {
  fastsplat_shown shown = in_tile(FASTSPLAT_PORT_SNAP, cycle, tile);
  shown.tag = tag;
  shown.x = x;
  shown.y = y;
  shown.mx = mx;
  shown.my = my;
  return show(checker, shown);
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_sheet(void* checker, std::uint64_t cycle, std::uint32_t tile,
                                                              std::uint32_t tag, const std::uint32_t* sums,
                                                              std::uint32_t words) {
  fastsplat_shown shown = in_tile(FASTSPLAT_PORT_SHEET, cycle, tile, sums, words);
  shown.tag = tag;
  return show(checker, shown);
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_window(void* checker, std::uint64_t cycle, std::uint32_t tile,
                                                               std::uint32_t tag, std::uint32_t x, std::uint32_t y,
                                                               const std::uint32_t* weights, std::uint32_t words) {
  fastsplat_shown shown = in_tile(FASTSPLAT_PORT_WINDOW, cycle, tile, weights, words);
  shown.tag = tag;
  shown.x = x;
  shown.y = y;
  return show(checker, shown);
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_composite(void* checker, std::uint64_t cycle,
                                                                  std::uint32_t tile, std::uint32_t block,
                                                                  const std::uint32_t* state, std::uint32_t words) {
  fastsplat_shown shown = in_tile(FASTSPLAT_PORT_COMPOSITE, cycle, tile, state, words);
  shown.block = block;
  return show(checker, shown);
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_sheet_done(void* checker, std::uint64_t cycle) {
  return show(checker, at(FASTSPLAT_PORT_SHEET_DONE, cycle));
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_pixels(void* checker, std::uint64_t cycle, std::uint32_t tile,
                                                               const std::uint32_t* pixels, std::uint32_t words,
                                                               std::uint32_t keep, std::int32_t last,
                                                               std::int32_t cut) {
  fastsplat_shown shown = in_tile(FASTSPLAT_PORT_PIXELS, cycle, tile, pixels, words);
  shown.given |= FASTSPLAT_GIVEN_KEEP;
  shown.keep = keep;
  shown.last = last;
  shown.cut = cut;
  return show(checker, shown);
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_verdict(void* checker, std::uint64_t cycle, std::uint32_t tag,
                                                                std::int32_t hidden) {
  fastsplat_shown shown = at(FASTSPLAT_PORT_VERDICT, cycle);
  shown.tag = tag;
  shown.hidden = hidden;
  return show(checker, shown);
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_dpi_finish(void* checker, const std::uint32_t* counters,
                                                               std::uint32_t words) {
  return guarded(__func__, [&](const char* call) {
    if (words > 0) require(call, "counters", counters);
    std::vector<std::uint64_t> values(words / 2);
    for (std::size_t i = 0; i < values.size(); ++i)
      values[i] = counters[2 * i] | static_cast<std::uint64_t>(counters[2 * i + 1]) << 32;
    return fastsplat_checker_finish(static_cast<fastsplat_checker*>(checker), values.data(), values.size());
  });
}

}  // namespace fastsplat::capi
