// From flags to a scene: file first, flags over it, everything checked before anything is read or allocated.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "cli/options.hpp"
#include "scene/sequence.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {

/// A scene: a file, single flags, or a file overridden by flags. Absent ones leave the file's or the default value.
struct SceneFlags {
  std::optional<std::string> file, volume, transfer_function, kernel, size;
  std::optional<double> nan_as;
  bool perspective = false, orthographic = false;
  /// The flags made from scene::settings() ("--slab-width"), with their texts, which have no problem.
  std::map<std::string, std::string> settings;
  bool operator==(const SceneFlags&) const = default;
};

void declare(Options& options, SceneFlags& to);

/// --nan-as, wherever volumes are read.
void declare_nan_as(Options& options, std::optional<double>& to);
volume::ReadOptions reading(const std::optional<double>& nan_as);

/// UserError where a flag, or a key of the file, changes nothing: neither in the scene nor in any frame of `sequence`.
/// A key may also have its meaning in the file's own scene, before the flags.
scene::SceneDescription describe(const SceneFlags& flags, const scene::Sequence* sequence = nullptr);

/// UserError (Usage) for flags that only say how a picture is shown, of a verb that makes none. A file's keys stay: the
/// scene is the same.
void refuse_display(const SceneFlags& flags);

/// Reads the volume and resolves all names.
scene::Scene build(const SceneFlags& flags);

/// One line: "ch2bet 181x217x181, mri-head, image_aligned, 512x512".
std::string summary(const scene::Scene& scene);

}  // namespace fastsplat::cli
