#include <algorithm>
#include <map>
#include <set>
#include <sstream>

#include "base/hash_text.hpp"
#include "testbench/closure/closure_report.hpp"

namespace fastsplat::testbench {
namespace {

constexpr const char* kStyle = R"css(
:root{--ink:#1c2330;--soft:#5d6779;--line:#dfe3ea;--page:#fff;--pane:#f6f7f9;--good:#1a7f45;--bad:#b3261e;--warn:#8a5a00;
--goodbg:#e4f4ea;--badbg:#fbe6e4;--warnbg:#fbf0da}
@media(prefers-color-scheme:dark){:root{--ink:#e4e8ef;--soft:#9aa5b8;--line:#323a48;--page:#14181f;--pane:#1c222c;
--good:#62c98c;--bad:#ff8a80;--warn:#e6b45c;--goodbg:#173324;--badbg:#40201e;--warnbg:#3a2f17}}
*{box-sizing:border-box}
body{margin:0;font:15px/1.5 system-ui,sans-serif;color:var(--ink);background:var(--page)}
main{max-width:1180px;margin:0 auto;padding:24px 24px 80px}
h1{font-size:26px;margin:0 0 4px}h2{font-size:19px;margin:40px 0 10px}
p{margin:4px 0;color:var(--soft)}
.tiles{display:flex;flex-wrap:wrap;gap:12px;margin:20px 0}
.tile{background:var(--pane);border:1px solid var(--line);border-radius:8px;padding:10px 16px;min-width:150px}
.tile b{display:block;font-size:22px;font-variant-numeric:tabular-nums}.tile span{color:var(--soft);font-size:13px}
table{border-collapse:collapse;width:100%;font-variant-numeric:tabular-nums}
th{text-align:left;font-weight:600;color:var(--soft);font-size:13px;border-bottom:2px solid var(--line);padding:4px 10px}
td{border-bottom:1px solid var(--line);padding:4px 10px;vertical-align:top}
td.n,th.n{text-align:right}
.pill{display:inline-block;border-radius:10px;padding:0 9px;font-size:13px;white-space:nowrap}
.good{color:var(--good);background:var(--goodbg)}.bad{color:var(--bad);background:var(--badbg)}.warn{color:var(--warn);background:var(--warnbg)}
details{border:1px solid var(--line);border-radius:8px;margin:8px 0;background:var(--pane)}
details>div{padding:4px 14px 14px;background:var(--page);border-top:1px solid var(--line);border-radius:0 0 8px 8px;overflow-x:auto}
summary{cursor:pointer;padding:8px 14px;display:flex;gap:8px;align-items:center}
summary:before{content:"\25b8";color:var(--soft);flex:none}details[open]>summary:before{content:"\25be"}
summary .name{font-weight:600;flex:none;width:230px}summary .say{color:var(--soft);flex:1;min-width:0}
.pills{display:flex;gap:5px;flex:none}
ul.finds{margin:6px 0;padding-left:20px}ul.finds li{color:var(--bad)}
code,pre{font:13px/1.5 ui-monospace,monospace}
.bins{columns:3 270px;column-gap:28px;margin:8px 0 0;padding:0;list-style:none}
.bins li{display:flex;justify-content:space-between;gap:10px;break-inside:avoid;font-size:13px;border-bottom:1px dotted var(--line)}
.bins li.none{color:var(--bad);font-weight:600}
.bins b{font-weight:400;font-variant-numeric:tabular-nums;color:var(--soft)}.bins li.none b{color:var(--bad)}
h3{font-size:14px;margin:12px 0 0}
table.src{table-layout:fixed;min-width:900px}
table.src td{border:0;padding:0 8px;font:12.5px/1.45 ui-monospace,monospace;white-space:pre-wrap;overflow-wrap:anywhere}
table.src td:first-child{width:52px;color:var(--soft);text-align:right}
table.src td:nth-child(2){width:150px;color:var(--soft);text-align:right}
tr.hit td:nth-child(3){background:var(--goodbg)}tr.miss td:nth-child(3){background:var(--badbg)}tr.excused td:nth-child(3){background:var(--warnbg)}
)css";

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

/// 1234567 -> 1 234 567, with thin spaces.
std::string grouped(std::uint64_t number) {
  std::string digits = std::to_string(number);
  for (auto at = static_cast<std::ptrdiff_t>(digits.size()) - 3; at > 0; at -= 3)
    digits.insert(static_cast<std::size_t>(at), "\u2009");
  return digits;
}

std::string pill(const char* kind, const std::string& text) {
  return std::string("<span class=\"pill ") + kind + "\">" + escaped(text) + "</span>";
}

std::string share(std::size_t hit, std::size_t of) { return std::to_string(hit) + "/" + std::to_string(of); }

void tile(std::ostream& out, const std::string& number, const std::string& what) {
  out << "<div class=\"tile\"><b>" << number << "</b><span>" << what << "</span></div>\n";
}

void findings(std::ostream& out, const char* title, const std::vector<std::string>& lines) {
  if (lines.empty()) return;
  out << "<h2>" << title << "</h2><ul class=\"finds\">\n";
  for (const auto& line : lines) out << "<li>" << escaped(line) << "</li>\n";
  out << "</ul>\n";
}

void head(std::ostream& out, const ClosureReport& report) {
  const std::size_t reached = report.lines.points.size() - report.lines.unreached.size();
  std::size_t passed = 0, decided = 0;
  for (const ClosureTest& test : report.closure.tests) {
    if (test.outcome == TestOutcome::NotRun) continue;
    ++decided;
    if (test.outcome == TestOutcome::Passed) ++passed;
  }
  std::uint64_t comparisons = 0, splats = 0;
  for (const auto& input : report.inputs) {
    comparisons += input.book.comparisons;
    splats += input.book.splats;
  }
  out << "<h1>Coverage closure " << (report.closed() ? pill("good", "closed") : pill("bad", "open"))
      << "</h1>\n<p>FastSplat " << escaped(report.version)
      << ". The RTL beside its model; what was sampled was compared, bit for bit.</p>\n<div class=\"tiles\">";
  tile(out, share(report.closure.hit, report.closure.bins), "bins hit, by testpoint and configuration");
  if (!report.lines.points.empty()) {
    const auto excused = std::count_if(report.lines.unreached.begin(), report.lines.unreached.end(),
                                       [](const auto& finding) { return !finding.reason.empty(); });
    tile(out, share(reached, report.lines.points.size()),
         "lines and branches reached, " + std::to_string(excused) + " excused");
  }
  if (decided > 0) tile(out, share(passed, decided), "tests of the plan passed");
  tile(out, grouped(splats), "splats");
  tile(out, grouped(comparisons), "comparisons");
  out << "</div>\n<table><tr><th>configuration<th>hash<th class=n>streams<th class=n>splats<th class=n>cycles<th "
         "class=n>comparisons</tr>\n";
  for (const auto& [book, planned] : report.inputs) {
    out << "<tr><td>" << escaped(book.config) << "<td><code>" << hash_text(book.config_hash) << "</code><td class=n>"
        << grouped(book.streams) << "<td class=n>" << grouped(book.splats) << "<td class=n>" << grouped(book.cycles)
        << "<td class=n>" << grouped(book.comparisons) << "</tr>\n";
  }
  out << "</table>\n";
}

void names(std::ostream& out, const char* title, const std::vector<std::string>& list) {
  if (list.empty()) return;
  out << "<h3>" << title << "</h3>";
  for (std::size_t i = 0; i < list.size(); ++i) out << (i > 0 ? ", " : "") << "<code>" << escaped(list[i]) << "</code>";
  out << "\n";
}

void testpoint(std::ostream& out, const Testpoint& point, const Closure& closure) {
  std::vector<const ClosureRow*> rows;
  std::ostringstream pills, tests;
  for (const ClosureRow& row : closure.rows) {
    if (row.testpoint != point.name) continue;
    rows.push_back(&row);
    pills << pill(row.hit == row.bins.size() ? "good" : "bad", row.config + " " + share(row.hit, row.bins.size()));
  }
  std::size_t passed = 0, failed = 0, planned = 0;
  for (const ClosureTest& test : closure.tests) {
    if (test.testpoint != point.name) continue;
    ++planned;
    if (test.outcome == TestOutcome::Passed) ++passed;
    if (test.outcome == TestOutcome::Failed) ++failed;
    tests << "<tr><td><code>" << escaped(test.test) << "</code><td class=n>"
          << (test.runs > 0 ? std::to_string(test.runs) : "") << "<td>"
          << (test.outcome == TestOutcome::Passed   ? pill("good", "passed")
              : test.outcome == TestOutcome::Failed ? pill("bad", "failed")
                                                    : pill("warn", "not run here"))
          << "</tr>\n";
  }
  if (rows.empty())
    pills << pill(failed > 0 ? "bad" : passed == planned ? "good" : "warn", "tests " + share(passed, planned));
  out << "<details"
      << (failed > 0 ||
                  std::any_of(rows.begin(), rows.end(), [](const auto* row) { return row->hit < row->bins.size(); })
              ? " open"
              : "")
      << "><summary><span class=name>" << escaped(point.name) << "</span><span class=say>" << escaped(point.proves)
      << "</span><span class=pills>" << pills.str() << "</span></summary><div>\n";
  names(out, "Campaigns", point.campaigns);
  names(out, "Assertions", point.assertions);
  names(out, "Faults", point.faults);
  if (planned > 0) out << "<h3>Tests</h3><table><tr><th>test<th class=n>runs<th></tr>\n" << tests.str() << "</table>\n";
  for (const ClosureRow* row : rows) {
    out << "<h3>" << escaped(row->config) << ": bins and hits</h3><ul class=bins>\n";
    for (const ClosureBin& bin : row->bins)
      out << "<li" << (bin.hits == 0 ? " class=none" : "") << "><span>" << escaped(bin.name) << "</span><b>"
          << grouped(bin.hits) << "</b></li>\n";
    out << "</ul>\n";
  }
  out << "</div></details>\n";
}

void source(std::ostream& out, const std::string& file, const std::vector<std::string>& lines,
            const LineClosure& closure) {
  struct Note {
    std::string text;
    bool reached = false, missed = false, excused = false;
  };
  std::map<int, Note> notes;
  std::size_t points = 0, reached = 0, excused = 0;
  for (const LinePoint& point : closure.points) {
    if (point.file != file) continue;
    ++points;
    const auto finding =
        std::find_if(closure.unreached.begin(), closure.unreached.end(), [&](const LineFinding& found) {
          return found.point.file == point.file && found.point.line == point.line &&
                 found.point.column == point.column && found.point.kind == point.kind;
        });
    const bool hit = point.hits > 0, excuse = finding != closure.unreached.end() && !finding->reason.empty();
    reached += hit ? 1 : 0;
    excused += excuse ? 1 : 0;
    Note& note = notes[point.line];
    note.text += (note.text.empty() ? "" : "\n") + point.kind + " " + grouped(point.hits);
    std::set<int> covered(point.lines.begin(), point.lines.end());
    covered.insert(point.line);
    for (const int line : covered) {
      if (hit)
        notes[line].reached = true;
      else
        (excuse ? notes[line].excused : notes[line].missed) = true;
    }
  }
  const bool open = reached + excused < points;
  out << "<details" << (open ? " open" : "") << "><summary><span class=name>" << escaped(file)
      << "</span><span class=say>" << lines.size() << " lines</span><span class=pills>";
  if (excused > 0) out << pill("warn", std::to_string(excused) + " excused");
  out << pill(open ? "bad" : "good", share(reached, points)) << "</span></summary><div><table class=src>\n";
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const auto found = notes.find(static_cast<int>(i) + 1);
    const char* kind = "";
    if (found != notes.end())
      kind = found->second.missed ? "miss" : found->second.excused ? "excused" : found->second.reached ? "hit" : "";
    out << "<tr class=\"" << kind << "\"><td>" << i + 1 << "<td>" << (found == notes.end() ? "" : found->second.text)
        << "<td>" << escaped(lines[i]) << "</tr>\n";
  }
  out << "</table></div></details>\n";
}

}  // namespace

std::string closure_html(const ClosureReport& report) {
  std::ostringstream out;
  out << "<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content=\"width=device-width\">"
         "<title>FastSplat coverage</title><style>"
      << kStyle << "</style><main>\n";
  head(out, report);
  findings(out, "Campaigns that failed", report.failures);
  findings(out, "Open bins and tests", report.closure.findings);
  findings(out, "Open lines", report.lines.findings);
  out << "<h2>Testpoints</h2><p>Bins count where a testpoint's own campaigns hit them. Open one to see its bins.</p>\n";
  for (const Testpoint& point : report.plan.testpoints) testpoint(out, point, report.closure);
  if (!report.lines.points.empty()) {
    out << "<h2>Lines and branches of the RTL</h2><p>Counted over all instances and runs of the configurations with "
           "line counts: "
        << pill("good", "reached") << " " << pill("bad", "never reached") << " " << pill("warn", "excused") << "</p>\n";
    for (const auto& [file, lines] : report.lines.sources) source(out, file, lines, report.lines);
    out << "<h2>Excused</h2><table><tr><th>place<th>line<th>because</tr>\n";
    for (const LineFinding& finding : report.lines.unreached) {
      if (finding.reason.empty()) continue;
      out << "<tr><td>" << escaped(finding.point.file) << ":" << finding.point.line << " (" << finding.point.kind
          << ")<td><code>" << escaped(finding.text) << "</code><td>" << escaped(finding.reason) << "</tr>\n";
    }
    out << "</table>\n";
  }
  out << "</main></html>\n";
  return out.str();
}

}  // namespace fastsplat::testbench
