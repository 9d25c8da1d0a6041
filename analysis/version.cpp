#include <array>
#include <cstdio>

#include "analysis/provenance.hpp"

namespace fastsplat::analysis {

std::string program_version() { return FASTSPLAT_VERSION; }

std::string hash_text(std::uint64_t hash) {
  std::array<char, 17> text{};
  std::snprintf(text.data(), text.size(), "%016llx", static_cast<unsigned long long>(hash));
  return text.data();
}

}  // namespace fastsplat::analysis
