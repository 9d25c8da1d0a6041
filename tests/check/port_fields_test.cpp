// SPDX-License-Identifier: Apache-2.0
// Fields of a port against the same bits read one by one: every width and every count that a device can have.
#include "testbench/device/port_fields.hpp"

#include <gtest/gtest.h>

#include <cstdio>
#include <vector>

#include "testbench/device/pattern.hpp"

namespace fastsplat::test {
namespace {

std::uint32_t bit_by_bit(const std::vector<std::uint32_t>& words, std::size_t lsb, int bits) {
  std::uint32_t value = 0;
  for (int bit = 0; bit < bits; ++bit) {
    const std::size_t at = lsb + static_cast<std::size_t>(bit);
    value |= ((words[at / 32] >> (at % 32)) & 1) << bit;
  }
  return value;
}

TEST(PortFields, AreTheBitsOfThePort) {
  constexpr std::uint32_t kUntouched = 0xdeadbeef;
  std::uint64_t compared = 0, random = 1;
  for (int bits = 1; bits <= 32; ++bits) {
    const testbench::PortFields fields(bits);
    for (const std::size_t count : {1, 4, 16, 31, 32, 33, 64, 256}) {
      // Exactly as many words as hold the fields, so that the sanitizers' build sees reads beyond them.
      std::vector<std::uint32_t> words((count * static_cast<std::size_t>(bits) + 31) / 32);
      for (auto& word : words) word = static_cast<std::uint32_t>(random = testbench::mix(random));
      std::vector<std::uint32_t> out(count + 1, kUntouched);
      fields.unpack(words.data(), count, out.data());
      for (std::size_t i = 0; i < count; ++i, ++compared)
        ASSERT_EQ(out[i], bit_by_bit(words, i * static_cast<std::size_t>(bits), bits)) << bits << " bits, field " << i;
      ASSERT_EQ(out[count], kUntouched) << bits << " bits, " << count << " fields";
    }
  }
  std::printf("[figure] fields = %llu of 32 widths, all equal\n", static_cast<unsigned long long>(compared));
  EXPECT_GT(compared, 0u);
}

}  // namespace
}  // namespace fastsplat::test
