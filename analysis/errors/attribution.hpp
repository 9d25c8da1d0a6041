// Because of which step is the device's picture not golden's (docs/errors.md, section 2).
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "analysis/pipeline/chain.hpp"
#include "analysis/pipeline/step.hpp"
#include "base/progress.hpp"

namespace fastsplat::analysis {

/// Of a signed error over all values of a picture, all four channels alike; 1.0 is full scale.
struct Amount {
  double rms = 0.0, greatest = 0.0, bias = 0.0;  ///< greatest: of magnitudes
};
Amount amount_of(const stages::Picture& error);
/// a - b, value by value.
stages::Picture difference(const stages::Picture& a, const stages::Picture& b);
/// A part d of the whole error e has the share E[d e] / E[e^2]: not centred, since bias is error too. 0 if the error is
/// 0.
double share_of(const stages::Picture& part, const stages::Picture& error);

/// Shares are share_of() the whole error.
struct StepError {
  stages::StepSet set;
  double share = 0.0;  ///< of its increment, see Attribution::increments
  Amount increment;
  double only_share = 0.0;  ///< of the error where this step alone is the device's
  Amount only;
  Amount without;             ///< the error that is left where this step alone is real
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
  bool quick = false;  ///< no step alone, none left out
  stages::Picture real, device;
  Amount total;
  Amount floor8, floor16;        ///< of rounding the real picture once to 8 and to 16 bits
  std::vector<StepError> steps;  ///< in pipeline order; their shares add up to 1, or are all 0 where there is no error
  double driver_share = 0.0, device_share = 0.0, both_share = 0.0;
  double only_remainder = 0.0;  ///< 1 less the sum of only_share
  std::vector<GroupShare> groups;
  /// Step by step, what it changes when it becomes the device's after all before it: they add up to the error.
  std::vector<stages::Picture> increments;
  std::vector<int> blame;  ///< per pixel the step with the largest part of its error, -1 where there is none
  std::vector<PixelStory> stories;
  int chains = 0;  ///< frames computed
};

struct AttributionOptions {
  bool quick = false;    ///< increments only: a third of the frames
  bool shapley = false;  ///< over the groups: of five 30 frames more, of six 62
  int threads = 0;       ///< 0: all cores; never changes the result
  Progress progress{};   ///< counts frames
};

Attribution attribute(const stages::Chain& chain, const AttributionOptions& options = {});

}  // namespace fastsplat::analysis
