// SPDX-License-Identifier: Apache-2.0
// Random legal ellipse records: shapes as a driver would make them, from thin to round, and words that none would, up
// to the edges of rule 18.
#pragma once

#include "tests/cmodel/oracle/ellipse.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::test {

/// Shape and windows around a centre (x, y) that is given; tag and colours are left as they are.
void random_shape(const oracle::Symbols& c, Random& random, oracle::Ellipse& ellipse);

}  // namespace fastsplat::test
