// SPDX-License-Identifier: Apache-2.0
// fastsplat compare: measures the difference of TEST from REF and checks limits.
#include "analysis/compare.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "base/images/encoding.hpp"
#include "base/images/image_file.hpp"
#include "base/version.hpp"
#include "cli/coverage_difference.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"

namespace fastsplat::cli {
namespace {

struct CompareArguments {
  Common common;
  std::string ref, test, map, heat;
  int lsb_bits = 8;
  double peak = 1.0;
  int clusters = 5;
  std::optional<double> min_psnr, max_lsb, max_mean_lsb, max_rmse_lsb, max_bias_lsb, max_p99_lsb, min_ssim;
  bool allow_nonfinite = false;
  bool srgb = false;  ///< both are display pictures of any program
};

using Json = nlohmann::ordered_json;

void check(const CompareArguments& arguments) {
  const auto at_least = [](const char* flag, const std::optional<double>& value, double least) {
    if (!value || *value >= least) return;
    throw_usage({.where = flag,
                 .what = "invalid limit",
                 .expected = fmt::format("{} or more", least),
                 .got = fmt::format("{}", *value),
                 .fix = "use a positive limit: limits apply to magnitudes"});
  };
  at_least("--max-lsb", arguments.max_lsb, 0.0);
  at_least("--max-mean-lsb", arguments.max_mean_lsb, 0.0);
  at_least("--max-rmse-lsb", arguments.max_rmse_lsb, 0.0);
  at_least("--max-bias-lsb", arguments.max_bias_lsb, 0.0);
  at_least("--max-p99-lsb", arguments.max_p99_lsb, 0.0);
  if (!(arguments.peak > 0.0)) {
    throw_usage({.where = "--peak",
                 .what = "invalid peak",
                 .expected = "more than 0",
                 .got = fmt::format("{}", arguments.peak),
                 .fix = "use 1 for linear images"});
  }
  check_outputs({.images = {},
                 .maps = {arguments.map, arguments.heat},
                 .raws = {},
                 .others = {arguments.common.json},
                 .inputs = {arguments.ref, arguments.test}});
}

analysis::CompareOptions options_from(const CompareArguments& arguments) {
  analysis::CompareOptions options;
  options.lsb_bits = arguments.lsb_bits;
  options.peak = arguments.peak;
  options.clusters = arguments.clusters;
  options.min_psnr_db = arguments.min_psnr;
  options.max_abs_lsb = arguments.max_lsb;
  options.max_mean_lsb = arguments.max_mean_lsb;
  options.max_rmse_lsb = arguments.max_rmse_lsb;
  options.max_bias_lsb = arguments.max_bias_lsb;
  options.max_p99_lsb = arguments.max_p99_lsb;
  options.min_ssim = arguments.min_ssim;
  options.allow_nonfinite = arguments.allow_nonfinite;
  options.threads = arguments.common.threads;
  return options;
}

[[noreturn]] void not_comparable(const std::string& where, const std::string& what, const std::string& fix) {
  throw UserError(ExitCode::NotComparable, {.where = where, .what = what, .expected = {}, .got = {}, .fix = fix});
}

/// The declared encoding, or the one assumed.
std::string described_encoding(const images::LoadedImage& loaded) {
  if (!loaded.encoding.empty()) return "declares the encoding " + loaded.encoding;
  return images::encoding_of(loaded) == images::kSrgb
             ? "declares no encoding and is read as a display picture (sRGB), as PNG and JPEG are"
             : "declares no encoding and is read as linear values";
}

bool is_of_display_depth(const images::LoadedImage& picture) {
  return picture.kind == images::PixelKind::Uint8 || picture.kind == images::PixelKind::Uint16;
}

/// Requires a display picture, as --srgb states; no file may declare otherwise.
void require_looks(const std::string& file, const images::LoadedImage& picture) {
  if (!is_of_display_depth(picture)) {
    not_comparable(file,
                   fmt::format("holds {} values, but --srgb requires display pictures of 8 or 16 bits",
                               images::to_string(picture.kind)),
                   "leave --srgb out, and compare linear values with linear values");
  }
  if (!picture.encoding.empty() && picture.encoding != images::kSrgb)
    not_comparable(file, described_encoding(picture) + ", which contradicts --srgb",
                   "leave --srgb out, and compare pictures of one encoding");
}

bool opaque(const Image& image) {
  for (std::size_t at = 3; at < image.data.size(); at += 4) {
    if (image.data[at] != 1.0f) return false;
  }
  return true;
}

/// Stored samples are compared, so they must mean the same in both pictures.
void check_comparable(const CompareArguments& arguments, const images::LoadedImage& ref,
                      const images::LoadedImage& test) {
  if (arguments.srgb) {
    require_looks(arguments.ref, ref);
    require_looks(arguments.test, test);
  } else if (images::encoding_of(ref) != images::encoding_of(test)) {
    const auto may_be_srgb = [](const auto& picture) {
      return is_of_display_depth(picture) && (picture.encoding.empty() || picture.encoding == images::kSrgb);
    };
    not_comparable(arguments.ref,
                   fmt::format("{}, {} {}", described_encoding(ref), arguments.test, described_encoding(test)),
                   std::string("render both to .exr or .tif and compare those") +
                       (may_be_srgb(ref) && may_be_srgb(test) ? ", or use --srgb if both are display pictures" : ""));
  }
  const bool both_have_alpha = ref.image.channels == 4 && test.image.channels == 4;
  if (both_have_alpha && ref.unassociated != test.unassociated && !(opaque(ref.image) && opaque(test.image))) {
    const auto said = [](const images::LoadedImage& picture) {
      return picture.unassociated ? "colours not multiplied by alpha" : "colours multiplied by alpha";
    };
    not_comparable(arguments.ref, fmt::format("holds {}, {} {}", said(ref), arguments.test, said(test)),
                   "convert one: oiiotool --premult or --unpremult");
  }
  if (ref.grey != test.grey) {
    const auto name = [](const images::LoadedImage& picture) { return picture.grey.empty() ? "Y" : picture.grey; };
    if (ref.image.channels == 1 && test.image.channels == 1) {
      not_comparable(arguments.ref,
                     fmt::format("holds channel {}, {} channel {}", name(ref), arguments.test, name(test)),
                     "if both mean the same, rename one: oiiotool --chnames Y");
    }
  }
}

/// Converts grey pictures, and pictures whose alpha is 1 everywhere, to three channels with the same colours.
void spell_out(images::LoadedImage& picture) {
  Image& image = picture.image;
  if (image.channels == 3 || (image.channels == 4 && !opaque(image))) return;
  Image rgb(image.width, image.height, 3);
  const auto from = static_cast<std::size_t>(image.channels);
  for (std::size_t pixel = 0; pixel * 3 < rgb.data.size(); ++pixel) {
    for (std::size_t c = 0; c < 3; ++c) rgb.data[pixel * 3 + c] = image.data[pixel * from + (from == 1 ? 0 : c)];
  }
  image = std::move(rgb);
}

bool all_black(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t at = 0; at < image.data.size(); ++at) {
    if ((channels < 4 || at % channels != 3) && image.data[at] != 0.0f) return false;
  }
  return true;
}

struct Origin {
  std::string file;
  images::PixelKind kind;
  images::Metadata metadata;
};

/// The measurement and the pictures' origins.
struct CompareResult {
  analysis::CompareReport report;
  Origin ref, test;
  std::string all_black;  ///< the file that is all black while the other is not; else empty
  bool hidden = false;    ///< the worst error is a colour where alpha is 0 in both
};

std::vector<Remark> remarks_of(const CompareResult& result) {
  std::vector<Remark> out;
  if (!result.all_black.empty()) {
    out.push_back({Remark::Warning, result.all_black + " is all black, the other is not: the figures are meaningless"});
  }
  if (result.hidden) {
    out.push_back({Remark::Warning,
                   "the worst error is an invisible colour: alpha is 0 in both pictures there; compare visible colours "
                   "after oiiotool --premult"});
  }
  return out;
}

bool is_hidden(const analysis::CompareReport& report, const Image& ref, const Image& test) {
  const auto& worst = report.worst;
  return report.values > 0 && report.channels == 4 && worst.channel < 3 && worst.error_lsb != 0.0 &&
         ref.pixel(worst.x, worst.y)[3] == 0.0f && test.pixel(worst.x, worst.y)[3] == 0.0f;
}

Json to_json(const Origin& origin) {
  Json metadata = Json::object();
  for (const auto& [key, value] : origin.metadata) metadata[key] = value;
  return {{"file", origin.file}, {"format", images::to_string(origin.kind)}, {"metadata", metadata}};
}

Json to_json(const CompareResult& result) {
  Json json{{"verb", "compare"}, {"version", program_version()}};
  json.update(Json::parse(analysis::to_json(result.report)));
  json["all_black"] = result.all_black.empty() ? Json(nullptr) : Json(result.all_black);
  json["worst_is_hidden"] = result.hidden;
  json["ref"] = to_json(result.ref);
  json["test"] = to_json(result.test);
  return json;
}

/// Two coverage files. Exit code 1 if a bin was lost.
ExitCode compare_coverage(const CompareArguments& arguments, const Output& output) {
  const CompareArguments unset;
  const std::pair<const char*, bool> of_pictures[] = {{"--lsb-bits", arguments.lsb_bits != unset.lsb_bits},
                                                      {"--peak", arguments.peak != unset.peak},
                                                      {"--srgb", arguments.srgb},
                                                      {"--clusters", arguments.clusters != unset.clusters},
                                                      {"--min-psnr", arguments.min_psnr.has_value()},
                                                      {"--max-lsb", arguments.max_lsb.has_value()},
                                                      {"--max-mean-lsb", arguments.max_mean_lsb.has_value()},
                                                      {"--max-rmse-lsb", arguments.max_rmse_lsb.has_value()},
                                                      {"--max-bias-lsb", arguments.max_bias_lsb.has_value()},
                                                      {"--max-p99-lsb", arguments.max_p99_lsb.has_value()},
                                                      {"--min-ssim", arguments.min_ssim.has_value()},
                                                      {"--allow-nonfinite", arguments.allow_nonfinite},
                                                      {"--map", !arguments.map.empty()},
                                                      {"--heat", !arguments.heat.empty()}};
  for (const auto& [flag, set] : of_pictures) {
    if (!set) continue;
    throw_usage({.where = flag,
                 .what = "means nothing for coverage files",
                 .expected = "images",
                 .got = arguments.ref,
                 .fix = "leave it out: a lost bin gives exit code 1 anyway"});
  }
  const CoverageDifference difference = coverage_difference(arguments.ref, arguments.test);
  output.line(to_text(difference));
  output.json(to_json(difference));
  return difference.lost.empty() ? ExitCode::Pass : ExitCode::Failed;
}

ExitCode run(const CompareArguments& arguments) {
  const Output output(arguments.common);
  check(arguments);
  if (is_coverage(arguments.ref) || is_coverage(arguments.test)) return compare_coverage(arguments, output);
  auto ref = images::read_image(arguments.ref);
  auto test = images::read_image(arguments.test);
  check_comparable(arguments, ref, test);
  const bool looks = arguments.srgb || images::encoding_of(ref) == images::kSrgb;
  if (ref.image.channels != test.image.channels && looks) {
    spell_out(ref);
    spell_out(test);
  }
  const bool black = all_black(ref.image);
  const auto options = options_from(arguments);
  CompareResult result{.report = analysis::compare(ref.image, test.image, options),
                       .ref = {arguments.ref, ref.kind, ref.metadata},
                       .test = {arguments.test, test.kind, test.metadata},
                       .all_black = black == all_black(test.image) ? ""
                                    : black                        ? arguments.ref
                                                                   : arguments.test};
  result.hidden = is_hidden(result.report, ref.image, test.image);

  if (!arguments.map.empty()) {
    images::write_image(arguments.map, analysis::lsb_map(ref.image, test.image, options), {{"display", "srgb"}},
                        {.display = true});
  }
  if (!arguments.heat.empty()) {
    images::write_image(arguments.heat, analysis::heat_map(ref.image, test.image, options), {{"display", "srgb"}},
                        {.display = true});
  }
  output.line(analysis::to_text(result.report));
  output.remark(remarks_of(result));
  output.json(to_json(result));
  return result.report.pass ? ExitCode::Pass : ExitCode::Failed;
}

void declare(Options& options, CompareArguments& to) {
  options.positional("REF", to.ref, "the reference image, or the older coverage file");
  options.positional("TEST", to.test, "the image under test, or the newer coverage file");
  options.group("Measure");
  options.integer("--lsb-bits", to.lsb_bits, 1, 24, "N", "one LSB is 1/(2^N - 1)");
  options.number("--peak", to.peak, "NUMBER", "peak value of the PSNR");
  options.flag("--srgb", to.srgb, "both are display pictures, whatever wrote them: compare displayed values");
  options.integer("--clusters", to.clusters, 0, 1000, "N", "number of worst clusters to list");
  options.group("Limits (exit 1 when one fails)");
  options.number("--min-psnr", to.min_psnr, "DB", "least PSNR");
  options.number("--max-lsb", to.max_lsb, "LSB", "greatest |error|");
  options.number("--max-mean-lsb", to.max_mean_lsb, "LSB", "mean |error|");
  options.number("--max-rmse-lsb", to.max_rmse_lsb, "LSB", "root mean square error");
  options.number("--max-bias-lsb", to.max_bias_lsb, "LSB", "|mean error|");
  options.number("--max-p99-lsb", to.max_p99_lsb, "LSB", "99th percentile of |error|");
  options.number("--min-ssim", to.min_ssim, "0..1", "least structural similarity");
  options.flag("--allow-nonfinite", to.allow_nonfinite, "count NaN and infinity without failing");
  options.group("Output");
  options.word("--map", to.map, "FILE", "write a signed error map in LSB with legend, .png");
  options.word("--heat", to.heat, "FILE", "write an |error| heat map with legend, .png");
  declare(options, to.common);
  options.example("fastsplat compare golden.exr model.exr --min-psnr 48 --max-lsb 3",
                  "the device's error against the reference; exit 1 beyond a limit");
  options.example("fastsplat compare golden.exr model.exr --map map.png --heat heat.png --json compare.json",
                  "where they differ, as pictures and as JSON");
  options.example("fastsplat compare yesterday.json today.json", "bins of coverage that only one of the runs hit");
}

}  // namespace

const Subcommand subcommands::compare{
    "compare", "compare two images, or two coverage files: metrics in LSB and dB, maps, limits; bins lost and gained",
    subcommand<CompareArguments, declare, run>};

}  // namespace fastsplat::cli
