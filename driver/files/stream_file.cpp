// SPDX-License-Identifier: Apache-2.0
#include "driver/files/stream_file.hpp"

#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/machine_error.hpp"
#include "base/read_file.hpp"
#include "cmodel/model.hpp"
#include "cmodel/stream/crc32.hpp"
#include "cmodel/stream/stream_advice.hpp"
#include "driver/files/tile_cover.hpp"
#include "driver/tiles/compile.hpp"
#include "driver/tiles/frame_sink.hpp"
#include "driver/tiles/gaussian_frame.hpp"

namespace fastsplat::driver {
namespace {

using cmodel::Beat;
using cmodel::kBeatBytes;

static_assert(std::endian::native == std::endian::little,
              "beats are written as they lie in memory; swap them on a big-endian host");
static_assert(sizeof(Beat) == kBeatBytes);

[[noreturn]] void cannot_write(const std::filesystem::path& path) {
  throw_machine({.where = path.string(),
                 .what = fmt::format("cannot write: {}", std::strerror(errno)),
                 .expected = {},
                 .got = {},
                 .fix = "choose a writable folder with enough free space"});
}

class Writer {
 public:
  explicit Writer(const std::filesystem::path& path)
      : path_(path), file_(path), out_(file_.temporary(), std::ios::binary) {
    if (!out_) cannot_write(path_);
  }
  void write(std::span<const Beat> beats) {
    const auto* bytes = reinterpret_cast<const char*>(beats.data());
    for (const Beat& beat : beats) crc_.add(beat);
    beats_ += beats.size();
    if (!out_.write(bytes, static_cast<std::streamsize>(beats.size_bytes()))) cannot_write(path_);
  }
  void finish() {
    std::vector<Beat> end;
    cmodel::append(end, cmodel::EndFrame{beats_, crc_.value()});
    write(end);
    commit();
  }
  void commit() {
    out_.close();
    if (!out_) cannot_write(path_);
    file_.commit();
  }

 private:
  std::filesystem::path path_;
  AtomicFile file_;
  std::ofstream out_;
  std::uint64_t beats_ = 0;
  cmodel::Crc32 crc_;
};

std::string hex(std::uint32_t word) { return fmt::format("0x{:08x}", word); }

/// Checks first that the file is a stream, and of the supported version.
void require_stream(const Beat& first) {
  const auto opcode = static_cast<std::uint32_t>(get(first, cmodel::layout::kOpcode));
  const auto magic = static_cast<std::uint32_t>(get(first, cmodel::layout::kFrameMagic));
  if (opcode == static_cast<std::uint32_t>(cmodel::Opcode::BeginFrame) && magic == cmodel::kStreamMagic) {
    const std::int64_t version = get(first, cmodel::layout::kFrameVersion);
    if (version == cmodel::kStreamVersion) return;
    throw_input({.where = cmodel::beat_place(0),
                 .what = cmodel::version_message(version),
                 .expected = std::to_string(cmodel::kStreamVersion),
                 .got = std::to_string(version),
                 .fix = cmodel::kOtherVersion});
  }
  throw_input(
      {.where = cmodel::beat_place(0),
       .what = "not a FastSplat stream",
       .expected = fmt::format("begin_frame, opcode 0x{:02x} and magic {}",
                               static_cast<std::uint32_t>(cmodel::Opcode::BeginFrame), hex(cmodel::kStreamMagic)),
       .got = fmt::format("opcode 0x{:02x} and {}", opcode, hex(magic)),
       .fix = "name a stream file (.fss)"});
}

/// Reads the beats of a file in blocks.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {
    require_regular_file(path, "check the name, or write one with 'fastsplat stream record'");
    in_.open(path, std::ios::binary);
    if (!in_) cannot_read(std::strerror(errno));
    std::error_code error;
    bytes_ = std::filesystem::file_size(path, error);
    if (error) cannot_read(error.message());
  }

  /// visit(beat) for every whole beat; stops when it returns false. Throws UserError (Input) if the first beat does not
  /// begin a stream or the last one is truncated.
  template <class Visit>
  void each(Visit visit) {
    std::vector<Beat> block(4096);
    bool first = true;
    while (in_) {
      in_.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(block.size() * kBeatBytes));
      const auto got = static_cast<std::size_t>(in_.gcount()) / kBeatBytes;
      for (std::size_t i = 0; i < got; ++i) {
        if (first) require_stream(block[i]);
        first = false;
        if (!visit(block[i])) return;
      }
    }
    if (in_.bad()) cannot_read(std::strerror(errno));
    if (const auto rest = bytes_ % kBeatBytes; rest != 0) {
      throw_input({.where = cmodel::beat_place(bytes_ / kBeatBytes),
                   .what = "stream ends within this beat",
                   .expected = fmt::format("{} bytes", kBeatBytes),
                   .got = fmt::format("{} byte{}", rest, rest == 1 ? "" : "s"),
                   .fix = cmodel::kDamagedStream});
    }
  }
  std::uintmax_t bytes() const { return bytes_; }

  [[noreturn]] void refuse(std::string what, std::string expected, std::string got, std::string fix) const {
    throw_input({.where = path_.string(),
                 .what = std::move(what),
                 .expected = std::move(expected),
                 .got = std::move(got),
                 .fix = std::move(fix)});
  }

 private:
  [[noreturn]] void cannot_read(const std::string& reason) const {
    throw_machine({.where = path_.string(),
                   .what = "cannot read: " + reason,
                   .expected = {},
                   .got = {},
                   .fix = "check the file and its disk"});
  }

  std::filesystem::path path_;
  std::ifstream in_;
  std::uintmax_t bytes_ = 0;
};

