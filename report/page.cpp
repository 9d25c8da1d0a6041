// SPDX-License-Identifier: Apache-2.0
#include "report/page.hpp"

#include <stdexcept>

#include "report/base64.hpp"

namespace fastsplat::report {

std::string script_safe(std::string_view json) {
  std::string safe;
  safe.reserve(json.size() + json.size() / 16);
  for (std::size_t at = 0; at < json.size(); ++at) {
    const std::string_view rest = json.substr(at, 3);
    if (json[at] == '<') {
      safe += "\\u003c";
    } else if (json[at] == '>') {
      safe += "\\u003e";
    } else if (json[at] == '&') {
      safe += "\\u0026";
    } else if (rest == "\u2028" || rest == "\u2029") {
      safe += rest == "\u2028" ? "\\u2028" : "\\u2029";
      at += 2;
    } else {
      safe += json[at];
    }
  }
  return safe;
}

std::string filled(std::string_view page, std::string_view json, const std::vector<Block>& blocks) {
  const std::size_t mark = page.find(kDataMark);
  if (mark == std::string_view::npos || page.find(kDataMark, mark + 1) != std::string_view::npos)
    throw std::logic_error("report/template.html must hold " + std::string(kDataMark) + " exactly once");
  std::string data = "<script type=\"application/json\" id=\"data\">" + script_safe(json) + "</script>\n";
  for (const Block& block : blocks)
    data += "<script type=\"text/plain\" id=\"" + block.id + "\">" + base64(block.bytes) + "</script>\n";
  return std::string(page.substr(0, mark)) + data + std::string(page.substr(mark + kDataMark.size()));
}

}  // namespace fastsplat::report
