// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_interpolation.hpp"

#include <string>

#include "cmodel/numbers/sites.hpp"

namespace fastsplat::testbench {

InterpolationCoverage::InterpolationCoverage(const cmodel::Config& config, Coverage& coverage)
    : coverage_(coverage),
      guard_bits_(config.rlut_guard_bits),
      entries_(static_cast<std::size_t>(config.radial_entries)) {
  const auto declare = [&](Kind kind, const std::string& name) {
    places_[kind] = {.on_entry = coverage.declare("interpolation", name + "_on_an_entry"),
                     .between = coverage.declare("interpolation", name + "_between_entries"),
                     .behind_last = coverage.declare("interpolation", name + "_behind_the_last_entry")};
  };
  declare(Circle, "circle");
  if (config.has_ellipses()) declare(Ellipse, "ellipse");
  const std::int64_t rest = (std::int64_t{1} << guard_bits_) - 1;
  fall_ = RoundingPoint(coverage, "fall", "", cmodel::Sites(config)[cmodel::Site::RadialFall],
                        config.weight_format().max * rest);
}

void InterpolationCoverage::load(const cmodel::LoadTable& table) {
  if (table.table == cmodel::Table::Radial) radial_ = table.words;
}

void InterpolationCoverage::weight(Kind kind, std::uint64_t steps) {
  const std::size_t index = steps >> guard_bits_;
  if (index >= entries_) return;
  const auto rest = static_cast<std::int64_t>(steps - (std::uint64_t{index} << guard_bits_));
  const Places& places = places_.at(kind);
  coverage_.hit(rest == 0 ? places.on_entry : index + 1 == entries_ ? places.behind_last : places.between);
  if (rest == 0) return;
  const std::int64_t fall = std::int64_t{radial_.at(index)} - radial_.at(index + 1);
  fall_.sample(coverage_, fall * rest);
}

}  // namespace fastsplat::testbench
