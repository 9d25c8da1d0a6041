// SPDX-License-Identifier: Apache-2.0
// The ports in a waveform, read from the file itself: names and widths depend on the configuration.
#pragma once

#include <gtkwave/fstapi.h>

#include <fstream>
#include <string>

namespace fastsplat::testbench {

/// Writes the full name of each port of each instance, a line each, as a waveform viewer shows it:
/// "TOP.top.tdata_i[255:0]". Writes nothing if `wave` has no cycles.
inline void write_wave_ports(const std::string& wave, const std::string& file) {
  void* const reader = fstReaderOpen(wave.c_str());
  if (reader == nullptr) return;
  std::ofstream out(file);
  std::string scope;
  while (const fstHier* const item = fstReaderIterateHier(reader)) {
    if (item->htyp == FST_HT_SCOPE) {
      scope += item->u.scope.name;
      scope += '.';
    } else if (item->htyp == FST_HT_UPSCOPE) {
      scope.erase(scope.find_last_of('.', scope.size() - 2) + 1);
    } else if (item->htyp == FST_HT_VAR) {
      const bool port = item->u.var.direction == FST_VD_INPUT || item->u.var.direction == FST_VD_OUTPUT;
      if (!port) continue;
      std::string name = item->u.var.name;
      if (const auto space = name.find(' '); space != std::string::npos) name.erase(space, 1);  // "tdata_i [255:0]"
      out << scope << name << '\n';
    }
  }
  fstReaderClose(reader);
}

}  // namespace fastsplat::testbench
