// SPDX-License-Identifier: Apache-2.0
#include "cli/plan_columns.hpp"

#include <sstream>

namespace fastsplat::cli {

plan::TableOptions RowFlags::options() const {
  plan::TableOptions options{.columns = {}, .where = where, .sort = sort, .most = static_cast<std::size_t>(most)};
  std::istringstream all(columns);
  for (std::string column; std::getline(all, column, ',');) options.columns.push_back(column);
  return options;
}

void declare(Options& options, RowFlags& to) {
  options.positional("MERGED", to.merged, "merged results written by `fastsplat plan merge`");
  options.group("Rows and columns");
  options.word(
      "--columns", to.columns, "A,B,...",
      "columns to show: axes, metrics, id, kind, status, message, config_hash, scene_hash, program_hash, command");
  options.words("--where", to.where, "NAME=VALUE", "only rows with this value; repeatable");
  options.words("--sort", to.sort, "NAME", "sort by this column, with - before it in descending order; repeatable");
  options.integer("--most", to.most, 0, 1'000'000, "N", "maximum number of rows; 0: all");
}

}  // namespace fastsplat::cli