/// Refuses a beat that dump_stream cannot print; `layout` is null for an unknown opcode.
void check_dumped(std::uint64_t number, const Beat& beat, const cmodel::RecordLayout* layout, bool ended) {
  if (layout == nullptr) {
    throw_input({.where = cmodel::beat_place(number),
                 .what = "unknown opcode",
                 .expected = "a known opcode",
                 .got = fmt::format("0x{:02x}", beat[0] & 0xff),
                 .fix = cmodel::kDamagedStream});
  }
  if (ended) {
    throw_input({.where = cmodel::beat_place(number),
                 .what = "record out of order",
                 .expected = "nothing after end_frame",
                 .got = layout->name,
                 .fix = cmodel::kDamagedStream});
  }
}

/// " name=value" of each field; the magic and the configuration's hash in their usual form.
std::string fields_of(const Beat& beat, const cmodel::RecordLayout& layout) {
  std::string text;
  for (const auto& [name, field] : layout.fields) {
    const bool begins = layout.opcode == cmodel::Opcode::BeginFrame;
    const auto value = get(beat, field);
    const std::string_view field_name = name;
    if (begins && field_name == "hash_high") continue;
    if (begins && field_name == "hash_low") {
      const auto high = static_cast<std::uint64_t>(get(beat, cmodel::layout::kFrameHashHigh));
      text += " hash=" + hash_text(high << 32 | static_cast<std::uint64_t>(value));
    } else if (begins && field_name == "magic") {
      text += fmt::format(" {}={}", name, hex(static_cast<std::uint32_t>(value)));
    } else {
      text += fmt::format(" {}={}", name, value);
    }
  }
  return text;
}

/// Checks the beat count and the checksum of end_frame.
void check_end(std::uint64_t number, const Beat& beat, const cmodel::Crc32& crc) {
  const auto end = std::get<cmodel::EndFrame>(cmodel::from_beat(beat));
  if (end.beats != number) {
    throw_input({.where = cmodel::beat_place(number),
                 .what = "end_frame has the wrong number of beats",
                 .expected = std::to_string(number),
                 .got = std::to_string(end.beats),
                 .fix = cmodel::kDamagedStream});
  }
  if (end.crc != crc.value()) {
    throw_input({.where = cmodel::beat_place(number),
                 .what = "corrupt: wrong checksum of the preceding beats",
                 .expected = hex(crc.value()),
                 .got = hex(end.crc),
                 .fix = cmodel::kDamagedStream});
  }
}

std::int64_t opcode(const Beat& beat) { return get(beat, cmodel::layout::kOpcode); }

/// The frame of a replay, made once the header has been checked; the model delivers tiles only after that.
class ReplayFrame final : public cmodel::PixelSink {
 public:
  void begin(const cmodel::Config& config, int width, int height) { frame_.emplace(config, width, height); }
  void on_tile(cmodel::TilePixels&& tile) override { frame_->on_tile(std::move(tile)); }
  cmodel::Frame take() { return frame_->take(); }

 private:
  std::optional<FrameSink> frame_;
};

/// Feeds every beat to the device; calls `header` with begin_frame after the device has checked it.
template <class Header>
void feed(Reader& reader, const std::filesystem::path& path, cmodel::Device& device, const RenderOptions& options,
          Header header) {
  std::uint64_t beats = 0;
  CoverRule cover;
  naming(path, [&] {
    reader.each([&](const Beat& beat) {
      device.consume({&beat, 1});
      cover.see(beat);
      if (beats == 0) header(beat);
      ++beats;
      if (options.progress && beats % 65536 == 0) options.progress(beats * kBeatBytes, reader.bytes());
      return true;
    });
    device.finish();
  });
}

}  // namespace

void naming(const std::filesystem::path& path, const std::function<void()>& action) {
  try {
    action();
  } catch (const UserError& error) {
    if (!error.parts().where.starts_with("beat ")) throw;
    ErrorParts parts = error.parts();
    parts.where = path.string() + ": " + parts.where;
    throw UserError(error.code(), parts);
  }
}

void check_image_size(int width, int height) {
  const std::int64_t pixels = std::int64_t{width} * height;
  if (pixels <= kMostImagePixels) return;
  throw_usage({.where = "--size",
               .what = "image too large for a stream file",
               .expected = fmt::format("at most {} pixels, 8192x8192", kMostImagePixels),
               .got = fmt::format("{} pixels, {}x{}", pixels, width, height),
               .fix = "record it at a smaller --size"});
}

