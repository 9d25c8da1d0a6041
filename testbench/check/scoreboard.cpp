// SPDX-License-Identifier: Apache-2.0
#include "testbench/check/scoreboard.hpp"

#include <algorithm>
#include <array>
#include <cstring>

#include "testbench/device/tap_assembly.hpp"
#include "testbench/device/words.hpp"

namespace fastsplat::testbench {
namespace {

constexpr std::size_t kHeaderWords = sizeof(TapQueue::Header) / sizeof(std::uint32_t);
/// First size of a queue: a device's depth in small records. A short queue stays in the first-level cache.
constexpr std::size_t kFirstWords = 512;
constexpr std::size_t kWordsAtOnce = 4;

/// Most payloads are a few groups of four words: a library call would cost more than the copy.
void copy_words(const std::uint32_t* from, std::size_t count, std::uint32_t* to) {
  std::size_t i = 0;
  for (; i + kWordsAtOnce <= count; i += kWordsAtOnce) std::memcpy(to + i, from + i, kWordsAtOnce * sizeof *to);
  for (; i < count; ++i) to[i] = from[i];
}

bool equal_words(const std::uint32_t* a, const std::uint32_t* b, std::size_t count) {
  std::size_t i = 0;
  for (; i + kWordsAtOnce <= count; i += kWordsAtOnce) {
    std::array<std::uint64_t, 2> left, right;
    std::memcpy(left.data(), a + i, sizeof left);
    std::memcpy(right.data(), b + i, sizeof right);
    if (left != right) return false;
  }
  for (; i < count; ++i) {
    if (a[i] != b[i]) return false;
  }
  return true;
}

TapCopy owned(cmodel::Tap tap, const TapQueue::Header& header, std::span<const std::uint32_t> payload) {
  return {.tap = tap,
          .tile = header.tile,
          .sheet = header.sheet,
          .tag = header.tag,
          .cycle = 0,
          .x = header.x,
          .y = header.y,
          .payload = {payload.begin(), payload.end()}};
}

std::string position(std::int64_t x, std::int64_t y) { return "(" + std::to_string(x) + "," + std::to_string(y) + ")"; }

/// Meaning of a payload word, as "pixel (x,y): weight" or "mx". The pixel is the tile's, not the window's.
std::string word_name(const cmodel::Config& config, const TapCopy& record, std::size_t word) {
  static constexpr const char* kState[] = {"C_R", "C_G", "C_B", "T"};
  static constexpr const char* kSnap[] = {"x0", "y0", "mx", "my"};
  static constexpr const char* kPixel[] = {"R", "G", "B", "A"};
  const auto lanes = static_cast<std::size_t>(config.lanes);
  const auto pixel = [&](std::size_t lane) {
    return position(record.x + static_cast<std::int64_t>(lane % lanes),
                    record.y + static_cast<std::int64_t>(lane / lanes));
  };
  switch (record.tap) {
    case cmodel::Tap::Snap:
      return kSnap[word % 4];
    case cmodel::Tap::Footprint:
      return "pixel " + pixel(word) + ": weight";
    case cmodel::Tap::Sheet:
      return "pixel " + pixel(word / 4) + ": sheet " + kChannels[word % 4];
    case cmodel::Tap::Composite:
      return "pixel " + pixel(word / 4) + ": " + kState[word % 4];
    case cmodel::Tap::Pixel:
      return std::string("output ") + kPixel[word % 4];
  }
  return "?";
}

std::string place(const cmodel::Config& config, const TapCopy& record) {
  std::string text = std::string("stage ") + cmodel::to_string(record.tap) +
                     (record.tile == kNoTile ? ", outside any tile" : ", tile " + std::to_string(record.tile));
  if (record.tap != cmodel::Tap::Pixel) text += ", sheet " + std::to_string(record.sheet);
  // A device that composites every sample shows windows there too, and the record does not distinguish them from
  // blocks.
  const bool either = record.tap == cmodel::Tap::Composite && config.composite_every_sample != 0;
  if (record.tap <= cmodel::Tap::Sheet || either) text += ", splat " + std::to_string(record.tag);
  // x, y is one pixel only in the pixel tap; a window may begin outside the tile.
  const char* what = record.tap == cmodel::Tap::Pixel       ? ", pixel "
                     : either                               ? ", window or block at "
                     : record.tap == cmodel::Tap::Composite ? ", block at "
                                                            : ", window at ";
  return text + what + position(record.x, record.y);
}

}  // namespace

TapCopy copy(const cmodel::TapRecord& record) {
  return {.tap = record.tap,
          .tile = record.tile,
          .sheet = record.sheet,
          .tag = record.tag,
          .cycle = record.cycle,
          .x = record.x,
          .y = record.y,
          .payload = {record.payload.begin(), record.payload.end()}};
}

std::string describe(const cmodel::Config& config, const Divergence& divergence) {
  if (!divergence.rtl) return place(config, *divergence.model) + ": the RTL never produced this event";
  if (!divergence.model)
    return place(config, *divergence.rtl) + ": the RTL produced an event that the model did not (cycle " +
           std::to_string(divergence.rtl->cycle) + ")";
  const TapCopy& model = *divergence.model;
  const TapCopy& rtl = *divergence.rtl;
  if (divergence.header)
    return "expected " + place(config, model) + ", RTL has " + place(config, rtl) + " (cycle " +
           std::to_string(rtl.cycle) + ")";
  const std::uint32_t a = model.payload[divergence.word], b = rtl.payload[divergence.word];
  return place(config, model) + ", " + word_name(config, model, divergence.word) + " " + hex(a) + ", RTL " + hex(b) +
         " (differs in " + hex(a ^ b) + ", cycle " + std::to_string(rtl.cycle) + ")";
}

DivergenceRow row_of(const cmodel::Config& config, const Divergence& divergence) {
  const TapCopy& at = divergence.model ? *divergence.model : *divergence.rtl;
  DivergenceRow row{.tap = cmodel::to_string(at.tap),
                    .tile = std::nullopt,
                    .sheet = std::nullopt,
                    .splat = std::nullopt,
                    .x = at.x,
                    .y = at.y,
                    .cycle = std::nullopt,
                    .what = "record",
                    .expected = divergence.model ? place(config, *divergence.model) : "nothing",
                    .got = divergence.rtl ? place(config, *divergence.rtl) : "nothing"};
  if (at.tile != kNoTile) row.tile = at.tile;
  if (at.tap != cmodel::Tap::Pixel) row.sheet = at.sheet;
  if (at.tap <= cmodel::Tap::Sheet) row.splat = at.tag;
  if (divergence.rtl) row.cycle = divergence.rtl->cycle;
  if (!divergence.model || !divergence.rtl || divergence.header) return row;
  row.what = word_name(config, at, divergence.word);
  row.expected = hex(divergence.model->payload[divergence.word]);
  row.got = hex(divergence.rtl->payload[divergence.word]);
  return row;
}

void Scoreboard::Side::on_tap(const cmodel::TapRecord& record) {
  is_model ? board->expect(record) : board->check(record);
}

void TapQueue::make_room(std::size_t words) {
  // Fewer records are moved than were popped since the last move: constant time per record.
  const std::size_t held = tail_ - head_;
  std::vector<std::uint32_t> longer;
  if (head_ < data_.size() / 2 || data_.size() - held < words) {
    longer.resize(std::max({kFirstWords, 2 * data_.size(), held + words}));
    std::copy_n(data_.data() + head_, held, longer.data());
    data_ = std::move(longer);
  } else {
    std::copy_n(data_.data() + head_, held, data_.data());
  }
  head_ = 0;
  tail_ = held;
}

void TapQueue::push(const cmodel::TapRecord& record) {
  const Header header = TapQueue::header(record);
  const std::size_t words = kHeaderWords + header.words;
  if (data_.size() - tail_ < words) make_room(words);
  std::uint32_t* out = data_.data() + tail_;
  std::memcpy(out, &header, sizeof header);
  copy_words(record.payload.data(), header.words, out + kHeaderWords);
  tail_ += words;
}

TapQueue::Header TapQueue::front() const {
  Header header;
  std::memcpy(&header, &data_[head_], sizeof header);
  return header;
}

std::span<const std::uint32_t> TapQueue::payload() const {
  return {data_.data() + head_ + kHeaderWords, front().words};
}

void TapQueue::pop() {
  head_ += kHeaderWords + front().words;
  if (empty()) head_ = tail_ = 0;
}

void Scoreboard::expect(const cmodel::TapRecord& record) {
  expected_[static_cast<std::size_t>(record.tap)].push(record);
}

std::size_t Scoreboard::backlog() const {
  std::size_t words = 0;
  for (const auto& queue : expected_) words += queue.words();
  return words;
}

void Scoreboard::mismatch(cmodel::Tap tap, Divergence divergence) {
  ++mismatches_;
  ++mismatches_by_tap_[static_cast<std::size_t>(tap)];
  if (kept_.size() < most_kept_) kept_.push_back(std::move(divergence));
}

void Scoreboard::check(const cmodel::TapRecord& record) {
  auto& queue = expected_[static_cast<std::size_t>(record.tap)];
  if (queue.empty()) {
    mismatch(record.tap, {.model = std::nullopt, .rtl = copy(record), .word = 0, .header = false});
    return;
  }
  const auto header = queue.front();
  const auto payload = queue.payload();
  ++comparisons_;
  ++by_tap_[static_cast<std::size_t>(record.tap)];
  const bool same_header = header == TapQueue::header(record);
  const bool same = same_header && equal_words(payload.data(), record.payload.data(), payload.size());
  if (!same && kept_.size() >= most_kept_) {
    ++mismatches_;
    ++mismatches_by_tap_[static_cast<std::size_t>(record.tap)];
  } else if (!same) {
    const auto at =
        same_header ? std::mismatch(payload.begin(), payload.end(), record.payload.begin()).first : payload.begin();
    mismatch(record.tap, {.model = owned(record.tap, header, payload),
                          .rtl = copy(record),
                          .word = static_cast<std::size_t>(at - payload.begin()),
                          .header = !same_header});
  }
  queue.pop();
}

void Scoreboard::finish() {
  for (std::size_t tap = 0; tap < expected_.size(); ++tap) {
    for (auto& queue = expected_[tap]; !queue.empty(); queue.pop()) {
      const auto which = static_cast<cmodel::Tap>(tap);
      mismatch(
          which,
          {.model = owned(which, queue.front(), queue.payload()), .rtl = std::nullopt, .word = 0, .header = false});
    }
  }
}

}  // namespace fastsplat::testbench
