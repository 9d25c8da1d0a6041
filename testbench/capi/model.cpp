// SPDX-License-Identifier: Apache-2.0
// The model of the C interface: taps and tiles are kept until they are taken.
#include "cmodel/model.hpp"

#include <cstring>
#include <deque>
#include <memory>

#include "testbench/capi/config_handle.hpp"
#include "testbench/capi/guard.hpp"
#include "testbench/capi/handles.hpp"
#include "testbench/capi/tap_queue.hpp"

namespace fastsplat::capi {
namespace {

/// One stream through the model.
class Run final : private cmodel::TapSink, private cmodel::PixelSink {
 public:
  Run(const cmodel::Config& config, cmodel::StreamScope scope, std::uint32_t taps)
      : taps_(taps), model_(config, scope, *this, taps == 0 ? nullptr : this) {}

  void feed(const char* call, const std::uint32_t* words, std::size_t beats) {
    if (finished_) misuse(call, "the model is finished; reset it for another stream");
    if (!broken_.empty()) misuse(call, "the stream failed earlier (" + broken_ + "); reset the model");
    queue_.sweep();
    cmodel::Beat beat;
    for (; beats > 0; --beats, words += beat.size()) {
      std::memcpy(beat.data(), words, sizeof beat);
      try {
        model_.consume({&beat, 1});
      } catch (const UserError& error) {
        broken_ = error.what();
        throw;
      }
    }
  }

  void finish(const char* call) {
    if (finished_) misuse(call, "the model is already finished");
    if (!broken_.empty()) misuse(call, "the stream failed earlier (" + broken_ + "); reset the model");
    try {
      model_.finish();
    } catch (const UserError& error) {
      broken_ = error.what();
      throw;
    }
    finished_ = true;
  }

  bool next_tap(fastsplat_tap& out) { return queue_.pop(out); }

  bool next_tile(fastsplat_tile& out) {
    if (tiles_.empty()) return false;
    taken_ = std::move(tiles_.front());
    tiles_.pop_front();
    out = {.struct_size = sizeof out,
           .tile = taken_.tile,
           .x = taken_.x,
           .y = taken_.y,
           .width = static_cast<std::uint32_t>(taken_.width),
           .height = static_cast<std::uint32_t>(taken_.height),
           .words = taken_.words.size(),
           .rgba = taken_.words.data()};
    return true;
  }

  const cmodel::Counters& counters() const { return model_.counters(); }

 private:
  void on_tap(const cmodel::TapRecord& record) override {
    if ((taps_ >> static_cast<unsigned>(record.tap) & 1) != 0) queue_.push(record);
  }
  void on_tile(cmodel::TilePixels&& tile) override { tiles_.push_back(std::move(tile)); }

  std::uint32_t taps_;
  TapQueue queue_;
  std::deque<cmodel::TilePixels> tiles_;
  cmodel::TilePixels taken_;  ///< the tile whose words the caller may be reading
  cmodel::Model model_;
  std::string broken_;  ///< the stream's error; empty: none
  bool finished_ = false;
};

}  // namespace
}  // namespace fastsplat::capi

struct fastsplat_model {
  fastsplat::cmodel::Config config;
  std::uint32_t scope, taps;
  std::unique_ptr<fastsplat::capi::Run> run = make();

  std::unique_ptr<fastsplat::capi::Run> make() const {
    return std::make_unique<fastsplat::capi::Run>(
        config,
        scope == FASTSPLAT_WHOLE ? fastsplat::cmodel::StreamScope::Whole : fastsplat::cmodel::StreamScope::Subset,
        taps);
  }
};

namespace fastsplat::capi {
namespace {

static_assert(FASTSPLAT_BEAT_WORDS == cmodel::kBeatWords);
static_assert(FASTSPLAT_TAPS == cmodel::kTapCount && FASTSPLAT_TAP_PIXEL == static_cast<int>(cmodel::Tap::Pixel));

fastsplat_model& live(const char* call, fastsplat_model* model) {
  require_live(call, model, Kind::Model);
  return *model;
}

}  // namespace

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_create(const fastsplat_config* config, std::uint32_t scope,
                                                                 std::uint32_t taps, fastsplat_model** out) {
  return guarded(__func__, [&](const char* call) {
    require(call, "out", out);
    require_scope(call, scope);
    if (taps > FASTSPLAT_ALL_TAPS) misuse(call, "unknown taps", "at most 31", std::to_string(taps));
    auto model = std::make_unique<fastsplat_model>(
        fastsplat_model{.config = config_of(call, config), .scope = scope, .taps = taps});
    born(model.get(), Kind::Model);
    *out = model.release();
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_destroy(fastsplat_model* model) {
  return guarded(__func__, [&](const char* call) {
    if (model == nullptr) return FASTSPLAT_OK;
    bury(call, model, Kind::Model);
    delete model;
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_feed(fastsplat_model* model, const std::uint32_t* words,
                                                               std::size_t beats) {
  return guarded(__func__, [&](const char* call) {
    auto& of = live(call, model);
    if (beats > 0) require(call, "words", words);
    of.run->feed(call, words, beats);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_finish(fastsplat_model* model) {
  return guarded(__func__, [&](const char* call) {
    live(call, model).run->finish(call);
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_reset(fastsplat_model* model) {
  return guarded(__func__, [&](const char* call) {
    auto& of = live(call, model);
    of.run = of.make();
    return FASTSPLAT_OK;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_next_tap(fastsplat_model* model, fastsplat_tap* out) {
  return guarded(__func__, [&](const char* call) {
    require_size(call, sizeof *out, require(call, "out", out)->struct_size);
    const std::size_t size = out->struct_size;
    const bool found = live(call, model).run->next_tap(*out);
    out->struct_size = size;
    return found ? FASTSPLAT_OK : FASTSPLAT_NONE;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_next_tile(fastsplat_model* model, fastsplat_tile* out) {
  return guarded(__func__, [&](const char* call) {
    require_size(call, sizeof *out, require(call, "out", out)->struct_size);
    const std::size_t size = out->struct_size;
    const bool found = live(call, model).run->next_tile(*out);
    out->struct_size = size;
    return found ? FASTSPLAT_OK : FASTSPLAT_NONE;
  });
}

extern "C" FASTSPLAT_API fastsplat_status fastsplat_model_counters(fastsplat_model* model, std::uint64_t* values,
                                                                   std::size_t count) {
  return guarded(__func__, [&](const char* call) {
    const auto& of = live(call, model);
    require(call, "values", values);
    if (count != FASTSPLAT_MODEL_COUNTERS)
      misuse(call, "wrong number of counters", std::to_string(FASTSPLAT_MODEL_COUNTERS), std::to_string(count));
    of.run->counters().for_each([&](const char*, std::uint64_t value, const char*) { *values++ = value; });
    return FASTSPLAT_OK;
  });
}

}  // namespace fastsplat::capi
