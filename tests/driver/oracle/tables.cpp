// SPDX-License-Identifier: Apache-2.0
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

// N-3-3; rho by N-4-2.
RadiusSet radius_set(const oracle::Symbols& symbols, double r) {
  RadiusSet set;
  set.r = r;
  set.rho = static_cast<std::int64_t>(std::ceil(r * symbols.K()));
  set.E = static_cast<std::int64_t>(ceil_divide(2 * set.rho, symbols.K()));
  set.Ea = static_cast<std::int64_t>(ceil_divide(set.E, symbols.P)) * symbols.P;
  return set;
}

// N-4-2.
/// N-8-31: words as they are evaluated.
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

namespace {

/// v as c / 2^h: 24 bits, rounded up (N-4.1-3, N-4.2-4).
std::vector<std::uint32_t> scale(double v) {
  int log = 0;  // floor(log2 v)
  while (std::ldexp(v, -log) >= 2.0) ++log;
  while (std::ldexp(v, -log) < 1.0) --log;
  const int h = std::clamp(23 - log, 0, 62);
  return {static_cast<std::uint32_t>(std::min(16777216.0, std::ceil(std::ldexp(v, h)))), static_cast<std::uint32_t>(h)};
}

}  // namespace

std::vector<std::uint32_t> set_words(const Given& given, const RadiusSet& set) {
  const oracle::Symbols& symbols = given.symbols;
  if (symbols.index == "rlut") return rlut(symbols, set);
  const std::int64_t K = symbols.K();
  const double rK = set.r * static_cast<double>(K);
  // N-4.1-3, N-4.2-4, N-4.3-5.
  if (symbols.index == "linear") return scale(symbols.N / (rK * std::ldexp(1.0, symbols.g)));
  if (symbols.index == "squared") return scale(symbols.N / (rK * rK));
  if (symbols.index == "squared_elliptic") {
    const auto c = scale(symbols.N / (rK * rK));
    return {c[0], 0, c[0], c[1]};
  }
  const auto d = [&](std::int64_t m, std::int64_t i) { return static_cast<double>((i + 1) * K - m - set.rho); };
  const double aRR = given.a * given.R * given.R;
  const auto most = static_cast<std::int64_t>(oracle::u(symbols.wi, symbols.wf).largest);
  std::vector<std::uint32_t> words;
  if (symbols.index == "separable") {  // N-4.5-3
    const std::int64_t largest = std::min(std::int64_t{1} << symbols.wf, most) << symbols.g;
    for (std::int64_t m = 0; m < K; ++m)
      for (std::int64_t i = 0; i < set.Ea; ++i) {
        const bool inside = std::abs(d(m, i)) < rK && i < set.E;
        const double value = std::exp(-aRR * (d(m, i) * d(m, i) / (rK * rK)));
        const std::int64_t word = nearest(std::ldexp(value, symbols.wf + symbols.g));
        words.push_back(inside ? static_cast<std::uint32_t>(std::min(largest, word)) : 0);
      }
    return words;
  }
  // N-4.4-6: blit2d; N-4.4-1, N-4.4-3: in the order of its words.
  const auto image = [&](std::int64_t m) { return static_cast<std::int64_t>(oracle::remainder(-m - 2 * set.rho, K)); };
  for (std::int64_t my = 0; my < K; ++my)
    for (std::int64_t mx = 0; mx < K; ++mx) {
      if (symbols.symmetry == "eightfold" && (mx > image(mx) || my > image(my) || mx > my)) continue;
      for (std::int64_t j = 0; j < set.Ea; ++j)
        for (std::int64_t i = 0; i < set.Ea; ++i) {
          const double square = d(mx, i) * d(mx, i) + d(my, j) * d(my, j);
          const bool inside = square < rK * rK && i < set.E && j < set.E;
          const std::int64_t word = nearest(std::ldexp(std::exp(-aRR * (square / (rK * rK))), symbols.wf));
          words.push_back(inside ? static_cast<std::uint32_t>(std::min(most, word)) : 0);
        }
    }
  return words;
}

// N-4-3, N-4.1-4, N-4.7-4: the samples; N-4-4, N-4.1-5: their words. Of every kind (N-4.4-9, N-4.5-4).
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
  const double aRR = given.a * given.R * given.R, half = aRR / (2.0 * symbols.N);
  for (int t = 0; t < symbols.radial_words(); ++t) {
    const double middle = (t + 0.5) / symbols.N;
    const double F = symbols.interpolate != 0
                         ? std::tanh(half) / half * std::exp(-aRR * (static_cast<double>(t) / symbols.N)) * one
                         : std::exp(-aRR * (symbols.index == "linear" ? middle * middle : middle)) * one;
    entries.push_back({t, static_cast<std::int64_t>(std::floor(F)), F - std::floor(F)});
    sum += F;
    floors += entries.back().word;
  }
  std::vector<Entry> by_remainder = entries;
  std::stable_sort(by_remainder.begin(), by_remainder.end(),
                   [](const Entry& x, const Entry& y) { return x.remainder > y.remainder; });
  if (symbols.index == "linear") {
    double lost = 0.0;
    for (const Entry& entry : entries) lost += entry.remainder * (2 * entry.t + 1);
    for (const Entry& entry : by_remainder) {
      if (lost < (2 * entry.t + 1) / 2.0) continue;
      ++entries[static_cast<std::size_t>(entry.t)].word;
      lost -= 2 * entry.t + 1;
    }
  }
  const std::int64_t missing = symbols.index == "linear" ? 0 : nearest(sum) - floors;
  for (std::int64_t i = 0; i < missing; ++i) ++entries[static_cast<std::size_t>(by_remainder[i].t)].word;
  std::vector<std::uint32_t> words;
  const auto largest = static_cast<std::int64_t>(oracle::u(symbols.wi, symbols.wf).largest);
  for (const Entry& entry : entries) words.push_back(static_cast<std::uint32_t>(std::min(entry.word, largest)));
  return words;
}

// N-6-4
std::vector<std::uint32_t> factor(const oracle::Symbols& symbols) {
  std::vector<std::uint32_t> words{static_cast<std::uint32_t>(power_of_two(symbols.of))};
  for (int j = 1; j <= symbols.G; ++j) {
    const double tau = std::ldexp(j, symbols.si - log2_of(symbols.G));
    words.push_back(static_cast<std::uint32_t>(nearest(std::ldexp(-std::expm1(-tau) / tau, symbols.of))));
  }
  return words;
}

/// N-8-64.
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
