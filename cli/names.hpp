// SPDX-License-Identifier: Apache-2.0
// Built-in names on the command line.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastsplat::cli {

/// Whether `word` is a name and not a path: no folder, no extension (before a colon: "shells:1.5" is a name), and no
/// existing file.
bool is_name(const std::string& word);

/// Runs `resolve`, which looks up `word`. For names, its UserError (Input) becomes UserError (Usage): unknown names and
/// unsupported sizes are usage errors, problems with files remain input errors.
void as_word(const std::string& word, const std::function<void()>& resolve);

/// Throws the error of loading volume `word` if it is an unknown or invalid built-in name.
void check_volume_name(const std::string& word);

/// Values of --index.
std::vector<std::string> index_kinds();
/// Valid and ready patterns; a number follows those ending in "-".
std::vector<std::string> pattern_words();
/// The same and "all", for random streams.
std::vector<std::string> ready_words();
/// Classes of random streams, "all" first.
std::vector<std::string> stimulus_words();

}  // namespace fastsplat::cli
