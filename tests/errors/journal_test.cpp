// SPDX-License-Identifier: Apache-2.0
// Targets, their figures, and the journal of a search.
#include "analysis/errors/journal.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <limits>
#include <sstream>

#include "analysis/compare.hpp"
#include "analysis/errors/target.hpp"
#include "base/error.hpp"
#include "tests/cmodel/random_helper.hpp"

namespace fastsplat::analysis {
namespace {

TEST(Target, FiguresAreThoseOfCompare) {
  test::Random random(9);
  Image ref(37, 29, 4), out(37, 29, 4);
  for (std::size_t i = 0; i < ref.data.size(); ++i) {
    ref.data[i] = static_cast<float>(random.between(0, 4095)) / 4096.0F;
    out.data[i] = ref.data[i] + static_cast<float>(random.between(-40, 40)) / 8192.0F;
  }
  const auto want = compare(ref, out).figures;
  const Fidelity got = fidelity(ref, out, 2);
  EXPECT_EQ(got.rms_lsb, want.rmse_lsb);
  EXPECT_EQ(got.max_lsb, want.max_abs_lsb);
  EXPECT_EQ(got.psnr_db(), want.psnr_db);
  EXPECT_TRUE(std::isinf(fidelity(ref, ref, 1).psnr_db()));
  out.data[5] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_FALSE(parse_targets({"rms<=1e9"}).met(fidelity(ref, out, 1))) << "one pixel is not a number";
  std::printf("[figure] PSNR %.4f dB, RMS %.5f and max %.4f LSB8, as compare has them\n", got.psnr_db(), got.rms_lsb,
              got.max_lsb);
}

TEST(Target, IsMetWhereItsExcessIsOneAtMost) {
  for (const auto& [text, of, met] : {std::tuple{"psnr>=20", Fidelity{25.5, 99.0}, true},  // exactly 20 dB
                                      {"psnr>=50", Fidelity{0.8, 9.0}, true},
                                      {"psnr>=50", Fidelity{0.81, 0.9}, false},
                                      {"max<=1", Fidelity{0.1, 1.0}, true},
                                      {"max<=1", Fidelity{0.1, 1.001}, false},
                                      {"rms<=0.1", Fidelity{0.1, 5.0}, true},
                                      {"rms<=0.1", Fidelity{0.1001, 0.2}, false}}) {
    const Targets target = parse_targets({text});
    EXPECT_EQ(target.met(of), met) << text;
    EXPECT_EQ(target.excess(of) <= 1.0, met) << text;
  }
  const Targets both = parse_targets({"psnr>=50", "max<=1", "fps>=24"});
  EXPECT_TRUE(both.met({0.1, 1.0}));
  EXPECT_FALSE(both.met({0.1, 1.1}));
  EXPECT_FALSE(both.met({0.9, 1.0}));
  EXPECT_EQ(both.fps, 24.0);
  // The greatest of both: 50 dB are an RMS of 255 / 10^2.5 = 0.8064 LSB.
  std::printf("[figure] excess of the PSNR %.4f, of the maximum %.4f (2 of both)\n", both.excess({1.6128, 0.5}),
              both.excess({0.1, 2.0}));
  EXPECT_NEAR(both.excess({1.6128, 0.5}), 2.0, 1e-4);
  EXPECT_EQ(both.excess({0.1, 2.0}), 2.0);
  EXPECT_EQ(both.text(), "psnr>=50, max<=1, fps>=24");
  for (const char* bad : {"", "psnr", "psnr>50", "psnr>=", "psnr>=fifty", "psnr>=-3", "psnr>=1e9", "max<=0",
                          "ssim>=0.9", "max<=1LSB", "PSNR>=50", "fps>=0", "fps<=60"}) {
    try {
      parse_targets({bad});
      ADD_FAILURE() << "'" << bad << "' was taken";
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Usage);
      EXPECT_EQ(error.parts().where, "--target");
    }
  }
}

TEST(Target, OfOneFigureIsGivenOnce) {
  EXPECT_THROW(parse_targets({"psnr>=50", "psnr>=60"}), UserError);
  EXPECT_THROW(parse_targets({}), UserError);
}

class JournalFile : public ::testing::Test {
 protected:
  ~JournalFile() override { std::filesystem::remove(path_); }
  std::string bytes() const {
    std::ostringstream all;
    all << std::ifstream(path_, std::ios::binary).rdbuf();
    return all.str();
  }
  void write(const std::string& text) const { std::ofstream(path_, std::ios::binary) << text; }
  const std::filesystem::path path_ =
      std::filesystem::temp_directory_path() / ("fastsplat_journal_" + std::to_string(::getpid()) + ".jsonl");
};

TEST_F(JournalFile, KeepsItsValuesToTheLastBit) {
  const Fidelity awkward{0.1 + 0.2, 1.0 / 3.0};
  {
    Journal journal(path_);
    journal.add(1, 2, awkward);
    EXPECT_EQ(std::ranges::count(bytes(), '\n'), 2) << "not on disk before it went on";
    journal.add(0xffffffffffffffffULL, 2, std::nullopt);
  }
  const std::string before = bytes();
  const Journal again(path_);
  ASSERT_NE(again.find(1, 2), nullptr);
  EXPECT_EQ(*again.find(1, 2), Journal::Entry(awkward));
  ASSERT_NE(again.find(0xffffffffffffffffULL, 2), nullptr);
  EXPECT_FALSE(again.find(0xffffffffffffffffULL, 2)->has_value());
  EXPECT_EQ(again.find(2, 1), nullptr);
  EXPECT_EQ(bytes(), before) << "reading changed it";
  std::printf("[figure] a journal of two entries = %zu bytes\n", before.size());
}

/// Killed at any byte: complete entries are kept, and later ones are complete.
TEST_F(JournalFile, IsSoundAfterAnyCut) {
  {
    Journal journal(path_);
    for (std::uint64_t n = 0; n < 3; ++n) journal.add(n, 7, Fidelity{0.5, static_cast<double>(n)});
  }
  const std::string all = bytes();
  for (std::size_t cut = 0; cut <= all.size(); ++cut) {
    write(all.substr(0, cut));
    { Journal(path_).add(99, 7, Fidelity{1.0, 2.0}); }
    const Journal again(path_);
    const auto whole = std::count(all.begin(), all.begin() + static_cast<std::ptrdiff_t>(cut), '\n');
    for (std::uint64_t n = 0; n < 3; ++n)
      ASSERT_EQ(again.find(n, 7) != nullptr, static_cast<long>(n) + 1 < whole) << "cut at " << cut;
    ASSERT_NE(again.find(99, 7), nullptr) << "cut at " << cut;
  }
  std::printf("[figure] cuts = %zu, each sound\n", all.size() + 1);
}

TEST_F(JournalFile, RefusesWhatIsNone) {
  for (const char* text :
       {"name = \"base\"\n", "{}\n", "x", "{\"schema\":\"fastsplat.journal/1\"}\nnonsense\n",
        "{\"schema\":\"fastsplat.journal/1\"}\n{\"config\":\"12\",\"scene\":\"34\",\"drawn\":false}\n",
        "{\"schema\":\"fastsplat.journal/1\"}\n{\"drawn\":1}\n"}) {
    write(text);
    try {
      const Journal journal(path_);
      ADD_FAILURE() << text;
    } catch (const UserError& error) {
      EXPECT_EQ(error.code(), ExitCode::Input);
      EXPECT_EQ(error.parts().where.find(path_.string() + ":"), 0u) << error.what();
    }
    EXPECT_EQ(bytes(), text) << "a file that is not a journal was changed";
  }
}

}  // namespace
}  // namespace fastsplat::analysis
