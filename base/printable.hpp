// Text for terminals and pages: names of files and what files hold may have any bytes, of which some move the cursor,
// colour the screen or end a line.
#pragma once

#include <string>
#include <string_view>

namespace fastsplat {

/// One line: ends of lines and tabs become blanks; other control characters, and bytes that are not UTF-8, become
/// "\x1b". Visible characters stay.
std::string printable(std::string_view text);

/// The same of several lines, whose ends and tabs stay.
std::string printable_lines(std::string_view text);

}  // namespace fastsplat
