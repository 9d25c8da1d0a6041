// SPDX-License-Identifier: Apache-2.0
// The lines of an NRRD header: teem's fields by teem's names, keys of the user, names of data files.
#pragma once

#include "scene/volume/text_header.hpp"

namespace fastsplat::volume {

/// Reads the header up to and including its blank line, or the whole of a detached one. Fields are under teem's names,
/// whichever of teem's spellings the file has. Throws UserError (Input) for unknown fields and versions.
TextHeader read_nrrd_lines(const std::filesystem::path& path);

}  // namespace fastsplat::volume
