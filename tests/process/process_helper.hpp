// SPDX-License-Identifier: Apache-2.0
// The built program as a user runs it: arguments in; stdout, stderr, exit code and files out.
#pragma once

#include <sys/resource.h>
#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace fastsplat::cli_test {

/// A fresh folder under the system's temporary folder, removed with all it holds.
class TempFolder {
 public:
  TempFolder();
  ~TempFolder();
  TempFolder(const TempFolder&) = delete;
  TempFolder& operator=(const TempFolder&) = delete;

  const std::filesystem::path& path() const { return path_; }
  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  /// Names of everything in it, hidden files too, sorted.
  std::vector<std::string> entries() const;
  /// Writes `bytes` to a file in it; its path.
  std::string write(const std::string& name, const std::string& bytes) const;

 private:
  std::filesystem::path path_;
};

std::string read_bytes(const std::filesystem::path& path);

struct Surroundings {
  std::filesystem::path folder;          ///< working directory; empty: the tests'
  std::vector<std::string> environment;  ///< "NAME=value" added or replaced
  std::optional<rlim_t> largest_file;    ///< RLIMIT_FSIZE
  std::optional<std::string> stdout_to;  ///< a path instead of the captured pipe
  bool stdin_closed = false, stdout_closed = false, stderr_closed = false;
  int stop_reading_after = -1;  ///< closes the stdout pipe after this many bytes, as `| head` does
  int signal = 0;               ///< sent once `when` returns true
  std::function<bool(pid_t)> when;
};

struct Result {
  int code = -1;   ///< exit code; -1 when a signal ended it
  int signal = 0;  ///< that signal
  bool timed_out = false;
  std::string out, err;
};

/// Runs `words` (the program first) to its end, at most two minutes.
Result run_words(const std::vector<std::string>& words, const Surroundings& surroundings = {});
/// True once the process handles `signal`: before that, any signal ends it.
bool handles_signal(pid_t process, int signal);
/// The fastsplat of this build.
Result fastsplat(const std::vector<std::string>& arguments, const Surroundings& surroundings = {});
std::string program();

/// A failure a user can act on: the exit code, nothing on stdout, one line on stderr that holds `words` and a fix.
void expect_error(const Result& result, int code, const std::vector<std::string>& words);
/// Exit code 0 and no error line.
void expect_success(const Result& result);

/// A tiny file system of `bytes`, if this process may mount one.
class TinyDisk {
 public:
  TinyDisk(const std::filesystem::path& folder, int bytes);
  ~TinyDisk();
  TinyDisk(const TinyDisk&) = delete;
  TinyDisk& operator=(const TinyDisk&) = delete;
  bool mounted() const { return mounted_; }
  const std::string& reason() const { return reason_; }

 private:
  std::filesystem::path folder_;
  bool mounted_ = false;
  std::string reason_;
};

}  // namespace fastsplat::cli_test
