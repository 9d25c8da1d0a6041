// SPDX-License-Identifier: Apache-2.0
#include "tests/icarus/icarus_helper.hpp"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "cmodel/rtl_package/sv_package.hpp"
#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

namespace fs = std::filesystem;

/// As in icarus_bench.sv.
constexpr std::uint64_t kPatternCycles = 32768;
/// For a bench stuck in one moment of time; a running bench needs a tenth of it.
constexpr int kSeconds = 600;

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error("cannot read " + path.string());
  std::stringstream text;
  text << in.rdbuf();
  return text.str();
}

void shell(const std::string& command, const fs::path& log) {
  const int status = std::system((command + " >'" + log.string() + "' 2>&1").c_str());
  if (status != 0) throw std::runtime_error(command + "\n" + text_of(log));
}

std::size_t replace_all(std::string& text, const std::string& from, const std::string& to) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size(), ++count)
    text.replace(at, from.size(), to);
  return count;
}

Transcript read_transcript(const fs::path& path) {
  Transcript out;
  std::ifstream in(path);
  int last = -1;
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    std::string kind;
    int play = 0;
    words >> kind;
    if (kind == "power") {
      out.power_up = line.substr(line.find(' ') + 1);
    } else if (kind == "pixels") {
      PixelBeat beat;
      words >> play >> beat.last >> beat.keep >> beat.data;
      out.plays[play].pixels.push_back(beat);
    } else if (kind == "counter") {
      std::string number, high, low;
      words >> play >> number >> high >> low;
      const bool known = (high + low).find_first_not_of("0123456789abcdef") == std::string::npos;
      if (!known) out.wrong.push_back(line);
      out.plays[play].counters.push_back(known ? std::stoull(high + low, nullptr, 16) : 0);
    } else if (kind == "played") {
      words >> play;
      words >> out.plays[play].cycles;
      last = play;
    } else if (!line.empty()) {
      out.wrong.push_back(line);
    }
  }
  out.ended = last >= 0 && static_cast<std::size_t>(last) + 1 == out.plays.size();
  return out;
}

}  // namespace

std::string Icarus::missing() {
  for (const char* tool : {"iverilog -V", "vvp -V"}) {
    if (std::system((std::string(tool) + " >/dev/null 2>&1").c_str()) != 0)
      return "Icarus Verilog is not installed (package iverilog): the RTL is seen by one simulator only";
  }
  return {};
}

std::string Icarus::version() {
  const fs::path log = fs::path(FASTSPLAT_BINARY_DIR) / "icarus" / "version";
  fs::create_directories(log.parent_path());
  shell("iverilog -V", log);
  const std::string text = text_of(log);
  return text.substr(0, text.find(" ("));
}

Icarus::Icarus(const cmodel::Config& config, const std::string& name,
               const std::vector<std::pair<std::string, std::string>>& edits, Combinational combinational)
    : folder_(fs::path(FASTSPLAT_BINARY_DIR) / "icarus" / name) {
  fs::remove_all(folder_);
  fs::create_directories(folder_ / "rtl");
  const fs::path source(FASTSPLAT_SOURCE_DIR);
  std::vector<std::size_t> found(edits.size());
  for (const auto& entry : fs::recursive_directory_iterator(source / "rtl")) {
    if (!entry.is_regular_file()) continue;
    std::string text = text_of(entry.path());
    for (std::size_t i = 0; i < edits.size(); ++i) found[i] += replace_all(text, edits[i].first, edits[i].second);
    if (combinational == Combinational::AlwaysStar) replace_all(text, "always_comb", "always @*");
    std::ofstream(folder_ / "rtl" / entry.path().filename()) << text;
  }
  for (std::size_t i = 0; i < edits.size(); ++i) {
    if (found[i] != 1)
      throw std::runtime_error("'" + edits[i].first + "' stands " + std::to_string(found[i]) + " times in rtl/");
  }
  std::ofstream(folder_ / "fastsplat_pkg.sv") << cmodel::sv_package(config);
  const std::string at = "'" + folder_.string() + "'";
  shell("cd " + at + " && iverilog -g2012 -o bench.vvp -Irtl -s icarus_bench fastsplat_pkg.sv rtl/*.sv '" +
            (source / "testbench/module").string() + "'/*.sv '" + (source / "tests/icarus/icarus_bench.sv").string() +
            "'",
        folder_ / "iverilog.log");
}

Transcript Icarus::play(const Played& played) const {
  {
    std::ofstream beats(folder_ / "beats"), ready(folder_ / "ready"), plays(folder_ / "plays");
    beats << std::hex;
    for (const auto& beat : played.beats) {
      for (std::size_t word = beat.size(); word-- > 0;) {
        beats.width(8);
        beats.fill('0');
        beats << beat[word];
      }
      beats << "\n";
    }
    for (const auto& pattern : played.patterns)
      for (std::uint64_t cycle = 0; cycle < kPatternCycles; ++cycle) ready << (pattern.at(cycle) ? "1\n" : "0\n");
    for (const auto& play : played.plays)
      plays << play.reset << " " << play.beats << " " << play.linger << " " << play.input << " " << play.ready << "\n";
  }
  shell("cd '" + folder_.string() + "' && timeout -s KILL " + std::to_string(kSeconds) +
            " vvp -n bench.vvp +beats=beats +beat_count=" + std::to_string(played.beats.size()) +
            " +ready=ready +pattern_count=" + std::to_string(played.patterns.size()) + " +plays=plays",
        folder_ / "transcript");
  Transcript out = read_transcript(folder_ / "transcript");
  for (const auto& [play, result] : out.plays) {
    if (result.cycles > kPatternCycles) throw std::runtime_error("a play is longer than the bench's patterns");
  }
  out.ended = out.ended && out.plays.size() == played.plays.size();
  return out;
}

}  // namespace fastsplat::test
