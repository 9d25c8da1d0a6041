// fastsplat report: results and their pictures as one page that opens from disk.
#include "report/report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/atomic_file.hpp"
#include "base/version.hpp"
#include "cli/output.hpp"
#include "cli/output_names.hpp"
#include "cli/verbs/verbs.hpp"

namespace fastsplat::cli {
namespace {

struct Arguments {
  Common common;
  std::vector<std::string> results, pictures;
  std::string out;
  double most_megabytes = 5.0;
};

void check(const Arguments& arguments, const std::vector<report::NamedPicture>& pictures) {
  if (arguments.results.empty() && pictures.empty()) {
    throw_usage({.where = {},
                 .what = "report of what?",
                 .expected = {},
                 .got = {},
                 .fix = "name results that verbs wrote with --json, for example compare.json"});
  }
  const auto end = ending(arguments.out);
  if (end != ".html" && end != ".htm") {
    throw_usage({.where = arguments.out,
                 .what = "a report's name ends in .html",
                 .expected = {},
                 .got = {},
                 .fix = "for example -o report.html"});
  }
  if (!(arguments.most_megabytes > 0.0 && arguments.most_megabytes <= 1000.0)) {
    throw_usage({.where = "--most-megabytes",
                 .what = "no such size",
                 .expected = "more than 0, at most 1000",
                 .got = fmt::format("{}", arguments.most_megabytes),
                 .fix = "5 keeps a report easy to send"});
  }
  std::vector<std::string> inputs = arguments.results;
  for (const auto& picture : pictures) inputs.push_back(picture.file.string());
  check_outputs(
      {.images = {}, .maps = {}, .raws = {}, .others = {arguments.out, arguments.common.json}, .inputs = inputs});
}

ExitCode run(const Arguments& arguments) {
  const Output output(arguments.common);
  report::Request request{
      .results = {}, .pictures = {}, .most_bytes = static_cast<std::size_t>(arguments.most_megabytes * 1e6)};
  for (const auto& text : arguments.pictures) request.pictures.push_back(report::picture_from(text));
  check(arguments, request.pictures);
  for (const auto& name : arguments.results) {
    request.results.push_back(report::read_result(name));
    // Neither may it take the place of a picture that a result names.
    for (const auto& picture : report::pictures_of(request.results.back()))
      check_outputs({.others = {arguments.out, arguments.common.json}, .inputs = {picture.file.string()}});
  }
  const report::Report made = report::make_report(request);
  write_text_file(arguments.out, made.html);

  const bool judged = made.verdict.status != report::Status::Measured;
  if (!made.verdict.sentence.empty())
    output.line((judged ? to_string(made.verdict.status) + std::string(": ") : "") + made.verdict.sentence);
  output.line(fmt::format("{}: {}, {}, {:.2f} MB", arguments.out, counted(request.results.size(), "result"),
                          counted(made.pictures, "picture"), static_cast<double>(made.html.size()) / 1e6));
  for (const auto& remark : made.remarks) output.warn(remark);
  output.json({{"verb", "report"},
               {"version", program_version()},
               {"report", arguments.out},
               {"bytes", made.html.size()},
               {"verdict", {{"status", to_string(made.verdict.status)}, {"sentence", made.verdict.sentence}}},
               {"pictures", made.pictures},
               {"remarks", made.remarks}});
  return ExitCode::Pass;
}

void declare(Options& options, Arguments& to) {
  options.positionals("RESULT", to.results, 0, "what verbs wrote with --json, of any verb, in the page's order");
  options.group("Report");
  options.required("-o,--out", to.out, "FILE", "the page, .html: one file that opens from disk");
  options.words("--picture", to.pictures, "ROLE=FILE",
                "a picture more: golden, integer, rtl, blame or a word of yours; repeatable");
  options.number("--most-megabytes", to.most_megabytes, "MB", "pictures are cropped to keep the page below");
  declare(options, to.common);
  options.example("fastsplat report compare.json cmodel.json -o report.html");
}

}  // namespace

const Verb verbs::report{"report", "results and their pictures as one page that opens from disk",
                         verb<Arguments, declare, run>};

}  // namespace fastsplat::cli
