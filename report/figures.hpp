// SPDX-License-Identifier: Apache-2.0
// Reads figures of a result by path, "cycles/account/ideal". A missing figure means that the result is damaged, which
// is a UserError.
#pragma once

#include <cstdint>
#include <string>

#include "base/error.hpp"
#include "report/results.hpp"

namespace fastsplat::report {

class Figures {
 public:
  explicit Figures(const Result& result) : result_(result) {}

  /// The value at `place`, of any type. UserError (Input) if it is missing.
  const Json& at(const std::string& place) const;
  double number(const std::string& place) const;
  std::uint64_t count(const std::string& place) const;
  std::string text(const std::string& place) const;
  bool flag(const std::string& place) const;
  const Json& list(const std::string& place) const;
  /// Null if it is missing.
  const Json* find(const std::string& place) const;

  [[noreturn]] void damaged(const std::string& place, const std::string& expected) const;

 private:
  const Result& result_;
};

/// Runs `make`, which reads `result`; figures of a wrong type become UserError (Input).
template <class Make>
void reading(const Result& result, const Make& make) {
  try {
    make();
  } catch (const Json::exception&) {
    throw_input({.where = result.file.string(),
                 .what = "a damaged result of `" + result.subcommand + "`: a figure has the wrong type",
                 .expected = {},
                 .got = {},
                 .fix = "run this subcommand again with --json"});
  }
}

}  // namespace fastsplat::report
