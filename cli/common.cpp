// SPDX-License-Identifier: Apache-2.0
#include "cli/common.hpp"

namespace fastsplat::cli {

void declare(Options& options, Common& to) {
  options.group("Everywhere");
  options.word("--json", to.json, "FILE|-",
               "write the result as JSON to FILE, or to stdout (-), which then holds nothing else");
  options.flag("--quiet", to.quiet, "print errors only");
  options.integer("--threads", to.threads, 0, 1024, "N",
                  "number of threads; 0: all cores; results do not depend on it");
}

}  // namespace fastsplat::cli
