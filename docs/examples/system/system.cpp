// SPDX-License-Identifier: Apache-2.0
// fastsplat_system STREAM.fss PICTURE [--break]: renders a recorded stream in the simulated system, checks every pixel
// against the model and writes the picture. --break: spoils a beat first and shows how a host finds out and goes on.
#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/hash_text.hpp"
#include "base/images/image_file.hpp"
#include "cmodel/io/register_map.hpp"
#include "cmodel/model.hpp"
#include "cmodel/stream/stream_rules.hpp"
#include "docs/examples/system/host.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"
#include "driver/tiles/frame_sink.hpp"
#include "testbench/device/tile_assembly.hpp"

namespace fastsplat::examples {
namespace {

using namespace cmodel;

constexpr std::uint64_t kPatience = std::uint64_t{1} << 28;  ///< cycles for a frame

template <class... Args>
void say(fmt::format_string<Args...> text, Args&&... args) {
  fmt::print("{}\n", fmt::format(text, std::forward<Args>(args)...));
}

/// Who the device is, before anything is sent to it.
void meet(Host& host, const Config& config) {
  const std::uint32_t tile = host.read(kRegCapTile.address), lanes = host.read(kRegCapLanes.address);
  const std::uint64_t hash = host.read(kRegHashLow.address) | std::uint64_t{host.read(kRegHashHigh.address)} << 32;
  say("device: magic {:08x}, stream version {}, configuration {}", host.read(kRegMagic.address),
      host.read(kRegVersion.address), hash_text(hash));
  say("device: tiles to {} x {}, {} x {} lanes, {} radius sets", tile & 0xffff, tile >> 16, lanes & 0xffff,
      lanes & 0xffff, lanes >> 16);
  if (hash != config_hash(config)) {
    throw UserError(ExitCode::NotComparable, {.where = "HASH_LOW, HASH_HIGH",
                                              .what = "the device was built for another configuration",
                                              .expected = hash_text(config_hash(config)),
                                              .got = hash_text(hash),
                                              .fix = "build both for the same configuration"});
  }
}

/// A host that writes single bytes gets an error response.
void write_a_byte(Host& host) {
  const bool okay = host.write_bytes(kRegIrqMask.address, kIrqFrame | kIrqError, 0x1);
  const std::uint32_t mask = host.read(kRegIrqMask.address);
  say("device: a write of one byte: {}, IRQ_MASK {:#x}", okay ? "OKAY" : "SLVERR", mask);
  if (!okay && mask == 0) return;
  throw UserError(ExitCode::Simulation, {.where = "IRQ_MASK",
                                         .what = "a write of one byte was accepted",
                                         .expected = "SLVERR, and 0 as before",
                                         .got = {},
                                         .fix = "check WSTRB in fastsplat_top"});
}

/// A beat of a tile with a bit that has no name: refused. The host reads why, and resets.
void spoil(Host& host, std::vector<Beat> beats) {
  std::size_t at = 0;  // of the first end_sheet; words of tables are passed over
  while (get(beats[at], layout::kOpcode) != static_cast<std::int64_t>(Opcode::EndSheet))
    at += 1 + announced_beats(beats[at]);
  beats[at][5] ^= 1;
  host.start(std::move(beats));
  host.wait_for_interrupt(kPatience);
  const std::uint32_t irq = host.read(kRegIrq.address), error = host.read(kRegError.address);
  say("cycle {}: interrupt {:#x}: STATUS {:#x}, ERROR rule {} opcode {:#04x}, beat {} (spoiled: {})", host.cycle(), irq,
      host.read(kRegStatus.address), error & 0xff, error >> 8, host.read(kRegErrorBeat.address), at);
  host.stop();
  host.write(kRegControl.address, kControlReset | kControlClear);
  while ((host.read(kRegStatus.address) & kStatusBusy) != 0) {
  }
  host.write(kRegIrq.address, kIrqFrame | kIrqTile | kIrqError);
  say("cycle {}: soft reset done: STATUS {:#x}, ERROR {:#x}", host.cycle(), host.read(kRegStatus.address),
      host.read(kRegError.address));
}

struct Words {
  std::filesystem::path stream, picture;
  bool spoiled = false;
};

/// Everything that can be said without a simulation is said before it.
Words words_of(std::span<char*> args) {
  Words words;
  int files = 0;
  const auto refuse = [](const char* what, const std::string& got) {
    throw_usage({.where = "fastsplat_system",
                 .what = what,
                 .expected = "STREAM.fss PICTURE.png [--break]",
                 .got = got,
                 .fix = "write a stream with `fastsplat stream record --config small`"});
  };
  for (const std::string_view arg : args.subspan(1)) {
    if (arg == "--break")
      words.spoiled = true;
    else if (arg.starts_with("-"))
      refuse("unknown flag", std::string(arg));
    else if (++files <= 2)
      (files == 1 ? words.stream : words.picture) = arg;
  }
  if (files != 2) refuse("requires two files", std::to_string(files));
  std::error_code none;
  if (std::filesystem::equivalent(words.stream, words.picture, none))
    refuse("the output would replace the input", args[1]);
  const auto ending = words.picture.extension();
  if (ending != ".png" && ending != ".exr" && ending != ".tif")
    refuse("unsupported picture format", words.picture.string());
  images::require_library();
  const AtomicFile probe(words.picture);  // whether it could be written
  return words;
}

int run(std::span<char*> args) {
  const Words words = words_of(args);
  const Config config = driver::load_config("small");
  std::vector<Beat> beats;
  driver::read_beats(words.stream,
                     [&](std::span<const Beat> some) { beats.insert(beats.end(), some.begin(), some.end()); });
  const auto frame = std::get<BeginFrame>(from_beat(beats.at(0)));

  // The model's picture, to compare with; a stream that breaks a rule is refused here.
  driver::FrameSink expected(config, frame.width, frame.height);
  Model model(config, StreamScope::Whole, expected);
  driver::naming(words.stream.string(), [&] { model.consume(beats), model.finish(); });

  driver::FrameSink shown(config, frame.width, frame.height);
  testbench::TileAssembly tiles(config, shown);
  std::uint64_t aborted = 0;
  Host host({}, [&](const PixelBeat& beat) {
    if (beat.aborted)
      aborted += beat.last ? 1 : 0;  // of no use to anybody
    else
      tiles.pixels(beat.words, beat.last);
  });

  meet(host, config);
  write_a_byte(host);
  host.write(kRegIrqMask.address, kIrqFrame | kIrqError);
  if (words.spoiled) {
    spoil(host, beats);
    say("cycle {}: tiles that came out marked as cut short: {}", host.cycle(), aborted);
  }
  host.write(kRegControl.address, kControlClear);
  for (const Beat& beat : beats) tiles.accept(beat);
  say("cycle {}: the source begins: {} beats, {} x {} pixels", host.cycle(), beats.size(), frame.width, frame.height);
  host.start(beats);
  const std::uint64_t from = host.cycle();
  const bool done = host.wait_for_interrupt(kPatience);
  const std::uint32_t irq = host.read(kRegIrq.address);
  say("cycle {}: interrupt {:#x}: {}", host.cycle(), irq, (irq & kIrqFrame) != 0 ? "the frame has left" : "an error");
  if (!done || (irq & kIrqError) != 0)
    throw UserError(ExitCode::Simulation, {.where = "cycle " + std::to_string(host.cycle()),
                                           .what = "no complete frame was output",
                                           .expected = {},
                                           .got = {},
                                           .fix = {}});
  host.write(kRegIrq.address, irq);

  const auto counter = [&](int number) {
    const auto address = kRegCounters.address + 8 * static_cast<std::uint32_t>(number);
    const std::uint64_t low = host.read(address);  // keeps the high word
    return low | std::uint64_t{host.read(address + 4)} << 32;
  };
  int number = 0, wrong = 0;
  model.counters().for_each([&](const char* name, std::uint64_t value, const char*) {
    const std::uint64_t got = counter(number++);
    if (got != value) ++wrong, say("counter {}: {}, the model has {}", name, got, value);
  });
  say("counters: {} read, {} differ from the model; {} busy cycles of {}", number, wrong, counter(number),
      host.cycle() - from);

  const Frame picture = shown.take(), truth = expected.take();
  std::size_t different = 0;
  for (std::size_t i = 0; i < truth.words.size(); ++i) different += picture.words[i] != truth.words[i] ? 1 : 0;
  images::write_image(words.picture, driver::to_image(picture), {{"engine", "rtl"}, {"config", config.name}},
                      {.display = words.picture.extension() == ".png"});
  say("picture: {} words, {} differ from the model: {}", truth.words.size(), different, words.picture.string());
  return different == 0 && wrong == 0 && tiles.complete() ? 0 : 1;
}

}  // namespace
}  // namespace fastsplat::examples

int main(int argc, char** argv) {
  try {
    return fastsplat::examples::run({argv, static_cast<std::size_t>(argc)});
  } catch (const fastsplat::UserError& error) {
    std::fprintf(stderr, "error: %s\n", error.what());
    return static_cast<int>(error.code());
  }
}
