// Words of the command line that name what is built in.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastsplat::cli {

/// A name, and no path: no folder and no ending in it (before a colon: "shells:1.5" is a name), and no such file.
bool is_name(const std::string& word);

/// Runs `resolve`, which looks up `word`. What is wrong with a file is Input; a name that there is none of, or that
/// takes no such size, is a command line that makes no sense: Usage.
void as_word(const std::string& word, const std::function<void()>& resolve);

/// A volume of the command line: throws as loading it would where its name alone is wrong.
void check_volume_name(const std::string& word);

/// What --index may name.
std::vector<std::string> index_kinds();
/// Patterns of beats; those that end in "-" go on with a number.
std::vector<std::string> pattern_words();
/// ... and "all", of streams that are random.
std::vector<std::string> ready_words();
/// Classes of random streams, "all" first.
std::vector<std::string> stimulus_words();

}  // namespace fastsplat::cli
