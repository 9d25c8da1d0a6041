// SPDX-License-Identifier: Apache-2.0
#include "testbench/device/axi_read_memory.hpp"

#include <algorithm>
#include <utility>

namespace fastsplat::testbench {
namespace {

constexpr std::uint64_t kPage = 4096;          ///< no burst crosses one
constexpr unsigned kSize = 5, kIncrement = 1;  ///< 32 bytes a transfer; INCR
constexpr unsigned kSlaveError = 2;

}  // namespace

AxiReadMemory::AxiReadMemory(std::vector<cmodel::Beat> beats, std::uint64_t address, const AxiTimings& timings)
    : beats_(std::move(beats)), address_(address), timings_(timings), asked_(beats_.size()) {
  timings_.latency = std::max(timings_.latency, 1U);
}

void AxiReadMemory::expect(bool holds, const char* rule) {
  if (!holds && broken_.empty()) broken_ = rule;
}

void AxiReadMemory::take(const AxiRequest& request) {
  const std::uint64_t bytes = (std::uint64_t{request.len} + 1) * cmodel::kBeatBytes;
  expect(request.size == kSize && request.burst == kIncrement, "a burst other than INCR of 32 bytes");
  expect(request.address % cmodel::kBeatBytes == 0, "an address that is not aligned to beats");
  expect(request.address % kPage + bytes <= kPage, "a burst crosses 4 KB");
  const bool inside =
      request.address >= address_ && request.address - address_ + bytes <= beats_.size() * cmodel::kBeatBytes;
  expect(inside, "a burst outside the stream");
  ++bursts_;
  if (!inside) return;
  const std::size_t first = (request.address - address_) / cmodel::kBeatBytes;
  const std::uint64_t more = mix(timings_.seed + bursts_) % (timings_.more_latency + 1ULL);
  under_way_.push_back({first, request.len + 1, cycle_ + timings_.latency + more});
  most_under_way_ = std::max(most_under_way_, under_way_.size());
  for (unsigned i = 0; i <= request.len; ++i) {
    ++asked_[first + i];
    asked_now_.push_back(first + i);
  }
}

void AxiReadMemory::edge(const AxiRequest& request, bool answer_ready) {
  asked_now_.clear();
  expect(!waiting_.valid || waiting_ == request, "an address is withdrawn or changed before it was taken");
  waiting_ = {};
  if (request.valid && ready_) {
    take(request);
  } else if (request.valid) {
    waiting_ = request;
  }
  if (answer_.valid && answer_ready) answer_.valid = false;
  ++cycle_;
  ready_ = timings_.takes.at(cycle_);
  if (answer_.valid || under_way_.empty() || under_way_.front().from > cycle_) return;
  if (!timings_.has.at(cycle_)) return;
  Burst& burst = under_way_.front();
  answer_ = {.valid = true, .last = burst.left == 1, .response = 0, .data = beats_[burst.beat]};
  if (burst.beat == spoiled_) {
    answer_.response = kSlaveError;
    answer_.data.fill(0xdeadbeef);
  }
  ++burst.beat;
  if (--burst.left == 0) under_way_.pop_front();
}

}  // namespace fastsplat::testbench
