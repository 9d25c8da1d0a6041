// SPDX-License-Identifier: Apache-2.0
// The bins that only one of two coverage files hit.
#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "testbench/coverage/coverage_book.hpp"

namespace fastsplat::cli {

struct CoverageDifference {
  struct Side {
    std::string file;
    std::size_t bins = 0, hit = 0;  ///< over all campaigns
  };
  Side ref, test;
  std::string config;  ///< name
  std::uint64_t config_hash = 0;
  std::vector<testbench::CoverBin> lost;    ///< hit in REF only, with their hits there; by name
  std::vector<testbench::CoverBin> gained;  ///< hit in TEST only
};

/// Whether `fastsplat verify --coverage` wrote the file.
bool is_coverage(const std::filesystem::path& path);

/// Throws UserError (Input) for a damaged file, (NotComparable) for those of different configurations.
CoverageDifference coverage_difference(const std::string& ref, const std::string& test);

std::string to_text(const CoverageDifference& difference);
nlohmann::ordered_json to_json(const CoverageDifference& difference);

}  // namespace fastsplat::cli
