// SPDX-License-Identifier: Apache-2.0
#include "scene/gaussians/ply_hints.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <vector>

#include "base/lower_case.hpp"
#include "base/number_text.hpp"
#include "scene/gaussians/gaussian_scene.hpp"

namespace fastsplat::scene {
namespace {

bool has(std::string_view text, std::string_view part) { return text.find(part) != text.npos; }

/// "Vertical Axis: z" as the key verticalaxis and the value z.
struct Hint {
  std::string key{}, value{};  ///< lower case; the key keeps only letters
  std::string text{};          ///< as in the file
  bool marked = false;         ///< has a colon or an equals sign, so it is not free text
};

/// `end`: of the key; `marked`: by a colon or an equals sign.
Hint hint_of(const std::string& text, std::size_t end, bool marked) {
  end = std::min(end, text.size());
  Hint hint{.text = text, .marked = marked};
  for (const char c : lower_case(text.substr(0, end)))
    if (std::isalpha(static_cast<unsigned char>(c)) != 0) hint.key += c;
  const std::string rest = lower_case(text.substr(std::min(end + 1, text.size())));
  const std::size_t first = std::min(rest.find_first_not_of(" \t"), rest.size());
  hint.value = rest.substr(first, rest.find_last_not_of(" \t") + 1 - first);
  return hint;
}

/// Without a colon or equals sign, the key is the first word, or all words but the last.
std::vector<Hint> hints_in(const std::string& text) {
  if (const auto mark = text.find_first_of(":="); mark != text.npos) return {hint_of(text, mark, true)};
  std::vector<Hint> hints{hint_of(text, text.find(' '), false)};
  const auto last = text.find_last_of(' ');
  if (last != text.find(' ')) hints.push_back(hint_of(text, last, false));
  return hints;
}

bool is_one_of(const std::string& word, std::initializer_list<std::string_view> words) {
  return std::ranges::find(words, word) != words.end();
}

/// A direction of three numbers: the nearest axis, and whether it lies exactly along it.
struct Direction {
  UpAxis nearest = UpAxis::Z;
  bool exact = true;
};
std::optional<Direction> direction_of(const std::string& text) {
  constexpr const char* kBetween = " \t,;[]()";
  std::vector<double> numbers;
  for (std::size_t at = text.find_first_not_of(kBetween); at < text.size(); at = text.find_first_not_of(kBetween, at)) {
    const std::size_t end = std::min(text.find_first_of(kBetween, at), text.size());
    const auto number = number_from(std::string_view(text).substr(at, end - at));
    if (!number) return std::nullopt;
    numbers.push_back(*number);
    at = end;
  }
  if (numbers.size() != 3) return std::nullopt;
  const auto longest = std::ranges::max_element(numbers, {}, [](double n) { return std::abs(n); });
  if (*longest == 0.0) return std::nullopt;
  constexpr double kAlong = 1e-3;  // radians
  const auto axis = static_cast<int>(longest - numbers.begin());
  const bool exact = std::hypot(numbers[static_cast<std::size_t>((axis + 1) % 3)],
                                numbers[static_cast<std::size_t>((axis + 2) % 3)]) <= kAlong * std::abs(*longest);
  return Direction{static_cast<UpAxis>(axis + (*longest < 0.0 ? 3 : 0)), exact};
}

/// x, +y, -z, also followed by "up".
std::optional<UpAxis> axis_named(std::string text) {
  if (text.ends_with("up")) text.erase(text.find_last_not_of(" -_", text.size() - 3) + 1);
  if (text.starts_with('+')) text.erase(0, 1);
  const auto found = std::ranges::find(up_axis_names(), text);
  if (found == up_axis_names().end()) return std::nullopt;
  return static_cast<UpAxis>(found - up_axis_names().begin());
}

class HintReader {
 public:
  explicit HintReader(bool brush) : brush_(brush) {}

