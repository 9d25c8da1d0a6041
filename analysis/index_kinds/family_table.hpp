// SPDX-License-Identifier: Apache-2.0
// Compares all index kinds over grids, radii and table lengths, measured and predicted.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "analysis/index_kinds/family_cost.hpp"
#include "analysis/index_kinds/weight_field.hpp"

namespace fastsplat::analysis {

/// Ranges of the table, for kernel gauss2 (a = R = 2). Kinds without a radial table have a single length.
struct FamilyRange {
  std::vector<cmodel::IndexKind> kinds;
  std::vector<int> grids;    ///< k: steps a pixel of the centres' grid, snapped or not
  std::vector<int> radii;    ///< pixels
  std::vector<int> entries;  ///< N
  bool timed = false;        ///< with nanoseconds, which differ from run to run
};
/// k 4..64, radii 2, 4 and 8, N 64..2048.
FamilyRange whole_family();

/// Why a figure is more than twice, or less than half, its prediction.
enum class Remark {
  TableSteps,   ///< turned rms: the table's steps, which the law of the snap leaves out
  Ripple,       ///< aligned largest: the grid moves the whole lattice, and the field is not quite constant
  Field,        ///< aligned largest: the law holds for one splat; a field's steps add up to sqrt(pi a) R / (2N)
  Padding,      ///< bits: footprints of whole windows, words of the device's widths
  Unexplained,  ///< none of these; should not occur
};

struct FamilyCell {
  cmodel::Config config;
  int radius = 0;  ///< pixels
  bool has_table = false;
  FieldError aligned, turned;
  double snap_rms = 0.0, index_max = 0.0;  ///< predicted, 1/255
  std::uint64_t bits = 0;
  double bits_predicted = 0.0;
  Operations operations;
  std::uint64_t cycles = 0;
  double nanoseconds = 0.0;     ///< 0 where not timed
  std::vector<Remark> remarks;  ///< empty where no figure is off
};

/// `base` with another index: centres on a grid of `grid` steps, footprints of `radius` pixels, N entries.
cmodel::Config family_config(cmodel::IndexKind kind, int grid, int radius, int entries);

std::vector<FamilyCell> family_table(const FamilyRange& range);

/// "linear"
std::string name_of(cmodel::IndexKind kind);
/// The kind of that name. Throws UserError (Usage) that lists the names.
cmodel::IndexKind kind_of(const std::string& name);

char letter(Remark remark);
/// Meaning of the letter.
std::string sentence(Remark remark);

}  // namespace fastsplat::analysis
