// SPDX-License-Identifier: Apache-2.0
// What parameter sweeps query from the program: the flags of subcommands, whether commands parse, content hashes.
#pragma once

#include <string>

#include "analysis/sweep/make.hpp"
#include "scene/scene.hpp"

namespace fastsplat::cli {

plan::Vocabulary plan_vocabulary();

/// The scene that the settings of a case describe.
scene::SceneDescription scene_of(const plan::Settings& settings);

/// UserError (Input) if the content behind the names of the plan's cases has changed since it was made: an edited file
/// or another program. The error asks to make `plan_file` again.
void require_content(const plan::Plan& plan, const std::string& plan_file);

/// An input that has changed since this process read it for the plan's hashes; empty if none has.
std::string changed_file();

/// Hash of the running program and its image library, so that results of different programs are never mixed.
std::string program_hash();

}  // namespace fastsplat::cli
