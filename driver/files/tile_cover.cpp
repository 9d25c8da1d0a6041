// SPDX-License-Identifier: Apache-2.0
#include "driver/files/tile_cover.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "cmodel/stream/records.hpp"
#include "cmodel/stream/stream_advice.hpp"

namespace fastsplat::driver {
namespace {

/// Segment tree over xs[0] < xs[1] < ...: how often each stretch is covered, and the length covered at least once.
class Stretches {
 public:
  explicit Stretches(std::vector<std::int64_t> xs) : xs_(std::move(xs)), nodes_(4 * xs_.size()) {}

  void add(std::int64_t from, std::int64_t to, int times) { add(1, 0, xs_.size() - 1, from, to, times); }
  std::int64_t covered() const { return nodes_[1].covered; }

 private:
  struct Node {
    int whole = 0;  ///< rectangles that cover the whole node and are counted here
    std::int64_t covered = 0;
  };

  void add(std::size_t node, std::size_t low, std::size_t high, std::int64_t from, std::int64_t to, int times) {
    if (to <= xs_[low] || from >= xs_[high]) return;
    Node& at = nodes_[node];
    if (from <= xs_[low] && xs_[high] <= to) {
      at.whole += times;
    } else {
      const std::size_t middle = (low + high) / 2;
      add(2 * node, low, middle, from, to, times);
      add(2 * node + 1, middle, high, from, to, times);
    }
    at.covered = at.whole > 0     ? xs_[high] - xs_[low]
                 : high - low > 1 ? nodes_[2 * node].covered + nodes_[2 * node + 1].covered
                                  : 0;
  }

  std::vector<std::int64_t> xs_;
  std::vector<Node> nodes_;
};

}  // namespace

void TileCover::add(std::int64_t x, std::int64_t y, std::int64_t width, std::int64_t height) {
  if (width > 0 && height > 0) rectangles_.push_back({x, y, x + width, y + height});
}

std::int64_t TileCover::pixels() const {
  if (rectangles_.empty()) return 0;
  struct Edge {
    std::int64_t y, x0, x1;
    int times;
  };
  std::vector<std::int64_t> xs;
  std::vector<Edge> edges;
  for (const auto& r : rectangles_) {
    xs.insert(xs.end(), {r.x0, r.x1});
    edges.push_back({r.y0, r.x0, r.x1, 1});
    edges.push_back({r.y1, r.x0, r.x1, -1});
  }
  std::sort(xs.begin(), xs.end());
  xs.erase(std::unique(xs.begin(), xs.end()), xs.end());
  std::sort(edges.begin(), edges.end(), [](const Edge& a, const Edge& b) { return a.y < b.y; });
  Stretches row(std::move(xs));
  std::int64_t area = 0, y = edges.front().y;
  for (const auto& edge : edges) {
    area += row.covered() * (edge.y - y);
    y = edge.y;
    row.add(edge.x0, edge.x1, edge.times);
  }
  return area;
}

void CoverRule::see(const cmodel::Beat& beat) {
  const std::uint64_t number = beats_++;
  if (payload_left_ > 0) {
    --payload_left_;
    return;
  }
  payload_left_ = cmodel::announced_beats(beat);
  switch (static_cast<cmodel::Opcode>(get(beat, cmodel::layout::kOpcode))) {
    case cmodel::Opcode::BeginFrame:
      image_ = get(beat, cmodel::layout::kFrameWidth) * get(beat, cmodel::layout::kFrameHeight);
      break;
    case cmodel::Opcode::BeginTile:
      cover_.add(get(beat, cmodel::layout::kTileX), get(beat, cmodel::layout::kTileY),
                 get(beat, cmodel::layout::kTileWidth), get(beat, cmodel::layout::kTileHeight));
      break;
    case cmodel::Opcode::EndFrame:
      if (const std::int64_t missing = image_ - cover_.pixels(); missing != 0) {
        throw_input({.where = cmodel::beat_place(number),
                     .what = "tiles do not cover the image",
                     .expected = "every pixel in a tile",
                     .got = std::to_string(missing) + (missing == 1 ? " pixel uncovered" : " pixels uncovered"),
                     .fix = cmodel::kMiswrittenStream});
      }
      break;
    default:
      break;
  }
}

}  // namespace fastsplat::driver
