// SPDX-License-Identifier: Apache-2.0
// The device's inner loop as it is commonly modelled: SystemC's sc_ufixed types, weight by weight.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::bench {

/// docs/numerics.md, sections 4 and 5: adds RLUT words, reads the radial table, rounds and saturates products,
/// saturates sums. Windows must lie inside the tile; weights of 0 are skipped, as in the plain unit.
class ScSplatter {
 public:
  virtual ~ScSplatter() = default;
  /// Clears the tile.
  virtual void begin() = 0;
  virtual void splats(std::span<const cmodel::SplatRecord> records) = 0;
  /// A sum as the device's word.
  virtual std::uint32_t word(int x, int y, std::size_t channel) const = 0;
};

/// Uses radius set 0 only. Widths are fixed at compile time: null if no splatter has those of this configuration.
std::unique_ptr<ScSplatter> make_sc_splatter(const cmodel::Config& config, const cmodel::LoadTable& rlut,
                                             const cmodel::LoadTable& radial);

}  // namespace fastsplat::bench
