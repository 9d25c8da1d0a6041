// SPDX-License-Identifier: Apache-2.0
#include "cli/stream_config.hpp"

#include "cli/gaussian_flags.hpp"
#include "driver/config/config_file.hpp"
#include "driver/files/stream_file.hpp"

namespace fastsplat::cli {

ConfigFlags for_stream(ConfigFlags flags, const std::string& stream) {
  if (flags.config || !flags.changes.empty()) return flags;
  const std::uint64_t recorded = driver::recorded_config(stream);
  if (cmodel::config_hash(load_for_gaussians(flags)) == recorded) return for_gaussians(flags);
  for (const std::string& name : driver::config_names())
    if (cmodel::config_hash(driver::load_config(name)) == recorded) flags.config = name;
  return flags;
}

}  // namespace fastsplat::cli
