// SPDX-License-Identifier: Apache-2.0
// The coverage of one configuration, campaign by campaign: saved as JSON, added up over runs.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

#include "cmodel/numbers/config.hpp"
#include "testbench/coverage/coverage.hpp"

namespace fastsplat::testbench {

struct CoverageBook {
  std::string config;  ///< name
  std::uint64_t config_hash = 0;
  std::uint64_t streams = 0, splats = 0, comparisons = 0, cycles = 0;
  std::map<std::string, Coverage> campaigns{};  ///< stimulus class, "scene", "stream", "registers", ...

  static CoverageBook of(const cmodel::Config& config) {
    return {.config = config.name, .config_hash = cmodel::config_hash(config)};
  }
  /// Adds the coverage of another run. Throws UserError (NotComparable) if that is of another configuration.
  void merge(const CoverageBook& other);
};

void write_book(const std::filesystem::path& path, const CoverageBook& book);
/// Adds `more` to what the file holds, if it exists, and returns the sum. Concurrent runs wait for each other, so none
/// of them is lost.
CoverageBook add_to_book(const std::filesystem::path& path, const CoverageBook& more);
/// Throws UserError (Input) if this program did not write the file as coverage.
CoverageBook read_book(const std::filesystem::path& path);
/// Also throws UserError (NotComparable) if the file's configuration is not the run's, which `config` and `hash` name.
CoverageBook read_book_for(const std::filesystem::path& path, const std::string& config, std::uint64_t hash);

}  // namespace fastsplat::testbench
