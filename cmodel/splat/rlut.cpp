// SPDX-License-Identifier: Apache-2.0
#include "cmodel/splat/rlut.hpp"

namespace fastsplat::cmodel {

Rlut::Rlut(const Config& config)
    : columns_(static_cast<std::size_t>(config.rlut_columns)),
      lanes_(static_cast<std::size_t>(config.lanes)),
      phases_(static_cast<std::uint32_t>(config.phases)),
      sets_(static_cast<std::size_t>(config.rlut_sets)),
      words_(columns_ * phases_, 0) {}

void Rlut::load(const LoadTable& table) {
  const auto extent = static_cast<std::uint32_t>(table.words.size() / phases_);
  sets_[table.radius.set] = {.rho = table.radius.rho, .base = table.radius.base, .extent = extent};
  for (std::uint32_t m = 0; m < phases_; ++m) {
    for (std::uint32_t i = 0; i < extent; ++i) {
      words_[m * columns_ + table.radius.base + i] = table.words[static_cast<std::size_t>(m) * extent + i];
    }
  }
}

}  // namespace fastsplat::cmodel
