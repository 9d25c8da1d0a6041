// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <fstream>
#include <iterator>
#include <string>
#include <string_view>

#include "tests/fuzz/mutate.hpp"

namespace fastsplat::fuzz {
namespace {

constexpr std::size_t kLongest = 8192;

/// splitmix64
class Chance {
 public:
  explicit Chance(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t x = state_ += 0x9e3779b97f4a7c15;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9;
    x = (x ^ x >> 27) * 0x94d049bb133111eb;
    return x ^ x >> 31;
  }
  /// 0..below-1
  std::size_t below(std::size_t limit) { return limit == 0 ? 0 : static_cast<std::size_t>(next() % limit); }

 private:
  std::uint64_t state_;
};

/// Structures that break text readers.
constexpr std::array<std::string_view, 16> kWords{"-1",  "0",    "4294967296", "1e999", "nan", "99999999999999999999",
                                                  "\"",  "[",    "]",          "{",     "}",   "\n",
                                                  "\\u", "\xff", "=",          "null"};

void put(Input& input, std::size_t at, std::string_view bytes) {
  input.insert(input.begin() + static_cast<std::ptrdiff_t>(at), bytes.begin(), bytes.end());
}

/// A number of 1, 2, 4 or 8 bytes set to a limit of its range, in either order of bytes.
void set_number(Input& input, Chance& chance) {
  const std::size_t bytes = std::size_t{1} << chance.below(4);
  if (input.size() < bytes) return;
  const std::array<std::uint64_t, 6> limits{0,  1, ~std::uint64_t{0}, ~std::uint64_t{0} >> 1, std::uint64_t{1} << 31,
                                            255};
  const std::uint64_t value = limits[chance.below(limits.size())];
  const std::size_t at = chance.below(input.size() - bytes + 1);
  const bool little = chance.below(2) == 0;
  for (std::size_t i = 0; i < bytes; ++i)
    input[at + i] = static_cast<std::uint8_t>(value >> 8 * (little ? i : bytes - 1 - i));
}

void change(Input& input, const std::vector<Input>& seeds, Chance& chance) {
  const std::size_t at = chance.below(input.size());
  const std::size_t length = 1 + chance.below(std::min<std::size_t>(input.size() - at, 64));
  const auto from = input.begin() + static_cast<std::ptrdiff_t>(at);
  switch (chance.below(8)) {
    case 0:
      input[at] ^= static_cast<std::uint8_t>(1U << chance.below(8));
      return;
    case 1:
      input[at] = static_cast<std::uint8_t>(chance.next());
      return;
    case 2:
      set_number(input, chance);
      return;
    case 3:
      input.erase(from, from + static_cast<std::ptrdiff_t>(length));
      return;
    case 4: {
      const Input piece(from, from + static_cast<std::ptrdiff_t>(length));
      input.insert(from, piece.begin(), piece.end());
      return;
    }
    case 5: {
      const Input& other = seeds[chance.below(seeds.size())];
      const std::size_t begin = chance.below(other.size());
      const std::size_t taken = 1 + chance.below(std::min<std::size_t>(other.size() - begin, 256));
      const auto piece = other.begin() + static_cast<std::ptrdiff_t>(begin);
      input.insert(from, piece, piece + static_cast<std::ptrdiff_t>(taken));
      return;
    }
    case 6:
      put(input, at, kWords[chance.below(kWords.size())]);
      return;
    default:
      input.resize(at);
  }
}

}  // namespace

std::vector<Input> inputs_in(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> names;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.is_regular_file()) names.push_back(entry.path());
  std::sort(names.begin(), names.end());
  std::vector<Input> inputs;
  for (const auto& name : names) {
    std::ifstream file(name, std::ios::binary);
    inputs.emplace_back(std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>());
  }
  return inputs;
}

Input mutated(const std::vector<Input>& seeds, std::uint64_t number) {
  Chance chance(number);
  Input input = seeds[chance.below(seeds.size())];
  for (std::size_t changes = 1 + chance.below(4); changes > 0 && !input.empty(); --changes)
    change(input, seeds, chance);
  input.resize(std::min(input.size(), kLongest));
  return input;
}

std::vector<Input> hard_texts() {
  const auto times = [](std::size_t count, const std::string& text) {
    std::string out;
    while (count-- > 0) out += text;
    return out;
  };
  const std::string many = times(40'000, "a.") + "a", mega(1'000'000, 'a');
  const std::vector<std::string> texts{
      many + " = 1\n",
      "[" + many + "]\nb = 1\n",
      "[[" + many + "]]\nb = 1\n",
      "x = {" + many + " = 1}\n",
      times(2, "[" + times(100, "a.") + "a]\n" + times(100, "b.") + "b = 1\n"),
      "x = " + times(200, "{" + times(40, "a.") + "a = ") + "1" + times(200, "}") + "\n",
      "x = [\"\"\"a\"\"\"\", {" + many + " = 1}]\n",
      "x = " + times(100'000, "[") + times(100'000, "]") + "\n",
      mega + " = 1\n",
      "kind = \"" + mega + "\"\n",
      "<testcase name=\"" + mega + "\" status=\"run\">",
      times(100'000, "[") + times(100'000, "]"),
      times(100'000, "{\"a\":") + "1" + times(100'000, "}"),
      "{\"format\": \"fastsplat plan result 1\", \"checksum\": \"\", \"results\": " + times(100'000, "[") +
          times(100'000, "]") + "}",
  };
  std::vector<Input> inputs;
  for (const auto& text : texts) {
    inputs.emplace_back(text.begin(), text.end());
    for (const char choice : {0, 1, 2, 3}) {
      inputs.push_back({static_cast<std::uint8_t>(choice)});
      inputs.back().insert(inputs.back().end(), text.begin(), text.end());
    }
  }
  return inputs;
}

}  // namespace fastsplat::fuzz
