// Figures of a result by their place in it, "cycles/account/ideal"; one that is not there is the user's error: the
// result is damaged.
#pragma once

#include <cstdint>
#include <string>

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

}  // namespace fastsplat::report
