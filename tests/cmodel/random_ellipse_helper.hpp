// SPDX-License-Identifier: Apache-2.0
// Random legal ellipse records: shapes as from a driver, from thin to round, and words that no driver makes, up to the
// limits of rule 18.
#pragma once

#include "tests/cmodel/oracle/ellipse.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::test {

/// Shape and windows around a given centre (x, y); tag and colours are unchanged.
void random_shape(const oracle::Symbols& c, Random& random, oracle::Ellipse& ellipse);

}  // namespace fastsplat::test
