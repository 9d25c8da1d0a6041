// SPDX-License-Identifier: Apache-2.0
// The narrowing sites that observers see, by name: rounding, overflow and formats of each in a configuration.
// Observers: cmodel/numbers/observers.hpp.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "cmodel/numbers/config.hpp"
#include "cmodel/numbers/counters.hpp"
#include "cmodel/numbers/narrow.hpp"

namespace fastsplat::cmodel {

/// In the order of docs/numerics.md, sections 3 to 7.
enum class Site : std::uint8_t {
  Snap,          ///< xs, S pi.kl
  AxisProduct,   ///< index.kind separable: g(dx) g(dy), U wi.wf
  RadialFall,    ///< what interpolation subtracts from RADIAL[t], S (wi+1).wf
  Product,       ///< p_c, U si.sf
  Sum,           ///< S_c, U si.sf
  Fall,          ///< what interpolation subtracts from FACTOR[i], One.of
  SlabColour,    ///< mode 0: c_c, One.tf
  SlabOpacity,   ///< mode 0: a, One.tf
  AddedColour,   ///< mode 1: c_c, One.tf
  AddedOpacity,  ///< mode 1: a, One.tf
  Light,         ///< T * c_c, One.tf
  Over,          ///< C_c, U 1.tf
  Absorbed,      ///< T * a, One.tf
  SumOver,       ///< mode 2: X_c, U si.sf
  PixelOut,      ///< modes 0 and 1: R, G, B, A, U xi.xf
  PixelSum,      ///< mode 2: R, G, B, A, U xi.xf
};
constexpr std::size_t kSiteCount = 16;

struct SiteFacts {
  const char* name;                 ///< "slab_colour"; the RTL writes it in capitals
  std::uint64_t Counters::*counts;  ///< counter of overflows; null where none can occur
};
constexpr std::array<SiteFacts, kSiteCount> kSiteFacts{{
    {"snap", &Counters::snap_saturated},
    {"axis_product", nullptr},
    {"radial_fall", nullptr},
    {"product", &Counters::product_saturated},
    {"sum", &Counters::sheet_saturated},
    {"fall", nullptr},
    {"slab_colour", &Counters::opacity_saturated},
    {"slab_opacity", &Counters::opacity_saturated},
    {"added_colour", &Counters::opacity_saturated},
    {"added_opacity", &Counters::opacity_saturated},
    {"light", nullptr},
    {"over", &Counters::composite_saturated},
    {"absorbed", nullptr},
    {"sum_over", &Counters::composite_saturated},
    {"pixel_out", &Counters::pixel_saturated},
    {"pixel_sum", &Counters::pixel_saturated},
}};
/// Sums of words of one format: no fraction bit is dropped in any configuration.
constexpr bool is_sum(Site site) { return site == Site::Sum || site == Site::Over || site == Site::SumOver; }
constexpr const SiteFacts& facts(Site site) { return kSiteFacts[static_cast<std::size_t>(site)]; }

/// The site's narrowing in a configuration.
Narrowing narrowing(const Config& config, Site site);

/// All sites of a configuration.
class Sites {
 public:
  explicit Sites(const Config& config);
  const Narrowing& operator[](Site site) const { return table_[static_cast<std::size_t>(site)]; }

 private:
  std::array<Narrowing, kSiteCount> table_;
};

/// The narrowing of one site, for use in a unit.
template <Site S>
class NarrowAt {
 public:
  explicit NarrowAt(const Config& config) : narrowing_(narrowing(config, S)) {}

  /// Returns the narrowed word. Calls the observer with (site, narrowing, value, Narrowed).
  template <class Observer>
  std::int64_t operator()(std::int64_t value, Observer& observer) const {
    const Narrowed narrowed = is_sum(S) ? narrowing_.of_word(value) : narrowing_(value);
    observer(S, narrowing_, value, narrowed);
    return narrowed.word;
  }

 private:
  Narrowing narrowing_;
};

}  // namespace fastsplat::cmodel
