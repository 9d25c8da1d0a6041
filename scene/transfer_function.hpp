// SPDX-License-Identifier: Apache-2.0
// Maps a voxel's value to colour and opacity; presets and files in TOML (docs/guide/transfer-functions.md).
#pragma once

#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "scene/volume/volume.hpp"

namespace fastsplat::scene {

/// The unit of control points' positions (value_range.hpp).
enum class Domain {
  Value,       ///< raw voxel values
  Range,       ///< 0..1 of the volume's [min,max]
  Percentile,  ///< 0..1 of shown_span(), for scanners without units (MRI)
  Hounsfield,  ///< HU, by Volume::water; for volumes without it -1000..3000 HU are the volume's [min,max]
  Content,     ///< 0..1 from background_top() to the volume's max
};

struct ControlPoint {
  double at = 0.0;       ///< in the domain
  glm::dvec3 colour{0};  ///< linear RGB, 0..1
  double opacity = 0.0;  ///< of one reference length of this material, 0..1 (1 is clamped to 0.9999)
  bool operator==(const ControlPoint&) const = default;
};

struct Shading {
  bool on = false;
  double ambient = 0.3, diffuse = 0.7, specular = 0.2, shininess = 20.0;
  double gradient_floor = 0.0;  ///< gradient magnitudes below this fraction of spread() per kernel unit are not shaded
  bool operator==(const Shading&) const = default;
};

struct TransferFunction {
  std::string name;
  Domain domain = Domain::Range;
  double reference_length = 1.0;                ///< in kernel units (Volume::kernel_unit)
  std::optional<double> reference_length_mm{};  ///< used instead if present, in millimetres
  std::vector<ControlPoint> points;             ///< ascending in `at`, linear between, clamped outside
  Shading shading;                              ///< preset's suggestion; scene.toml and flags override
  bool operator==(const TransferFunction&) const = default;
};

/// `tf` in raw values and kernel units of this volume.
TransferFunction resolved(const TransferFunction& tf, const volume::Volume& volume);

/// A remark for the user about a transfer function on this volume, a sentence; "" without one.
std::string remark_on(const TransferFunction& tf, const volume::Volume& volume);

/// Colour and extinction per kernel unit, at a raw value.
struct Material {
  glm::vec3 colour{0};
  float extinction = 0.0f;  ///< -ln(1-opacity)/reference_length
};

/// A transfer function bound to a volume: domain resolved, tabulated. For 8/16-bit volumes exact per value;
/// for float volumes evaluated directly.
class Classifier {
 public:
  Classifier(const TransferFunction& tf, const volume::Volume& volume);
  Material operator()(float value) const;
  /// Also valid between the values that a volume stores.
  Material evaluate(double value) const;
  /// Whether no value of [low, high] has any opacity.
  bool transparent(double low, double high) const;

 private:
  std::vector<ControlPoint> points_;  // `at` in raw values
  double reference_length_ = 1.0;
  float table_min_ = 0.0f;
  std::vector<Material> table_;  // empty for float volumes
};

/// A preset by name, or a TOML file by path. Unknown names suggest the nearest; file errors carry line and column.
TransferFunction load_transfer_function(const std::string& name_or_path);
std::vector<std::string> transfer_function_presets();

}  // namespace fastsplat::scene
