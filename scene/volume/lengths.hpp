// SPDX-License-Identifier: Apache-2.0
// Lengths in headers of volumes: units, and replacements for an invalid spacing.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastsplat::volume {

/// Millimetres per `unit`, by the names and signs in use ("mm", "um", "micron", "metre"); nullopt for other words.
std::optional<double> mm_per_unit(std::string_view unit);

/// `declared` if positive, its absolute value if negative, 1 mm if zero or not a number.
double usable_length(double declared);

/// Adds a remark unless `declared`, the header's `name`, is a positive length; `used` mm replaces it.
void note_unusable_length(const std::string& name, double declared, double used, std::vector<std::string>& remarks);

}  // namespace fastsplat::volume
