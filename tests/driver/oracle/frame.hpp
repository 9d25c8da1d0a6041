// SPDX-License-Identifier: Apache-2.0
// From real splats to the records of a frame, written a second time from docs/numerics.md, section 8, and
// docs/stream.md alone. It loops over all tiles, sheets and splats, uses exact wide integers and shares nothing with
// the driver. Oracle and driver must produce the same words.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "tests/driver/oracle/given.hpp"
#include "tests/driver/oracle/tables.hpp"

namespace fastsplat::scene_oracle {

using Beat = std::array<std::uint32_t, 8>;

/// The frame is refused by the page.
struct Refused : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// Cases that occurred in a frame.
struct Met {
  std::uint64_t voxels = 0, vanished_voxels = 0, saturated_voxels = 0;
  std::uint64_t splat_records = 0, saturated_records = 0, sheets = 0;  ///< the counts that the driver reports too
  std::uint64_t radius_sets = 0;
  std::uint64_t several_sets = 0;     ///< frames with more than one
  std::uint64_t clamped_sets = 0;     ///< splats whose radius lies outside the bins
  std::uint64_t saturated_words = 0;  ///< V_c and v_c cut to their formats
  std::uint64_t cut_weights = 0;      ///< words of RADIAL cut to their format
  std::uint64_t odd_steps = 0;        ///< frames whose M was made even
  std::uint64_t rims_kept = 0;        ///< slices that i_0 = 0 or i_S = M changed
  std::uint64_t left_out = 0;         ///< slices of a splat that exists, with four zero words
  std::uint64_t beyond_E = 0;         ///< records with Ea that E does not have
  std::uint64_t other_tiles = 0;      ///< records of splats that also have some in an earlier tile
  std::uint64_t reordered = 0;        ///< neighbours in a sheet that are not in traversal order
  std::uint64_t empty_tiles = 0;
  std::uint64_t sets = 0;      ///< cull_blocks
  std::uint64_t ellipses = 0;  ///< voxels that are ellipse records
  std::uint64_t ellipse_records = 0;
  std::uint64_t thin_ellipses = 0;  ///< voxels that grew across
  std::uint64_t many_spans = 0;     ///< voxels of more than one ellipse record a tile
  std::uint64_t grown = 0;          ///< slices of kernels that grew in depth
  std::uint64_t carried_words = 0;  ///< words changed by the carry
};
struct MetName {
  const char* name;
  std::uint64_t Met::*member;
};
std::span<const MetName> met_names();
/// Occur only if splats have shapes.
bool is_of_ellipses(std::uint64_t Met::*member);

struct Frame {
  std::vector<Beat> preamble;            ///< begin_frame and tables
  std::vector<std::vector<Beat>> tiles;  ///< begin_tile .. end_tile
  Met met;
};

/// Throws Refused.
Frame compile(const Given& given);

Beat end_frame(const Frame& frame);

}  // namespace fastsplat::scene_oracle
