// SPDX-License-Identifier: Apache-2.0
// Renders one frame of a scene with one engine: a still, or a frame of an animation.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "base/images/image_file.hpp"
#include "cli/device_report.hpp"
#include "cli/output.hpp"
#include "cli/rtl_run.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"

namespace fastsplat::cli {

enum class Engine { Golden, CModel, Rtl };

/// UserError (Usage), with the nearest known name, for unknown names.
Engine engine_from(const std::string& name);
const char* to_string(Engine engine);

/// How frames are rendered.
struct Renderer {
  Engine engine = Engine::Golden;
  std::optional<cmodel::Config> config;  ///< present for a device
  Checking checking = Checking::Off;
  driver::Unit unit = driver::Unit::Fast;  ///< for the integer model and the golden renderer
  bool counters = false;                   ///< of the integer model, of the whole frame and not of what is visible
  int threads = 0;
};

/// Result files of one frame; `raw` empty for none.
struct FrameFiles {
  std::vector<std::string> out;
  std::string raw;
};

struct RenderedFrame {
  std::variant<Image, driver::DeviceRender> picture;
  golden::RenderReport golden;  ///< golden engine only
  std::optional<RtlRun> checked;
};

/// Counts of the golden renderer; 0 sheets for methods without sheets.
struct GoldenReport {
  std::uint64_t voxels = 0;
  int sheets = 0;
  golden::RenderReport report;
};

/// A frame in numbers.
struct FrameReport {
  std::string scene;             ///< its summary
  double footprint_width = 0.0;  ///< of a splat at the volume's centre, pixels
  std::variant<GoldenReport, DeviceReport> engine;
  std::optional<RtlRun> checked;
};

images::Metadata metadata_of(const Renderer& renderer, const scene::Scene& scene);
RenderedFrame render_frame(const Renderer& renderer, const scene::Scene& scene, const Progress& progress);
FrameReport report_of(const Renderer& renderer, const scene::Scene& scene, const RenderedFrame& frame);
std::string to_text(const FrameReport& report);
/// Keys of a subcommand's JSON.
nlohmann::ordered_json to_json(const FrameReport& report);
std::vector<Remark> remarks(const FrameReport& report);
void write_frame(const RenderedFrame& frame, const scene::Scene& scene, const FrameFiles& files,
                 const images::Metadata& metadata, const Output& output);

}  // namespace fastsplat::cli
