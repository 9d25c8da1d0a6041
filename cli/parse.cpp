// The command line, declared with CLI11. What CLI11 would report in many lines is checked before it sees the words.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <span>

#include "analysis/provenance.hpp"
#include "base/error.hpp"
#include "base/number_text.hpp"
#include "base/suggest.hpp"
#include "base/version.hpp"
#include "cli/arguments.hpp"
#include "scene/sequence.hpp"
#include "scene/settings.hpp"

namespace fastsplat::cli {
namespace {

// --- values ---------------------------------------------------------------------------------------------------------

CLI::Validator number() {
  return {[](std::string& text) {
            return number_from(text) ? std::string{} : "expected a finite number, got '" + text + "'";
          },
          ""};
}

CLI::Validator integer(long low, long high) {
  return {[low, high](std::string& text) -> std::string {
            const auto value = integer_from<long>(text);
            if (value && *value >= low && *value <= high) return {};
            return fmt::format("expected an integer from {} to {}, got '{}'", low, high, text);
          },
          ""};
}

CLI::Validator one_of(std::vector<std::string> names) {
  return {[names](std::string& text) -> std::string {
            if (std::find(names.begin(), names.end(), text) != names.end()) return {};
            return fmt::format("expected {}, got '{}'", fmt::join(names, " or "), text);
          },
          ""};
}

// --- options shared by verbs ----------------------------------------------------------------------------------------

void add_common(CLI::App& verb, Common& to) {
  verb.add_option("--json", to.json, "the result as JSON, to FILE or - for stdout (then stdout holds nothing else)")
      ->type_name("FILE|-")
      ->group("Everywhere");
  verb.add_flag("--quiet", to.quiet, "errors only")->group("Everywhere");
  verb.add_option("--threads", to.threads, "threads; 0 all cores; never changes a result")
      ->check(integer(0, 1024))
      ->type_name("N")
      ->group("Everywhere");
}

void add_scene(CLI::App& verb, SceneFlags& to) {
  const auto word = [&verb](const char* flag, std::optional<std::string>& value, const char* help, const char* group,
                            const char* unit) { verb.add_option(flag, value, help)->type_name(unit)->group(group); };
  word("--scene", to.file, "a scene.toml or a built-in demo:NAME (`doctor` lists them); the flags below override it",
       "Scene", "FILE|demo:NAME");
  word("--volume", to.volume, "NRRD or NIfTI file, a built-in like shells:128, or ch2, ch2bet, inia19-t1-brain",
       "Scene", "NAME|PATH");
  word("--tf", to.transfer_function, "transfer function: a preset or a TOML file", "Scene", "NAME|FILE");
  word("--kernel", to.kernel, "kernel by name: gauss2 (a=2,R=2), smooth (a=1.35,R=2)", "Scene", "NAME");
  word("--size", to.size, "image size: N (square) or WxH", "Camera", "N|WxH");
  verb.add_flag("--perspective", to.perspective, "perspective projection")->group("Camera");
  verb.add_flag("--orthographic", to.orthographic, "orthographic projection (default)")->group("Camera");

  for (const scene::Setting& setting : scene::settings()) {
    if (*setting.flag == '\0') continue;
    verb.add_option_function<std::string>(
            setting.flag, [&to, &setting](const std::string& text) { to.settings[setting.flag] = text; }, setting.help)
        ->check(CLI::Validator([&setting](std::string& text) { return scene::problem_with(setting, text); }, ""))
        ->type_name(setting.unit)
        ->group(setting.group);
  }
}

void add_outputs(CLI::App& verb, std::vector<std::string>& out, std::string& raw) {
  verb.add_option("-o,--out", out, "image: .exr (float, linear), .tif (16 bit, linear), .png (8 bit, sRGB); repeatable")
      ->allow_extra_args(false)
      ->type_name("FILE")
      ->group("Output");
  verb.add_option("--raw", raw, "the device's raw integer words as .exr (cmodel, rtl)")
      ->type_name("FILE")
      ->group("Output");
}

// --- the verbs ------------------------------------------------------------------------------------------------------

const char* const kDescription =
    "fastsplat: volume splatting hardware, as an integer device model and a floating-point golden renderer";
const char* const kFooter =
    "Exit codes: 0 pass, 1 failed, 2 usage, 3 input or output, 4 not comparable, 5 simulation, 70 internal, 130 "
    "interrupted.\n"
    "`fastsplat help VERB` (or VERB --help) tells the rest; docs/guide.md is the guide.";

struct CommandLine {
  CLI::App app{kDescription, "fastsplat"};
  RenderArguments render;
  CompareArguments compare;
  VolumeInfoArguments volume_info;
  VolumeConvertArguments volume_convert;
  StreamRecordArguments stream_record;
  StreamDumpArguments stream_dump;
  StreamReplayArguments stream_replay;
  CyclesArguments cycles;
  ConfigListArguments config_list;
  ConfigShowArguments config_show;
  ConfigCheckArguments config_check;
  DoctorArguments doctor;
  VerifyArguments verify;
  std::map<const CLI::App*, Command (*)(const CommandLine&)> leaf;

