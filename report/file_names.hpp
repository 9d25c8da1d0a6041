// A report is sent by mail: files are named in it, the folders in which they lay are not.
#pragma once

#include "report/results.hpp"

namespace fastsplat::report {

/// `data` with every path that tells a folder outside of the working one (/a/b, ~/b, ../b, file:///a/b) cut to its last
/// name, in every text and key: whole texts, words of commands, quoted names, messages. Relative paths stay. Where two
/// folders hold files of one name, "folder-2/" and so on tell them apart, by first appearance.
Json without_folders(const Json& data);

}  // namespace fastsplat::report
