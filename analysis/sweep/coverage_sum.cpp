// SPDX-License-Identifier: Apache-2.0
#include "analysis/sweep/coverage_sum.hpp"

#include <algorithm>

#include "base/error.hpp"
#include "base/json_text.hpp"

namespace fastsplat::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kBookFormat = "fastsplat coverage 1";

/// Adds every count of `from`, at any depth; all other values must be equal.
void add_counts(Json& to, const Json& from, const std::string& name) {
  if (to.is_number_unsigned() && from.is_number_unsigned()) {
    to = to.get<std::uint64_t>() + from.get<std::uint64_t>();
  } else if (to.is_object() && from.is_object()) {
    for (const auto& [key, value] : from.items()) {
      if (to.contains(key)) {
        add_counts(to[key], value, key);
      } else {
        to[key] = value;
      }
    }
  } else if (to != from) {
    throw std::runtime_error(name + " is " + json_text(from, -1) + ", but was " + json_text(to, -1));
  }
}

}  // namespace

void CoverageSum::add(const Json& book, const std::string& where) {
  try {
    if (book.at("format") != kBookFormat) throw std::runtime_error("unknown format");
    const std::string& hash = book.at("config_hash").get_ref<const std::string&>();
    const auto same = std::ranges::find_if(books_, [&](const Json& one) { return one["config_hash"] == hash; });
    if (same == books_.end()) {
      books_.push_back(book);
    } else {
      Json sum = *same;
      // Two names with the same hash are one configuration.
      Json more = book;
      more["config"] = sum["config"];
      add_counts(sum, more, "book");
      *same = std::move(sum);
    }
  } catch (const std::exception& error) {
    throw_input({.where = where,
                 .what = "the coverage cannot be accumulated",
                 .expected = std::string("coverage of format ") + kBookFormat,
                 .got = error.what(),
                 .fix = "remove this file, then run the case again with `fastsplat plan run`"});
  }
}

}  // namespace fastsplat::plan
