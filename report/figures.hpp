// Figures of a result by their place in it, "cycles/account/ideal"; one that is not there is the user's error: the
// result is damaged.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "report/results.hpp"

namespace fastsplat::report {

class Figures {
 public:
  explicit Figures(const Result& result) : result_(result) {}

  /// The value at `place`, of whatever type. UserError (Input) when there is none.
  const Json& at(const std::string& place) const;
  double number(const std::string& place) const;
  std::uint64_t count(const std::string& place) const;
  std::string text(const std::string& place) const;
  bool flag(const std::string& place) const;
  const Json& list(const std::string& place) const;
  /// Null where it is not there.
  const Json* find(const std::string& place) const;

  [[noreturn]] void damaged(const std::string& place, const std::string& expected) const;

 private:
  const Result& result_;
};

/// Runs `make`, which reads `result`: a figure of another type than it has becomes UserError (Input).
template <class Make>
void reading(const Result& result, const Make& make) {
  try {
    make();
  } catch (const Json::exception&) {
    throw_input({.where = result.file.string(),
                 .what = "a damaged result of `" + result.verb + "`: a figure has the wrong type",
                 .expected = {},
                 .got = {},
                 .fix = "run this subcommand again with --json"});
  }
}

}  // namespace fastsplat::report