  CommandLine() {
    app.footer(kFooter);
    app.set_help_flag("-h,--help", "what you are reading");
    app.set_version_flag("--version", program_version(), "the version of the program");
    declare_render();
    declare_compare();
    declare_volume();
    declare_stream();
    declare_cycles();
    declare_config();
    declare_verify();
    CLI::App* verb = app.add_subcommand("doctor", "versions, processors, scans; what is missing and how to get it");
    add_common(*verb, doctor.common);
    leaf[verb] = [](const CommandLine& all) -> Command { return all.doctor; };
    app.add_subcommand("help", "help on a verb")->add_option("verb", "a verb");
  }

  void declare_render() {
    CLI::App* verb = app.add_subcommand("render", "volume + transfer function + camera to an image");
    add_scene(*verb, render.scene);
    verb->add_option("--engine", render.engine,
                     "golden (floating point), cmodel (the integer device) or rtl (its Verilated RTL)")
        ->type_name("golden|cmodel|rtl")
        ->group("Engine");
    verb->add_option("--config", render.config,
                     "cmodel, rtl: hardware configuration, a name or a TOML file (default base)")
        ->type_name("NAME|FILE")
        ->group("Engine");
    verb->add_option("--index", render.index, "cmodel, rtl: index generator (rlut)")
        ->check(one_of({"rlut"}))
        ->type_name("NAME")
        ->group("Engine");
    verb->add_flag("--check", render.check, "rtl: compares every tap, pixel and counter with the model (exit 1)")
        ->group("Engine");
    verb->add_option("--orbit", render.orbit, "azimuth from A to B degrees, both included; 0..360 is a whole turn")
        ->type_name("A..B")
        ->group("Animation");
    verb->add_flag("--sequence", render.sequence, "what the scene's [sequence] says")->group("Animation");
    verb->add_option("--frames", render.frames, "frames; the # in --out become their numbers, from 0")
        ->check(integer(1, scene::kMaxFrames))
        ->type_name("N")
        ->group("Animation");
    verb->add_option("--video", render.video, "the PNG frames as a video, .mp4, .mkv or .webm (needs ffmpeg)")
        ->type_name("FILE")
        ->group("Animation");
    verb->add_option("--rate", render.rate, "the video's frames a second (24)")
        ->check(number())
        ->type_name("NUMBER")
        ->group("Animation");
    add_outputs(*verb, render.out, render.raw);
    verb->add_option("--save-scene", render.save_scene, "writes the scene, flags applied, as TOML")
        ->type_name("FILE")
        ->group("Output");
    add_common(*verb, render.common);
    verb->footer("Example: fastsplat render --volume shells:64 --size 256 --engine cmodel --config base -o shells.png");
    leaf[verb] = [](const CommandLine& all) -> Command { return all.render; };
  }

