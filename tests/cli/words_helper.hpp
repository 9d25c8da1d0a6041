// SPDX-License-Identifier: Apache-2.0
// Joins words of a command line.
#pragma once

#include <string>
#include <vector>

namespace fastsplat::cli_test {

using Words = std::vector<std::string>;

inline Words with(Words words, const Words& more) {
  words.insert(words.end(), more.begin(), more.end());
  return words;
}

/// A scene that takes no time.
inline const Words kSmall{"--volume", "shells:12", "--size", "24"};

}  // namespace fastsplat::cli_test
