// Parses, calls, maps errors to exit codes (docs/guide.md, "Exit codes").
#include <exception>
#include <new>
#include <string>
#include <variant>

#include "base/error.hpp"
#include "cli/output.hpp"
#include "cli/process.hpp"
#include "cli/verbs.hpp"

int main(int argc, char** argv) {
  using namespace fastsplat;
  try {
    cli::prepare_process();
    const auto command = cli::parse(argc, argv);
    return static_cast<int>(std::visit([](const auto& arguments) { return cli::run(arguments); }, command));
  } catch (const UserError& error) {
    cli::print_error(error.what());
    return static_cast<int>(error.code());
  } catch (const std::bad_alloc&) {
    cli::print_error("not enough memory for this; use a smaller volume or --size");
    return static_cast<int>(ExitCode::Input);
  } catch (const std::exception& error) {
    cli::print_error(std::string("internal: ") + error.what() + "; please report it with the command line");
    return static_cast<int>(ExitCode::Internal);
  } catch (...) {
    cli::print_error("internal: unknown exception; please report it with the command line");
    return static_cast<int>(ExitCode::Internal);
  }
}
