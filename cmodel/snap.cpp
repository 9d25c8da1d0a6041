#include "cmodel/snap.hpp"

#include "cmodel/narrow.hpp"

namespace fastsplat::cmodel {

SnappedAxis snap(const Config& config, std::int32_t centre, std::uint32_t rho) {
  const Narrowed on_grid =
      narrow<Rounding::RND, Overflow::SAT>(centre, config.position_frac_bits, config.snapped_format());
  const std::int64_t rim = on_grid.word - static_cast<std::int64_t>(rho);
  const std::int64_t k = config.phases;
  return {.origin = static_cast<std::int32_t>((rim >> config.phase_bits()) + 1),
          .phase = static_cast<std::uint32_t>(rim & (k - 1)),
          .saturated = on_grid.overflow};
}

}  // namespace fastsplat::cmodel
