// SPDX-License-Identifier: Apache-2.0
// fastsplat report: results and pictures as one page that opens from disk, and as JUnit XML, CSV and Markdown.
#include "report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/atomic_file.hpp"
#include "base/lower_case.hpp"
#include "base/printable.hpp"
#include "base/version.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/subcommands/subcommands.hpp"
#include "report/formats/output_formats.hpp"

namespace fastsplat::cli {
namespace {

struct ReportArguments {
  Common common;
  std::vector<std::string> results, pictures;
  std::string out;                   ///< empty for none
  std::string junit, csv, markdown;  ///< files; empty for none
  double most_megabytes = 5.0;
};

std::vector<std::string> written_by(const ReportArguments& arguments) {
  return {arguments.out, arguments.junit, arguments.csv, arguments.markdown, arguments.common.json};
}

void check(const ReportArguments& arguments, const std::vector<report::NamedPicture>& pictures) {
  const bool output_formats = !(arguments.junit.empty() && arguments.csv.empty() && arguments.markdown.empty());
  if (arguments.results.empty() && (pictures.empty() || output_formats)) {
    throw_usage({.where = {},
                 .what = "nothing to report on",
                 .expected = {},
                 .got = {},
                 .fix = "name results written with --json, for example compare.json"});
  }
  if (arguments.out.empty() && !output_formats) {
    throw_usage({.where = {},
                 .what = "nothing to write",
                 .expected = "--out, --junit, --csv or --markdown",
                 .got = {},
                 .fix = "for example -o report.html"});
  }
  if (arguments.out.empty() && !pictures.empty()) {
    throw_usage({.where = "--picture",
                 .what = "pictures need a page",
                 .expected = {},
                 .got = {},
                 .fix = "add -o report.html, or leave it out"});
  }
  require_file("--junit", arguments.junit);
  require_file("--csv", arguments.csv);
  require_file("--markdown", arguments.markdown);
  const auto end = ending_of(arguments.out);
  if (!arguments.out.empty() && end != ".html" && end != ".htm") {
    throw_usage({.where = arguments.out,
                 .what = "the name of a report must end in .html",
                 .expected = {},
                 .got = {},
                 .fix = "for example -o report.html"});
  }
  if (!(arguments.most_megabytes > 0.0 && arguments.most_megabytes <= 1000.0)) {
    throw_usage({.where = "--most-megabytes",
                 .what = "invalid size",
                 .expected = "more than 0, at most 1000",
                 .got = fmt::format("{}", arguments.most_megabytes),
                 .fix = "use 5 for a report that is easy to send"});
  }
  std::vector<std::string> inputs = arguments.results;
  for (const auto& picture : pictures) inputs.push_back(picture.file.string());
  check_outputs({.images = {}, .maps = {}, .raws = {}, .others = written_by(arguments), .inputs = inputs});
}

/// Writes the requested output formats; generates all texts before the first file.
void write_output_formats(const ReportArguments& arguments, const std::vector<report::Result>& results) {
  const std::string junit = arguments.junit.empty() ? "" : report::to_junit(results);
  const std::string csv = arguments.csv.empty() ? "" : report::to_csv(results);
  const std::string markdown = arguments.markdown.empty() ? "" : report::to_markdown(results);
  if (!arguments.junit.empty()) write_text_file(arguments.junit, junit);
  if (!arguments.csv.empty()) write_text_file(arguments.csv, csv);
  if (!arguments.markdown.empty()) write_text_file(arguments.markdown, markdown);
}

report::Verdict verdict_of_all(const std::vector<report::Result>& results) {
  std::vector<report::Verdict> verdicts;
  for (const auto& result : results) verdicts.push_back(report::verdict_of(result));
  return verdicts.empty() ? report::Verdict{} : report::verdict_of(verdicts);
}

ExitCode run(const ReportArguments& arguments) {
  const Output output(arguments.common);
  report::Request request{
      .results = {}, .pictures = {}, .most_bytes = static_cast<std::size_t>(arguments.most_megabytes * 1e6)};
  for (const auto& text : arguments.pictures) request.pictures.push_back(report::picture_from(text));
  check(arguments, request.pictures);
  for (const auto& name : arguments.results) {
    request.results.push_back(report::read_result(name));
    // An output must not replace a picture that a result names.
    for (const auto& picture : report::pictures_of(request.results.back()))
      check_outputs({.others = written_by(arguments), .inputs = {picture.file.string()}});
  }
  report::Report made;
  if (arguments.out.empty()) {
    made.verdict = verdict_of_all(request.results);
  } else {
    made = report::make_report(request);
  }
  write_output_formats(arguments, request.results);
  if (!arguments.out.empty()) write_text_file(arguments.out, made.html);

  const bool has_verdict = made.verdict.status != report::Status::Measured;
  if (!made.verdict.sentence.empty())
    output.line((has_verdict ? to_string(made.verdict.status) + std::string(": ") : "") +
                printable(made.verdict.sentence));
  for (const auto& face : {arguments.junit, arguments.csv, arguments.markdown}) {
    if (!face.empty()) output.line(fmt::format("{}: {}", face, counted(request.results.size(), "result")));
  }
  if (!arguments.out.empty())
    output.line(fmt::format("{}: {}, {}, {:.2f} MB", arguments.out, counted(request.results.size(), "result"),
                            counted(made.pictures, "picture"), static_cast<double>(made.html.size()) / 1e6));
  for (const auto& remark : made.remarks) output.warn(remark);
  output.json({{"verb", "report"},
               {"version", program_version()},
               {"report", arguments.out},
               {"junit", arguments.junit},
               {"csv", arguments.csv},
               {"markdown", arguments.markdown},
               {"bytes", made.html.size()},
               {"verdict", {{"status", to_string(made.verdict.status)}, {"sentence", made.verdict.sentence}}},
               {"pictures", made.pictures},
               {"remarks", made.remarks}});
  return ExitCode::Pass;
}

void declare(Options& options, ReportArguments& to) {
  options.positionals("RESULT", to.results, 0,
                      "results written with --json by any subcommand, in the order of the page");
  options.group("Report");
  options.word("-o,--out", to.out, "FILE", "write the page, .html: one file that opens from disk");
  options.words("--picture", to.pictures, "ROLE=FILE",
                "add a picture with a role: golden, integer, rtl, blame or your own word; repeatable");
  options.number("--most-megabytes", to.most_megabytes, "MB",
                 "maximum size of the page; pictures are cropped to keep it");
  options.group("Other output formats");
  options.word("--junit", to.junit, "FILE",
               "write JUnit XML: one test case per gate, failures with the command that reproduces them");
  options.word("--csv", to.csv, "FILE", "write the rows of the results, for spreadsheets");
  options.word("--markdown", to.markdown, "FILE", "write verdicts, gates and rows as Markdown tables, for a review");
  declare(options, to.common);
  options.example("fastsplat report compare.json cycles.json -o report.html", "results of two subcommands on one page");
  options.example(
      "fastsplat report compare.json --picture golden=golden.exr --picture integer=model.exr -o viewer.html",
      "a page with pictures to inspect");
  options.example("fastsplat report compare.json cycles.json --junit gates.xml --csv rows.csv --markdown review.md",
                  "results for a build server, a spreadsheet and a review");
}

}  // namespace

const Subcommand subcommands::report{
    "report", "write results and pictures as one page that opens from disk, or as JUnit XML, CSV, Markdown",
    subcommand<ReportArguments, declare, run>};

}  // namespace fastsplat::cli
