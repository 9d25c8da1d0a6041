// SPDX-License-Identifier: Apache-2.0
// Shared by all fuzz targets: the input as a file, and the permitted outcomes of reading it.
#pragma once

#include <unistd.h>

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <span>
#include <string>

#include "base/error.hpp"

namespace fastsplat::fuzz {

using Bytes = std::span<const std::uint8_t>;

/// A finding: libFuzzer keeps the input.
[[noreturn]] inline void finding(const std::string& what) {
  std::fprintf(stderr, "finding: %s\n", what.c_str());
  std::abort();
}

/// Removes and returns the first byte, or 0 after the last.
inline std::uint8_t take_byte(Bytes& bytes) {
  if (bytes.empty()) return 0;
  const std::uint8_t first = bytes.front();
  bytes = bytes.subspan(1);
  return first;
}

/// Writes the bytes to a file in this process's own folder; the path is the same for the same ending.
inline std::filesystem::path file_of(Bytes bytes, const std::string& ending) {
  static const std::filesystem::path folder = [] {
    auto path = std::filesystem::temp_directory_path() / ("fastsplat-fuzz-" + std::to_string(::getpid()));
    std::filesystem::create_directories(path);
    return path;
  }();
  const std::filesystem::path path = folder / ("input" + ending);
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!file.flush()) {
    std::fprintf(stderr, "cannot write %s\n", path.c_str());
    std::exit(70);
  }
  return path;
}

/// Runs `read`: it returns, or refuses the input in one line as an input or usage error. Any other exception, code or
/// form of the line is a finding, and so are the sanitizers' reports. True if it returned.
template <class Read>
bool answered(Read&& read) {
  try {
    read();
    return true;
  } catch (const UserError& error) {
    const std::string line = error.what();
    if (line.empty() || line.find('\n') != std::string::npos) finding("a message that is not one line: " + line);
    if (error.code() != ExitCode::Input && error.code() != ExitCode::Usage) finding("exit code of: " + line);
    return false;
  }
}

}  // namespace fastsplat::fuzz

/// libFuzzer's entry, one in each target.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);
