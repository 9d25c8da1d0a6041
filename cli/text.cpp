// --help, --version, help.
#include "cli/output.hpp"
#include "cli/verbs.hpp"

namespace fastsplat::cli {

ExitCode run(const TextArguments& arguments) {
  write_stdout(arguments.text);
  return ExitCode::Pass;
}

}  // namespace fastsplat::cli
