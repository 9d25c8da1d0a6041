// SPDX-License-Identifier: Apache-2.0
// Facts about the library: versions and names of counters.
#include "base/version.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/numbers/stall_counters.hpp"
#include "testbench/capi/fastsplat.h"
#include "testbench/capi/guard.hpp"
#include "testbench/capi/handles.hpp"

namespace fastsplat::capi {
namespace {

constexpr const char* kCounters[] = {
#define X(name, meaning) #name,
    FASTSPLAT_COUNTERS(X)
#undef X
#define X(name, counter, meaning) #name,
        FASTSPLAT_STALL_COUNTERS(X)
#undef X
};
static_assert(std::size(kCounters) == FASTSPLAT_COUNTERS_CULLING);
static_assert(sizeof(cmodel::Counters) == FASTSPLAT_MODEL_COUNTERS * sizeof(std::uint64_t));

}  // namespace

extern "C" FASTSPLAT_API std::uint32_t fastsplat_api_version(void) {
  return static_cast<std::uint32_t>(FASTSPLAT_API_MAJOR) << 16 | FASTSPLAT_API_MINOR;
}

extern "C" FASTSPLAT_API const char* fastsplat_version(void) {
  static const std::string version = program_version();
  return version.c_str();
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_counter_name(std::size_t index, const char** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "out", out);
    if (index >= std::size(kCounters)) return FASTSPLAT_NONE;
    *out = kCounters[index];
    return FASTSPLAT_OK;
  });
}

}  // namespace fastsplat::capi
