// SPDX-License-Identifier: Apache-2.0
// A word of a command line as a shell reads it back.
#pragma once

#include <string>

namespace fastsplat {

/// Unchanged if every shell reads it as one plain word, else in single quotes.
std::string shell_word(const std::string& word);

}  // namespace fastsplat
