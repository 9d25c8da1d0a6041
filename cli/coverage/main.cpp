// SPDX-License-Identifier: Apache-2.0
// fastsplat_coverage: runs the campaigns, closes docs/verification_plan.toml, writes closure.md, closure.json
// and closure.html.
//   fastsplat_coverage --tests              prints the plan's tests as a regular expression for ctest
//   fastsplat_coverage FOLDER [RESULTS.xml] [COVERAGE.json ...]
#include <algorithm>
#include <cstdio>
#include <exception>
#include <memory>
#include <mutex>

#include "analysis/provenance.hpp"
#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/shell_word.hpp"
#include "base/version.hpp"
#include "cli/output.hpp"
#include "driver/config/config_file.hpp"
#include "driver/tiles/compile.hpp"
#include "report/report.hpp"
#include "scene/scene.hpp"
#include "testbench/closure/closure_lcov.hpp"
#include "testbench/closure/closure_report.hpp"
#include "testbench/closure/coverage_campaigns.hpp"
#include "testbench/device/covered_registry.hpp"

namespace fastsplat::cli {
namespace {

namespace tb = testbench;

const std::filesystem::path kSource = FASTSPLAT_SOURCE_DIR;

/// The runs of each configuration; smaller ones are faster and run more. Scenes fit the product configurations only.
struct Run {
  const char* config;
  tb::CoverageVolume volume;
  bool scenes;
};
constexpr Run kRuns[] = {{"tiny", {.splats = 36000, .seeds = 18, .resets = 480}, true},
                         {"mustfail", {.splats = 36000, .seeds = 18, .resets = 480}, false},
                         {"westover", {.splats = 36000, .seeds = 18, .resets = 480}, false},
                         {"cull", {.splats = 36000, .seeds = 18, .resets = 480}, false},
                         {"post", {.splats = 36000, .seeds = 18, .resets = 480}, false},
                         {"small", {.splats = 36000, .seeds = 18, .resets = 480}, true},
                         {"base", {.splats = 7200, .seeds = 24, .resets = 180}, true}};

cmodel::Config load(const std::string& name) {
  const auto own = kSource / "configs" / "faults" / (name + ".toml");
  return driver::load_config(std::filesystem::exists(own) ? own.string() : name);
}

struct Frame {
  const char* name;
  scene::Method method;
  scene::SlabOpacity opacity;
};
constexpr Frame kFrames[] = {
    {"image-aligned, exponential", scene::Method::ImageAligned, scene::SlabOpacity::Exponential},
    {"axis-aligned, additive", scene::Method::AxisAligned, scene::SlabOpacity::Additive},
    {"X-ray", scene::Method::XRay, scene::SlabOpacity::Exponential},
};

std::vector<std::pair<std::string, cmodel::BeatSource>> scenes(const cmodel::Config& config) {
  std::vector<std::pair<std::string, cmodel::BeatSource>> out;
  for (const Frame& frame : kFrames) {
    scene::SceneDescription description;
    description.volume = "shells:24";
    description.width = 72;  // wider than a tile of the small configurations and not a multiple of one
    description.height = 40;
    description.method = frame.method;
    description.slab_opacity = frame.opacity;
    const auto compiled = std::make_shared<const driver::CompiledFrame>(scene::build_scene(description), config);
    out.emplace_back(frame.name, [compiled](const cmodel::BeatSink& sink) { compiled->emit(sink); });
  }
  return out;
}

/// Makes a configuration's device with line coverage, if the build has one.
class Covered {
 public:
  explicit Covered(const cmodel::Config& config) {
    for (const tb::CoveredEntry& entry : tb::covered_registry()) {
      if (config.name != entry.config) continue;
      device_ = [this, config, make = entry.make](cmodel::PixelSink& pixels, const tb::RtlOptions& options) {
        return make(config, pixels, options, [this](const std::string& dat) {
          const std::lock_guard lock(mutex_);
          lines_.add(dat);
        });
      };
    }
  }
  const tb::MakeDevice& device() const { return device_; }  ///< empty: no line coverage
  const tb::LineCoverage& lines() const { return lines_; }

  /// The cover points as bins.
  tb::Coverage cover_points() const {
    tb::Coverage out;
    for (const auto& [name, hits] : lines_.cover_points()) out.hit(out.declare("cover", name), hits);
    return out;
  }

