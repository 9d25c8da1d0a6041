// SPDX-License-Identifier: Apache-2.0
// Results of configurations in a file of JSON lines, which a later search reads instead of simulating again.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <optional>
#include <string>
#include <utility>

#include "analysis/errors/target.hpp"

namespace fastsplat::analysis {

class Journal {
 public:
  /// The result of a configuration and a scene; nullopt if it could not be drawn.
  using Entry = std::optional<Fidelity>;

  /// Without a file, entries are kept in memory only. Otherwise its entries are read and new ones appended. A line that
  /// a killed program left incomplete is removed. Throws UserError (Input) if another line is not an entry.
  explicit Journal(const std::filesystem::path& path = {});

  /// Null if unknown.
  const Entry* find(std::uint64_t config, std::uint64_t scene) const;
  /// Flushed to the file before this returns.
  void add(std::uint64_t config, std::uint64_t scene, const Entry& entry);

 private:
  std::filesystem::path path_;
  std::ofstream out_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Entry> entries_;
};

}  // namespace fastsplat::analysis
