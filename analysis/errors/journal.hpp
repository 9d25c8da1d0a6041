// What configurations did, kept in a file: JSON lines that a later search finds instead of simulating again.
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
  /// What became of a configuration and a scene; no fidelity where it could not be drawn.
  using Entry = std::optional<Fidelity>;

  /// Without a file nothing is kept. Else its entries are read and new ones appended. A line that a killed program left
  /// incomplete is cut off the next time. Throws UserError (Input) if another line is not an entry.
  explicit Journal(const std::filesystem::path& path = {});

  /// Null where nothing is known.
  const Entry* find(std::uint64_t config, std::uint64_t scene) const;
  /// On disk before this returns.
  void add(std::uint64_t config, std::uint64_t scene, const Entry& entry);

 private:
  std::filesystem::path path_;
  std::ofstream out_;
  std::map<std::pair<std::uint64_t, std::uint64_t>, Entry> entries_;
};

}  // namespace fastsplat::analysis
