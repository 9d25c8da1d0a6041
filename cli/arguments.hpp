// What the user asked for, as plain data: parse.cpp fills one of these, one file per verb carries it out.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace fastsplat::cli {

/// Options that every verb has.
struct Common {
  std::string json;    ///< --json: a file, `-` for stdout, empty for none
  bool quiet = false;  ///< --quiet: errors only
  int threads = 0;     ///< --threads: 0 all cores; never changes a result
};

/// A scene: a file, single flags, or a file overridden by flags. Absent ones leave the file's or the default value.
struct SceneFlags {
  std::optional<std::string> file, volume, transfer_function, kernel, size;
  bool perspective = false, orthographic = false;
  /// The flags made from scene::settings() ("--slab-width"), with their texts, which have no problem.
  std::map<std::string, std::string> settings;
  bool operator==(const SceneFlags&) const = default;
};

struct RenderArguments {
  Common common;
  SceneFlags scene;
  std::string engine = "golden", index = "rlut";
  std::optional<std::string> config;
  std::vector<std::string> out;
  std::string raw;         ///< raw device words as EXR; empty for none
  std::string save_scene;  ///< where to write the scene as TOML; empty for none
  bool check = false;      ///< rtl: compares every tap with the model
  // An animation; its names in `out` and `raw` hold a run of '#' for the frame's number.
  std::optional<std::string> orbit;  ///< "A..B", degrees
  bool sequence = false;             ///< as the scene's [sequence] says
  std::optional<int> frames;
  std::string video;   ///< empty for none
  double rate = 24.0;  ///< of the video, frames a second
};

struct VerifyArguments {
  Common common;
  SceneFlags scene;
  std::string stream;            ///< a .fss file; empty for none
  std::optional<int> random;     ///< splats per seed
  std::uint64_t seed = 1;        ///< of the first run
  int seeds = 1;                 ///< seed, seed+1, ...
  std::string stimulus = "all";  ///< stimulus class
  std::string config = "base", ready = "always", input = "always", fill = "random";
  std::optional<int> reset_after;  ///< beats before a warm reset
  std::string coverage;            ///< where functional coverage is added up; empty for none
  std::string failure;             ///< where a failure's stream and waveform go, without ending; empty: by source
};

struct CompareArguments {
  Common common;
  std::string ref, test, map, heat;
  int lsb_bits = 8;
  double peak = 1.0;
  int clusters = 5;
  std::optional<double> min_psnr, max_lsb, max_mean_lsb, max_rmse_lsb, max_bias_lsb, max_p99_lsb, min_ssim;
  bool allow_nonfinite = false;
};

struct VolumeInfoArguments {
  Common common;
  std::string volume;
};

struct VolumeConvertArguments {
  Common common;
  std::string volume, out;
  std::optional<std::string> type;
};

struct StreamRecordArguments {
  Common common;
  SceneFlags scene;
  std::string config = "base", out;
};

struct StreamDumpArguments {
  Common common;
  std::string stream;
  std::optional<int> limit;
};

struct StreamReplayArguments {
  Common common;
  std::string stream, config = "base", raw;
  std::vector<std::string> out;
};

struct CyclesArguments {
  Common common;
  SceneFlags scene;
  std::string stream;  ///< a recorded stream instead of a scene
  std::string config = "base", input = "always", ready = "always", trace;
  int seed = 1;
};

struct ConfigListArguments {
  Common common;
};

struct ConfigShowArguments {
  Common common;
  std::string config;
};

struct ConfigCheckArguments {
  Common common;
  std::string file;
};

struct DoctorArguments {
  Common common;
};

/// --help, --version, `help`: a text to print.
struct TextArguments {
  std::string text;
};

using Command =
    std::variant<TextArguments, RenderArguments, CompareArguments, VolumeInfoArguments, VolumeConvertArguments,
                 StreamRecordArguments, StreamDumpArguments, StreamReplayArguments, CyclesArguments,
                 ConfigListArguments, ConfigShowArguments, ConfigCheckArguments, DoctorArguments, VerifyArguments>;

/// The command line as one Command. Whatever makes no sense is a UserError (Usage) with the fix.
Command parse(int argc, const char* const* argv);

}  // namespace fastsplat::cli
