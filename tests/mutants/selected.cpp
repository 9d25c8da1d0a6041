// SPDX-License-Identifier: Apache-2.0
// What fastsplat_mutant_pkg asks for, in a program of tests.
#include "tests/mutants/selected.hpp"

extern "C" int fastsplat_mutant() { return fastsplat_mutants::selected; }
