// SPDX-License-Identifier: Apache-2.0
#include "lab/session.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "analysis/compare.hpp"
#include "analysis/errors/area.hpp"
#include "analysis/errors/attribution.hpp"
#include "analysis/errors/attribution_report.hpp"
#include "analysis/errors/cost.hpp"
#include "analysis/errors/pixel_report.hpp"
#include "analysis/errors/synthesised.hpp"
#include "analysis/pipeline/chain.hpp"
#include "base/error.hpp"
#include "base/fnv1a.hpp"
#include "base/hash_text.hpp"
#include "base/json_text.hpp"
#include "base/srgb.hpp"
#include "cmodel/cycles/cycle_model.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/cull_log.hpp"
#include "driver/tiles/gaussian_frame.hpp"
#include "driver/tiles/render.hpp"
#include "golden/render.hpp"
#include "lab/limits.hpp"
#include "lab/link.hpp"
#include "lab/tables.hpp"
#include "lab/termination.hpp"
#include "scene/settings.hpp"
#include "scene/splat_store.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::lab {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t kFloatScale = 1 << 16;  ///< of golden's words, as in a report
constexpr std::size_t kScenes = 4;             ///< kept at most
constexpr std::size_t kStoreBytes = std::size_t{256} << 20;

template <class Word>
std::string hash_of(const std::vector<Word>& words) {
  std::uint64_t hash = kFnv1aStart;
  for (const Word word : words) hash = fnv1a(hash, std::uint64_t{static_cast<std::uint32_t>(word)});
  return hash_text(hash);
}

Words words_of(const std::string& id, const Image& image) {
  Words out{.id = id,
            .width = image.width,
            .height = image.height,
            .channels = image.channels,
            .scale = kFloatScale,
            .words = {}};
  out.words.reserve(image.data.size());
  for (const float value : image.data)
    out.words.push_back(std::isfinite(value)
                            ? static_cast<std::int32_t>(
                                  std::lround(std::clamp(value, -16384.0F, 16384.0F) * static_cast<float>(kFloatScale)))
                            : 0);
  return out;
}

Words words_of(const std::string& id, const cmodel::Frame& frame) {
  Words out{.id = id,
            .width = frame.width,
            .height = frame.height,
            .scale = std::int64_t{1} << frame.frac_bits,
            .int_bits = frame.int_bits,
            .words = {}};
  out.words.assign(frame.words.begin(), frame.words.end());
  return out;
}

/// A map for display: 8 bits, sRGB.
Words display_words(const std::string& id, const Image& image) {
  Words out{
      .id = id, .width = image.width, .height = image.height, .channels = image.channels, .scale = 255, .words = {}};
  for (const float value : image.data)
    out.words.push_back(static_cast<std::int32_t>(std::lround(255.0 * srgb_encode(std::clamp(value, 0.0F, 1.0F)))));
  return out;
}

template <class Counted>
Json counted_json(const Counted& counted) {
  Json out;
  counted.for_each([&](const char* name, std::uint64_t value, const char*) { out[name] = value; });
  return out;
}

Json config_json(const cmodel::Config& config) {
  Json out{{"name", config.name}, {"hash", hash_text(cmodel::config_hash(config))}, {"values", Json::object()}};
  for (const auto& key : cmodel::config_keys()) out["values"][key.name] = cmodel::text_of(config, key);
  const bool counted = config.index() == cmodel::IndexKind::Rlut;
  out["cost"] = counted ? analysis::to_json(analysis::cost(config)) : Json(nullptr);
  out["synthesis"] = analysis::synthesised(config);
  out["area"] = analysis::area_json(config);
  return out;
}

/// A resolved transfer function as a file of the product's.
std::string toml_of(const scene::TransferFunction& tf) {
  const auto number = scene::number_as_toml;
  std::string text =
      fmt::format("domain = \"value\"\nreference_length = {}\npoints = [\n", number(tf.reference_length));
  for (const auto& point : tf.points) {
    text += fmt::format("  {{at = {}, colour = [{}, {}, {}], opacity = {}}},\n", number(point.at),
                        number(point.colour.r), number(point.colour.g), number(point.colour.b), number(point.opacity));
  }
  text += "]\n";
  if (!tf.shading.on) return text;
  return text +
         fmt::format("[shading]\nambient = {}\ndiffuse = {}\nspecular = {}\nshininess = {}\ngradient_floor = {}\n",
                     number(tf.shading.ambient), number(tf.shading.diffuse), number(tf.shading.specular),
                     number(tf.shading.shininess), number(tf.shading.gradient_floor));
}

Json idle_json(const std::vector<Idle>& idle) {
  Json out = Json::object();
  for (const Idle& one : idle) out[one.setting] = one.reason;
  return out;
}

}  // namespace

