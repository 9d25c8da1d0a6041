#include "driver/stream_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <optional>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "cmodel/crc32.hpp"
#include "cmodel/model.hpp"
#include "driver/compile.hpp"
#include "driver/frame_sink.hpp"

namespace fastsplat::driver {
namespace {

using cmodel::Beat;
using cmodel::kBeatBytes;

static_assert(std::endian::native == std::endian::little,
              "beats are written as they lie in memory; swap them on a big-endian host");
static_assert(sizeof(Beat) == kBeatBytes);

constexpr std::int64_t kLargestImage = std::int64_t{1}
                                       << 26;  ///< pixels; a header alone must not cost more memory than this

[[noreturn]] void cannot_write(const std::filesystem::path& path) {
  throw_input({.where = path.string(),
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

/// Beats of a file in blocks, with the CRC of all beats before the current block's end kept for the last one.
class Reader {
 public:
  explicit Reader(const std::filesystem::path& path) : path_(path) {
    std::error_code error;
    if (std::filesystem::is_directory(path, error)) refuse("is a directory", "a stream file", {}, "name a .fss file");
    in_.open(path, std::ios::binary);
    if (!in_)
      refuse(fmt::format("cannot read: {}", std::strerror(errno)), {}, {},
             "check the name; 'fastsplat stream record' makes one");
    bytes_ = std::filesystem::file_size(path, error);
    if (error) refuse("is not a regular file", "a stream file", {}, "name a .fss file");
    if (bytes_ == 0) refuse("is empty", "a stream of whole beats", "0 bytes", "record it again");
    if (bytes_ % kBeatBytes != 0) {
      refuse("truncated", fmt::format("a multiple of {} bytes", kBeatBytes), fmt::format("{} bytes", bytes_),
             "record it again");
    }
  }

  /// visit(beat) for every beat; stops when it returns false.
  template <class Visit>
  void each(Visit visit) {
    std::vector<Beat> block(4096);
    while (in_) {
      in_.read(reinterpret_cast<char*>(block.data()), static_cast<std::streamsize>(block.size() * kBeatBytes));
      const auto got = static_cast<std::size_t>(in_.gcount()) / kBeatBytes;
      for (std::size_t i = 0; i < got; ++i) {
        if (!visit(block[i])) return;
      }
    }
    if (in_.bad()) refuse(fmt::format("cannot read: {}", std::strerror(errno)), {}, {}, "check the disk");
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
  std::filesystem::path path_;
  std::ifstream in_;
  std::uintmax_t bytes_ = 0;
};

std::int64_t opcode(const Beat& beat) { return get(beat, cmodel::layout::kOpcode); }

/// The frame of a replay: made when the header is known to be sound; the model hands it tiles only after that.
class ReplayFrame final : public cmodel::PixelSink {
 public:
  void begin(const cmodel::Config& config, int width, int height) {
    frame_.emplace(config, width, height);
    width_ = width;
    covered_.assign(static_cast<std::size_t>(width) * height, false);
  }
  void on_tile(cmodel::TilePixels&& tile) override {
    for (int y = tile.y; y < tile.y + tile.height; ++y) {
      const auto first = covered_.begin() + static_cast<std::ptrdiff_t>(y) * width_ + tile.x;
      std::fill(first, first + tile.width, true);
    }
    frame_->on_tile(std::move(tile));
  }
  std::int64_t uncovered() const { return std::count(covered_.begin(), covered_.end(), false); }
  cmodel::Frame take() { return frame_->take(); }

 private:
  std::optional<FrameSink> frame_;
  int width_ = 0;
  std::vector<bool> covered_;  ///< pixels that a tile delivered
};

/// Every beat to the device, which has checked begin_frame when `header` is called with it.
template <class Header>
void feed(Reader& reader, const std::filesystem::path& path, cmodel::Device& device, const RenderOptions& options,
          Header header) {
  std::uint64_t beats = 0;
  try {
    reader.each([&](const Beat& beat) {
      device.consume({&beat, 1});
      if (beats == 0) header(beat);
      ++beats;
      if (options.progress && beats % 65536 == 0) options.progress(beats * kBeatBytes, reader.bytes());
      return true;
    });
    device.finish();
  } catch (const UserError& error) {
    if (error.parts().where.rfind("beat ", 0) != 0) throw;
    ErrorParts parts = error.parts();
    parts.where = path.string() + ": " + parts.where;
    throw UserError(error.code(), parts);
  }
}

}  // namespace

DriverReport record_stream(const scene::Scene& scene, const cmodel::Config& config, const std::filesystem::path& path,
                           const RenderOptions& options) {
  Writer writer(path);
  const CompiledFrame compiled(scene, config);
  const DriverReport report =
      compiled.emit([&](std::span<const Beat> beats) { writer.write(beats); }, options.progress);
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
    if (pixels > kLargestImage) {
      reader.refuse("image too large to replay", fmt::format("at most {} pixels", kLargestImage),
                    fmt::format("{} pixels", pixels), "record it at a smaller --size");
    }
    frame.begin(config, header.width, header.height);
  });
  if (const std::int64_t uncovered = frame.uncovered(); uncovered != 0) {
    reader.refuse("tiles do not cover the image", "every pixel in a tile", fmt::format("{} pixels in none", uncovered),
                  "record it again");
  }
  DeviceRender out;
  out.frame = frame.take();
  out.counters = device.counters();
  out.report.tiles = out.counters.tiles;
  out.report.sheets = out.counters.sheets;
  out.report.splat_records = out.counters.splats;
  return out;
}

void feed_stream(const std::filesystem::path& path, cmodel::Device& device, const RenderOptions& options) {
  Reader reader(path);
  feed(reader, path, device, options, [](const Beat&) {});
}

void read_beats(const std::filesystem::path& path, const cmodel::BeatSink& sink) {
  Reader reader(path);
  constexpr std::size_t kBlock = 4096;
  std::vector<Beat> block;
  reader.each([&](const Beat& beat) {
    block.push_back(beat);
    if (block.size() == kBlock) {
      sink(block);
      block.clear();
    }
    return true;
  });
  if (!block.empty()) sink(block);
}

void write_beats(const std::filesystem::path& path, std::span<const Beat> beats) {
  Writer writer(path);
  writer.write(beats);
  writer.commit();
}

void dump_stream(const std::filesystem::path& path, const std::function<bool(const std::string&)>& line) {
  Reader reader(path);
  std::uint64_t number = 0, payload_left = 0;
  reader.each([&](const Beat& beat) {
    std::string text;
    if (payload_left > 0) {
      --payload_left;
      text = fmt::format("{:>8}    {} {} {} {} {} {}", number, beat[0], beat[1], beat[2], beat[3], beat[4], beat[5]);
    } else {
      const auto* layout = cmodel::find_layout(static_cast<std::uint32_t>(opcode(beat)));
      if (layout == nullptr) {
        reader.refuse(fmt::format("beat {} (byte offset {}): unknown opcode", number, number * kBeatBytes),
                      "a known opcode", fmt::format("0x{:02x}", opcode(beat)), "record it again");
      }
      if (number == 0 && layout->opcode != cmodel::Opcode::BeginFrame) {
        reader.refuse("not a FastSplat stream", "begin_frame first", layout->name, "name a .fss file");
      }
      text = fmt::format("{:>8} {}", number, layout->name);
      for (const auto& [name, field] : layout->fields) text += fmt::format(" {}={}", name, get(beat, field));
      if (layout->opcode == cmodel::Opcode::LoadTable)
        payload_left = (std::uint64_t{cmodel::announced_words(beat)} + 5) / 6;
    }
    ++number;
    return line(text);
  });
}

}  // namespace fastsplat::driver
