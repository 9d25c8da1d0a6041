// What a plan asks the program: which flags its verbs have, whether words make sense, what is behind names.
#pragma once

#include <string>

#include "analysis/sweep/make.hpp"

namespace fastsplat::cli {

plan::Vocabulary plan_vocabulary();

/// UserError (Input) where what is behind the names of a plan's cases is not what it was made of: an edited file,
/// another program. `plan_file` is named as the one to make again.
void require_content(const plan::Plan& plan, const std::string& plan_file);

/// Of the running program and its image library: results of one are never taken for those of another.
std::string program_hash();

}  // namespace fastsplat::cli
