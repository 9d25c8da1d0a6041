// SPDX-License-Identifier: Apache-2.0
// Common main() of the peers: registers and runs the lines; exits with 1 if pictures or words differ.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>
#include <exception>

namespace fastsplat::bench {

template <class Register>
int run_peer(int count, char** arguments, const Register& register_all) try {
  register_all();
  benchmark::Initialize(&count, arguments);
  if (benchmark::ReportUnrecognizedArguments(count, arguments)) return 2;
  benchmark::RunSpecifiedBenchmarks();
  benchmark::Shutdown();
  return 0;
} catch (const std::exception& problem) {
  std::fprintf(stderr, "peers: %s\n", problem.what());
  return 1;
}

}  // namespace fastsplat::bench
