// SPDX-License-Identifier: Apache-2.0
// Random draws whose order C++ leaves open.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_helper.hpp"

namespace fastsplat::architecture {

/// "scene/x.cpp:3: two draws in no defined order", where a generator draws in two arguments of a call or in two
/// operands of an operator. Braces, statements, && || ?: and shifts have an order. `draws`: those seen.
std::vector<std::string> draw_offences(const std::vector<SourceFile>& files, int& draws);

}  // namespace fastsplat::architecture
