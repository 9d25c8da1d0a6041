// The one sentence that matters of each verb's result: the only place that knows which verbs can be reported.
#pragma once

#include <map>
#include <string>

#include "report/figures.hpp"

namespace fastsplat::report {

using SentenceOf = Verdict (*)(const Figures&);

/// By verb. Each throws UserError (Input) where a figure that it tells is missing.
const std::map<std::string, SentenceOf>& verdicts();

}  // namespace fastsplat::report
