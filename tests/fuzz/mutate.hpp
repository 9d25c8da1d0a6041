// Inputs for the targets without libFuzzer: seeds, and what a seeded chance makes of them.
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

}  // namespace fastsplat::fuzz
