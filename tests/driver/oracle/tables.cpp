#include "tests/driver/oracle/tables.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/cmodel/oracle/number.hpp"

namespace fastsplat::scene_oracle {

using oracle::ceil_divide;
using oracle::log2_of;
using oracle::power_of_two;

std::int64_t nearest(double real) { return static_cast<std::int64_t>(std::floor(real + 0.5)); }

RadiusSet radius_set(const oracle::Symbols& symbols, double r) {
  RadiusSet set;
  set.r = r;
  set.rho = static_cast<std::int64_t>(std::ceil(r * symbols.k));
  set.E = static_cast<std::int64_t>(ceil_divide(2 * set.rho, symbols.k));
  set.Ea = static_cast<std::int64_t>(ceil_divide(set.E, symbols.P)) * symbols.P;
  return set;
}

std::vector<std::uint32_t> rlut(const oracle::Symbols& symbols, const RadiusSet& set) {
  const auto rim = static_cast<std::int64_t>(power_of_two(log2_of(symbols.N) + symbols.g));
  const double rk = set.r * symbols.k;
  std::vector<std::uint32_t> words;
  for (std::int64_t m = 0; m < symbols.k; ++m)
    for (std::int64_t i = 0; i < set.Ea; ++i) {
      const auto d = static_cast<double>((i + 1) * symbols.k - m - set.rho);
      std::int64_t word = rim;
      if (std::abs(d) < rk && i < set.E) word = std::min(rim, nearest(d * d * static_cast<double>(rim) / (rk * rk)));
      words.push_back(static_cast<std::uint32_t>(word));
    }
  return words;
}

std::vector<std::uint32_t> radial(const Given& given) {
  const oracle::Symbols& symbols = given.symbols;
  const double one = std::ldexp(1.0, symbols.wf);
  struct Entry {
    int t;
    std::int64_t word;
    double remainder;
  };
  std::vector<Entry> entries;
  double sum = 0.0;
  std::int64_t floors = 0;
  for (int t = 0; t < symbols.N; ++t) {
    const double F = std::exp(-given.a * given.R * given.R * ((t + 0.5) / symbols.N)) * one;
    entries.push_back({t, static_cast<std::int64_t>(std::floor(F)), F - std::floor(F)});
    sum += F;
    floors += entries.back().word;
  }
  std::vector<Entry> by_remainder = entries;
  std::stable_sort(by_remainder.begin(), by_remainder.end(),
                   [](const Entry& x, const Entry& y) { return x.remainder > y.remainder; });
  const std::int64_t missing = nearest(sum) - floors;
  for (std::int64_t i = 0; i < missing; ++i) ++entries[static_cast<std::size_t>(by_remainder[i].t)].word;
  std::vector<std::uint32_t> words;
  const auto largest = static_cast<std::int64_t>(oracle::u(symbols.wi, symbols.wf).largest);
  for (const Entry& entry : entries) words.push_back(static_cast<std::uint32_t>(std::min(entry.word, largest)));
  return words;
}

std::vector<std::uint32_t> factor(const oracle::Symbols& symbols) {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(power_of_two(symbols.of))};
  for (int j = 1; j <= symbols.G; ++j) {
    const double tau = std::ldexp(j, symbols.si - log2_of(symbols.G));
    words.push_back(static_cast<std::uint32_t>(nearest(std::ldexp(-std::expm1(-tau) / tau, symbols.of))));
  }
  return words;
}

std::vector<std::int64_t> phi(const Given& given) {
  const double one = std::ldexp(1.0, given.symbols.hf);
  auto M = static_cast<std::int64_t>(std::ceil(std::ldexp(2.0 * given.R, given.symbols.zf)));
  if (M % 2 != 0) ++M;
  std::vector<std::int64_t> table;
  for (std::int64_t i = 0; i <= M; ++i) {
    const double d = std::ldexp(static_cast<double>(i - M / 2), -given.symbols.zf);
    double share = (1.0 + std::erf(std::sqrt(given.a) * d) / std::erf(std::sqrt(given.a) * given.R)) / 2.0;
    if (d <= -given.R) share = 0.0;
    if (d >= given.R) share = 1.0;
    table.push_back(nearest(share * one));
  }
  table.front() = 0;
  table.back() = static_cast<std::int64_t>(one);
  return table;
}

}  // namespace fastsplat::scene_oracle
