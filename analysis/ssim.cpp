// SPDX-License-Identifier: Apache-2.0
#include "analysis/ssim.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "analysis/error_values.hpp"

namespace fastsplat::analysis {
namespace {

constexpr int kBlockRows = 32;

std::vector<double> gaussian_window(int size) {
  constexpr double kSigma = 1.5;
  std::vector<double> weights(static_cast<std::size_t>(size));
  double sum = 0;
  for (int i = 0; i < size; ++i) {
    const double d = i - size / 2;
    sum += weights[static_cast<std::size_t>(i)] = std::exp(-d * d / (2 * kSigma * kSigma));
  }
  for (double& weight : weights) weight /= sum;
  return weights;
}

/// Averages over the window: x, y, x^2, y^2, xy, and the share of non-finite values.
constexpr std::size_t kMoments = 6;
using Rows = std::array<std::vector<double>, kMoments>;

class BlockFilter {
 public:
  BlockFilter(int width, int rows, const std::vector<double>& weights)
      : width_(width), out_width_(width - static_cast<int>(weights.size()) + 1), weights_(weights) {
    for (auto& plane : filtered_) plane.resize(static_cast<std::size_t>(out_width_) * rows);
    for (auto& row : products_) row.resize(static_cast<std::size_t>(width));
    for (auto& row : moments_) row.resize(static_cast<std::size_t>(out_width_));
  }

  /// Horizontal pass over row `slot` of the block.
  void load(int slot, const double* x, const double* y) {
    for (int i = 0; i < width_; ++i) {
      const auto at = static_cast<std::size_t>(i);
      const bool finite = std::isfinite(x[i]) && std::isfinite(y[i]);
      const double a = finite ? x[i] : 0.0;
      const double b = finite ? y[i] : 0.0;
      products_[0][at] = a;
      products_[1][at] = b;
      products_[2][at] = a * a;
      products_[3][at] = b * b;
      products_[4][at] = a * b;
      products_[5][at] = finite ? 0.0 : 1.0;
    }
    for (std::size_t m = 0; m < kMoments; ++m) {
      double* out = filtered_[m].data() + static_cast<std::ptrdiff_t>(slot) * out_width_;
      std::fill(out, out + out_width_, 0.0);
      for (std::size_t k = 0; k < weights_.size(); ++k) accumulate(out, products_[m].data() + k, weights_[k]);
    }
  }

  /// Vertical pass: the six moments of output row `slot`.
  const Rows& moments(int slot) {
    for (std::size_t m = 0; m < kMoments; ++m) {
      std::fill(moments_[m].begin(), moments_[m].end(), 0.0);
      for (std::size_t k = 0; k < weights_.size(); ++k) {
        const auto row = static_cast<std::ptrdiff_t>(slot) + static_cast<std::ptrdiff_t>(k);
        accumulate(moments_[m].data(), filtered_[m].data() + row * out_width_, weights_[k]);
      }
    }
    return moments_;
  }

 private:
  void accumulate(double* out, const double* in, double weight) const {
    for (int i = 0; i < out_width_; ++i) out[i] += weight * in[i];
  }

  int width_, out_width_;
  const std::vector<double>& weights_;
  Rows products_, filtered_, moments_;
};

struct Sum {
  double ssim = 0;
  std::uint64_t windows = 0;
};

void add_row(const Rows& moments, double peak, Sum& sum) {
  const double c1 = (0.01 * peak) * (0.01 * peak);
  const double c2 = (0.03 * peak) * (0.03 * peak);
  const auto& [x, y, xx, yy, xy, nonfinite] = moments;
  for (std::size_t i = 0; i < x.size(); ++i) {
    if (nonfinite[i] != 0.0) continue;
    const double var_x = xx[i] - x[i] * x[i];
    const double var_y = yy[i] - y[i] * y[i];
    const double cov = xy[i] - x[i] * y[i];
    sum.ssim += ((2 * x[i] * y[i] + c1) * (2 * cov + c2)) / ((x[i] * x[i] + y[i] * y[i] + c1) * (var_x + var_y + c2));
    ++sum.windows;
  }
}

}  // namespace

double ssim(int width, int height, int channels, double peak, int threads, const RowSource& ref,
            const RowSource& test) {
  constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();
  if (width < 1 || height < 1) return kNaN;
  const int shorter = std::min(width, height);
  const int window = std::min(11, shorter - 1 + shorter % 2);
  const auto weights = gaussian_window(window);
  const int out_height = height - window + 1;
  const int blocks = (out_height + kBlockRows - 1) / kBlockRows;

  std::vector<Sum> sums(static_cast<std::size_t>(blocks) * channels);
  for_blocks(sums.size(), 1, threads, [&](std::size_t job, std::size_t, std::size_t) {
    const int channel = static_cast<int>(job) / blocks;
    const int first = static_cast<int>(job) % blocks * kBlockRows;
    const int rows = std::min(kBlockRows, out_height - first);
    BlockFilter filter(width, rows + window - 1, weights);
    std::vector<double> x(static_cast<std::size_t>(width)), y(x.size());
    for (int slot = 0; slot < rows + window - 1; ++slot) {
      ref(channel, first + slot, x.data());
      test(channel, first + slot, y.data());
      filter.load(slot, x.data(), y.data());
    }
    for (int slot = 0; slot < rows; ++slot) add_row(filter.moments(slot), peak, sums[job]);
  });

  Sum total;
  for (const Sum& sum : sums) {
    total.ssim += sum.ssim;
    total.windows += sum.windows;
  }
  return total.windows == 0 ? kNaN : total.ssim / static_cast<double>(total.windows);
}

}  // namespace fastsplat::analysis
