// SPDX-License-Identifier: Apache-2.0
// Reads the project's source as text: its files, their includes, and the words outside comments.
#pragma once

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace fastsplat::architecture {

struct SourceFile {
  std::string path;  ///< relative to the root, "cmodel/model.cpp"
  std::string text;
  bool is_header() const { return path.ends_with(".hpp") || path.ends_with(".h"); }
};

inline const std::set<std::string> kCpp{".cpp", ".hpp", ".cc", ".h", ".inc"};
inline const std::set<std::string> kSystemVerilog{".sv", ".svh"};

/// Files below root/<folder> with one of the endings.
std::vector<SourceFile> read_sources(const std::filesystem::path& root, const std::vector<std::string>& folders,
                                     const std::set<std::string>& endings = kCpp);

/// Comments become blanks and the contents of strings vanish; line numbers stay.
std::string without_comments(const std::string& text);

struct Include {
  std::string target;  ///< as written, without quotes or brackets
  int line;
};
std::vector<Include> includes_of(const std::string& text);

struct Word {
  std::string text;
  int line;
};
/// Identifiers, keywords and numeric literals outside comments and strings; include lines contribute their target's
/// parts.
std::vector<Word> words_of(const std::string& text);

/// room -> rooms it may include (itself always). A room is a folder, or a sub-folder that has an entry of its own; a
/// file belongs to the deepest room that holds it.
using Arrows = std::map<std::string, std::set<std::string>>;

/// The deepest room of `arrows` that holds `path`; empty if none does.
std::string room_of(const std::string& path, const Arrows& arrows);

/// "cmodel/x.cpp:3: includes scene/scene.hpp; cmodel may include base", one per offence. `checked` counts project
/// includes seen.
std::vector<std::string> arrow_offences(const std::vector<SourceFile>& files, const Arrows& arrows, int& checked);

/// Include cycles, as "a.hpp -> b.hpp -> a.hpp"; empty without cycles.
std::string include_ring(const std::vector<SourceFile>& files);

/// Words that an integer device must not contain.
std::vector<std::string> device_word_offences(const std::vector<SourceFile>& files, int& checked);

}  // namespace fastsplat::architecture
