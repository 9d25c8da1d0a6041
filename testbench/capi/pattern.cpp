// SPDX-License-Identifier: Apache-2.0
// The ready/valid patterns of the C interface.
#include "testbench/device/pattern.hpp"

#include <memory>

#include "testbench/capi/guard.hpp"
#include "testbench/capi/handles.hpp"

struct fastsplat_pattern {
  fastsplat::testbench::Pattern pattern;
};

namespace fastsplat::capi {

extern "C" FASTSPLAT_API fastsplat_status fastsplat_pattern_create(const char* text, std::uint64_t seed,
                                                                   fastsplat_pattern** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "text", text);
    require(call, "out", out);
    auto handle = std::make_unique<fastsplat_pattern>(fastsplat_pattern{testbench::Pattern(text, seed)});
    born(handle.get(), Kind::Pattern);
    *out = handle.release();
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_pattern_destroy(fastsplat_pattern* pattern) {
  return guarded(__func__, [&](const char* call) {
    if (pattern == nullptr) return FASTSPLAT_OK;
    bury(call, pattern, Kind::Pattern);
    delete pattern;
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_pattern_at(const fastsplat_pattern* pattern, std::uint64_t cycle,
                                                               std::int32_t* ready) {
  return guarded(__func__, [&](const char* call) {
    require_live(call, pattern, Kind::Pattern);
    *require(call, "ready", ready) = pattern->pattern.at(cycle) ? 1 : 0;
    return FASTSPLAT_OK;
  });
}

}  // namespace fastsplat::capi
