// SPDX-License-Identifier: Apache-2.0
#include "tests/index_kinds/xml_helper.hpp"

#include <cctype>
#include <stdexcept>

namespace fastsplat::analysis {
namespace {

class Reader {
 public:
  explicit Reader(const std::string& text) : text_(text) {}

  XmlElement document() {
    skip_space();
    XmlElement root = element();
    skip_space();
    if (at_ != text_.size()) fail("something behind the root");
    return root;
  }

 private:
  [[noreturn]] void fail(const std::string& what) const {
    throw std::runtime_error(what + " at character " + std::to_string(at_));
  }
  bool here(const std::string& word) const { return text_.compare(at_, word.size(), word) == 0; }
  void take(const std::string& word) {
    if (!here(word)) fail("expected " + word);
    at_ += word.size();
  }
  void skip_space() {
    while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])) != 0) ++at_;
  }
  std::string name() {
    std::string out;
    while (at_ < text_.size() && (std::isalnum(static_cast<unsigned char>(text_[at_])) != 0 || text_[at_] == '-'))
      out += text_[at_++];
    if (out.empty()) fail("expected a name");
    return out;
  }
  char character() {
    if (at_ >= text_.size() || text_[at_] == '<') fail("unexpected < or end");
    if (text_[at_] != '&') return text_[at_++];
    for (const auto& [entity, stands_for] : {std::pair{"&lt;", '<'}, {"&gt;", '>'}, {"&amp;", '&'}}) {
      if (here(entity)) {
        take(entity);
        return stands_for;
      }
    }
    fail("unknown entity");
  }
  XmlElement element() {
    XmlElement out;
    take("<");
    out.name = name();
    for (skip_space(); !here(">") && !here("/>"); skip_space()) {
      const std::string key = name();
      take("=\"");
      std::string value;
      while (!here("\"")) value += character();
      take("\"");
      if (!out.attributes.emplace(key, value).second) fail("attribute twice: " + key);
    }
    if (here("/>")) {
      take("/>");
      return out;
    }
    take(">");
    while (!here("</")) {
      if (here("<"))
        out.children.push_back(element());
      else
        out.text += character();
    }
    take("</" + out.name + ">");
    return out;
  }

  const std::string& text_;
  std::size_t at_ = 0;
};

}  // namespace

std::vector<const XmlElement*> XmlElement::all(const std::string& wanted) const {
  std::vector<const XmlElement*> out;
  for (const XmlElement& child : children) {
    if (child.name == wanted) out.push_back(&child);
    const auto below = child.all(wanted);
    out.insert(out.end(), below.begin(), below.end());
  }
  return out;
}

XmlElement parse_xml(const std::string& text) { return Reader(text).document(); }

}  // namespace fastsplat::analysis
