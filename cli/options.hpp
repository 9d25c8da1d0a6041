// How a verb declares its flags: names, values, limits, help. Verbs include this and never CLI11, which compiles
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

/// The flags of one verb. What is declared is filled in when the command line is parsed, so it must still be there
/// then. `name` is as the user writes it ("--size", "-o,--out", "VOLUME"); `unit` what the help calls the value. A
/// target that is no std::optional keeps its value, the default, when the flag is absent.
class Options {
 public:
  /// What is wrong with the text of a value; empty for nothing. It may rewrite the text.
  using Problem = std::function<std::string(std::string&)>;
  using Take = std::function<void(const std::string&)>;

  explicit Options(CLI::App& verb);

  /// The heading in the help over what follows.
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
  /// What none of the above is.
  void value(const char* name, Problem problem, Take take, const char* unit, const char* help);

  /// A word without a flag that has to be there; in the order declared.
  void positional(const char* name, std::string& to, const char* help);
  /// One or more of them, in the user's order; none are well where `least` is 0.
  void positionals(const char* name, std::vector<std::string>& to, int least, const char* help);
  /// A word that has to be there.
  void required(const char* name, std::string& to, const char* unit, const char* help);

  /// Names that the value declared last may have, for shells to offer: beside files where it takes those by its unit.
  void values(Values names) { description_.flags.back().values = std::move(names); }
  /// ... and no file, where it is a word without a flag.
  void only_values(Values names) {
    values(std::move(names));
    description_.flags.back().only_values = true;
  }

  /// A command that does something worth knowing, and what: one line. The help begins with them; a test runs each.
  void example(const std::string& command, const std::string& does, Example::Speed speed = Example::Quick);

  /// What was declared so far.
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

  static Problem one_of(const std::vector<std::string>& names);
  static Problem within(long low, long high);
  static Problem finite();
  void describe(const char* name, const char* unit, const char* help, bool required, bool repeatable);

  CLI::App& verb_;
  std::string group_;
  Description description_;
};

}  // namespace fastsplat::cli
