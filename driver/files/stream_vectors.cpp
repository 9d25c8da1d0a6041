// SPDX-License-Identifier: Apache-2.0
#include "driver/files/stream_vectors.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <deque>
#include <fstream>
#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/json_text.hpp"
#include "base/machine_error.hpp"
#include "cmodel/model.hpp"
#include "driver/files/stream_file.hpp"

namespace fastsplat::driver {
namespace {

std::string tap_file(cmodel::Tap tap) { return std::string(to_string(tap)) + ".hex"; }

/// A text file being written, with its line count and checksum.
class TextFile {
 public:
  TextFile(const std::filesystem::path& folder, const std::string& name)
      : path_(folder / name), file_(path_), out_(file_.temporary(), std::ios::binary), facts_{.name = name} {
    if (!out_) refuse();
  }
  void line(const std::string& text) {
    out_ << text << '\n';
    if (!out_) refuse();
    crc_ = crc32(crc_, reinterpret_cast<const Bytef*>(text.data()), static_cast<uInt>(text.size()));
    crc_ = crc32(crc_, reinterpret_cast<const Bytef*>("\n"), 1);
    ++facts_.lines;
    facts_.bytes += text.size() + 1;
  }
  void close() {
    out_.close();
    if (!out_) refuse();
  }
  void commit() { file_.commit(); }
  VectorFile facts() const {
    VectorFile out = facts_;
    out.crc = static_cast<std::uint32_t>(crc_);
    return out;
  }

 private:
  [[noreturn]] void refuse() const {
    throw_machine({.where = path_.string(),
                   .what = fmt::format("cannot write: {}", std::strerror(errno)),
                   .expected = {},
                   .got = {},
                   .fix = "choose a writable folder with enough free space"});
  }

  std::filesystem::path path_;
  AtomicFile file_;
  std::ofstream out_;
  VectorFile facts_;
  uLong crc_ = crc32(0, nullptr, 0);
};

/// "[1,2,3]"
template <class Words>
std::string array(const Words& words) {
  return fmt::format("[{}]", fmt::join(words, ","));
}

/// A device that records its input beats and the model's taps and pixels for them.
class Scribe final : public cmodel::Device, private cmodel::TapSink, private cmodel::PixelSink {
 public:
  Scribe(const cmodel::Config& config, const std::filesystem::path& folder)
      : config_(config),
        beats_(folder, "beats.hex"),
        output_(folder, "output.hex"),
        records_(folder, "records.json"),
        model_(config, cmodel::StreamScope::Whole, *this, this) {
    for (int tap = 0; tap < cmodel::kTapCount; ++tap)
      taps_.emplace_back(folder, tap_file(static_cast<cmodel::Tap>(tap)));
    records_.line("[");
  }

  void consume(std::span<const cmodel::Beat> beats) override {
    for (const auto& beat : beats) {
      model_.consume({&beat, 1});
      std::string digits;
      for (std::size_t word = beat.size(); word-- > 0;) digits += fmt::format("{:08x}", beat[word]);
      beats_.line(digits);
      record(fmt::format("{{\"beat\":{}}}", array(beat)));
      for (const auto& text : shown_) record(text);
      shown_.clear();
      ++report_.beats;
    }
  }
  void finish() override {
    model_.finish();
    records_.line(open_ + "]");
    report_.counters = model_.counters();
  }
  const cmodel::Counters& counters() const override { return model_.counters(); }

  /// Gives all files their names, vectors.json last.
  VectorReport commit(const std::filesystem::path& stream, const std::filesystem::path& folder) {
    std::vector<TextFile*> all{&beats_, &output_, &records_};
    for (auto& tap : taps_) all.push_back(&tap);
    for (auto* file : all) {
      file->close();
      report_.files.push_back(file->facts());
    }
    TextFile contents(folder, "vectors.json");
    contents.line(contents_text(stream));
    contents.close();
    for (auto* file : all) file->commit();
    contents.commit();
    return report_;
  }

 private:
  /// Writes one record per line, with a comma after each but the last.
  void record(const std::string& text) {
    if (!open_.empty()) records_.line(open_ + ",");
    open_ = text;
  }

  void on_tap(const cmodel::TapRecord& record) override {
    const auto kind = static_cast<std::size_t>(record.tap);
    ++report_.taps[kind];
    taps_[kind].line(fmt::format("{:08x} {:08x} {:08x} {:08x} {:08x} {:08x}", record.tile, record.sheet, record.tag,
                                 static_cast<std::uint32_t>(record.x), static_cast<std::uint32_t>(record.y),
                                 fmt::join(record.payload, " ")));
    shown_.push_back(fmt::format(R"({{"tap":"{}","tile":{},"sheet":{},"tag":{},"x":{},"y":{},"words":{}}})",
                                 to_string(record.tap), record.tile, record.sheet, record.tag, record.x, record.y,
                                 array(record.payload)));
  }

