// SPDX-License-Identifier: Apache-2.0
// Describes a subcommand: its flags, their values, examples. Help, man pages and shell completion are generated from
// it.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastsplat::cli {

/// Called only when the values are needed, never on an ordinary run.
using Values = std::function<std::vector<std::string>()>;

/// A flag, or a positional argument.
struct Flag {
  std::vector<std::string> names;  ///< "-o", "--out"; a positional argument has one name, without leading '-'
  std::string unit;                ///< name of its value in the help; empty: the flag takes no value
  std::string help, group;
  bool required = false;
  bool repeatable = false;
  Values values = {};        ///< null: unknown
  bool only_values = false;  ///< a positional argument that never names a file

  bool positional() const { return !names.front().starts_with('-'); }
  bool takes_value() const { return positional() || !unit.empty(); }
  /// Whether its value may name a file, by its unit: "NAME|FILE", "PATH", "PREFIX" of files.
  bool takes_file() const;
  bool takes_folder() const;
};

struct Example {
  enum Speed { Quick, Slow };  ///< Slow: tests only parse it
  std::string command, does;
  Speed speed = Quick;
};

struct Description {
  std::string name;     ///< as typed after `fastsplat`: "stream record"; empty: the program itself
  std::string summary;  ///< one line
  std::vector<Flag> flags;
  std::vector<Example> examples;
  bool group = false;  ///< a group "NAME ..." of subcommands, which does nothing itself
};

}  // namespace fastsplat::cli
