// SPDX-License-Identifier: Apache-2.0
// Streams that break one rule each, which a device must refuse.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cmodel/stream/stream_rules.hpp"
#include "testbench/stimulus/directed_stream.hpp"

namespace fastsplat::testbench {

using Beats = std::vector<cmodel::Beat>;

struct Violation {
  std::string name;
  cmodel::StreamRule rule;
  std::function<void(Beats&)> commit;  ///< on a copy of the stream it was made for
};

/// Every rule that a device checks, broken in each way `beats` allows; numbers just beside the right ones, bits at both
/// ends. `beats` is a whole legal stream with every record and a tile of two sheets (small_stream()).
std::vector<Violation> violations(const cmodel::Config& config, const Beats& beats);

}  // namespace fastsplat::testbench
