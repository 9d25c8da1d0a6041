#include "cli/common.hpp"

namespace fastsplat::cli {

void declare(Options& options, Common& to) {
  options.group("Everywhere");
  options.word("--json", to.json, "FILE|-",
               "the result as JSON, to FILE or - for stdout (then stdout holds nothing else)");
  options.flag("--quiet", to.quiet, "errors only");
  options.integer("--threads", to.threads, 0, 1024, "N", "threads; 0 all cores; never changes a result");
}

}  // namespace fastsplat::cli
