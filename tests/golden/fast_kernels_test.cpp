// SPDX-License-Identifier: Apache-2.0
// Vector code against its plain definition: the same bits with every kind of vector instruction.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <random>

#include "golden/add_footprint.hpp"
#include "golden/ray_profile.hpp"
#include "golden/sheet.hpp"
#include "golden/splat_sums.hpp"
#include "scenes_helper.hpp"
#include "targets_helper.hpp"

namespace fastsplat::golden::testing {
namespace {

class Uniform {
 public:
  explicit Uniform(unsigned seed) : random_(seed) {}
  double operator()(double low, double high) { return low + (high - low) * (random_() / 4294967296.0); }
  int below(int end) { return static_cast<int>(random_() % static_cast<unsigned>(end)); }

 private:
  std::mt19937 random_;
};

/// Sums that differ in a bit, of rows [0, height).
std::size_t differing(const Sheet& a, const Sheet& b) {
  std::size_t bits = 0;
  for (int y = a.rows().first; y < a.rows().end; ++y) {
    for (int x = 0; x < a.width(); ++x) {
      for (int c = 0; c < 4; ++c) {
        bits += std::bit_cast<std::uint64_t>(a.row(y)[x][c]) != std::bit_cast<std::uint64_t>(b.row(y)[x][c]);
      }
    }
  }
  return bits;
}

TEST(FastKernels, FootprintsAreAddedBitForBit) {
  Targets targets;
  ASSERT_FALSE(targets.all().empty());
  constexpr int kMostSheets = 9;
  std::map<std::string, std::size_t> compared;
  for (const std::uint64_t target : targets.all()) {
    targets.choose(target);
    Uniform uniform(11);
    std::size_t sums = 0;
    for (const int width : {1, 7, 64, 129}) {
      for (const double scale : {0.2, 1.0, 2.3, 9.0}) {
        const Rows rows{5, 21};
        std::vector<Sheet> plain(kMostSheets, Sheet(rows, width)), fast(kMostSheets, Sheet(rows, width));
        const scene::Kernel kernel{uniform(0.5, 4.0), uniform(0.6, 3.0)};
        Footprint footprint;
        SplatSums together;
        for (int splat = 0; splat < 200; ++splat) {
          ProjectedSplat p;
          p.x = uniform(-3, width + 3), p.y = uniform(2, 24);  // clipped on every side
          p.shape = {scale * scale, uniform(-0.4, 0.4) * scale * scale, uniform(0.5, 1.5) * scale * scale};
          p.reach_x = kernel.radius() * std::sqrt(p.shape.xx), p.reach_y = kernel.radius() * std::sqrt(p.shape.yy);
          footprint.rasterise(kernel, p, rows, width);
          together.clear();
          for (int s = 0, sheets = uniform.below(kMostSheets + 1); s < sheets; ++s) {
            const Sums value{uniform(0, 1), uniform(0, 1e-9), uniform(-1, 1), uniform(0, 1e9)};
            plain[s].add(footprint, value);
            together.add(fast[s], rows.first, value);
          }
          together.add_footprint(footprint);
        }
        for (int s = 0; s < kMostSheets; ++s) {
          ASSERT_EQ(differing(plain[s], fast[s]), 0u) << add_footprint_target() << " width " << width << " s " << scale;
          sums += 4u * static_cast<std::size_t>(width) * 16u;
        }
      }
    }
    compared[add_footprint_target()] += sums;
  }
  for (const auto& [name, sums] : compared) {
    figure("sums_equal_bit_for_bit_on_" + name, static_cast<double>(sums), "more than 100000, every one");
    EXPECT_GT(sums, 100000u);
  }
}

TEST(FastKernels, KernelsAreWalkedBitForBit) {
  Targets targets;
  std::map<std::string, std::size_t> compared;
  for (const std::uint64_t target : targets.all()) {
    targets.choose(target);
    Uniform uniform(5);
    for (const auto& [a, radius] :
         std::initializer_list<std::pair<double, double>>{{2, 2}, {1.35, 2}, {0.1, 8}, {20, 0.5}, {1.02, 3}}) {
      const scene::Kernel kernel(a, radius);
      const RaySamples samples(13.7);
      for (const std::size_t part : {std::size_t{1}, std::size_t{37}, std::size_t{256}, samples.count}) {
        for (const int count : {1, 3, 4, 5, 50}) {
          RayProfile plain(kernel, samples), fast(kernel, samples);
          std::vector<RayHit> hits;
          for (int i = 0; i < count; ++i) {
            // Some on samples, some beyond the ends.
            const double depth = i % 5 == 0 ? (uniform.below(20) + 0.5) / 32.0 : uniform(-13.6, 13.6);
            hits.push_back(
                {{uniform(0, 1), uniform(0, 1e-6), uniform(0, 1e6), uniform(0, 1)}, samples.position(depth)});
            plain.add(hits.back());
          }
          std::vector<Sums> walked(samples.count);
          for (std::size_t begin = 0; begin < samples.count; begin += part) {
            const std::size_t end = std::min(begin + part, samples.count);
            fast.begin_part(begin, end);
            for (const RayHit& hit : hits) fast.add_to_part(hit);
            fast.flush();
            ASSERT_TRUE(fast.touched_begin() >= fast.touched_end() ||
                        (fast.touched_begin() >= begin && fast.touched_end() <= end));
            for (std::size_t j = fast.touched_begin(); j < fast.touched_end(); ++j) walked[j] = fast[j];
            fast.clear();
          }
          for (std::size_t j = 0; j < samples.count; ++j) {
            for (int c = 0; c < 4; ++c) {
              ASSERT_EQ(std::bit_cast<std::uint64_t>(plain[j][c]), std::bit_cast<std::uint64_t>(walked[j][c]))
                  << add_footprint_target() << " a " << a << " R " << radius << " part " << part << " sample " << j;
            }
          }
          compared[add_footprint_target()] += 4 * samples.count;
        }
      }
    }
  }
  for (const auto& [name, sums] : compared) {
    figure("samples_equal_bit_for_bit_on_" + name, static_cast<double>(sums), "more than 100000, every one");
    EXPECT_GT(sums, 100000u);
  }
}

}  // namespace
}  // namespace fastsplat::golden::testing