std::shared_ptr<const volume::Volume> Session::volume_of(const scene::SceneDescription& description) {
  const std::string key = description.volume + (description.nan_as ? fmt::format(" {}", *description.nan_as) : "");
  if (key == volume_key_ && volume_) return volume_;
  const volume::Volume head = volume::read_volume_header(description.volume);
  const std::int64_t voxels = std::int64_t{head.dims.x} * head.dims.y * head.dims.z;
  if (voxels > kMostVoxels) {
    throw_usage({.where = description.volume,
                 .what = "too large for a page",
                 .expected = fmt::format("at most {} voxels", kMostVoxels),
                 .got = fmt::format("{}", voxels),
                 .fix = "use the program, or a smaller volume"});
  }
  volume_.reset();
  scenes_.clear();
  store_ = std::make_shared<scene::SplatStore>(kStoreBytes);
  volume::ReadOptions options;
  if (description.nan_as) options.nan_as = static_cast<float>(*description.nan_as);
  volume_ = std::make_shared<const volume::Volume>(volume::load_volume(description.volume, options));
  volume_key_ = key;
  return volume_;
}

Session::Kept& Session::kept(const scene::SceneDescription& description) {
  const std::string key = scene::to_toml(description);
  const auto found = std::find_if(scenes_.begin(), scenes_.end(), [&](const auto& one) { return one->key == key; });
  if (found != scenes_.end()) {
    std::rotate(scenes_.begin(), found, found + 1);
  } else {
    auto volume = volume_of(description);
    scenes_.insert(scenes_.begin(),
                   std::make_unique<Kept>(Kept{key, scene::build_scene(description, std::move(volume)), {}}));
    scenes_.front()->scene.store = store_;
    if (scenes_.size() > kScenes) scenes_.pop_back();
  }
  return *scenes_.front();
}

const Image& Session::golden_of(Kept& kept) {
  if (kept.golden.data.empty()) {
    scene::check_capability(kept.scene, scene::kOffersAll);
    kept.golden = golden::render(kept.scene, {.threads = 1, .progress = {}});
  }
  return kept.golden;
}

const scene::Scene& Session::scene_of(const Request& request) {
  if (request.gaussians) {
    throw_usage({.where = request.gaussians->name,
                 .what = "supports volumes only, not 3-D Gaussians",
                 .expected = {},
                 .got = {},
                 .fix = "choose a volume"});
  }
  return kept(request.scene).scene;
}

std::unique_ptr<stages::Chain> Session::chain_of(const Request& request) {
  return request.gaussians ? std::make_unique<stages::Chain>(gaussians_.of(*request.gaussians).scene, request.config, 1)
                           : std::make_unique<stages::Chain>(scene_of(request), request.config);
}

void Session::emit(const Request& request, const cmodel::BeatSink& sink) {
  if (!request.gaussians) {
    driver::CompiledFrame(scene_of(request), request.config).emit(sink);
    return;
  }
  const GaussianView& view = gaussians_.of(*request.gaussians);
  driver::GaussianFrame(view.scene, view.projected, request.config).emit(sink);
}

Session::Drawn Session::drawn(const Request& request) {
  const driver::RenderOptions options{.threads = 1, .counters = false, .progress = {}};
  if (!request.gaussians) {
    auto render = driver::render(scene_of(request), request.config, options);
    return {std::move(render.frame), render.report.splat_records};
  }
  const GaussianView& view = gaussians_.of(*request.gaussians);
  auto render = driver::render_gaussians(driver::GaussianFrame(view.scene, view.projected, request.config), options);
  return {std::move(render.frame), render.report.records};
}

Json Session::frame(const Json& json, std::vector<Words>& pictures) {
  const Request request = read_request(json);
  const GaussianView* const view = request.gaussians ? &gaussians_.of(*request.gaussians) : nullptr;
  const Image& golden = view != nullptr ? view->golden : golden_of(kept(request.scene));
  const auto& remarks = view != nullptr ? view->scene.cloud->remarks : kept(request.scene).scene.remarks;
  pictures.push_back(words_of("golden", golden));
  Json out{{"idle", idle_json(request.idle)}, {"command", {}},           {"remarks", remarks},
           {"width", golden.width},           {"height", golden.height}, {"config", config_json(request.config)}};
  try {
    const Drawn device = drawn(request);
    pictures.push_back(words_of("device", device.frame));
    analysis::CompareOptions options;
    options.threads = 1;
    options.similarity = !json.value("quick", false);
    out["words_hash"] = hash_of(device.frame.words);
    out["compare"] = Json::parse(analysis::to_json(analysis::compare(golden, driver::to_image(device.frame), options)));
    out["records"] = device.records;
  } catch (const UserError& error) {
    out["device_error"] = error.what();
  }
  out["command"] = command_line(json, request, out.contains("device_error"));
  for (Words& words : pictures) words.encoded = view != nullptr && !view->scene.cloud->linear;
  return out;
}

