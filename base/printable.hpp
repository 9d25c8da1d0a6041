// SPDX-License-Identifier: Apache-2.0
// Makes text safe for terminals and pages. File names and contents may have any bytes, some of which move the cursor,
// colour the screen or end a line.
#pragma once

#include <string>
#include <string_view>

namespace fastsplat {

/// `text` as one line: line ends and tabs become blanks; other control characters, and bytes that are not UTF-8, become
/// "\x1b". Visible characters stay.
std::string printable(std::string_view text);

/// The same for several lines; line ends and tabs stay.
std::string printable_lines(std::string_view text);

}  // namespace fastsplat
