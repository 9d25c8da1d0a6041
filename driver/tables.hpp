// The device's tables from the kernel: doubles in, loaded words out (docs/numerics.md, sections 4, 6 and 8).
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/config.hpp"
#include "cmodel/records.hpp"
#include "scene/kernel.hpp"

namespace fastsplat::driver {

/// RLUT of one radius set: `radius` in pixels, `base` its first column. Words in load_table order.
cmodel::LoadTable rlut_table(const cmodel::Config& config, std::uint32_t set, double radius, std::uint32_t base);

/// Radial table, U wi.wf, quantised with its sum preserved (largest remainder).
cmodel::LoadTable radial_table(const cmodel::Config& config, const scene::Kernel& kernel);

/// (1-exp(-tau))/tau at the G+1 segment ends, One.of.
cmodel::LoadTable factor_table(const cmodel::Config& config);

/// PHI: cumulative slice weights One.hf at steps of 2^-zf kernel units, M+1 words, M even.
std::vector<std::uint32_t> slice_table(const cmodel::Config& config, const scene::Kernel& kernel);

/// Values to words of `frac_bits`, each rounded down or up such that the sum is the rounded sum of the values;
/// the largest remainders go up, the first of equal ones first.
std::vector<std::uint32_t> quantise_preserving_sum(const std::vector<double>& values, int frac_bits);

}  // namespace fastsplat::driver
