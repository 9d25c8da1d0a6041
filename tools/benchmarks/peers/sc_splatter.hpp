// The inner loop of the device as it is commonly described: SystemC's sc_ufixed types, weight by weight.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>

#include "cmodel/numbers/config.hpp"
#include "cmodel/stream/records.hpp"

namespace fastsplat::bench {

/// docs/numerics.md, sections 4 and 5: RLUT words are added, the radial table is read, products are rounded and
/// saturated, sums saturate. Windows that lie inside the tile; a weight of 0 is passed over, as the plain unit does.
class ScSplatter {
 public:
  virtual ~ScSplatter() = default;
  /// A tile of zeros.
  virtual void begin() = 0;
  virtual void splats(std::span<const cmodel::SplatRecord> records) = 0;
  /// The word of a sum, as the device has it.
  virtual std::uint32_t word(int x, int y, std::size_t channel) const = 0;
};

/// Of radius set 0 and no other. The types' widths are fixed when this is compiled: null where no splatter has those of
/// this configuration.
std::unique_ptr<ScSplatter> make_sc_splatter(const cmodel::Config& config, const cmodel::LoadTable& rlut,
                                             const cmodel::LoadTable& radial);

}  // namespace fastsplat::bench
