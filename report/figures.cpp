// SPDX-License-Identifier: Apache-2.0
#include "report/figures.hpp"

#include "base/error.hpp"
#include "base/json_text.hpp"

namespace fastsplat::report {

void Figures::damaged(const std::string& place, const std::string& expected) const {
  const Json* found = find(place);
  std::string got = found ? json_text(*found, -1) : "nothing";
  if (got.size() > 40) got = got.substr(0, 37) + "...";
  throw_input({.where = result_.file.string(),
               .what = "a damaged result of `" + result_.subcommand + "`: " + place,
               .expected = expected,
               .got = got,
               .fix = "run this subcommand again with --json"});
}

const Json* Figures::find(const std::string& place) const {
  const Json::json_pointer pointer("/" + place);
  return result_.json.contains(pointer) ? &result_.json.at(pointer) : nullptr;
}

const Json& Figures::at(const std::string& place) const {
  const Json* found = find(place);
  if (!found) damaged(place, "a figure");
  return *found;
}

double Figures::number(const std::string& place) const {
  const Json* found = find(place);
  if (!found || !found->is_number()) damaged(place, "a number");
  return found->get<double>();
}

std::uint64_t Figures::count(const std::string& place) const {
  const Json* found = find(place);
  if (!found || !found->is_number_unsigned()) damaged(place, "a count");
  return found->get<std::uint64_t>();
}

std::string Figures::text(const std::string& place) const {
  const Json* found = find(place);
  if (!found || !found->is_string()) damaged(place, "a text");
  return found->get<std::string>();
}

bool Figures::flag(const std::string& place) const {
  const Json* found = find(place);
  if (!found || !found->is_boolean()) damaged(place, "true or false");
  return found->get<bool>();
}

const Json& Figures::list(const std::string& place) const {
  const Json* found = find(place);
  if (!found || !found->is_array()) damaged(place, "a list");
  return *found;
}

}  // namespace fastsplat::report