Json Session::cycles(const Json& json) {
  const Request request = read_request(json);
  const cmodel::Config& config = request.config;
  if (auto wrong = cmodel::cycle_violation(config)) throw_usage(*wrong);
  cmodel::CycleOptions options;
  driver::CullRun culls;
  if (config.culls()) {
    culls = driver::run_culls(driver::CompiledFrame(scene_of(request), config, 1),
                              driver::terminations(scene_of(request), config));
    options.culls = &culls.log;
  }
  cmodel::CycleModel model(config, cmodel::StreamScope::Subset, options);
  emit(request, [&](std::span<const cmodel::Beat> beats) { model.consume(beats); });
  model.finish();
  return {{"actual", model.stalls().busy},
          {"idle", model.idle_cycles()},
          {"end", model.end_cycle()},
          {"account", counted_json(model.account())},
          {"bytes_in", model.sent().total() * cmodel::kBeatBytes},
          {"bytes_out", model.pixel_beats() * static_cast<std::uint64_t>(config.lanes) * cmodel::kPixelBytes}};
}

Json Session::errors(const Json& json, std::vector<Words>& pictures) {
  const Request request = read_request(json);
  const auto attribution = analysis::attribute(*chain_of(request), {.quick = true, .threads = 1});
  pictures.push_back(display_words("blame", analysis::blame_map(attribution)));
  return analysis::to_json(attribution, std::nullopt);
}

/// The picture's words: the sheet's number plus 1, and 0 where a pixel never terminates.
Json Session::terminated(const Json& json, std::vector<Words>& pictures) {
  const Request request = read_request(json);
  const TerminationMap map = termination(scene_of(request), request.config);
  Words picture{.id = "terminated", .width = map.width, .height = map.height, .channels = 1, .words = map.sheets};
  std::optional<std::int32_t> first;
  std::int32_t last = 0;
  std::size_t count = 0;
  for (std::int32_t& word : picture.words) {
    if (word++ < 0) continue;
    first = std::min(first.value_or(word), word), last = std::max(last, word);
    ++count;
  }
  picture.scale = std::max(1, last);
  Json out{{"pixels", count},
           {"of", map.sheets.size()},
           {"freeze_below", request.config.freeze_below},
           {"map_hash", hash_of(picture.words)}};
  if (first) out["first"] = *first - 1, out["last"] = last - 1;
  pictures.push_back(std::move(picture));
  return out;
}

Json Session::pixel(const Json& json) {
  const Request request = read_request(json);
  const auto chain = chain_of(request);
  return analysis::to_json(analysis::explain(*chain, json.at("x").get<int>(), json.at("y").get<int>(), 1), *chain);
}

Json Session::histogram(const Json& json) {
  const Request request = read_request(json);
  const scene::Scene& scene = scene_of(request);
  const volume::Volume& volume = *scene.volume;
  constexpr std::size_t kBins = 256;
  std::vector<std::uint64_t> bins(kBins);
  const double span = std::max(1e-30, static_cast<double>(volume.max) - volume.min);
  for (const float voxel : volume.voxels)
    ++bins[std::min(kBins - 1, static_cast<std::size_t>((voxel - volume.min) / span * kBins))];
  const auto tf = scene::resolved(scene.transfer_function, volume);
  Json points = Json::array();
  for (const auto& point : tf.points)
    points.push_back(
        {{"at", point.at}, {"colour", {point.colour.r, point.colour.g, point.colour.b}}, {"opacity", point.opacity}});
  return {{"min", volume.min},
          {"max", volume.max},
          {"bins", bins},
          {"tf", tf.name},
          {"toml", toml_of(tf)},
          {"points", points},
          {"dims", {volume.dims.x, volume.dims.y, volume.dims.z}}};
}

Json Session::config(const Json& json) {
  const Request request = read_request(json);
  Json out = config_json(request.config);
  out["toml"] = driver::to_toml(request.config);
  return out;
}

Answer Session::answer(const std::string& request) {
  Answer answer;
  Json out;
  try {
    const Json json = Json::parse(request);
    const auto ask = json.at("ask").get<std::string>();
    if (ask == "tables")
      out = tables();
    else if (ask == "frame")
      out = frame(json, answer.pictures);
    else if (ask == "cycles")
      out = cycles(json);
    else if (ask == "errors")
      out = errors(json, answer.pictures);
    else if (ask == "terminated")
      out = terminated(json, answer.pictures);
    else if (ask == "pixel")
      out = pixel(json);
    else if (ask == "histogram")
      out = histogram(json);
    else if (ask == "config")
      out = config(json);
    else if (ask == "link")
      out = state_of_link(json.at("link").get<std::string>());
    else
      throw_usage({.where = "ask", .what = "unknown request", .expected = {}, .got = ask, .fix = {}});
  } catch (const UserError& error) {
    out = {{"error", error.what()}};
  } catch (const std::bad_alloc&) {
    out = {{"error", "the page's memory is full: use a smaller volume or picture"}};
  } catch (const std::exception& error) {
    out = {{"error", error.what()}};
  }
  if (out.contains("error")) answer.pictures.clear();
  Json list = Json::array();
  for (const Words& words : answer.pictures)
    list.push_back({{"id", words.id},
                    {"width", words.width},
                    {"height", words.height},
                    {"channels", words.channels},
                    {"scale", words.scale},
                    {"int_bits", words.int_bits},
                    {"encoded", words.encoded}});
  out["pictures"] = list;
  answer.json = json_text(out, -1);
  return answer;
}

}  // namespace fastsplat::lab
