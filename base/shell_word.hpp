// A word of a command line as a shell reads it back.
#pragma once

#include <string>

namespace fastsplat {

/// As it is where no shell takes it for anything else; in single quotes otherwise.
std::string shell_word(const std::string& word);

}  // namespace fastsplat
