// SPDX-License-Identifier: Apache-2.0
#include "analysis/clusters.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <tuple>

namespace fastsplat::analysis {
namespace {

class Finder {
 public:
  Finder(const std::vector<double>& errors, int width, int height, double threshold)
      : errors_(errors), width_(width), height_(height), threshold_(threshold), seen_(errors.size(), 0) {}

  std::vector<Cluster> all() {
    std::vector<Cluster> clusters;
    for (int y = 0; y < height_; ++y) {
      for (int x = 0; x < width_; ++x) {
        if (take(x, y)) clusters.push_back(grow(x, y));
      }
    }
    return clusters;
  }

 private:
  struct Pixel {
    int x, y;
  };

  std::size_t index(int x, int y) const { return static_cast<std::size_t>(y) * width_ + x; }

  /// Claims a pixel above the threshold that belongs to no cluster yet. NaN is never above.
  bool take(int x, int y) {
    if (x < 0 || y < 0 || x >= width_ || y >= height_) return false;
    const std::size_t i = index(x, y);
    if (seen_[i] != 0 || !(std::abs(errors_[i]) >= threshold_)) return false;
    seen_[i] = 1;
    return true;
  }

  Cluster grow(int x, int y) {
    std::vector<Pixel> members{{x, y}};
    for (std::size_t next = 0; next < members.size(); ++next) {
      const Pixel at = members[next];
      for (int dy = -1; dy <= 1; ++dy) {
        for (int dx = -1; dx <= 1; ++dx) {
          if (take(at.x + dx, at.y + dy)) members.push_back({at.x + dx, at.y + dy});
        }
      }
    }
    // Row order, so that sum and first worst do not depend on the order of the flood fill.
    std::sort(members.begin(), members.end(), [](Pixel a, Pixel b) { return std::tie(a.y, a.x) < std::tie(b.y, b.x); });
    Cluster cluster{
        .x0 = x, .y0 = y, .x1 = x, .y1 = y, .pixels = members.size(), .max_lsb = -1, .sum_lsb = 0, .worst = {}};
    for (const auto [px, py] : members) {
      const double error = errors_[index(px, py)];
      cluster.x0 = std::min(cluster.x0, px);
      cluster.y0 = std::min(cluster.y0, py);
      cluster.x1 = std::max(cluster.x1, px);
      cluster.y1 = std::max(cluster.y1, py);
      cluster.sum_lsb += std::abs(error);
      if (std::abs(error) > cluster.max_lsb) {
        cluster.max_lsb = std::abs(error);
        cluster.worst = {.x = px, .y = py, .channel = 0, .ref = 0, .test = 0, .error_lsb = error};
      }
    }
    return cluster;
  }

  const std::vector<double>& errors_;
  int width_, height_;
  double threshold_;
  std::vector<std::uint8_t> seen_;
};

}  // namespace

std::vector<Cluster> find_clusters(const std::vector<double>& pixel_errors, int width, int height, double threshold,
                                   int most) {
  auto clusters = Finder(pixel_errors, width, height, threshold).all();
  std::stable_sort(clusters.begin(), clusters.end(), [](const Cluster& a, const Cluster& b) {
    return std::tie(a.max_lsb, a.sum_lsb) > std::tie(b.max_lsb, b.sum_lsb);
  });
  if (clusters.size() > static_cast<std::size_t>(most)) clusters.resize(static_cast<std::size_t>(most));
  return clusters;
}

}  // namespace fastsplat::analysis
