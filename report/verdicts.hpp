// SPDX-License-Identifier: Apache-2.0
// The one-sentence verdict of each subcommand's result. Only this table defines which subcommands have reports.
#pragma once

#include <map>
#include <string>

#include "report/figures.hpp"

namespace fastsplat::report {

using SentenceOf = Verdict (*)(const Figures&);

/// By subcommand. Each throws UserError (Input) if a figure that it uses is missing.
const std::map<std::string, SentenceOf>& verdicts();

}  // namespace fastsplat::report
