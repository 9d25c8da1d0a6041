// SPDX-License-Identifier: Apache-2.0
// The subset of XML in our pictures, read strictly: elements, attributes, text, the entities lt, gt and amp.
#pragma once

#include <map>
#include <string>
#include <vector>

namespace fastsplat::analysis {

struct XmlElement {
  std::string name;
  std::map<std::string, std::string> attributes;
  std::string text;  ///< between the children
  std::vector<XmlElement> children;

  /// All elements of this name, at any depth.
  std::vector<const XmlElement*> all(const std::string& wanted) const;
};

/// Throws std::runtime_error with the place of the error.
XmlElement parse_xml(const std::string& text);

}  // namespace fastsplat::analysis
