// The verbs: each carries out its arguments and returns the exit code; what goes wrong is a UserError.
#pragma once

#include "base/error.hpp"
#include "cli/arguments.hpp"

namespace fastsplat::cli {

ExitCode run(const TextArguments& arguments);
ExitCode run(const RenderArguments& arguments);
ExitCode run(const CompareArguments& arguments);
ExitCode run(const VolumeInfoArguments& arguments);
ExitCode run(const VolumeConvertArguments& arguments);
ExitCode run(const StreamRecordArguments& arguments);
ExitCode run(const StreamDumpArguments& arguments);
ExitCode run(const StreamReplayArguments& arguments);
ExitCode run(const CyclesArguments& arguments);
ExitCode run(const ConfigListArguments& arguments);
ExitCode run(const ConfigShowArguments& arguments);
ExitCode run(const ConfigCheckArguments& arguments);
ExitCode run(const DoctorArguments& arguments);
ExitCode run(const VerifyArguments& arguments);

}  // namespace fastsplat::cli