  void take(const Hint& hint) {
    if (is_one_of(hint.key, {"verticalaxis", "upaxis", "up", "upvector", "updirection", "worldup"})) return up(hint);
    // "Y-up" alone, and "coordinate system: Z up".
    const std::string text = lower_case(hint.text);
    if (!hint.marked && text.ends_with("up") && axis_named(text)) return up({.value = text, .text = hint.text});
    if (is_one_of(hint.key, {"coordinatesystem", "coordinates", "axes"}) && hint.value.ends_with("up")) return up(hint);
    if (is_one_of(hint.key, {"splatrendermode", "rendermode", "rasterizemode"})) return mode(hint);
    if (is_one_of(hint.key, {"antialiased", "antialias", "antialiasing"})) return antialiased(hint);
    if (hint.key == "trainflags" && has(hint.value, "antialias")) out_.antialiased = true;
    if (hint.key.ends_with("colorspace") || hint.key.ends_with("colourspace")) return colours(hint);
    if (hint.key == "gamma") return gamma(hint);
    if (hint.key == "handedness" && hint.value != "right") refuse_to_follow(hint, "the picture may be mirrored");
    if (hint.key == "shdegree") out_.degree = integer_from<int>(hint.value);
    const bool activated = has(hint.value, "linear") || has(hint.value, "activated") || has(hint.value, "identity");
    if ((hint.key.starts_with("scale") || hint.key.starts_with("scaling")) && activated)
      refuse_to_follow(hint, "scales are read as logarithms");
    if (hint.key.starts_with("opacit") && activated) refuse_to_follow(hint, "opacities are read as logits");
    if (has(hint.value, "xyzw")) refuse_to_follow(hint, "rotations are read as w x y z");
  }
  PlyHints result() { return std::move(out_); }

 private:
  void refuse_to_follow(const Hint& hint, const std::string& instead) {
    out_.remarks.push_back(fmt::format("the header's '{}' is not supported: {}", hint.text, instead));
  }
  void up(const Hint& hint) {
    auto axis = axis_named(hint.value);
    // Brush names only the vertical axis, not its sign, and its frames have y pointing down.
    if (brush_ && axis == UpAxis::Y) axis = UpAxis::MinusY;
    if (const auto direction = direction_of(hint.value); !axis && direction) {
      axis = direction->nearest;
      if (!direction->exact)
        refuse_to_follow(hint, "the nearest axis, " + up_axis_names()[static_cast<std::size_t>(*axis)] + ", is up");
    }
    if (!axis) {
      if (hint.marked) refuse_to_follow(hint, "use --up AXIS");
      return;
    }
    if (out_.up && out_.up != axis) refuse_to_follow({.text = "two vertical axes"}, "the last one is used");
    out_.up = axis;
  }
  void mode(const Hint& hint) {
    out_.antialiased = is_one_of(hint.value, {"mip", "antialiased"});
    if (hint.value == "2dgs") return refuse_to_follow(hint, "discs are drawn as flat 3-D Gaussians");
    if (!out_.antialiased && !is_one_of(hint.value, {"default", "classic"}))
      refuse_to_follow(hint, "drawn as 'default'");
  }
  void antialiased(const Hint& hint) {
    const bool on = is_one_of(hint.value, {"1", "true", "yes", "on"});
    if (on || is_one_of(hint.value, {"0", "false", "no", "off"})) {
      out_.antialiased = on;
    } else if (hint.marked) {
      refuse_to_follow(hint, "drawn without anti-aliasing");
    }
  }
  void colours(const Hint& hint) {
    out_.linear = has(hint.value, "linear");
    if (!out_.linear && !has(hint.value, "srgb")) refuse_to_follow(hint, "colours are read as sRGB");
  }
  void gamma(const Hint& hint) {
    const auto value = number_from(hint.value);
    if (value == 1.0) {
      out_.linear = true;
    } else {
      refuse_to_follow(hint, "colours are read as sRGB");
    }
  }

  bool brush_;
  PlyHints out_{};
};

}  // namespace

PlyHints hints_of(std::span<const std::string> comments) {
  HintReader reader(
      std::ranges::any_of(comments, [](const auto& text) { return has(lower_case(text), "exported from brush"); }));
  for (const std::string& text : comments) {
    for (const Hint& hint : hints_in(text)) reader.take(hint);
  }
  return reader.result();
}

}  // namespace fastsplat::scene