  void declare_verify() {
    CLI::App* verb = app.add_subcommand("verify", "the RTL beside the model: every tap, pixel and counter compared");
    verb->add_option("--stream", verify.stream, "a recorded stream, .fss")->type_name("FILE")->group("Stimulus");
    verb->add_option("--random", verify.random, "random streams of about N splats per seed")
        ->check(integer(1, 1'000'000'000))
        ->type_name("N")
        ->group("Stimulus");
    verb->add_option("--class", verify.stimulus, "random: stimulus class (all; an unknown one lists them)")
        ->type_name("NAME")
        ->group("Stimulus");
    verb->add_option("--seed", verify.seed, "of random streams, patterns and reset fill")
        ->check(integer(0, std::numeric_limits<long>::max()))
        ->type_name("S")
        ->group("Stimulus");
    verb->add_option("--seeds", verify.seeds, "random: runs with seeds S, S+1, ...")
        ->check(integer(1, 1'000'000))
        ->type_name("N")
        ->group("Stimulus");
    verb->add_option("--config", verify.config, "hardware configuration with RTL")
        ->type_name("NAME|FILE")
        ->group("Device");
    verb->add_option(
            "--ready", verify.ready,
            "when pixels are taken: always, every-N, never-N, random-PERCENT, burst-N; random: all takes turns")
        ->type_name("PATTERN")
        ->group("Device");
    verb->add_option("--input", verify.input, "when beats are offered, a pattern as above")
        ->type_name("PATTERN")
        ->group("Device");
    verb->add_option("--fill", verify.fill, "what registers and memories hold before reset")
        ->check(one_of({"zero", "one", "random"}))
        ->type_name("zero|one|random")
        ->group("Device");
    verb->add_option("--reset-after", verify.reset_after, "warm reset after N beats, then the whole stream")
        ->check(integer(1, 2'000'000'000))
        ->type_name("N")
        ->group("Device");
    verb->add_option("--coverage", verify.coverage, "functional coverage as JSON, added to what FILE holds")
        ->type_name("FILE")
        ->group("Output");
    verb->add_option("--failure", verify.failure, "a failure's small stream and waveform: PREFIX.fss and PREFIX.fst")
        ->type_name("PREFIX")
        ->group("Output");
    add_scene(*verb, verify.scene);
    add_common(*verb, verify.common);
    verb->footer("Example: fastsplat verify --random 1000 --seed 7 --config tiny --ready random-50");
    leaf[verb] = [](const CommandLine& all) -> Command { return all.verify; };
  }

  void declare_compare() {
    CLI::App* verb = app.add_subcommand("compare", "two images: metrics in LSB and dB, maps, limits");
    verb->add_option("REF", compare.ref, "the reference image")->required();
    verb->add_option("TEST", compare.test, "the image under test")->required();
    verb->add_option("--lsb-bits", compare.lsb_bits, "one LSB is 1/(2^N - 1)")
        ->check(integer(1, 24))
        ->type_name("N")
        ->group("Measure");
    verb->add_option("--peak", compare.peak, "PSNR's peak value")
        ->check(number())
        ->type_name("NUMBER")
        ->group("Measure");
    verb->add_option("--clusters", compare.clusters, "worst clusters listed")
        ->check(integer(0, 1000))
        ->type_name("N")
        ->group("Measure");
    const auto limit = [verb](const char* flag, std::optional<double>& value, const char* help, const char* unit) {
      verb->add_option(flag, value, help)->check(number())->type_name(unit)->group("Limits (exit 1 when one fails)");
    };
    limit("--min-psnr", compare.min_psnr, "least PSNR", "DB");
    limit("--max-lsb", compare.max_lsb, "greatest |error|", "LSB");
    limit("--max-mean-lsb", compare.max_mean_lsb, "mean |error|", "LSB");
    limit("--max-rmse-lsb", compare.max_rmse_lsb, "root mean square error", "LSB");
    limit("--max-bias-lsb", compare.max_bias_lsb, "|mean error|", "LSB");
    limit("--max-p99-lsb", compare.max_p99_lsb, "99th percentile of |error|", "LSB");
    limit("--min-ssim", compare.min_ssim, "least structural similarity", "0..1");
    verb->add_flag("--allow-nonfinite", compare.allow_nonfinite, "NaN and infinity are counted but do not fail")
        ->group("Limits (exit 1 when one fails)");
    verb->add_option("--map", compare.map, "signed error map in LSB with legend, .png")
        ->type_name("FILE")
        ->group("Output");
    verb->add_option("--heat", compare.heat, "|error| heat map with legend, .png")->type_name("FILE")->group("Output");
    add_common(*verb, compare.common);
    verb->footer("Example: fastsplat compare golden.exr cmodel.exr --min-psnr 48 --max-lsb 3 --map map.png");
    leaf[verb] = [](const CommandLine& all) -> Command { return all.compare; };
  }

  void declare_volume() {
    CLI::App* group = app.add_subcommand("volume", "info and convert: NRRD, NIfTI, built-in volumes");
    CLI::App* info = group->add_subcommand("info", "size, spacing, type, range");
    info->add_option("VOLUME", volume_info.volume, "a file or a name")->required();
    add_common(*info, volume_info.common);
    leaf[info] = [](const CommandLine& all) -> Command { return all.volume_info; };

    CLI::App* convert = group->add_subcommand("convert", "to .nrrd, .nhdr, .nii or .nii.gz");
    convert->add_option("VOLUME", volume_convert.volume, "a file or a name")->required();
    convert->add_option("OUT", volume_convert.out, "the file to write")->required();
    convert->add_option("--type", volume_convert.type, "voxel type; default as stored")
        ->check(one_of({"u8", "i8", "u16", "i16", "f32"}))
        ->type_name("u8|i8|u16|i16|f32")
        ->group("Output");
    add_common(*convert, volume_convert.common);
    leaf[convert] = [](const CommandLine& all) -> Command { return all.volume_convert; };
  }

  void declare_stream() {
    CLI::App* group = app.add_subcommand("stream", "record, dump and replay what the device is fed (.fss)");
    CLI::App* record = group->add_subcommand("record", "compiles a scene into a stream file");
    add_scene(*record, stream_record.scene);
    record->add_option("--config", stream_record.config, "hardware configuration, a name or a TOML file")
        ->type_name("NAME|FILE")
        ->group("Engine");
    record->add_option("-o,--out", stream_record.out, "the stream file, .fss")
        ->required()
        ->type_name("FILE")
        ->group("Output");
    add_common(*record, stream_record.common);
    leaf[record] = [](const CommandLine& all) -> Command { return all.stream_record; };

    CLI::App* dump = group->add_subcommand("dump", "one line of text per record");
    dump->add_option("STREAM", stream_dump.stream, "a stream file")->required();
    dump->add_option("--limit", stream_dump.limit, "stops after N records")
        ->check(integer(0, 2'000'000'000))
        ->type_name("N")
        ->group("Output");
    add_common(*dump, stream_dump.common);
    leaf[dump] = [](const CommandLine& all) -> Command { return all.stream_dump; };

    CLI::App* replay = group->add_subcommand("replay", "feeds a stream to the integer device");
    replay->add_option("STREAM", stream_replay.stream, "a stream file")->required();
    replay->add_option("--config", stream_replay.config, "the configuration it was recorded for")
        ->type_name("NAME|FILE")
        ->group("Engine");
    add_outputs(*replay, stream_replay.out, stream_replay.raw);
    add_common(*replay, stream_replay.common);
    leaf[replay] = [](const CommandLine& all) -> Command { return all.stream_replay; };
  }

  void declare_cycles() {
    CLI::App* verb = app.add_subcommand("cycles", "clock cycles of a scene or stream on the device, and where they go");
    add_scene(*verb, cycles.scene);
    verb->add_option("--stream", cycles.stream, "a recorded stream instead of a scene")
        ->type_name("FILE")
        ->group("Scene");
    verb->add_option("--config", cycles.config, "hardware configuration, a name or a TOML file")
        ->type_name("NAME|FILE")
        ->group("Engine");
    const auto pattern = [verb](const char* flag, std::string& value, const char* help) {
      verb->add_option(flag, value, help)->type_name("PATTERN")->group("Engine");
    };
    pattern("--input", cycles.input, "when the source has a beat: always, every-N, never-N, random-PERCENT, burst-N");
    pattern("--ready", cycles.ready, "when the sink takes pixels: as --input");
    verb->add_option("--seed", cycles.seed, "of the patterns")
        ->check(integer(0, 2'000'000'000))
        ->type_name("N")
        ->group("Engine");
    verb->add_option("--trace", cycles.trace, "a timeline as JSON that ui.perfetto.dev opens; 1 us stands for a cycle")
        ->type_name("FILE")
        ->group("Output");
    add_common(*verb, cycles.common);
    verb->footer("Example: fastsplat cycles --volume shells:64 --size 256 --config base --trace shells.json");
    leaf[verb] = [](const CommandLine& all) -> Command { return all.cycles; };
  }

  void declare_config() {
    CLI::App* group = app.add_subcommand("config", "list, show and check hardware configurations");
    CLI::App* list = group->add_subcommand("list", "the built-in ones");
    add_common(*list, config_list.common);
    leaf[list] = [](const CommandLine& all) -> Command { return all.config_list; };

    CLI::App* show = group->add_subcommand("show", "every key of one, as TOML that --config takes");
    show->add_option("CONFIG", config_show.config, "a name or a TOML file")->required();
    add_common(*show, config_show.common);
    leaf[show] = [](const CommandLine& all) -> Command { return all.config_show; };

    CLI::App* check = group->add_subcommand("check", "every key there, known and within its limits?");
    check->add_option("FILE", config_check.file, "a TOML file (or a name)")->required();
    add_common(*check, config_check.common);
    leaf[check] = [](const CommandLine& all) -> Command { return all.config_check; };
  }
};

// --- finding the verb, checking the words
// -----------------------------------------------------------------------------

std::string called(const CLI::App& verb) {
  std::string name = verb.get_name();
  for (const CLI::App* app = verb.get_parent(); app != nullptr; app = app->get_parent())
    name = app->get_name() + " " + name;
  return name;
}

std::vector<std::string> subcommand_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* sub : app.get_subcommands([](const CLI::App*) { return true; }))
    names.push_back(sub->get_name());
  return names;
}

std::vector<std::string> flag_names(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const auto& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

[[noreturn]] void misused(const CLI::App& verb, const std::string& what, std::string fix = {}) {
  if (fix.empty()) fix = "`" + called(verb) + " --help` lists what there is";
  throw_usage({.where = {}, .what = what, .expected = {}, .got = {}, .fix = std::move(fix)});
}

// Descends words of verbs from `app`; `at` ends on the first word that is none.
CLI::App* find_verb(CLI::App& app, const std::vector<std::string>& words, std::size_t& at) {
  CLI::App* verb = &app;
  while (at < words.size()) {
    const auto names = subcommand_names(*verb);
    if (names.empty() || words[at].starts_with('-')) break;
    if (std::find(names.begin(), names.end(), words[at]) == names.end()) {
      misused(*verb, fmt::format("unknown {} '{}'", verb == &app ? "verb" : verb->get_name() + " verb", words[at]),
              suggestion(words[at], names));
    }
    verb = verb->get_subcommand(words[at++]);
  }
  return verb;
}

// The one flag that may have been meant; nothing rather than a list of thirty.
std::string near_flag(const CLI::App& verb, const std::string& flag) {
  const auto hint = flag.starts_with("--") ? suggestion(flag, flag_names(verb)) : std::string{};
  return hint.starts_with("did you mean") ? hint : std::string{};
}

// Unknown flags, flags without their value and flags given twice, in the user's order.
void check_words(const CLI::App& verb, std::span<const std::string> words) {
  std::map<const CLI::Option*, int> seen;
  for (std::size_t at = 0; at < words.size(); ++at) {
    const std::string& word = words[at];
    if (word == "--") return;
    const bool is_long = word.starts_with("--");
    const bool is_short =
        !is_long && word.size() >= 2 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1]));
    if (!is_long && !is_short) continue;
    const auto equals = word.find('=');
    const std::string flag = is_long ? word.substr(0, equals) : word.substr(0, 2);
    const CLI::Option* option = verb.get_option_no_throw(flag);
    if (option == nullptr)
      misused(verb, fmt::format("unknown flag {} of `{}`", flag, called(verb)), near_flag(verb, flag));
    const bool repeatable = option->get_items_expected_max() > 1;
    if (++seen[option] > 1 && !repeatable) misused(verb, flag + " is given twice", "give it once");
    if (option->get_items_expected_max() == 0) {
      if (is_long && equals != std::string::npos) misused(verb, flag + " takes no value", "write just " + flag);
      continue;
    }
    if (is_long ? equals != std::string::npos : word.size() > 2) {
      if (is_long && equals + 1 == word.size())
        misused(verb, flag + " needs a value", "it is a " + option->get_type_name());
      continue;
    }
    ++at;
    const bool missing = at >= words.size() || words[at].empty() || words[at].starts_with("--");
    if (missing) misused(verb, flag + " needs a value", "expected " + option->get_type_name() + " after it");
  }
}

TextArguments help_of(CLI::App& app, CLI::App& verb) {
  return {verb.help(&verb == &app ? "" : called(*verb.get_parent()))};
}

}  // namespace

Command parse(int argc, const char* const* argv) {
  CommandLine line;
  const std::vector<std::string> words(argv + std::min(argc, 1), argv + argc);
  std::size_t at = 0;
  if (!words.empty() && words[0] == "help") {
    at = 1;
    CLI::App* verb = find_verb(line.app, words, at);
    if (at < words.size())
      misused(line.app, "unexpected '" + words[at] + "' after help", "`fastsplat help` lists the verbs");
    return help_of(line.app, *verb);
  }
  CLI::App* verb = find_verb(line.app, words, at);
  const std::span rest(words.begin() + static_cast<std::ptrdiff_t>(at), words.end());
  for (const auto& word : rest) {
    if (word == "--help" || word == "-h") return help_of(line.app, *verb);
    if (word == "--version" && verb == &line.app) return TextArguments{"fastsplat " + program_version() + "\n"};
  }
  check_words(*verb, rest);
  if (!line.leaf.contains(verb)) {
    misused(*verb, fmt::format("{}: which verb?", called(*verb)),
            fmt::format("one of {}; `{} --help` tells what they do", fmt::join(subcommand_names(*verb), ", "),
                        called(*verb)));
  }
  try {
    line.app.parse(argc, argv);
  } catch (const CLI::ExtrasError&) {
    const auto extra = line.app.remaining(true);
    misused(*verb, fmt::format("unexpected '{}' after `{}`", extra.empty() ? "?" : extra.front(), called(*verb)));
  } catch (const CLI::RequiredError& error) {
    misused(*verb, fmt::format("{}: {}", called(*verb), error.what()));
  } catch (const CLI::ParseError& error) {
    misused(*verb, error.what());
  }
  return line.leaf.at(verb)(line);
}

}  // namespace fastsplat::cli
