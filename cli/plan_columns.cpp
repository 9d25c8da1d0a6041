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
  options.positional("MERGED", to.merged, "what `fastsplat plan merge` wrote");
  options.group("Rows and columns");
  options.word("--columns", to.columns, "A,B,...",
               "axes, metrics, id, kind, status, message, config_hash, scene_hash, program_hash, command");
  options.words("--where", to.where, "NAME=VALUE", "rows of this value only; repeatable");
  options.words("--sort", to.sort, "NAME", "by this column, the largest first with - before it; repeatable");
  options.integer("--most", to.most, 0, 1'000'000, "N", "rows at the most; 0 all");
}

}  // namespace fastsplat::cli