DriverReport record_stream(const scene::Scene& scene, const cmodel::Config& config, const std::filesystem::path& path,
                           const RenderOptions& options) {
  check_image_size(scene.camera.width(), scene.camera.height());
  Writer writer(path);
  const CompiledFrame compiled(scene, config);
  const DriverReport report =
      compiled.emit([&](std::span<const Beat> beats) { writer.write(beats); }, options.progress);
  writer.finish();
  return report;
}

GaussianReport record_stream(const GaussianFrame& frame, const std::filesystem::path& path, const Progress& progress) {
  check_image_size(frame.grid().image_width, frame.grid().image_height);
  Writer writer(path);
  const GaussianReport report = frame.emit([&](std::span<const Beat> beats) { writer.write(beats); }, progress);
  writer.finish();
  return report;
}

DeviceRender replay_stream(const std::filesystem::path& path, const cmodel::Config& config,
                           const RenderOptions& options) {
  Reader reader(path);
  ReplayFrame frame;
  cmodel::Model device(config, cmodel::StreamScope::Whole, frame);
  feed(reader, path, device, options, [&](const Beat& first) {
    const auto header = std::get<cmodel::BeginFrame>(cmodel::from_beat(first));
    const std::int64_t pixels = std::int64_t{header.width} * header.height;
    if (pixels > kMostImagePixels) {
      reader.refuse("image too large to replay", fmt::format("at most {} pixels", kMostImagePixels),
                    fmt::format("{} pixels", pixels), "record it at a smaller --size");
    }
    frame.begin(config, header.width, header.height);
  });
  DeviceRender out;
  out.frame = frame.take();
  out.counters = device.counters();
  out.report.tiles = out.counters.tiles;
  out.report.sheets = out.counters.sheets;
  out.report.splat_records = out.counters.splats;
  return out;
}

cmodel::BeginFrame feed_stream(const std::filesystem::path& path, cmodel::Device& device,
                               const RenderOptions& options) {
  Reader reader(path);
  cmodel::BeginFrame header;
  feed(reader, path, device, options,
       [&](const Beat& first) { header = std::get<cmodel::BeginFrame>(cmodel::from_beat(first)); });
  return header;
}

void read_beats(const std::filesystem::path& path, const cmodel::BeatSink& sink) {
  Reader reader(path);
  constexpr std::size_t kBlock = 4096;
  std::vector<Beat> block;
  naming(path, [&] {
    reader.each([&](const Beat& beat) {
      block.push_back(beat);
      if (block.size() == kBlock) {
        sink(block);
        block.clear();
      }
      return true;
    });
    if (!block.empty()) sink(block);
  });
}

std::uint64_t recorded_config(const std::filesystem::path& path) {
  Reader reader(path);
  std::uint64_t hash = 0;
  naming(path, [&] {
    reader.each([&](const Beat& beat) {
      hash = std::get<cmodel::BeginFrame>(cmodel::from_beat(beat)).config_hash;
      return false;
    });
  });
  return hash;
}

void require_covered(const std::filesystem::path& path) {
  Reader reader(path);
  CoverRule cover;
  naming(path, [&] {
    reader.each([&](const Beat& beat) {
      cover.see(beat);
      return true;
    });
  });
}

void write_beats(const std::filesystem::path& path, std::span<const Beat> beats) {
  Writer writer(path);
  writer.write(beats);
  writer.commit();
}

void dump_stream(const std::filesystem::path& path, const std::function<bool(const std::string&)>& line) {
  Reader reader(path);
  naming(path, [&] {
    std::uint64_t number = 0, payload_left = 0;
    bool ended = false, all = true;
    cmodel::Crc32 crc;
    reader.each([&](const Beat& beat) {
      std::string text;
      const auto* layout = payload_left > 0 ? nullptr : cmodel::find_layout(static_cast<std::uint32_t>(opcode(beat)));
      if (payload_left > 0) {
        --payload_left;
        text = fmt::format("{:>8}    {}", number, fmt::join(beat, " "));
      } else {
        check_dumped(number, beat, layout, ended);
        text = fmt::format("{:>8} {}{}", number, layout->name, fields_of(beat, *layout));
        payload_left = cmodel::announced_beats(beat);
      }
      all = line(text);
      if (!all) return false;
      ended = layout != nullptr && layout->opcode == cmodel::Opcode::EndFrame;
      if (ended) check_end(number, beat, crc);
      crc.add(beat);
      ++number;
      return true;
    });
    if (all && !ended) {
      throw_input({.where = cmodel::beat_place(number),
                   .what = "stream ends too early",
                   .expected = payload_left > 0 ? "a beat of table words" : "end_frame",
                   .got = "end of data",
                   .fix = cmodel::kDamagedStream});
    }
  });
}

}  // namespace fastsplat::driver
