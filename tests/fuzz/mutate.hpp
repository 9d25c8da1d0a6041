// SPDX-License-Identifier: Apache-2.0
// Inputs for the targets without libFuzzer: seeds, and seeded random changes of them.
#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

namespace fastsplat::fuzz {

using Input = std::vector<std::uint8_t>;

/// The files of a folder, by name.
std::vector<Input> inputs_in(const std::filesystem::path& folder);

/// A pure function of seeds and number: one of the seeds with one to four changes (bits, bytes, numbers at their
/// limits, pieces left out, doubled, taken from another seed). At most 8192 bytes.
Input mutated(const std::vector<Input>& seeds, std::uint64_t number);

/// Structures on which text readers recurse, or which they hold twice. These are long dotted keys and headers, deep
/// arrays and tables of TOML and JSON, and names and strings of a megabyte. Each comes after every first byte by which
/// targets choose a reader.
std::vector<Input> hard_texts();

}  // namespace fastsplat::fuzz