  /// The beats of fastsplat_pixel_out: P pixels of a row, pixel 0 lowest. Pixels outside the tile are 0 and not in
  /// keep.
  void on_tile(cmodel::TilePixels&& tile) override {
    const int lanes = config_.lanes, digits = (lanes + 3) / 4;
    for (int y = 0; y < tile.height; ++y) {
      for (int x = 0; x < tile.width; x += lanes) {
        const int inside = std::min(lanes, tile.width - x);
        std::string data;
        for (int pixel = lanes; pixel-- > 0;) {
          for (int channel = 4; channel-- > 0;) {
            const auto at = (static_cast<std::size_t>(y) * tile.width + x + pixel) * 4 + channel;
            data += fmt::format("{:08x}", pixel < inside ? tile.words[at] : 0);
          }
        }
        const bool last = y + 1 == tile.height && x + lanes >= tile.width;
        output_.line(fmt::format("{}_{:0{}x}_{}", last ? 1 : 0, (std::uint64_t{1} << inside) - 1, digits, data));
        ++report_.pixel_beats;
      }
    }
    shown_.push_back(fmt::format(R"({{"picture":{},"x":{},"y":{},"width":{},"height":{},"words":{}}})", tile.tile,
                                 tile.x, tile.y, tile.width, tile.height, array(tile.words)));
  }

  std::string contents_text(const std::filesystem::path& stream) const {
    nlohmann::ordered_json json{{"format", "fastsplat-vectors"},
                                {"version", 1},
                                {"stream", stream.filename().string()},
                                {"config", {{"name", config_.name}, {"hash", hash_text(config_hash(config_))}}},
                                {"lanes", config_.lanes},
                                {"tile", {{"width", config_.tile_width}, {"height", config_.tile_height}}},
                                {"beats", report_.beats},
                                {"pixel_beats", report_.pixel_beats}};
    for (std::size_t tap = 0; tap < report_.taps.size(); ++tap)
      json["taps"][to_string(static_cast<cmodel::Tap>(tap))] = report_.taps[tap];
    report_.counters.for_each(
        [&](const char* name, std::uint64_t value, const char*) { json["counters"][name] = value; });
    for (const auto& file : report_.files) {
      json["files"].push_back({{"name", file.name},
                               {"lines", file.lines},
                               {"bytes", file.bytes},
                               {"crc32", fmt::format("{:08x}", file.crc)}});
    }
    return json_text(json, 1);
  }

  cmodel::Config config_;
  TextFile beats_, output_, records_;
  std::deque<TextFile> taps_;
  std::vector<std::string> shown_;  ///< records of the current beat
  std::string open_;                ///< the last record, held back until the next one is known to follow
  VectorReport report_;
  cmodel::Model model_;
};

/// Creates the folder; false if it existed. Its parent must exist, as for every other result, so that a typo does not
/// create a tree of folders.
bool make_folder(const std::filesystem::path& folder) {
  const auto plain = folder.has_filename() ? folder : folder.parent_path();  // without a slash at its end
  const auto parent = plain.has_parent_path() ? plain.parent_path() : std::filesystem::path(".");
  std::error_code error;
  const bool lies = std::filesystem::is_directory(parent, error);
  const bool made = lies && std::filesystem::create_directory(plain, error);
  if (lies && !error && std::filesystem::is_directory(plain)) return made;
  // If a file is in the way, libraries report either nothing or that it exists.
  std::error_code ignored;
  const bool in_the_way = lies && std::filesystem::exists(plain, ignored);
  throw_input({.where = folder.string(),
               .what = "cannot create the folder: " + (!lies ? "the folder " + parent.string() + " does not exist"
                                                       : in_the_way ? "it is a file"
                                                                    : error.message()),
               .expected = {},
               .got = {},
               .fix = "choose another name"});
}

}  // namespace

std::vector<std::string> vector_file_names() {
  std::vector<std::string> names{"beats.hex", "output.hex", "records.json"};
  for (int tap = 0; tap < cmodel::kTapCount; ++tap) names.push_back(tap_file(static_cast<cmodel::Tap>(tap)));
  names.emplace_back("vectors.json");
  return names;
}

VectorReport write_vectors(const std::filesystem::path& stream, const cmodel::Config& config,
                           const std::filesystem::path& folder, const RenderOptions& options) {
  std::optional<UnfinishedPath> made;  // declared before the files in it, so that it is removed after them
  if (make_folder(folder)) made.emplace(folder);
  Scribe scribe(config, folder);
  feed_stream(stream, scribe, options);
  const VectorReport report = scribe.commit(stream, folder);
  if (made) made->keep();
  return report;
}

}  // namespace fastsplat::driver
