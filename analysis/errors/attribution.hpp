// SPDX-License-Identifier: Apache-2.0
// Attributes the device's error, or that of floats, to the steps of the pipeline (docs/errors.md, section 2).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/pipeline/chain.hpp"
#include "analysis/pipeline/step.hpp"
#include "base/progress.hpp"

namespace fastsplat::analysis {

/// Figures of a signed error over all values of a picture, all four channels alike; 1.0 is full scale.
struct Amount {
  double rms = 0.0, greatest = 0.0, bias = 0.0;  ///< greatest: largest magnitude
};
Amount amount_of(const stages::Picture& error);
/// a - b, value by value.
stages::Picture difference(const stages::Picture& a, const stages::Picture& b);
/// The share E[d e] / E[e^2] of a part d in the whole error e: not centred, since bias is error too. 0 if the error is
/// 0.
double share_of(const stages::Picture& part, const stages::Picture& error);

/// Shares are share_of() the whole error.
struct StepError {
  stages::StepSet set;
  double share = 0.0;  ///< of its increment, see Attribution::increments
  Amount increment;
  double only_share = 0.0;  ///< of the error with this step alone on the device
  Amount only;
  Amount without;             ///< the error that remains with this step alone real
  double pixels_ruled = 0.0;  ///< share of the pixels with an error, see Attribution::blame
};

struct PixelStory {
  const char* which = "";  ///< "median", "p90", "worst"
  int x = 0, y = 0, channel = 0;
  double error = 0.0;
  std::vector<std::pair<std::string, double>> parts;  ///< the steps' increments there, largest first
};

struct GroupShare {
  std::string name;
  double share = 0.0;  ///< Shapley value; all add up to 1
};

struct Attribution {
  bool quick = false;  ///< without `only` and `without`
  std::optional<stages::FloatNumbers> floats{};  ///< what `device` and the steps are of, if not the device's integers
  stages::Picture real, device;
  Amount total;
  Amount floor8, floor16;        ///< of rounding the real picture once to 8 and to 16 bits
  std::vector<StepError> steps;  ///< in pipeline order; their shares add up to 1, or are all 0 without an error
  double driver_share = 0.0, device_share = 0.0, both_share = 0.0;
  double only_remainder = 0.0;  ///< 1 less the sum of only_share
  std::vector<GroupShare> groups;
  /// Per step, the change of the picture when it joins all earlier steps on the device. They add up to the error.
  std::vector<stages::Picture> increments;
  std::vector<int> blame;  ///< per pixel the step with the largest part of its error; -1: no error
  std::vector<PixelStory> stories;
  int chains = 0;  ///< frames computed
};

struct AttributionOptions {
  bool quick = false;    ///< increments only: a third of the frames
  /// Of floats with these numbers instead of the device.
  std::optional<stages::FloatNumbers> floats{};
  bool shapley = false;  ///< of the groups: 30 more frames for five groups, 62 for six
  int threads = 0;       ///< 0: all cores; never changes the result
  Progress progress{};   ///< counts frames
};

Attribution attribute(const stages::Chain& chain, const AttributionOptions& options = {});

}  // namespace fastsplat::analysis
