// SPDX-License-Identifier: Apache-2.0
// Removes folders from a report, which may be sent by mail: files are named in it, their folders are not.
#pragma once

#include "report/results.hpp"

namespace fastsplat::report {

/// `data` with every path outside the working folder (/a/b, ~/b, ../b, file:///a/b) cut to its last name, in all texts
/// and keys: whole texts, words of commands, quoted names, messages. Relative paths stay. If several folders hold files
/// of the same name, "folder-2/" and so on distinguish them, in order of first appearance.
Json without_folders(const Json& data);

/// The same of all results together, and of the names of their files. `file` stays, for messages on the terminal.
std::vector<Result> without_folders(const std::vector<Result>& results);

}  // namespace fastsplat::report
