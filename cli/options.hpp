// SPDX-License-Identifier: Apache-2.0
// Declares a subcommand's flags: names, values, limits, help. Subcommands include this instead of CLI11, which compiles
// slowly.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "base/number_text.hpp"
#include "cli/description.hpp"

namespace CLI {
class App;
}

namespace fastsplat::cli {

/// The flags of one subcommand. Targets are filled when the command line is parsed, so they must outlive parsing.
/// `name` is as the user types it ("--size", "-o,--out", "VOLUME"), `unit` the value's name in the help. If the flag is
/// absent, the target keeps its value: the default, or an empty std::optional.
class Options {
 public:
  /// Describes what is wrong with a value's text; empty if valid. It may rewrite the text.
  using Problem = std::function<std::string(std::string&)>;
  using Take = std::function<void(const std::string&)>;

  explicit Options(CLI::App& subcommand);

  /// Heading in the help for the flags that follow.
  void group(const std::string& title) { group_ = title; }
  void flag(const char* name, bool& to, const char* help);
  /// Any word.
  template <class To>
  void word(const char* name, To& to, const char* unit, const char* help) {
    value(
        name, {}, [&to](const std::string& text) { to = text; }, unit, help);
  }
  /// Repeatable, in the user's order.
  void words(const char* name, std::vector<std::string>& to, const char* unit, const char* help);
  /// One of `names`.
  template <class To>
  void choice(const char* name, To& to, const std::vector<std::string>& names, const char* unit, const char* help) {
    value(
        name, one_of(names), [&to](const std::string& text) { to = text; }, unit, help);
    values([names] { return names; });
  }
  /// An integer in low..high.
  template <class To>
  void integer(const char* name, To& to, long low, long high, const char* unit, const char* help) {
    value(
        name, within(low, high),
        [&to](const std::string& text) { to = static_cast<Held<To>>(*integer_from<long>(text)); }, unit, help);
  }
  /// Any finite number.
  template <class To>
  void number(const char* name, To& to, const char* unit, const char* help) {
    value(
        name, finite(), [&to](const std::string& text) { to = *number_from(text); }, unit, help);
  }
  /// The check of `choice`.
  static Problem one_of(const std::vector<std::string>& names);
  /// A value with its own check and conversion.
  void value(const char* name, Problem problem, Take take, const char* unit, const char* help);

  /// A required positional argument; they are parsed in the order declared.
  void positional(const char* name, std::string& to, const char* help);
  /// Positional arguments in the user's order, at least `least`.
  void positionals(const char* name, std::vector<std::string>& to, int least, const char* help);
  /// A required flag with any word.
  void required(const char* name, std::string& to, const char* unit, const char* help);

  /// Values that shells offer for the flag declared last, besides files if its unit allows them.
  void values(Values names) { description_.flags.back().values = std::move(names); }
  /// The same for a positional argument that never names a file.
  void only_values(Values names) {
    values(std::move(names));
    description_.flags.back().only_values = true;
  }

  /// An example command and its purpose, in one line. The help begins with the examples; a test runs each.
  void example(const std::string& command, const std::string& does, Example::Speed speed = Example::Quick);

  /// Everything declared so far.
  const Description& description() const { return description_; }

 private:
  template <class T>
  struct Target {
    using Value = T;
  };
  template <class T>
  struct Target<std::optional<T>> {
    using Value = T;
  };
  template <class T>
  using Held = typename Target<T>::Value;

  static Problem within(long low, long high);
  static Problem finite();
  void describe(const char* name, const char* unit, const char* help, bool required, bool repeatable);

  CLI::App& subcommand_;
  std::string group_;
  Description description_;
};

}  // namespace fastsplat::cli
