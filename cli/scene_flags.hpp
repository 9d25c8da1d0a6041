// SPDX-License-Identifier: Apache-2.0
// From flags to a scene: flags override the file; everything is checked before reading data or allocating.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "cli/options.hpp"
#include "scene/sequence.hpp"
#include "scene/volume/volume_file.hpp"

namespace fastsplat::cli {

/// A scene: a file, flags, or both. Absent flags keep the file's or the default value.
struct SceneFlags {
  std::optional<std::string> file, volume, transfer_function, kernel, size;
  std::optional<double> nan_as;
  bool perspective = false, orthographic = false;
  /// Flags generated from scene::settings() ("--slab-width") and their validated texts.
  std::map<std::string, std::string> settings;
  bool operator==(const SceneFlags&) const = default;
};

void declare(Options& options, SceneFlags& to);

/// --nan-as, for all subcommands that read volumes.
void declare_nan_as(Options& options, std::optional<double>& to);
volume::ReadOptions reading(const std::optional<double>& nan_as);

/// UserError if a flag or a key of the file has no effect on the scene or on any frame of `sequence`. A key may also
/// have its effect in the file's own scene, before the flags apply.
scene::SceneDescription describe(const SceneFlags& flags, const scene::Sequence* sequence = nullptr);

/// UserError (Usage) for pictures that cannot fit in memory: engines hold several frames of doubles or words.
void check_memory(int width, int height);

/// UserError (Usage) for display-only flags, for subcommands that write no picture. Display keys of a file are
/// accepted.
void refuse_display(const SceneFlags& flags);

/// Reads the volume and resolves all names.
scene::Scene build(const SceneFlags& flags);

/// One line: "ch2bet 181x217x181, mri-head, image_aligned, 512x512".
std::string summary(const scene::Scene& scene);

}  // namespace fastsplat::cli
