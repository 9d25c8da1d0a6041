// From a voxel's value to colour and opacity; presets and files in TOML (docs/guide.md, "Transfer functions").
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "scene/volume/volume.hpp"

namespace fastsplat::scene {

/// How control points' positions are read: raw voxel values, 0..1 of the volume's [min,max],
/// or 0..1 of the span between the 0.5 and 99.8 percentile of the non-minimum voxels (scanners without units: MRI).
enum class Domain { Value, Range, Percentile };

struct ControlPoint {
  double at = 0.0;       ///< in the domain
  glm::dvec3 colour{0};  ///< linear RGB, 0..1
  double opacity =
      0.0;  ///< of one reference length of this material, 0..1 (exclusive of 1 unless it is clamped: 1 -> 0.9999)
};

struct Shading {
  bool on = false;
  double ambient = 0.3, diffuse = 0.7, specular = 0.2, shininess = 20.0;
  double gradient_floor =
      0.0;  ///< gradient magnitudes below this fraction of the volume's range per kernel unit are not shaded
};

struct TransferFunction {
  std::string name;
  Domain domain = Domain::Range;
  double reference_length = 1.0;     ///< in kernel units (Volume::kernel_unit)
  std::vector<ControlPoint> points;  ///< ascending in `at`, linear between, clamped outside
  Shading shading;                   ///< preset's suggestion; scene.toml and flags override
};

/// The same in raw values of this volume.
TransferFunction resolved(const TransferFunction& tf, const volume::Volume& volume);

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
  /// Between the values that a volume stores, too.
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
