// What there is to know of a verb besides how to carry it out: its flags, their values, examples. Help, man pages and
// completion are all made of this.
#pragma once

#include <functional>
#include <string>
#include <vector>

namespace fastsplat::cli {

/// Asked when somebody wants them, never on an ordinary run.
using Values = std::function<std::vector<std::string>()>;

/// A flag, or a word without one.
struct Flag {
  std::vector<std::string> names;  ///< "-o", "--out"; a word without a flag has one that does not begin with '-'
  std::string unit;                ///< what its value is called; empty: it takes none
  std::string help, group;
  bool required = false;
  bool repeatable = false;
  Values values = {};        ///< null: none are known
  bool only_values = false;  ///< a word without a flag that names no file

  bool positional() const { return !names.front().starts_with('-'); }
  bool takes_value() const { return positional() || !unit.empty(); }
  /// What its value may name, by its unit: "NAME|FILE", "PATH", "PREFIX" of files.
  bool takes_file() const;
  bool takes_folder() const;
};

struct Example {
  enum Speed { Quick, Slow };  ///< Slow: too slow for a test to run, so that it only has to parse
  std::string command, does;
  Speed speed = Quick;
};

struct Description {
  std::string name;     ///< as typed behind `fastsplat`: "stream record"; empty: the program itself
  std::string summary;  ///< one line
  std::vector<Flag> flags;
  std::vector<Example> examples;
  bool group = false;  ///< the head of verbs "NAME ...": takes nothing itself
};

}  // namespace fastsplat::cli
