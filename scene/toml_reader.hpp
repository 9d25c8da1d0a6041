// SPDX-License-Identifier: Apache-2.0
// Strict TOML: every key must be known, every value in range; each error has file:line:column and a hint.
#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "base/toml/toml_kind.hpp"

namespace fastsplat::scene {

/// One table of a TOML document. Read the known keys, then call finish(): unread keys are refused.
/// Every failure is a UserError (Input) that starts with "source:line:column".
class TomlTable {
 public:
  /// `source` names the document in messages.
  static TomlTable parse(const std::string& text, const std::string& source, TomlKind kind);
  static TomlTable parse_file(const std::filesystem::path& path, TomlKind kind);

  bool has(const std::string& key) const;

  // Absent keys give nullopt; a wrong type or a value outside [low, high] throws.
  std::optional<double> number(const std::string& key, double low, double high);
  std::optional<int> integer(const std::string& key, int low, int high);
  std::optional<bool> flag(const std::string& key);
  std::optional<std::string> text(const std::string& key);
  std::optional<std::array<double, 3>> triple(const std::string& key, double low, double high);
  /// An array of at least `least` numbers.
  std::optional<std::vector<double>> numbers(const std::string& key, std::size_t least, double low, double high);
  std::optional<TomlTable> table(const std::string& key);
  std::vector<TomlTable> tables(const std::string& key);  ///< array of tables; empty when absent

  /// "source:line:column" of a present key, else of this table.
  std::string where(const std::string& key) const;
  [[noreturn]] void refuse(const std::string& key, const std::string& what, const std::string& expected,
                           const std::string& got, const std::string& fix) const;

  /// Refuses the first key that was never read.
  void finish() const;

 private:
  struct Document;
  TomlTable(std::shared_ptr<const Document> document, const void* table, std::string path);
  const void* find(const std::string& key);

  std::shared_ptr<const Document> document_;
  const void* table_;            // a toml::table of document_
  std::string path_;             // dotted name of this table, empty for the root
  std::set<std::string> known_;  // keys read so far
};

}  // namespace fastsplat::scene
