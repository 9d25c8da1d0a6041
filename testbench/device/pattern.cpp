// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/pattern.hpp"

#include <algorithm>
#include <charconv>
#include <vector>

#include "base/error.hpp"
#include "base/suggest.hpp"

namespace fastsplat::testbench {

std::vector<std::string> Pattern::examples() {
  return {"always", "random-50", "random-10", "every-3", "alternate-40", "burst-16"};
}

Pattern::Pattern(const std::string& text, std::uint64_t seed) : seed_(mix(seed)), text_(text) {
  const auto refuse = [&](const std::string& fix = "for example random-50") {
    throw_usage({.where = "pattern '" + text + "'",
                 .what = "unknown ready/valid pattern",
                 .expected = "always, every-N, alternate-N or burst-N with N 1..1000000, or random-PERCENT with 1..100",
                 .got = {},
                 .fix = fix});
  };
  if (text == "always") return;
  const auto dash = std::min(text.find('-'), text.size());
  const std::string name = text.substr(0, dash);
  const std::vector<std::string> words{"always", "every", "alternate", "burst", "random"};
  const bool known = std::find(words.begin(), words.end(), name) != words.end();
  if (name == "never") refuse("for N cycles on and N cycles off use alternate" + text.substr(dash));
  if (const auto meant = did_you_mean(name, words); !known && !meant.empty()) refuse(meant);
  if (dash == text.size()) refuse();
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data() + dash + 1, end, number_);
  const bool percent = name == "random";
  if (error != std::errc{} || stop != end || number_ < 1 || number_ > (percent ? 100 : 1000000)) refuse();
  if (name == "every") {
    kind_ = Kind::Every;
  } else if (name == "alternate") {
    kind_ = Kind::Alternate;
  } else if (percent) {
    kind_ = Kind::Random;
  } else if (name == "burst") {
    kind_ = Kind::Burst;
  } else {
    refuse();
  }
}

bool Pattern::at(std::uint64_t cycle) const {
  switch (kind_) {
    case Kind::Always:
      return true;
    case Kind::Every:
      return (cycle + seed_) % number_ == 0;
    case Kind::Alternate:
      return (cycle + seed_) / number_ % 2 == 0;
    case Kind::Random:
      return mix(seed_ + cycle) % 100 < number_;
    case Kind::Burst: {
      // Each stretch of N cycles is on up to a seeded point and off after it, or the other way round.
      const std::uint64_t draw = mix(seed_ + cycle / number_);
      return (cycle % number_ < draw % number_) != ((draw >> 40 & 1) != 0);
    }
  }
  return true;
}

std::uint64_t Pattern::next(std::uint64_t cycle) const {
  while (!at(cycle)) ++cycle;
  return cycle;
}

std::uint64_t Pattern::longest_wait() const {
  switch (kind_) {
    case Kind::Always:
    case Kind::Random:
      return 0;
    case Kind::Every:
      return number_;
    case Kind::Alternate:
      return number_ + 1;
    case Kind::Burst:
      return 2 * number_;  // the end of one stretch and the beginning of the next
  }
  return 0;
}

}  // namespace fastsplat::testbench
