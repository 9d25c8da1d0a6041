// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/attribution.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <string_view>

#include "analysis/error_values.hpp"

namespace fastsplat::analysis {
namespace {

using stages::Mixture;
using stages::Picture;

double product(const golden::Sums& a, const golden::Sums& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

double product(const Picture& a, const Picture& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.pixels.size(); ++i) sum += product(a.pixels[i], b.pixels[i]);
  return sum;
}

Amount floor_of(const Picture& real, int bits) {
  Picture error = real;
  for (golden::Sums& pixel : error.pixels) {
    for (double& value : pixel) value = std::floor(value * lsb_per_unit(bits) + 0.5) / lsb_per_unit(bits) - value;
  }
  return amount_of(error);
}

/// Draws frames with mixtures and counts them.
class Frames {
 public:
  Frames(const stages::Chain& chain, int total, const AttributionOptions& options)
      : chain_(chain), options_(options), total_(static_cast<std::size_t>(total)) {}
  Picture operator()(const Mixture& mixture) {
    Picture picture = chain_(mixture, options_.threads);
    ++done_;
    if (options_.progress) options_.progress(done_, total_);
    return picture;
  }
  int done() const { return static_cast<int>(done_); }

 private:
  const stages::Chain& chain_;
  const AttributionOptions& options_;
  std::size_t total_, done_ = 0;
};

/// Shapley values of the groups, for v(S) = E[(S's error) e] / E[e^2]; v of all groups is 1.
std::vector<GroupShare> shapley(const std::vector<stages::StepSet>& groups, const Picture& real, const Picture& error,
                                const Mixture& all_steps, Frames& frames) {
  const std::size_t n = groups.size(), all = (std::size_t{1} << n) - 1;
  std::vector<double> worth(all + 1, 0.0);
  for (std::size_t coalition = 1; coalition < all; ++coalition) {
    Mixture mixture;
    for (std::size_t g = 0; g < n; ++g) {
      if ((coalition >> g & 1) != 0) mixture = mixture.with(groups[g].steps, all_steps);
    }
    worth[coalition] = share_of(difference(frames(mixture), real), error);
  }
  worth[all] = 1.0;
  std::vector<double> factorial(n + 1, 1.0);
  for (std::size_t i = 1; i <= n; ++i) factorial[i] = factorial[i - 1] * static_cast<double>(i);
  std::vector<GroupShare> out;
  for (std::size_t g = 0; g < n; ++g) {
    double value = 0.0;
    for (std::size_t others = 0; others <= all; ++others) {
      if ((others >> g & 1) != 0) continue;
      const auto size = static_cast<std::size_t>(std::popcount(others));
      value += factorial[size] * factorial[n - size - 1] / factorial[n] *
               (worth[others | (std::size_t{1} << g)] - worth[others]);
    }
    out.push_back({groups[g].name, value});
  }
  return out;
}

std::vector<int> blame_of(const Attribution& a, const Picture& error) {
  std::vector<int> blame(error.pixels.size(), -1);
  for (std::size_t i = 0; i < blame.size(); ++i) {
    double most = 0.0;
    for (std::size_t k = 0; k < a.increments.size(); ++k) {
      const double part = product(a.increments[k].pixels[i], error.pixels[i]);
      if (part > most) most = part, blame[i] = static_cast<int>(k);
    }
  }
  return blame;
}

std::vector<PixelStory> stories_of(const Attribution& a, const Picture& error) {
  const auto worst_channel = [&](std::size_t pixel) {
    const golden::Sums& e = error.pixels[pixel];
    std::size_t worst = 0;
    for (std::size_t c = 1; c < 4; ++c) {
      if (std::abs(e[c]) > std::abs(e[worst])) worst = c;
    }
    return worst;
  };
  std::vector<std::pair<double, std::size_t>> wrong;  // pixels, the worst last; ties in reverse row order
  for (std::size_t i = 0; i < error.pixels.size(); ++i) {
    const double size = std::abs(error.pixels[i][worst_channel(i)]);
    if (size > 0.0) wrong.emplace_back(size, i);
  }
  if (wrong.empty()) return {};
  std::ranges::sort(
      wrong, [](const auto& x, const auto& y) { return x.first != y.first ? x.first < y.first : x.second > y.second; });
  const auto rank = [&](double p) {
    return static_cast<std::size_t>(std::ceil(p * static_cast<double>(wrong.size()))) - 1;
  };
  std::vector<PixelStory> out;
  for (const auto& [which, at] : {std::pair{"median", rank(0.5)}, {"p90", rank(0.9)}, {"worst", wrong.size() - 1}}) {
    const std::size_t pixel = wrong[at].second, c = worst_channel(pixel);
    PixelStory story{which,
                     static_cast<int>(pixel % static_cast<std::size_t>(error.width)),
                     static_cast<int>(pixel / static_cast<std::size_t>(error.width)),
                     static_cast<int>(c),
                     error.pixels[pixel][c],
                     {}};
    for (std::size_t k = 0; k < a.steps.size(); ++k)
      story.parts.emplace_back(a.steps[k].set.name, a.increments[k].pixels[pixel][c]);
    std::ranges::stable_sort(story.parts,
                             [](const auto& x, const auto& y) { return std::abs(x.second) > std::abs(y.second); });
    out.push_back(std::move(story));
  }
  return out;
}

}  // namespace

Picture difference(const Picture& a, const Picture& b) {
  Picture out = a;
  for (std::size_t i = 0; i < out.pixels.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) out.pixels[i][c] -= b.pixels[i][c];
  }
  return out;
}

