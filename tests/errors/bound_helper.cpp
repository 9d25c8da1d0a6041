// SPDX-License-Identifier: Apache-2.0
#include "tests/errors/bound_helper.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "tests/pipeline/mixtures_helper.hpp"

namespace fastsplat::test {

using analysis::BoundCheck, analysis::Known, stages::Mixture, stages::Picture;

namespace {

std::string facts_of(const stages::Chain& chain) {
  return stages::test::text_of(chain.config()) + "\n" + scene::to_toml(chain.scene().description);
}

}  // namespace

void BoundTotals::add(const BoundCheck& one) {
  ++frames;
  values += one.values;
  over += one.over;
  worst = std::max(worst, one.worst);
}

void BoundTotals::print(const std::string& what) const {
  std::printf("[figure] %s: %llu bounds, %llu values, %llu over (limit 0), worst measured / bound %.4f (limit 1)\n",
              what.c_str(), static_cast<unsigned long long>(frames), static_cast<unsigned long long>(values),
              static_cast<unsigned long long>(over), worst);
}

void hold(const stages::Chain& chain, BoundTotals& totals, Known least) {
  const Picture real = chain(Mixture{}), device = chain(Mixture::all_device());
  for (const Known known : analysis::kLevels) {
    if (known < least) continue;
    const BoundCheck one = check(analysis::bound(chain, real, known, 2), real, device);
    totals.add(one);
    EXPECT_EQ(one.over, 0u) << analysis::to_string(known) << ", worst " << one.worst << " " << facts_of(chain);
  }
}

void hold(const stages::Chain& chain, const Mixture& device, BoundTotals& totals) {
  const Picture real = chain(Mixture{});
  const BoundCheck one = check(analysis::bound(chain, real, Mixture{}, device, 2), real, chain(device));
  totals.add(one);
  EXPECT_EQ(one.over, 0u) << device.text() << ", worst " << one.worst << " " << facts_of(chain);
}

}  // namespace fastsplat::test
