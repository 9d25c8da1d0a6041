// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>

#include "report/file_names.hpp"
#include "report/formats/output_format.hpp"
#include "report/formats/output_formats.hpp"

namespace fastsplat::report {
namespace {

/// Escapes UTF-8 for text and attributes of XML 1.0, where other control characters are invalid even when escaped.
std::string xml(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size(); ++at) {
    const char c = text[at];
    const auto byte = static_cast<unsigned char>(c);
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else if (c == '>') {
      out += "&gt;";
    } else if (c == '"') {
      out += "&quot;";
    } else if (c == '\n' || c == '\t' || c == '\r') {
      out += fmt::format("&#{};", static_cast<int>(byte));
    } else if (byte < 0x20 || text.compare(at, 3, "\xEF\xBF\xBE") == 0 || text.compare(at, 3, "\xEF\xBF\xBF") == 0) {
      out += "\xEF\xBF\xBD";
      if (byte >= 0x20) at += 2;
    } else if (byte == 0x7f ||
               (byte == 0xc2 && at + 1 < text.size() && static_cast<unsigned char>(text[at + 1]) < 0xa0)) {
      out += "\xEF\xBF\xBD";  // XML allows DEL and C1 controls, but terminals obey them
      if (byte == 0xc2) ++at;
    } else {
      out += c;
    }
  }
  return out;
}

/// A test case's class name: build servers split it into folders at dots.
std::string class_name(const Result& result) {
  std::string name = "fastsplat." + result.subcommand;
  std::replace(name.begin(), name.end(), ' ', '_');
  if (result.subcommand == "plan") name += "." + result.json.value("name", "");
  return name;
}

double seconds_of(const Result& result) {
  const auto found = result.json.find("seconds");
  return found != result.json.end() && found->is_number() ? std::max(0.0, found->get<double>()) : 0.0;
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }

std::string test_case(const Result& result, const Gate& gate, double seconds) {
  std::string text = fmt::format("    <testcase classname=\"{}\" name=\"{}\" time=\"{:.3f}\"", xml(class_name(result)),
                                 xml(gate.name), seconds);
  if (gate.status == Status::Pass) return text + "/>\n";
  const char* kind = gate.status == Status::Fail ? "failure" : "error";
  const std::string again = gate.command.empty() ? "" : "\nreproduce: " + gate.command;
  return text + fmt::format(">\n      <{0} message=\"{1}\" type=\"{2}\">{3}</{0}>\n    </testcase>\n", kind,
                            xml(first_line(gate.message)), to_string(gate.status), xml(gate.message + again));
}

struct Count {
  std::size_t tests = 0, failures = 0, errors = 0;
  double seconds = 0.0;
  void add(const Count& other) {
    tests += other.tests;
    failures += other.failures;
    errors += other.errors;
    seconds += other.seconds;
  }
  std::string attributes() const {
    return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\" time=\"{:.3f}\"", tests, failures, errors, seconds);
  }
};

/// Adds its counts to `all`.
std::string suite(const Result& result, Count& all) {
  const auto gates = gates_of(result);
  Count count{.tests = gates.size(), .failures = 0, .errors = 0, .seconds = seconds_of(result)};
  std::string cases;
  for (const Gate& gate : gates) {
    count.failures += gate.status == Status::Fail ? 1 : 0;
    count.errors += gate.status == Status::Error ? 1 : 0;
    cases += test_case(result, gate, count.seconds / static_cast<double>(gates.size()));
  }
  all.add(count);
  const std::string command = command_of(result);
  return fmt::format("  <testsuite name=\"{}\" {}>\n    <properties>\n", xml(result.subcommand + " " + name_of(result)),
                     count.attributes()) +
         fmt::format("      <property name=\"verdict\" value=\"{}\"/>\n", xml(verdict_of(result).sentence)) +
         (command.empty() ? "" : fmt::format("      <property name=\"command\" value=\"{}\"/>\n", xml(command))) +
         "    </properties>\n" + cases + "  </testsuite>\n";
}

}  // namespace

std::string to_junit(const std::vector<Result>& with_folders) {
  const auto results = without_folders(with_folders);
  Count all;
  std::string suites;
  for (const Result& result : results) reading(result, [&] { suites += suite(result, all); });
  return fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"fastsplat\" {}>\n{}</testsuites>\n",
      all.attributes(), suites);
}

}  // namespace fastsplat::report