double share_of(const Picture& part, const Picture& error) {
  const double squared = product(error, error);
  return squared > 0.0 ? product(part, error) / squared : 0.0;
}

Amount amount_of(const Picture& error) {
  Amount out;
  double squares = 0.0, sum = 0.0;
  for (const golden::Sums& pixel : error.pixels) {
    for (const double value : pixel) {
      squares += value * value;
      sum += value;
      out.greatest = std::max(out.greatest, std::abs(value));
    }
  }
  const double values = 4.0 * static_cast<double>(error.pixels.size());
  out.rms = std::sqrt(squares / values);
  out.bias = sum / values;
  return out;
}

Attribution attribute(const stages::Chain& chain, const AttributionOptions& options) {
  Attribution out;
  out.quick = options.quick;
  out.floats = options.floats;
  const Mixture all = options.floats ? Mixture::all_floats(*options.floats) : Mixture::all_device();
  const std::vector<stages::StepSet> sets = chain.sets(options.floats.has_value());
  const auto n = static_cast<int>(sets.size());
  const std::vector<stages::StepSet> groups = stages::group_sets(chain.holds_densities());
  const int coalitions = (1 << groups.size()) - 2;  // without the empty one and the full one
  // Both ends; the n - 1 mixtures between them; each step alone (the first is known), each step left out (the last is
  // known).
  Frames frames(chain, 2 + (n - 1) + (options.quick ? 0 : 2 * (n - 1)) + (options.shapley ? coalitions : 0), options);
  out.real = frames(Mixture{});
  out.device = frames(all);
  const Picture error = difference(out.device, out.real);
  const auto share = [&](const Picture& part) { return share_of(part, error); };
  out.total = amount_of(error);
  out.floor8 = floor_of(out.real, 8);
  out.floor16 = floor_of(out.real, 16);

  Mixture so_far;
  Picture before = out.real;
  out.only_remainder = 1.0;
  for (int k = 0; k < n; ++k) {
    const auto& set = sets[static_cast<std::size_t>(k)];
    const bool last = k + 1 == n;
    StepError step;
    step.set = set;
    Picture left_out;
    if (last) left_out = before;
    so_far = so_far.with(set.steps, all);
    Picture after = last ? out.device : frames(so_far);
    out.increments.push_back(difference(after, before));
    before = std::move(after);
    step.share = share(out.increments.back());
    step.increment = amount_of(out.increments.back());
    if (!options.quick) {
      const Picture only =
          k == 0 ? out.increments.back() : difference(frames(Mixture{}.with(set.steps, all)), out.real);
      step.only_share = share(only);
      step.only = amount_of(only);
      if (!last) left_out = frames(all.with(set.steps, Mixture{}));
      step.without = amount_of(difference(left_out, out.real));
    }
    const std::string_view by = set.by;
    (by == "driver" ? out.driver_share : by == "device" ? out.device_share : out.both_share) += step.share;
    out.only_remainder -= step.only_share;
    out.steps.push_back(std::move(step));
  }
  out.blame = blame_of(out, error);
  const auto wrong = std::ranges::count_if(out.blame, [](int step) { return step >= 0; });
  for (const int step : out.blame) {
    if (step >= 0) out.steps[static_cast<std::size_t>(step)].pixels_ruled += 1.0 / static_cast<double>(wrong);
  }
  out.stories = stories_of(out, error);
  if (options.shapley && out.total.rms > 0.0) out.groups = shapley(groups, out.real, error, all, frames);
  out.chains = frames.done();
  return out;
}

}  // namespace fastsplat::analysis
