// SPDX-License-Identifier: Apache-2.0
#include "cli/coverage_difference.hpp"

#include <fmt/format.h>

#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "base/hash_text.hpp"
#include "base/version.hpp"

namespace fastsplat::cli {
namespace {

using Json = nlohmann::ordered_json;
using Bins = std::map<std::string, std::uint64_t>;  ///< name -> hits, over all campaigns

Bins bins_of(const testbench::CoverageBook& book) {
  Bins out;
  for (const auto& [campaign, coverage] : book.campaigns) {
    for (const testbench::CoverBin& bin : coverage.bins()) out[bin.name] += bin.hits;
  }
  return out;
}

CoverageDifference::Side side(const std::string& file, const Bins& bins) {
  CoverageDifference::Side out{.file = file, .bins = bins.size()};
  for (const auto& [name, hits] : bins) out.hit += hits > 0 ? 1 : 0;
  return out;
}

/// Hit here and not there.
std::vector<testbench::CoverBin> only_in(const Bins& here, const Bins& there) {
  std::vector<testbench::CoverBin> out;
  for (const auto& [name, hits] : here) {
    const auto other = there.find(name);
    if (hits > 0 && (other == there.end() || other->second == 0)) out.push_back({name, hits});
  }
  return out;
}

std::string list(const std::string& title, const std::vector<testbench::CoverBin>& bins) {
  std::string out = fmt::format("{}: {}\n", title, bins.size());
  for (const testbench::CoverBin& bin : bins) out += fmt::format("  {} ({})\n", bin.name, bin.hits);
  return out;
}

Json to_json(const CoverageDifference::Side& side) {
  return {{"file", side.file}, {"bins", side.bins}, {"hit", side.hit}};
}

Json to_json(const std::vector<testbench::CoverBin>& bins) {
  Json json = Json::object();
  for (const testbench::CoverBin& bin : bins) json[bin.name] = bin.hits;
  return json;
}

}  // namespace

bool is_coverage(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path)) return false;  // a pipe can be read once
  std::ifstream file(path);
  std::string head(64, '\0');
  file.read(head.data(), static_cast<std::streamsize>(head.size()));
  return head.find("\"fastsplat coverage ") != std::string::npos;
}

CoverageDifference coverage_difference(const std::string& ref, const std::string& test) {
  const auto before = testbench::read_book(ref);
  const auto after = testbench::read_book_for(test, before.config, before.config_hash);
  const Bins old_bins = bins_of(before), new_bins = bins_of(after);
  return {.ref = side(ref, old_bins),
          .test = side(test, new_bins),
          .config = before.config,
          .config_hash = before.config_hash,
          .lost = only_in(old_bins, new_bins),
          .gained = only_in(new_bins, old_bins)};
}

std::string to_text(const CoverageDifference& difference) {
  const auto said = [](const CoverageDifference::Side& side) {
    return fmt::format("{} of {} bins hit in {}", side.hit, side.bins, side.file);
  };
  return fmt::format("coverage of {} {}: {}, {}\n", difference.config, hash_text(difference.config_hash),
                     said(difference.ref), said(difference.test)) +
         list("lost", difference.lost) + list("gained", difference.gained);
}

Json to_json(const CoverageDifference& difference) {
  return {{"format", "fastsplat coverage difference 1"},
          {"version", program_version()},
          {"config", difference.config},
          {"config_hash", hash_text(difference.config_hash)},
          {"ref", to_json(difference.ref)},
          {"test", to_json(difference.test)},
          {"lost", to_json(difference.lost)},
          {"gained", to_json(difference.gained)}};
}

}  // namespace fastsplat::cli
