// SPDX-License-Identifier: Apache-2.0
// Random draws whose order C++ does not define.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_helper.hpp"

namespace fastsplat::architecture {

/// "scene/x.cpp:3: two draws in no defined order" for two draws in two arguments of a call or in two operands of an
/// operator. Braces, statements, && || ?: and shifts have an order. `draws`: number of draws seen.
std::vector<std::string> draw_offences(const std::vector<SourceFile>& files, int& draws);

}  // namespace fastsplat::architecture
