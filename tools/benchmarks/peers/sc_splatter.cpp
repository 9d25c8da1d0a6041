// SPDX-License-Identifier: Apache-2.0
#include "tools/benchmarks/peers/sc_splatter.hpp"

#define SC_INCLUDE_FX
#include <cmath>
#include <systemc>
#include <vector>

#include "cmodel/splat/rlut.hpp"
#include "cmodel/splat/snap.hpp"

// SystemC's library has its own main(), which calls sc_main().
int sc_main(int, char**) { return 0; }

namespace fastsplat::bench {
namespace {

/// Parameters: widths of a configuration, named as in docs/numerics.md, section 2.
template <int nl, int g, int wi, int wf, int cf, int si, int sf>
class Splatter final : public ScSplatter {
  using Distance = sc_dt::sc_uint<nl + g + 2>;
  using Weight = sc_dt::sc_ufixed<wi + wf, wi>;
  using Colour = sc_dt::sc_ufixed<cf, 0>;
  using Product = sc_dt::sc_ufixed<si + sf, si, sc_dt::SC_RND, sc_dt::SC_SAT>;
  using Sum = sc_dt::sc_ufixed<si + sf, si, sc_dt::SC_TRN, sc_dt::SC_SAT>;

 public:
  static bool fits(const cmodel::Config& c) {
    return c.radial_index_bits() == nl && c.rlut_guard_bits == g && c.radial_int_bits == wi &&
           c.radial_frac_bits == wf && c.colour_frac_bits == cf && c.sheet_int_bits == si && c.sheet_frac_bits == sf &&
           c.rounding_product == static_cast<int>(cmodel::Rounding::RND);
  }

  Splatter(const cmodel::Config& config, const cmodel::LoadTable& rlut, const cmodel::LoadTable& radial)
      : config_(config), rho_(rlut.radius.rho) {
    cmodel::Rlut table(config);
    table.load(rlut);
    extent_ = table.extent(0);
    for (std::uint32_t phase = 0; phase < static_cast<std::uint32_t>(config.phases); ++phase) {
      for (std::uint32_t column = 0; column < extent_; column += static_cast<std::uint32_t>(config.lanes)) {
        for (const std::uint32_t word : table.read(0, phase, column)) distances_.push_back(word);
      }
    }
    for (const std::uint32_t word : radial.words) weights_.push_back(real<Weight>(word, wf));
    begin();
  }

  void begin() override {
    sums_.assign(static_cast<std::size_t>(config_.tile_width) * static_cast<std::size_t>(config_.tile_height) * 4,
                 Sum(0));
  }

  void splats(std::span<const cmodel::SplatRecord> records) override {
    for (const cmodel::SplatRecord& record : records) {
      const cmodel::SnappedAxis x = cmodel::snap(config_, record.x, rho_), y = cmodel::snap(config_, record.y, rho_);
      const Colour colour[4] = {real<Colour>(record.colour[0], cf), real<Colour>(record.colour[1], cf),
                                real<Colour>(record.colour[2], cf), real<Colour>(record.colour[3], cf)};
      const Distance* columns = &distances_[std::size_t{x.phase} * extent_];
      const Distance* rows = &distances_[std::size_t{y.phase} * extent_];
      for (std::uint32_t j = 0; j < extent_; ++j) {
        for (std::uint32_t i = 0; i < extent_; ++i) {
          const Distance q = columns[i] + rows[j];
          const Distance t = q >> g;
          if (t >= weights_.size()) continue;
          const Weight& weight = weights_[t];
          if (weight == 0) continue;
          Sum* sums = &sums_[index(x.origin + static_cast<int>(i), y.origin + static_cast<int>(j))];
          for (std::size_t c = 0; c < 4; ++c) {
            const Product product = colour[c] * weight;
            sums[c] = sums[c] + product;
          }
        }
      }
    }
  }

  std::uint32_t word(int x, int y, std::size_t channel) const override {
    return static_cast<std::uint32_t>(std::ldexp(sums_[index(x, y) + channel].to_double(), sf));
  }

 private:
  template <class Fixed>
  static Fixed real(std::uint32_t word, int frac_bits) {
    return Fixed(std::ldexp(static_cast<double>(word), -frac_bits));
  }
  std::size_t index(int x, int y) const {
    return (static_cast<std::size_t>(y) * static_cast<std::size_t>(config_.tile_width) + static_cast<std::size_t>(x)) *
           4;
  }

  cmodel::Config config_;
  std::uint32_t rho_, extent_ = 0;
  std::vector<Distance> distances_;  ///< [phase][column]
  std::vector<Weight> weights_;
  std::vector<Sum> sums_;
};

using Base = Splatter<10, 6, 1, 14, 16, 2, 16>;
using Compact = Splatter<8, 6, 0, 8, 15, 1, 15>;

}  // namespace

std::unique_ptr<ScSplatter> make_sc_splatter(const cmodel::Config& config, const cmodel::LoadTable& rlut,
                                             const cmodel::LoadTable& radial) {
  if (Base::fits(config)) return std::make_unique<Base>(config, rlut, radial);
  if (Compact::fits(config)) return std::make_unique<Compact>(config, rlut, radial);
  return nullptr;
}

}  // namespace fastsplat::bench
