// SPDX-License-Identifier: Apache-2.0
#include "testbench/coverage/coverage_book.hpp"

#include <nlohmann/json.hpp>

#include "base/atomic_file.hpp"
#include "base/error.hpp"
#include "base/folder_lock.hpp"
#include "base/hash_text.hpp"
#include "base/json_file.hpp"
#include "base/json_text.hpp"

namespace fastsplat::testbench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kFormat = "fastsplat coverage 1";
constexpr std::size_t kMostBytes = std::size_t{1} << 26;

std::pair<std::string, std::string> split(const std::string& bin) {
  const auto dot = bin.find('.');
  return {bin.substr(0, dot), dot == std::string::npos ? "" : bin.substr(dot + 1)};
}

}  // namespace

void CoverageBook::merge(const CoverageBook& other) {
  if (other.config_hash != config_hash) {
    throw UserError(ExitCode::NotComparable, {.where = "coverage of configuration " + other.config,
                                              .what = "was collected with another configuration",
                                              .expected = config + " " + hash_text(config_hash),
                                              .got = hash_text(other.config_hash),
                                              .fix = "run it again with this version"});
  }
  streams += other.streams;
  splats += other.splats;
  comparisons += other.comparisons;
  cycles += other.cycles;
  for (const auto& [name, coverage] : other.campaigns) campaigns[name].merge(coverage);
}

void write_book(const std::filesystem::path& path, const CoverageBook& book) {
  Json json{{"format", kFormat},       {"config", book.config}, {"config_hash", hash_text(book.config_hash)},
            {"streams", book.streams}, {"splats", book.splats}, {"comparisons", book.comparisons},
            {"cycles", book.cycles}};
  json["campaigns"] = Json::object();
  for (const auto& [name, coverage] : book.campaigns) {
    Json& bins = json["campaigns"][name] = Json::object();
    for (const auto& bin : coverage.bins()) bins[bin.name] = bin.hits;
  }
  write_text_file(path, json_text(json, 1) + "\n");
}

namespace {

/// nlohmann would wrap a negative number and cut a fraction.
std::uint64_t count_of(const Json& json) {
  if (!json.is_number_unsigned()) throw std::runtime_error(json_text(json, -1) + " is not a count");
  return json.get<std::uint64_t>();
}

CoverageBook book_from(const Json& json) {
  if (json.at("format") != kFormat) throw std::runtime_error("unknown format");
  CoverageBook book{.config = json.at("config"),
                    .config_hash = std::stoull(json.at("config_hash").get<std::string>(), nullptr, 16),
                    .streams = count_of(json.at("streams")),
                    .splats = count_of(json.at("splats")),
                    .comparisons = count_of(json.at("comparisons")),
                    .cycles = count_of(json.at("cycles"))};
  if (!json.at("campaigns").is_object()) throw std::runtime_error("campaigns is not an object");
  for (const auto& [name, bins] : json.at("campaigns").items()) {
    Coverage& coverage = book.campaigns[name];
    for (const auto& [bin, hits] : bins.items()) {
      const auto [group, short_name] = split(bin);
      coverage.hit(coverage.declare(group, short_name), count_of(hits));
    }
  }
  return book;
}

}  // namespace

CoverageBook read_book(const std::filesystem::path& path) {
  return from_json_file<Json>(
      path,
      {.what = "not a coverage file",
       .expected = std::string("a file written by 'fastsplat verify --coverage FILE' (") + kFormat + ")",
       .fix = {},
       .most_bytes = kMostBytes},
      book_from);
}

CoverageBook read_book_for(const std::filesystem::path& path, const std::string& config, std::uint64_t hash) {
  CoverageBook book = read_book(path);
  if (book.config_hash == hash) return book;
  throw UserError(ExitCode::NotComparable, {.where = path.string(),
                                            .what = "holds coverage of another configuration",
                                            .expected = config + " " + hash_text(hash),
                                            .got = book.config + " " + hash_text(book.config_hash),
                                            .fix = "name a file of that configuration"});
}

CoverageBook add_to_book(const std::filesystem::path& path, const CoverageBook& more) {
  const FolderLock lock(path);
  CoverageBook sum = more;
  if (std::filesystem::exists(path)) {
    sum = read_book_for(path, more.config, more.config_hash);
    sum.merge(more);
  }
  write_book(path, sum);
  return sum;
}

}  // namespace fastsplat::testbench
