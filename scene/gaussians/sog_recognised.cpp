// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/sog_file.hpp"

namespace fastsplat::scene {

bool is_sog(std::string_view head) {
  return head.starts_with("PK\x03\x04") && (head.find("meta.json") != head.npos || head.find(".webp") != head.npos);
}

bool is_sog_meta(std::string_view head) { return head.starts_with("{") && head.find("\"means\"") != head.npos; }

}  // namespace fastsplat::scene
