// SPDX-License-Identifier: Apache-2.0
#include "tests/driver/fast_unit_helper.hpp"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <cstdio>

#include "base/error.hpp"
#include "cmodel/fast/row_kernel.hpp"

namespace fastsplat::driver {
namespace {

constexpr int kThreads[] = {1, 2, 3, 8};
constexpr int kBandRows[] = {0, 1, 1000, 2, 64, 7, 12};  // rounded up to blocks of 2 to 16 pixels; tiles of 32 to 128

bool same_report(const DriverReport& a, const DriverReport& b) {
  return a.splat_records == b.splat_records && a.saturated_records == b.saturated_records && a.sheets == b.sheets &&
         a.tiles == b.tiles;
}

}  // namespace

Targets::Targets() {
  std::uint64_t left = static_cast<std::uint64_t>(hwy::SupportedTargets());
  for (; left != 0; left &= left - 1) {
    choose(left & (~left + 1));
    if (cmodel::fast::has_vectors()) all_.push_back(left & (~left + 1));
  }
  choose(0);
  EXPECT_FALSE(all_.empty()) << "no vector instructions here: nothing can be compared";
}

void Targets::choose(std::uint64_t target) {
  hwy::SetSupportedTargetsForTest(static_cast<std::int64_t>(target));
  hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

void UnitsCompared::add(const std::string& name, const std::string& what, const char* difference,
                        const cmodel::Frame& frame, const UnitReport& units) {
  ++frames_;
  ++drawn_with_[cmodel::fast::vector_target()];
  words_ += frame.words.size();
  UnitReport& sum = units_[name];
  sum += units;
  EXPECT_EQ(units.plain, units.redone) << what << ": the fast unit was not chosen";
  if (difference != nullptr && ++different_ <= 5)
    ADD_FAILURE() << what << " on " << cmodel::fast::vector_target() << ": " << difference << " differ";
}

void UnitsCompared::frame(const std::string& name, const std::string& what, const scene::SceneDescription& description,
                          const cmodel::Config& config) {
  const scene::Scene scene = scene::build_scene(description);
  DeviceRender plain;
  try {
    plain = render(scene, config, {.threads = 1, .unit = Unit::Plain});
  } catch (const UserError&) {
    return;  // a footprint wider than the RLUT
  }
  EXPECT_EQ(plain.units.fast, 0u) << what;
  for (const std::uint64_t target : targets_.all()) {
    targets_.choose(target);
    // Every target and configuration meets every number of threads and every height.
    const int threads = kThreads[(frames_ + combinations_) % 4], rows = kBandRows[frames_ % 7];
    const DeviceRender fast = render(scene, config, {.threads = threads, .unit = Unit::Fast, .band_rows = rows});
    const char* difference = fast.frame.words != plain.frame.words     ? "words"
                             : !(fast.counters == plain.counters)      ? "counters"
                             : !same_report(fast.report, plain.report) ? "reports"
                                                                       : nullptr;
    add(name, what + ", " + std::to_string(threads) + " threads, bands of " + std::to_string(rows) + " rows",
        difference, fast.frame, fast.units);
    // Every third frame in bands of another height, too.
    for (const int height : {rows, kBandRows[(frames_ + 3) % 7]}) {
      if (height != rows && frames_ % 3 != 0) continue;
      const DeviceRender picture = render(scene, config, {.threads = threads, .counters = false, .band_rows = height});
      pictures_ += picture.counted ? 0 : 1;
      if (picture.frame.words != plain.frame.words && ++different_ <= 5)
        ADD_FAILURE() << what << ", without counters, " << threads << " threads, bands of " << height << " rows";
    }
  }
  ++combinations_;
}

void UnitsCompared::gaussians(const std::string& what, const GaussianFrame& frame) {
  const GaussianRender plain = render_gaussians(frame, {.threads = 1, .unit = Unit::Plain});
  EXPECT_EQ(plain.units.fast, 0u) << what;
  for (const std::uint64_t target : targets_.all()) {
    targets_.choose(target);
    const int threads = kThreads[frames_ % 4];
    const GaussianRender fast = render_gaussians(frame, {.threads = threads});
    const char* difference = fast.frame.words != plain.frame.words         ? "words"
                             : !(fast.counters == plain.counters)          ? "counters"
                             : fast.report.records != plain.report.records ? "reports"
                                                                           : nullptr;
    add("Gaussians", what, difference, fast.frame, fast.units);
    const GaussianRender picture = render_gaussians(frame, {.threads = threads, .counters = false});
    pictures_ += picture.counted ? 0 : 1;
    left_out_ += plain.report.records - picture.report.records;
    if (picture.frame.words != plain.frame.words && ++different_ <= 5) ADD_FAILURE() << what << ", without counters";
  }
  ++combinations_;
}

std::uint64_t UnitsCompared::redone() const {
  std::uint64_t sum = 0;
  for (const auto& [name, units] : units_) sum += units.redone;
  return sum;
}

void UnitsCompared::finish() const {
  std::printf(
      "[figure] frames drawn by both units = %zu, each with every target: %zu, words %zu, different %zu (limit 0)\n",
      combinations_, frames_, words_, different_);
  std::printf("[figure] frames drawn without counters = %zu\n", pictures_);
  if (left_out_ > 0) std::printf("[figure] records of Gaussians left out of them = %zu\n", left_out_);
  for (const auto& [name, unit] : units_) {
    std::printf("[figure] %s: tiles drawn fast %llu, redone by the plain unit %llu, splats hidden %llu\n", name.c_str(),
                static_cast<unsigned long long>(unit.fast), static_cast<unsigned long long>(unit.redone),
                static_cast<unsigned long long>(unit.hidden_splats));
    EXPECT_GT(unit.fast, 0u) << name;
  }
  for (const auto& [name, count] : drawn_with_)
    std::printf("[figure] frames drawn with %s = %d\n", name.c_str(), count);
  EXPECT_EQ(different_, 0u);
}

}  // namespace fastsplat::driver
