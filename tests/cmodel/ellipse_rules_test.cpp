// SPDX-License-Identifier: Apache-2.0
// The rules of an ellipse record in docs/stream.md (S-ellipse-4, S-ellipse-5, S-ellipse-6). A record that breaks one is
// refused at its beat with the rule's number. Every bit counts as in the oracle. Both sides of every edge of rule 18
// occur.
#include <gtest/gtest.h>

#include <functional>

#include "cmodel/model.hpp"
#include "cmodel/stream/stream_rules.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/cmodel/random_ellipse_helper.hpp"
#include "tests/cmodel/small_stream_helper.hpp"
#include "tests/cmodel/stream_writer_helper.hpp"
#include "tests/cmodel/verdict_helper.hpp"

namespace fastsplat::test {
namespace {

using cmodel::StreamRule;
using Bytes = std::vector<std::uint8_t>;

/// P = 2, pf = 2, pi = 6, N = 4, g = 1: a corner's q is below 256 * 4 * 8 = 8192.
cmodel::Config ellipse_config(int f = 3) {
  oracle::Symbols symbols = symbols_of(small_stream_config());
  symbols.f = f;
  return config_of(symbols, "small_ellipses");
}

oracle::Ellipse sound() {
  oracle::Ellipse e;
  e.x = 13, e.y = 18;
  e.v[0] = 200, e.v[1] = 100, e.v[2] = 50, e.v[3] = 255;
  e.A = 40, e.B = -30, e.C = 25, e.h = 7;
  e.left = -3, e.top = -2;
  e.nx = 3, e.ny = 2;
  return e;
}

constexpr std::size_t kEllipseBeat = 7;

/// 0 begin_frame · 1-2 RADIAL · 3-4 FACTOR · 5 begin_tile · 6 begin_sheet · 7 the ellipse · 8 another · 9 end_sheet ·
/// 10 end_tile · 11 end_frame. No radius set: an ellipse needs none.
Bytes with_ellipse(const cmodel::Config& config, const oracle::Ellipse& e) {
  StreamWriter w(symbols_of(config));
  w.begin_frame(8, 8, 1);
  w.load_table(1, 0, 0, 0, {7, 5, 2, 1});
  w.load_table(2, 0, 0, 0, {16, 11, 8});
  w.begin_tile(0, 0, 0, 0, 8, 8);
  w.begin_sheet(0);
  w.ellipse(e);
  w.ellipse(sound());
  w.end_sheet();
  w.end_tile();
  w.end_frame();
  return w.bytes();
}

void flip(Bytes& bytes, std::size_t beat, std::size_t word, std::uint32_t bits) {
  for (std::size_t i = 0; i < 4; ++i)
    bytes[beat * cmodel::kBeatBytes + 4 * word + i] ^= static_cast<std::uint8_t>(bits >> (8 * i));
}

/// The rule that the model reports as broken.
StreamRule broken_rule(const cmodel::Config& config, const Bytes& bytes, std::uint64_t* beat = nullptr) {
  Collector collector;
  cmodel::Model model(config, cmodel::StreamScope::Whole, collector, nullptr);
  try {
    model.consume(to_beats(bytes));
    model.finish();
  } catch (const cmodel::StreamRefusal& refusal) {
    if (beat != nullptr) *beat = refusal.beat();
    return refusal.rule();
  }
  return StreamRule::None;
}

struct Broken {
  const char* name;
  StreamRule rule;
  std::function<void(oracle::Ellipse&)> shape;
  std::function<void(Bytes&)> bytes = [](Bytes&) {};
};

void nothing(oracle::Ellipse&) {}

const Broken kBroken[] = {
    {"reserved, lowest", StreamRule::Reserved, nothing, [](Bytes& b) { flip(b, 7, 3, 1U << 28); }},
    {"reserved, highest", StreamRule::Reserved, nothing, [](Bytes& b) { flip(b, 7, 3, 1U << 31); }},
    // S-ellipse-2.
    {"x above its format", StreamRule::Range, [](oracle::Ellipse& e) { e.x = 128; }},
    {"x below its format", StreamRule::Range, [](oracle::Ellipse& e) { e.x = -129; }},
    {"y above its format", StreamRule::Range, [](oracle::Ellipse& e) { e.y = 128; }},
    {"y at the end of its field", StreamRule::Range, [](oracle::Ellipse& e) { e.y = -2097152; }},
    {"R above its format", StreamRule::Range, [](oracle::Ellipse& e) { e.v[0] = 256; }},
    {"G above its format", StreamRule::Range, [](oracle::Ellipse& e) { e.v[1] = 256; }},
    {"B above its format", StreamRule::Range, [](oracle::Ellipse& e) { e.v[2] = 65535; }},
    {"tau above its format", StreamRule::Range, [](oracle::Ellipse& e) { e.v[3] = 256; }},
    {"tag", StreamRule::Tag, nothing, [](Bytes& b) { flip(b, 7, 1, 1); }},
    {"B too large", StreamRule::Shape, [](oracle::Ellipse& e) { e.A = 4, e.C = 4, e.B = 9; }},
    {"B too small", StreamRule::Shape, [](oracle::Ellipse& e) { e.A = 4, e.C = 4, e.B = -9; }},
    {"B without A", StreamRule::Shape, [](oracle::Ellipse& e) { e.A = 0, e.B = 1; }},
    {"B without C", StreamRule::Shape, [](oracle::Ellipse& e) { e.C = 0, e.B = -1; }},
    {"the least B with the largest A and C", StreamRule::Shape,
     [](oracle::Ellipse& e) { e.A = e.C = 4194303, e.B = -8388608, e.h = 63; }},
    {"511 pixels to the right", StreamRule::Shape, [](oracle::Ellipse& e) { e.left = 507, e.nx = 2, e.h = 63; }},
    {"511 pixels down", StreamRule::Shape, [](oracle::Ellipse& e) { e.top = 509, e.ny = 1, e.h = 63; }},
    {"as far as the words go", StreamRule::Shape, [](oracle::Ellipse& e) { e.top = 511, e.ny = 32, e.h = 63; }},
    {"q at the first pixel of the first row", StreamRule::Shape,
     [](oracle::Ellipse& e) { e.A = 20, e.B = 40, e.C = 20, e.h = 0, e.left = e.top = -4, e.nx = e.ny = 1; }},
    {"q at the last pixel of the first row", StreamRule::Shape,
     [](oracle::Ellipse& e) { e.A = 20, e.B = -40, e.C = 20, e.h = 0, e.left = 3, e.top = -4, e.nx = e.ny = 1; }},
    {"q at the first pixel of the last row", StreamRule::Shape,
     [](oracle::Ellipse& e) { e.A = 20, e.B = -40, e.C = 20, e.h = 0, e.left = -4, e.top = 3, e.nx = e.ny = 1; }},
    {"q at the last pixel of the last row", StreamRule::Shape,
     [](oracle::Ellipse& e) { e.A = 20, e.B = 40, e.C = 20, e.h = 0, e.left = e.top = 3, e.nx = e.ny = 1; }},
    // Two broken rules: the first one is reported (S-rule-1).
    {"reserved and range", StreamRule::Reserved, [](oracle::Ellipse& e) { e.x = 128; },
     [](Bytes& b) { flip(b, 7, 3, 1U << 28); }},
    {"range and tag", StreamRule::Range, [](oracle::Ellipse& e) { e.v[0] = 256; }, [](Bytes& b) { flip(b, 7, 1, 1); }},
    {"tag and shape", StreamRule::Tag, [](oracle::Ellipse& e) { e.A = 0; }, [](Bytes& b) { flip(b, 7, 1, 1); }},
};

// N-4.6-2.
TEST(EllipseRules, TheSoundOneIsTakenWithoutARadiusSet) {
  ASSERT_FALSE(cmodel::first_violation(ellipse_config())) << one_line(*cmodel::first_violation(ellipse_config()));
  bool taken = false;
  EXPECT_EQ(disagreement(ellipse_config(), with_ellipse(ellipse_config(), sound()), &taken), "");
  EXPECT_TRUE(taken);
}

TEST(EllipseRules, EachBrokenOnceIsRefusedUnderItsNumber) {
  int refused = 0;
  for (const Broken& broken : kBroken) {
    oracle::Ellipse e = sound();
    broken.shape(e);
    Bytes bytes = with_ellipse(ellipse_config(), e);
    broken.bytes(bytes);
    seal(bytes);
    std::uint64_t beat = 0;
    EXPECT_EQ(broken_rule(ellipse_config(), bytes, &beat), broken.rule) << broken.name;
    EXPECT_EQ(beat, kEllipseBeat) << broken.name;
    const Verdict model = model_verdict(ellipse_config(), bytes);
    EXPECT_FALSE(model.parts.what.empty() || model.parts.expected.empty() || model.parts.got.empty())
        << broken.name << ": " << model.text;
    EXPECT_NE(model.parts.expected, model.parts.got) << broken.name << ": " << model.text;
    EXPECT_EQ(model.text.find('\n'), std::string::npos) << broken.name;
    EXPECT_EQ(disagreement(ellipse_config(), bytes), "") << broken.name;
    ++refused;
  }
  std::printf("[figure] rules of an ellipse broken and refused = %d\n", refused);
  EXPECT_EQ(refused, static_cast<int>(std::size(kBroken)));
}

TEST(EllipseRules, PlaceAndCounters) {
  const cmodel::Config config = ellipse_config();
  // Without ellipses in the configuration the opcode is unknown (N-4.6-1, S-ellipse-1).
  const cmodel::Config none = ellipse_config(0);
  std::uint64_t beat = 0;
  EXPECT_EQ(broken_rule(none, with_ellipse(none, sound()), &beat), StreamRule::Opcode);
  EXPECT_EQ(beat, kEllipseBeat);
  EXPECT_EQ(disagreement(none, with_ellipse(none, sound())), "");
  // Outside a sheet.
  Bytes bytes = with_ellipse(config, sound());
  bytes.erase(bytes.begin() + 6 * cmodel::kBeatBytes, bytes.begin() + 7 * cmodel::kBeatBytes);
  seal(bytes);
  EXPECT_EQ(broken_rule(config, bytes, &beat), StreamRule::Order);
  EXPECT_EQ(beat, 6U);
  EXPECT_EQ(disagreement(config, bytes), "");
  // end_sheet counts both (S-ellipse-2).
  bytes = with_ellipse(config, sound());
  flip(bytes, 9, 2, 3);  // 2 becomes 1
  seal(bytes);
  EXPECT_EQ(broken_rule(config, bytes, &beat), StreamRule::EndCount);
  EXPECT_EQ(beat, 9U);
  EXPECT_EQ(disagreement(config, bytes), "");
  // The key is part of the hash.
  bytes = with_ellipse(ellipse_config(4), sound());
  EXPECT_EQ(broken_rule(config, bytes, &beat), StreamRule::Configuration);
}

TEST(EllipseRules, EverySingleBitCountsAsTheOracleSays) {
  int flips = 0, taken = 0;
  for (std::size_t bit = 0; bit < cmodel::kBeatBits; ++bit) {
    Bytes bytes = with_ellipse(ellipse_config(), sound());
    flip(bytes, kEllipseBeat, bit / 32, 1U << bit % 32);
    seal(bytes);
    bool accepted = false;
    EXPECT_EQ(disagreement(ellipse_config(), bytes, &accepted), "") << "bit " << bit;
    ++flips;
    taken += accepted ? 1 : 0;
  }
  std::printf("[figure] single bits of an ellipse flipped = %d, of which still legal = %d\n", flips, taken);
  EXPECT_EQ(flips, 256);
  EXPECT_GT(taken, 60);
}

struct Field {
  const char* name;
  std::int64_t least, most;
  std::function<std::int64_t(const oracle::Ellipse&)> get;
  std::function<void(oracle::Ellipse&, std::int64_t)> set;
};

#define FIELD(name, least, most)                                                                                  \
  Field {                                                                                                         \
#name, least, most,                                                                                           \
        [](const oracle::Ellipse& e)                                                                              \
             -> std::int64_t { return e.name; }, [](oracle::Ellipse & e,                                          \
                                                    std::int64_t                                                  \
                                                        value) { e.name = static_cast<decltype(e.name)>(value); } \
  }

// From a legal record one word moves towards an end, up to the first illegal value: both sides of the limit.
TEST(EllipseRules, BothSidesOfEveryEdge) {
  const Field fields[] = {FIELD(A, 0, 4194303),   FIELD(B, -8388608, 8388607), FIELD(C, 0, 4194303), FIELD(h, 0, 63),
                          FIELD(left, -512, 511), FIELD(top, -512, 511),       FIELD(nx, 1, 32),     FIELD(ny, 1, 32)};
  Random random(seed_or(73));
  const cmodel::Config config = ellipse_config();
  const oracle::Symbols symbols = symbols_of(config);
  std::map<std::string, int> edges;  // by the part of the rule
  for (int n = 0; n < 4000; ++n) {
    oracle::Ellipse e = sound();
    e.x = static_cast<std::int32_t>(random.between(-128, 127));
    e.y = static_cast<std::int32_t>(random.between(-128, 127));
    random_shape(symbols, random, e);
    const Field& field = fields[random.between(0, std::size(fields) - 1)];
    std::int64_t good = field.get(e), bad = random.once_in(2) ? field.least : field.most;
    field.set(e, bad);
    if (oracle::broken_shape(symbols, e) == nullptr) continue;
    while (good - bad > 1 || bad - good > 1) {
      const std::int64_t middle = (good + bad) / 2;
      field.set(e, middle);
      (oracle::broken_shape(symbols, e) == nullptr ? good : bad) = middle;
    }
    field.set(e, bad);
    const char* part = oracle::broken_shape(symbols, e);
    ASSERT_NE(part, nullptr);
    EXPECT_EQ(broken_rule(config, with_ellipse(config, e)), StreamRule::Shape)
        << part << ", " << field.name << " = " << bad;
    field.set(e, good);
    EXPECT_EQ(broken_rule(config, with_ellipse(config, e)), StreamRule::None)
        << part << ", " << field.name << " = " << good;
    ++edges[part];
  }
  for (const auto& [part, count] : edges) std::printf("[figure] edges met of '%s' = %d\n", part.c_str(), count);
  EXPECT_EQ(edges.size(), 4U);
  for (const auto& [part, count] : edges) EXPECT_GT(count, 20) << part;
}

}  // namespace
}  // namespace fastsplat::test
