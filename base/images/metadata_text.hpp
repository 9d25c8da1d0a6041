// SPDX-License-Identifier: Apache-2.0
// How metadata are spelt in files: an entry each, named "fastsplat:<key>", or lines of the picture's description.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "base/images/image_file.hpp"

namespace fastsplat::images {

inline constexpr std::string_view kEntryPrefix = "fastsplat:";

/// The key of an entry of this name; empty if it is not ours.
std::optional<std::string> metadata_key(std::string_view name);

/// The entries as lines "fastsplat:key=value", with line breaks written as \n and \r.
std::string metadata_lines(const Metadata& metadata);
/// Adds what such lines hold.
void read_metadata_lines(std::string_view description, Metadata& metadata);

/// Entries that a PNG cannot hold by themselves: without a value, or with a carriage return.
Metadata only_as_lines(const Metadata& metadata);

}  // namespace fastsplat::images
