// SPDX-License-Identifier: Apache-2.0
// Line-based headers, as of NRRD and MetaImage: fields by name, with their line numbers for messages.
#pragma once

#include <cstdint>
#include <filesystem>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

namespace fastsplat::volume {

/// `text` without blanks, tabs and carriage returns at both ends.
std::string trimmed(const std::string& text);
/// The words of `text`, split at white space.
std::vector<std::string> words_of(const std::string& text);

struct TextHeader {
  struct Field {
    std::string value;
    int line = 0;
  };

  std::filesystem::path path;
  const char* format = "";                  ///< "NRRD" or "MetaImage", for messages
  std::map<std::string, Field> fields{};    ///< by the format's own name of the field
  std::vector<std::string> listed_files{};  ///< the lines after a field with LIST
  std::uint64_t end = 0;                    ///< first byte after the header
  bool ended = false;                       ///< ended by its last line, not by the end of the file

  /// Throws UserError (Input) about a line of the file; 0 is the file as a whole.
  [[noreturn]] void refuse(int line, std::string what, std::string expected, std::string got, std::string fix) const;
  /// "PATH:LINE"
  std::string place(int line) const;
  /// The field by the first of its names that exists, else nullptr.
  const Field* find(std::initializer_list<const char*> names) const;
  const Field& need(const char* name) const;
  /// Throws UserError (Input) for a duplicate field.
  void add(const std::string& name, std::string value, int line);
  /// A whole number, not negative.
  std::uint64_t count(const Field& field, const std::string& word) const;
  /// `many` numbers; they may be infinite or not numbers.
  std::vector<double> numbers(const Field& field, std::size_t many) const;
};

/// The lines of a file's first MiB without their ends.
class HeaderLines {
 public:
  explicit HeaderLines(const std::filesystem::path& path);
  /// False at the end.
  bool next(std::string& line);
  int number() const { return number_; }     ///< of the last line, from 1
  std::uint64_t end() const { return at_; }  ///< first byte behind the last line
  bool cut() const;                          ///< the file continues after the first MiB

 private:
  std::string head_;
  std::size_t at_ = 0;
  int number_ = 0;
};

/// Whether a line contains bytes that do not occur in text.
bool is_binary(const std::string& line);

}  // namespace fastsplat::volume
