// SPDX-License-Identifier: Apache-2.0
// Answers the page's requests: one JSON object in, one JSON object and pictures out.
#pragma once

#include <cstdint>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "base/image.hpp"
#include "cmodel/stream/device.hpp"
#include "cmodel/stream/frame.hpp"
#include "lab/gaussians.hpp"
#include "lab/request.hpp"
#include "scene/scene.hpp"
#include "scene/volume/volume.hpp"

namespace fastsplat::stages {
class Chain;
}

namespace fastsplat::lab {

/// A picture of an answer: words as the report's viewer takes them, value = word / scale.
struct Words {
  std::string id;  ///< "golden", "device", "blame", "terminated"
  int width = 0, height = 0, channels = 4;
  std::int64_t scale = 1;
  int int_bits = -1;     ///< of the device's format; -1: floats, rounded to the scale
  bool encoded = false;  ///< sRGB, as the colours of most trained Gaussians
  std::vector<std::int32_t> words;
};

struct Answer {
  std::string json;  ///< {"error": "one line"} if the request cannot be answered
  std::vector<Words> pictures;
};

/// Keeps volumes, scenes and golden pictures between requests, at most a few of each.
class Session {
 public:
  /// `request`: {"ask": "tables" | "frame" | "cycles" | "errors" | "terminated" | "pixel" | "histogram" | "config" |
  /// "link", ...} with the keys of lab/request.hpp, and of "frame": "quick" (no SSIM); of "pixel": "x" and "y"; of
  /// "link": "link" (lab/link.hpp). Never throws.
  Answer answer(const std::string& request);

 private:
  struct Kept {
    std::string key;
    scene::Scene scene;
    Image golden;  ///< empty until it is asked for
  };

  struct Drawn {
    cmodel::Frame frame;
    std::uint64_t records = 0;
  };

  std::shared_ptr<const volume::Volume> volume_of(const scene::SceneDescription& description);
  Kept& kept(const scene::SceneDescription& description);
  const Image& golden_of(Kept& kept);
  /// The scene of a request about a volume. Throws UserError for Gaussians.
  const scene::Scene& scene_of(const Request& request);
  /// Refers to the request's configuration.
  std::unique_ptr<stages::Chain> chain_of(const Request& request);
  /// Compiles what a request draws, without end_frame.
  void emit(const Request& request, const cmodel::BeatSink& sink);

  Drawn drawn(const Request& request);

  nlohmann::ordered_json frame(const nlohmann::ordered_json& json, std::vector<Words>& pictures);
  nlohmann::ordered_json cycles(const nlohmann::ordered_json& json);
  nlohmann::ordered_json errors(const nlohmann::ordered_json& json, std::vector<Words>& pictures);
  nlohmann::ordered_json terminated(const nlohmann::ordered_json& json, std::vector<Words>& pictures);
  nlohmann::ordered_json pixel(const nlohmann::ordered_json& json);
  nlohmann::ordered_json histogram(const nlohmann::ordered_json& json);
  nlohmann::ordered_json config(const nlohmann::ordered_json& json);

  std::shared_ptr<scene::SplatStore> store_;  ///< of the last scene drawn
  std::string volume_key_;
  std::shared_ptr<const volume::Volume> volume_;
  std::vector<std::unique_ptr<Kept>> scenes_;  ///< the last used first
  GaussianViews gaussians_;
};

}  // namespace fastsplat::lab
