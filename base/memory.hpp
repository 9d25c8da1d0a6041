// SPDX-License-Identifier: Apache-2.0
// The machine's memory.
#pragma once

#include <unistd.h>

#include <cstddef>

namespace fastsplat {

/// In bytes; 0: unknown.
inline std::size_t machine_memory() {
  const long pages = ::sysconf(_SC_PHYS_PAGES), bytes = ::sysconf(_SC_PAGE_SIZE);
  return pages > 0 && bytes > 0 ? static_cast<std::size_t>(pages) * static_cast<std::size_t>(bytes) : 0;
}

}  // namespace fastsplat
