// SPDX-License-Identifier: Apache-2.0
// Seeded legal streams with random tables, in named classes, each made to reach one corner of the device.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "testbench/stimulus/stream_document.hpp"

namespace fastsplat::testbench {

enum class StimulusClass {
  Mixed,             ///< anything legal
  TableCorners,      ///< RLUT words 0, just inside, at the edge; sums on both sides of the last radial entry
  RoundingTies,      ///< products that lie exactly between two words, in every rounding
  Saturation,        ///< each channel alone and all, in product, sum, slab, picture and output
  Thresholds,        ///< transmittances beside the early-termination threshold, sums beside the largest word
  BankPhases,        ///< every window origin modulo P, in both axes
  ScreenEdges,       ///< windows across each edge and corner of partial tiles
  Hazards,           ///< the same words again after 1, 2, 3, ... windows
  SwapHazards,       ///< the same words at the end of a sheet and the start of the next
  SwapPhases,        ///< sheets of 0, 1, 2, ... splats: the swap meets every phase of splatting and compositing
  EmptySheets,       ///< sheets and tiles with nothing in them
  OffTile,           ///< sheets whose splats all miss the tile
  SparseSheets,      ///< few splats far apart: the compositor is the slower side
  MultiWindow,       ///< footprints of many windows
  PositionExtremes,  ///< centres at and near both ends of the position format
  Bubbles,           ///< the source pauses
  BackPressure,      ///< the sink pauses
  Reset,             ///< a warm reset in the middle, then the whole stream
};
const std::vector<StimulusClass>& stimulus_classes();
const char* to_string(StimulusClass which);
const char* meaning(StimulusClass which);
StimulusClass stimulus_class_from(const std::string& name);  ///< throws UserError (Usage)

struct Stimulus {
  StreamDocument document;
  std::string ready, input;       ///< patterns that the class needs; empty: the user's
  std::uint64_t reset_after = 0;  ///< beats before a warm reset; 0: none
};

/// About `splats` splats. A pure function of its arguments.
Stimulus make_stimulus(const cmodel::Config& config, StimulusClass which, std::uint64_t seed, std::uint64_t splats);

}  // namespace fastsplat::testbench
