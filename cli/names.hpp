// Words of the command line that name what is built in.
#pragma once

#include <functional>
#include <string>

namespace fastsplat::cli {

/// A name, and no path: no folder and no ending in it (before a colon: "shells:1.5" is a name), and no such file.
bool is_name(const std::string& word);

/// Runs `resolve`, which looks up `word`. What is wrong with a file is Input; a name that there is none of, or that
/// takes no such size, is a command line that makes no sense: Usage.
void as_word(const std::string& word, const std::function<void()>& resolve);

/// A volume of the command line: throws as loading it would where its name alone is wrong.
void check_volume_name(const std::string& word);

}  // namespace fastsplat::cli
