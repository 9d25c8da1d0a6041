// SPDX-License-Identifier: Apache-2.0
// The configurations the tests run on: those of configs/*.toml, read here without the driver, and random legal ones.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cmodel/numbers/config.hpp"
#include "tests/cmodel/oracle/symbols.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::test {

/// "table.key" -> value of a file of `key = value` lines below [table] lines; texts keep their quotes.
std::map<std::string, std::string> read_keys(const std::string& path);

/// configs/<name>.toml. Throws std::runtime_error when a key is missing or a number is not one.
cmodel::Config named_config(const std::string& name);
/// The same with every sample composited.
cmodel::Config sampling(const std::string& name);
/// Names of all files in configs/.
std::vector<std::string> config_names();

/// As index.kind names it.
std::string name_of(cmodel::IndexKind kind);

oracle::Symbols symbols_of(const cmodel::Config& config);
cmodel::Config config_of(const oracle::Symbols& symbols, const std::string& name);

/// Legal, small enough to render quickly (tiles up to 40 pixels, up to 64 columns), otherwise arbitrary; one key in
/// three is at an end of its range. Another index.kind only on request; blit2d with or without symmetry.
cmodel::Config random_config(Random& random, cmodel::IndexKind kind = cmodel::IndexKind::Rlut);
/// The same with ellipses, so not linear.
cmodel::Config random_ellipse_config(Random& random, cmodel::IndexKind kind = cmodel::IndexKind::Rlut);
/// With densities, and one in three with ellipses as well (but not linear, which has none).
cmodel::Config random_density_config(Random& random, cmodel::IndexKind kind = cmodel::IndexKind::Rlut);

}  // namespace fastsplat::test
