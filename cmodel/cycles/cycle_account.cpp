// SPDX-License-Identifier: Apache-2.0
#include "cmodel/cycles/cycle_account.hpp"

#include <algorithm>
#include <cassert>

namespace fastsplat::cmodel {

void Accountant::Walk::add(Pause kind, std::uint64_t a, std::uint64_t b) {
  const std::uint64_t first = std::max(a, from), last = std::min(b, to);
  if (first < last) paused[index(kind)] += last - first;
}

void Accountant::sheet(std::size_t buffer, std::uint64_t windows, std::uint64_t from, std::uint64_t to) {
  account_.ideal += windows;
  walks_[1 - buffer].windows_beside += windows;
  walks_[buffer] = {.from = from, .to = to, .windows_beside = 0, .paused = {}};
}

void Accountant::settle(std::size_t buffer) {
  Walk& walk = walks_[buffer];
  const std::uint64_t picks = walk.to - walk.from;
  // Slices that the next sheet's windows cannot hide cost a cycle even in an ideal device. Decode pauses in at least as
  // many of the walk's cycles.
  std::uint64_t exposed = picks > walk.windows_beside ? picks - walk.windows_beside : 0;
  account_.ideal += exposed;
  for (std::size_t kind = 0; kind < pauses_.size(); ++kind) {
    const std::uint64_t taken = std::min(exposed, walk.paused[kind]);
    pauses_[kind] -= taken;
    exposed -= taken;
  }
  assert(exposed == 0);
  walk = {};
}

CycleAccount Accountant::account() const {
  CycleAccount out = account_;
  out.sheet_buffer = pauses_[index(Pause::Buffer)];
  out.drain = pauses_[index(Pause::Drain)];
  out.input = pauses_[index(Pause::Input)];
  out.map = pauses_[index(Pause::Map)];
  out.hidden = pauses_[index(Pause::Hidden)];
  out.records = pauses_[index(Pause::Records)];
  out.hazard = pauses_[index(Pause::Hazard)];
  return out;
}

}  // namespace fastsplat::cmodel
