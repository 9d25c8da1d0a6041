// SPDX-License-Identifier: Apache-2.0
// How good a picture has to be: "psnr>=50", "max<=1", "rms<=0.1"; in LSB of 8 bits, as compare counts
// (docs/compare.md). How fast it has to be drawn: "fps>=60".
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/image.hpp"

namespace fastsplat::analysis {

/// compare's figures of the same name: over all values of all channels alike, alpha too.
struct Fidelity {
  double rms_lsb = 0.0, max_lsb = 0.0;
  double psnr_db() const;  ///< +inf if rms_lsb is 0
  bool operator==(const Fidelity&) const = default;
};
/// Throws UserError (NotComparable) if sizes differ.
Fidelity fidelity(const Image& ref, const Image& test, int threads);

struct Target {
  enum class Figure { Psnr, Max, Rms } figure = Figure::Psnr;
  double limit = 0.0;
  std::string text;  ///< as it was given

  bool met(const Fidelity& of) const;
  /// Error / allowed error: at most 1 if the target is met, up to the last bit of a double.
  double excess(const Fidelity& of) const;
  /// "PSNR 50.32 dB", "max 0.83 LSB8", "RMS 0.0921 LSB8"
  std::string reached(const Fidelity& of) const;
};

/// Targets that hold together.
struct Targets {
  std::vector<Target> pictures;  ///< empty: any picture is good enough
  std::optional<double> fps;     ///< frames a second
  std::string fps_text;          ///< as it was given

  bool met(const Fidelity& of) const;
  /// The greatest of all; 0 without any.
  double excess(const Fidelity& of) const;
  std::string text() const;                       ///< "psnr>=50, max<=4, fps>=60"
  std::string reached(const Fidelity& of) const;  ///< "PSNR 50.32 dB, max 3.2 LSB8"; empty without any
};

/// "psnr>=50", "fps>=60"; each figure at most once, and at least one. Throws UserError (Usage) that names --target.
Targets parse_targets(const std::vector<std::string>& texts);

}  // namespace fastsplat::analysis