 private:
  std::mutex mutex_;
  tb::LineCoverage lines_;
  tb::MakeDevice device_;
};

tb::ClosureInput run_one(const Run& run, tb::LineCoverage& lines, std::vector<std::string>& failures) {
  const auto config = load(run.config);
  Covered covered(config);
  tb::CoverageOrder order{
      .config = config,
      .volume = run.volume,
      .scenes = run.scenes ? scenes(config) : decltype(scenes(config)){},
      .device = covered.device(),
      .progress = [](const std::string& what) { std::fprintf(stderr, "coverage: %s\n", what.c_str()); }};
  auto runs = tb::run_coverage(order);
  for (const auto& failure : runs.failures) failures.push_back(config.name + ": " + failure);
  tb::ClosureInput input{std::move(runs.book), tb::planned_bins(config)};
  if (covered.device()) {
    const auto points = covered.cover_points();
    input.planned.merge(points);
    input.book.campaigns[tb::kCoverPoints] = points;
    lines.merge(covered.lines());
  }
  return input;
}

std::map<std::string, bool> tests_of(const std::string& path, std::vector<std::string>& failures) {
  auto results = tb::read_test_results(path);
  if (results.empty()) failures.push_back("no test of the plan was run: " + path + " lists none");
  return results;
}

/// Reads a coverage file. Reports files of other or changed configurations before minutes of campaigns instead of
/// ignoring them.
tb::CoverageBook book_of(const std::string& path) {
  auto book = tb::read_book(path);
  std::string names;
  for (const Run& one : kRuns) {
    const auto config = load(one.config);
    if (book.config == config.name) return tb::read_book_for(path, config.name, cmodel::config_hash(config));
    names += (names.empty() ? "" : ", ") + config.name;
  }
  throw_input({.where = path,
               .what = "holds coverage of a configuration outside this closure",
               .expected = "one of " + names,
               .got = book.config,
               .fix = "leave the file out, or open it with `fastsplat report`"});
}

/// The page that `fastsplat report` makes.
std::string page_of(const std::filesystem::path& result) {
  report::Request request;
  request.results.push_back(report::read_result(result));
  return report::make_report(request).html;
}

ExitCode run(const std::vector<std::string>& arguments) {
  const auto plan = tb::read_plan(kSource / "docs" / "verification_plan.toml");
  if (arguments == std::vector<std::string>{"--tests"}) {
    std::puts(tb::tests_expression(plan).c_str());
    return ExitCode::Pass;
  }
  if (arguments.empty()) {
    throw_usage({.where = "fastsplat_coverage",
                 .what = "the output folder is missing",
                 .expected = "a folder",
                 .got = {},
                 .fix = "run tools/coverage, which names it"});
  }
  const std::filesystem::path folder = arguments[0];
  tb::ClosureReport report{.version = program_version(),
                           .command = "tools/coverage",
                           .plan = plan,
                           .inputs = {},
                           .closure = {},
                           .lines = {},
                           .failures = {}};
  std::map<std::string, bool> results;
  std::vector<tb::CoverageBook> more;
  for (std::size_t i = 1; i < arguments.size(); ++i) {
    if (arguments[i].ends_with(".xml")) {
      results = tests_of(arguments[i], report.failures);
    } else {
      more.push_back(book_of(arguments[i]));
      report.command += " " + shell_word(arguments[i]);
    }
  }
  tb::LineCoverage lines;
  for (const Run& one : kRuns) {
    tb::ClosureInput input = run_one(one, lines, report.failures);
    for (const auto& book : more) {
      if (book.config == input.book.config) input.book.merge(book);
    }
    tb::write_book(folder / (input.book.config + ".json"), input.book);
    for (auto& finding : tb::classes_without_streams(input.book)) report.failures.push_back(std::move(finding));
    report.inputs.push_back(std::move(input));
  }
  report.closure = tb::close_coverage(plan, report.inputs, results);
  report.lines =
      tb::close_lines(lines, kSource / "rtl", tb::read_exclusions(kSource / "docs" / "coverage_exclusions.toml"));
  write_text_file(folder / "closure.md", tb::closure_markdown(report));
  write_text_file(folder / "closure.json", tb::closure_json(report));
  write_text_file(folder / "closure.html", page_of(folder / "closure.json"));
  write_text_file(folder / "closure.info", tb::closure_info(report, kSource));
  std::filesystem::create_directories(folder / "coverview");
  for (const auto& [name, text] : tb::coverview_files(report, kSource))
    write_text_file(folder / "coverview" / name, text);
  for (const auto* list : {&report.failures, &report.closure.findings, &report.lines.findings}) {
    for (const auto& line : *list) std::printf("open: %s\n", line.c_str());
  }
  const auto excused = std::count_if(report.lines.unreached.begin(), report.lines.unreached.end(),
                                     [](const auto& finding) { return !finding.reason.empty(); });
  const auto passed = std::count_if(report.closure.tests.begin(), report.closure.tests.end(),
                                    [](const auto& test) { return test.outcome == tb::TestOutcome::Passed; });
  std::printf(
      "%s: %zu of %zu bins hit; %zu of %zu lines and branches reached, %td excused; %td of %zu tests of the plan "
      "passed (`./run test` runs the slow ones)\n%s\n",
      report.closed() ? "closed" : "open", report.closure.hit, report.closure.bins,
      report.lines.points.size() - report.lines.unreached.size(), report.lines.points.size(), excused, passed,
      report.closure.tests.size(), (folder / "closure.html").c_str());
  return report.closed() ? ExitCode::Pass : ExitCode::Failed;
}

}  // namespace
}  // namespace fastsplat::cli

int main(int argc, char** argv) {
  using namespace fastsplat;
  try {
    return static_cast<int>(cli::run({argv + 1, argv + argc}));
  } catch (const UserError& error) {
    cli::print_error(error.what());
    return static_cast<int>(error.code());
  } catch (const std::exception& error) {
    cli::print_error(std::string("internal: ") + error.what());
    return static_cast<int>(ExitCode::Internal);
  }
}
