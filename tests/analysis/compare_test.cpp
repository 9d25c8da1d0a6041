// SPDX-License-Identifier: Apache-2.0
// The figures against hand arithmetic, against plain re-implementations and against OpenImageIO's own comparison.
#include "analysis/compare.hpp"

#include <OpenImageIO/imagebufalgo.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/images/image_helper.hpp"

namespace fastsplat::analysis {
namespace {

using testing::HasSubstr;

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInf = std::numeric_limits<float>::infinity();

Image image_of(int width, int height, int channels, std::vector<float> values) {
  Image image(width, height, channels);
  image.data = std::move(values);
  return image;
}

Image plus(Image image, const Image& error) {
  for (std::size_t i = 0; i < image.data.size(); ++i) image.data[i] += error.data[i];
  return image;
}

bool kept(const CompareReport& report, const std::string& name) {
  for (const auto& limit : report.limits) {
    if (limit.name == name) return limit.ok;
  }
  ADD_FAILURE() << name << " was not applied";
  return false;
}

TEST(Compare, TwoByTwoByHand) {
  // 2 bits: 1 LSB = 1/3. Errors in LSB: +0.75, -1.5, 0, +0.375 (every value is exact in float and in double).
  const Image ref = image_of(2, 2, 1, {0.0f, 1.0f, 0.5f, 0.25f});
  const Image test = image_of(2, 2, 1, {0.25f, 0.5f, 0.5f, 0.375f});
  const CompareReport report = compare(ref, test, {.lsb_bits = 2});
  const Figures& figures = report.figures;
  EXPECT_EQ(report.values, 4u);
  EXPECT_DOUBLE_EQ(figures.max_abs_lsb, 1.5);
  EXPECT_DOUBLE_EQ(figures.mean_abs_lsb, (0.75 + 1.5 + 0.375) / 4);
  EXPECT_DOUBLE_EQ(figures.bias_lsb, (0.75 - 1.5 + 0.375) / 4);
  EXPECT_DOUBLE_EQ(figures.rmse_lsb, std::sqrt((0.5625 + 2.25 + 0.140625) / 4));
  // Mean squared error in value: (1/16 + 1/4 + 1/64) / 4 = 21/256, so 10 log10(256/21).
  EXPECT_NEAR(figures.psnr_db, 10 * std::log10(256.0 / 21), 1e-12);
  // Sorted 0, 0.375, 0.75, 1.5: ranks 2, 4, 4, 4, 4, 4.
  EXPECT_THAT(figures.percentiles_lsb, testing::ElementsAre(0.375, 1.5, 1.5, 1.5, 1.5, 1.5));
  // [0,0.5): 0 and 0.375; [0.5,1.5): 0.75; [1.5,2.5): 1.5.
  EXPECT_THAT(report.histogram, testing::ElementsAre(2, 1, 1));
  EXPECT_EQ(report.worst.x, 1);
  EXPECT_EQ(report.worst.y, 0);
  EXPECT_EQ(report.worst.ref, 1.0);
  EXPECT_EQ(report.worst.test, 0.5);
  EXPECT_DOUBLE_EQ(report.worst.error_lsb, -1.5);
  // REF on the grid of thirds: 0, 3, 1.5 -> 2, 0.75 -> 1.
  EXPECT_DOUBLE_EQ(report.floor.max_abs_lsb, 0.5);
  EXPECT_DOUBLE_EQ(report.floor.bias_lsb, (0.5 + 0.25) / 4);
  EXPECT_DOUBLE_EQ(report.floor.rmse_lsb, std::sqrt((0.25 + 0.0625) / 4));
  // The window shrinks to 1 x 1 on two pixels: no variance, SSIM = (2ab + c1) / (aa + bb + c1), c1 = 1e-4.
  const auto luminance = [](double a, double b) { return (2 * a * b + 1e-4) / (a * a + b * b + 1e-4); };
  EXPECT_NEAR(figures.ssim, (luminance(0, 0.25) + luminance(1, 0.5) + 1 + luminance(0.25, 0.375)) / 4, 1e-12);
  EXPECT_TRUE(report.pass);
}

TEST(Compare, OfEqualErrorsTheFirstIsWorst) {
  // Large enough for several blocks; equal errors in the second half of the first block, and in later ones.
  const Image ref(300, 300, 4);
  Image test = ref;
  for (const int y : {20, 200, 299}) test.pixel(7, y)[2] = test.pixel(9, y)[1] = -0.5f;
  const Place worst = compare(ref, test).worst;
  EXPECT_THAT((std::array{worst.x, worst.y, worst.channel}), testing::ElementsAre(7, 20, 2));
}

TEST(Compare, PeakMovesPsnrOnly) {
  const Image ref = images::random_image(20, 20, 3, 1);
  const Image test = images::random_image(20, 20, 3, 2);
  const auto one = compare(ref, test).figures;
  const auto ten = compare(ref, test, {.peak = 10.0}).figures;
  EXPECT_NEAR(ten.psnr_db - one.psnr_db, 20.0, 1e-12);
  EXPECT_EQ(ten.rmse_lsb, one.rmse_lsb);
}

struct OiioCase {
  const char* name;
  Image ref, test;
};

std::vector<OiioCase> oiio_cases() {
  std::vector<OiioCase> cases;
  cases.push_back({"noise", images::random_image(129, 67, 4, 1), images::random_image(129, 67, 4, 2)});
  const Image base = images::random_image(200, 150, 4, 3);
  cases.push_back({"small noise", base, plus(base, images::random_image(200, 150, 4, 4, -0.01f, 0.01f))});
  Image gradient(256, 64, 3), shifted(256, 64, 3);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 256; ++x) {
      for (int c = 0; c < 3; ++c) {
        gradient.pixel(x, y)[c] = static_cast<float>((x + 0.3 * c) / 256);
        shifted.pixel(x, y)[c] = gradient.pixel(x, y)[c] * (1.0f + 0.001f * static_cast<float>(y));
      }
    }
  }
  cases.push_back({"gradient", gradient, shifted});
  cases.push_back({"one channel", images::random_image(33, 34, 1, 5), images::random_image(33, 34, 1, 6)});
  cases.push_back({"identical", base, base});
  return cases;
}

OIIO::ImageBuf buffer_of(const Image& image) {
  const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::FLOAT);
  OIIO::ImageBuf buffer(spec);
  EXPECT_TRUE(buffer.set_pixels(OIIO::ROI::All(), OIIO::TypeDesc::FLOAT, image.data.data()));
  return buffer;
}

TEST(Compare, AgreesWithOpenImageIO) {
  // OpenImageIO subtracts in float: each error is off by at most 2^-24 of itself. A mean of errors is then off by 2^-24
  // of itself, one of squares by 2^-23, and PSNR by 20/ln(10) * 2^-24 dB. The limits are doubled for the sums' own
  // rounding.
  constexpr double kRelative = 0x1p-22;
  constexpr double kDecibel = 2 * 8.686 * 0x1p-24;
  double worst = 0;
  int compared = 0;
  for (const auto& [name, ref, test] : oiio_cases()) {
    SCOPED_TRACE(name);
    // Its peak is the largest value, but at least 1.
    double peak = 1.0;
    for (const Image* image : {&ref, &test}) {
      for (const float value : image->data) peak = std::max(peak, double{value});
    }
    const CompareReport report = compare(ref, test, {.peak = peak});
    const Figures& ours = report.figures;
    const Place& place = report.worst;
    const auto theirs = OIIO::ImageBufAlgo::compare(buffer_of(ref), buffer_of(test), 0.0f, 0.0f);
    const auto check = [&](double got, double expected) {
      EXPECT_NEAR(got, expected, kRelative * expected);
      if (expected != 0) worst = std::max(worst, std::abs(got / expected - 1));
      ++compared;
    };
    check(ours.mean_abs_lsb / 255, theirs.meanerror);
    check(ours.rmse_lsb / 255, theirs.rms_error);
    check(ours.max_abs_lsb / 255, theirs.maxerror);
    if (theirs.maxerror == 0) {
      EXPECT_EQ(ours.psnr_db, std::numeric_limits<double>::infinity());
      EXPECT_TRUE(std::isinf(theirs.PSNR));
    } else {
      EXPECT_NEAR(ours.psnr_db, theirs.PSNR, kDecibel);
      EXPECT_EQ(place.x, theirs.maxx);
      EXPECT_EQ(place.y, theirs.maxy);
      EXPECT_EQ(place.channel, theirs.maxc);
    }
  }
  std::printf("[figure] relative difference from OpenImageIO's compare = %.2e over %d figures (limit %.2e)\n", worst,
              compared, kRelative);
  EXPECT_EQ(compared, 15);
}

TEST(Compare, LeavesOutExactlyTheValuesThatAreNotFinite) {
  // OpenImageIO gets equal numbers where ours gets NaN: no error there, only more values to divide by.
  const Image ref = images::random_image(90, 70, 4, 1);
  Image holes = images::random_image(90, 70, 4, 2);
  Image filled = holes;
  for (std::size_t i = 0; i < ref.data.size(); i += 97) {
    holes.data[i] = i % 2 == 0 ? kNaN : -kInf;
    filled.data[i] = ref.data[i];
  }
  const CompareReport report = compare(ref, holes);
  const auto theirs = OIIO::ImageBufAlgo::compare(buffer_of(ref), buffer_of(filled), 0.0f, 0.0f);
  const double share = static_cast<double>(ref.data.size()) / static_cast<double>(report.values);
  EXPECT_GT(share, 1.01);
  EXPECT_NEAR(report.figures.mean_abs_lsb / 255, theirs.meanerror * share, 0x1p-22);
  EXPECT_NEAR(report.figures.rmse_lsb / 255, theirs.rms_error * std::sqrt(share), 0x1p-22);
  EXPECT_NEAR(report.figures.max_abs_lsb / 255, theirs.maxerror, 0x1p-22);
  EXPECT_EQ(report.worst.x, theirs.maxx);
  EXPECT_EQ(report.worst.y, theirs.maxy);
}

TEST(Compare, OrderStatisticsAreExact) {
  for (const int width : {1, 7, 100, 1009}) {
    const Image ref = images::random_image(width, 1, 1, 9);
    const Image test = images::random_image(width, 1, 1, 10);
    std::vector<double> sorted;
    for (int x = 0; x < width; ++x) sorted.push_back(std::abs((double{test.data[x]} - ref.data[x]) * 255));
    std::sort(sorted.begin(), sorted.end());
    const auto got = compare(ref, test).figures.percentiles_lsb;
    const std::array<double, 6> percent{50, 90, 95, 99, 99.9, 99.99};
    for (std::size_t p = 0; p < percent.size(); ++p) {
      // The least value that at least this share of the values does not exceed.
      std::size_t rank = 1;
      while (static_cast<double>(rank) * 100 < percent[p] * width - 1e-6) ++rank;
      EXPECT_EQ(got[p], sorted[rank - 1]) << percent[p] << " of " << width;
    }
  }
}

TEST(Compare, IdenticalImages) {
  const Image image = images::random_image(64, 48, 4, 3);
  const CompareReport report = compare(image, image, {.min_psnr_db = 200.0, .max_abs_lsb = 0.0, .min_ssim = 1.0});
  EXPECT_TRUE(report.pass);
  EXPECT_EQ(report.figures.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_EQ(report.figures.max_abs_lsb, 0.0);
  EXPECT_EQ(report.figures.ssim, 1.0);
  EXPECT_THAT(report.histogram, testing::ElementsAre(64 * 48 * 4));
  EXPECT_TRUE(report.clusters.empty());
}

TEST(Compare, FloorIsWhatRoundingOnceGives) {
  const Image ref = images::random_image(100, 80, 4, 3);
  Image rounded = ref;
  for (float& value : rounded.data) value = static_cast<float>(std::floor(value * 255.0 + 0.5) / 255.0);
  const CompareReport report = compare(ref, rounded);
  // The rounded values are floats here and doubles in the floor: 2^-25 of 255 LSB.
  constexpr double kFloat = 255 * 0x1p-25;
  EXPECT_NEAR(report.figures.max_abs_lsb, report.floor.max_abs_lsb, kFloat);
  EXPECT_NEAR(report.figures.rmse_lsb, report.floor.rmse_lsb, kFloat);
  EXPECT_NEAR(report.figures.bias_lsb, report.floor.bias_lsb, kFloat);
  EXPECT_NEAR(report.figures.ssim, report.floor.ssim, 1e-6);
  EXPECT_LE(report.floor.max_abs_lsb, 0.5);
  // Uniform values: the error is uniform in [-1/2, 1/2], rms sqrt(1/12); 32000 values, 5 sigma of its estimate
  // (0.0046).
  std::printf("[figure] floor rms = %.5f LSB (uniform: 0.28868)\n", report.floor.rmse_lsb);
  EXPECT_NEAR(report.floor.rmse_lsb, std::sqrt(1.0 / 12), 0.005);
  // A REF that lies on the grid has no floor.
  const CompareReport on_grid = compare(image_of(2, 1, 1, {0.0f, 1.0f}), image_of(2, 1, 1, {0.5f, 1.0f}));
  EXPECT_EQ(on_grid.floor.psnr_db, std::numeric_limits<double>::infinity());
  // All values of an 8-bit file, which floats hold to 2^-25.
  Image file(256, 1, 1);
  for (int i = 0; i < 256; ++i) file.data[static_cast<std::size_t>(i)] = static_cast<float>(i / 255.0);
  const CompareReport of_file = compare(file, plus(file, image_of(256, 1, 1, std::vector<float>(256, 0.25f))));
  std::printf("[figure] floor of an 8-bit file = %g LSB (limit 0)\n", of_file.floor.max_abs_lsb);
  EXPECT_EQ(of_file.floor.max_abs_lsb, 0.0);
  EXPECT_EQ(of_file.floor.psnr_db, std::numeric_limits<double>::infinity());
  EXPECT_EQ(of_file.floor.ssim, 1.0);
}

TEST(Compare, ThreadsNeverChangeTheResult) {
  const Image ref = images::random_image(317, 301, 4, 1);
  Image test = plus(ref, images::random_image(317, 301, 4, 2, -0.02f, 0.02f));
  test.data[5] = kNaN;
  const std::string one = to_json(compare(ref, test, {.threads = 1}));
  for (const int threads : {0, 2, 3, 8}) EXPECT_EQ(to_json(compare(ref, test, {.threads = threads})), one) << threads;
}

TEST(Compare, NotFiniteFailsAndIsCounted) {
  Image ref = images::random_image(20, 20, 4, 1);
  Image test = ref;
  const double clean_max = compare(ref, test).figures.max_abs_lsb;
  ref.data[3] = kNaN;
  ref.data[4] = kInf;
  test.data[4] = kInf;  // equal infinities cannot be compared either
  test.data[9] = -kInf;
  ref.data[20] = -kInf;  // against a number
  const CompareReport report = compare(ref, test);
  EXPECT_FALSE(report.pass);
  EXPECT_FALSE(kept(report, "max_nonfinite"));
  EXPECT_EQ(report.nonfinite_ref, 3u);
  EXPECT_EQ(report.nonfinite_test, 2u);
  EXPECT_EQ(report.values, 20u * 20 * 4 - 4);
  EXPECT_EQ(report.figures.max_abs_lsb, clean_max);
  EXPECT_TRUE(std::isfinite(report.figures.ssim));
  EXPECT_THAT(to_text(report), HasSubstr("NOT FINITE: 3 values in REF, 2 in TEST"));
  EXPECT_TRUE(compare(ref, test, {.allow_nonfinite = true}).pass);
}

TEST(Compare, ComparingNothingFails) {
  for (const CompareReport& report :
       {compare(Image(0, 0, 4), Image(0, 0, 4)),
        compare(image_of(1, 1, 1, {kNaN}), image_of(1, 1, 1, {0.5f}), {.allow_nonfinite = true})}) {
    EXPECT_EQ(report.values, 0u);
    EXPECT_FALSE(report.pass);
    EXPECT_FALSE(kept(report, "min_values"));
    EXPECT_TRUE(std::isnan(report.figures.psnr_db));
  }
  // A threshold on a figure that does not exist is not kept.
  EXPECT_FALSE(kept(compare(Image(0, 0, 4), Image(0, 0, 4), {.max_abs_lsb = 3.0}), "max_abs_lsb"));
}

TEST(Compare, EveryThresholdCanFail) {
  const Image ref = images::random_image(40, 40, 4, 1);
  Image test = ref;
  for (float& value : test.data) value -= 0.01f;  // bias -2.55 LSB
  const Figures got = compare(ref, test).figures;
  struct Threshold {
    const char* name;
    std::optional<double> CompareOptions::*limit;
    double got;
    double stricter;  ///< added to `got` it must fail
  };
  for (const auto& [name, limit, value, stricter] :
       {Threshold{"min_psnr_db", &CompareOptions::min_psnr_db, got.psnr_db, 1e-9},
        Threshold{"max_abs_lsb", &CompareOptions::max_abs_lsb, got.max_abs_lsb, -1e-9},
        Threshold{"max_mean_lsb", &CompareOptions::max_mean_lsb, got.mean_abs_lsb, -1e-9},
        Threshold{"max_rmse_lsb", &CompareOptions::max_rmse_lsb, got.rmse_lsb, -1e-9},
        Threshold{"max_bias_lsb", &CompareOptions::max_bias_lsb, std::abs(got.bias_lsb), -1e-9},
        Threshold{"max_p99_lsb", &CompareOptions::max_p99_lsb, got.percentiles_lsb[3], -1e-9},
        Threshold{"min_ssim", &CompareOptions::min_ssim, got.ssim, 1e-9}}) {
    CompareOptions options;
    options.*limit = value;
    EXPECT_TRUE(compare(ref, test, options).pass) << name;
    options.*limit = value + stricter;
    const CompareReport report = compare(ref, test, options);
    EXPECT_FALSE(report.pass) << name;
    EXPECT_FALSE(kept(report, name));
    EXPECT_TRUE(kept(report, "min_values"));
  }
  EXPECT_LT(got.bias_lsb, -2.5);
}

TEST(Compare, WorstClusters) {
  Image ref(80, 60, 4);  // 19200 values, so that p99.9 is still 0 and the threshold 1 LSB
  Image test(80, 60, 4);
  const auto put = [&](int x, int y, int channel, double lsb) {
    test.pixel(x, y)[channel] = static_cast<float>(lsb / 255);
  };
  put(5, 5, 0, 4);
  put(6, 6, 1, -6);  // touches by a corner: the same cluster
  put(7, 6, 1, 2);
  put(7, 6, 3, -3);  // one pixel counts once, by its worst channel
  put(20, 20, 2, 5);
  put(0, 29, 0, 0.9);  // below 1 LSB: none
  const CompareReport report = compare(ref, test);
  EXPECT_EQ(report.cluster_threshold_lsb, 1.0);
  ASSERT_EQ(report.clusters.size(), 2u);
  const Cluster& first = report.clusters[0];
  EXPECT_THAT((std::array{first.x0, first.y0, first.x1, first.y1}), testing::ElementsAre(5, 5, 7, 6));
  EXPECT_EQ(first.pixels, 3u);
  EXPECT_NEAR(first.max_lsb, 6, 1e-5);
  EXPECT_NEAR(first.sum_lsb, 4 + 6 + 3, 1e-5);
  EXPECT_THAT((std::array{first.worst.x, first.worst.y, first.worst.channel}), testing::ElementsAre(6, 6, 1));
  EXPECT_NEAR(first.worst.error_lsb, -6, 1e-5);
  EXPECT_EQ(first.worst.test, test.pixel(6, 6)[1]);
  EXPECT_EQ(report.clusters[1].worst.x, 20);
  EXPECT_EQ(compare(ref, test, {.clusters = 1}).clusters.size(), 1u);
}

TEST(Compare, HistogramCountsEverythingOnce) {
  const Image ref = images::random_image(50, 50, 4, 1);
  const Image test = plus(ref, images::random_image(50, 50, 4, 2, -2.0f, 2.0f));
  const CompareReport report = compare(ref, test);
  std::uint64_t total = 0;
  for (const auto count : report.histogram) total += count;
  EXPECT_EQ(total, report.values);
  ASSERT_EQ(report.histogram.size(), 257u);
  std::uint64_t far = 0;
  for (std::size_t i = 0; i < ref.data.size(); ++i) far += std::abs(double{test.data[i]} - ref.data[i]) * 255 >= 255.5;
  EXPECT_EQ(report.histogram.back(), far);
  EXPECT_GT(far, 0u);
}

TEST(Compare, RefusesWhatIsNotComparable) {
  const auto message = images::refusal(ExitCode::NotComparable, [] { compare(Image(4, 3, 4), Image(4, 4, 4)); });
  EXPECT_THAT(message, HasSubstr("differ in size (expected 4 x 3 x 4, got 4 x 4 x 4)"));
  images::refusal(ExitCode::NotComparable, [] { compare(Image(4, 3, 4), Image(4, 3, 3)); });
  images::refusal(ExitCode::NotComparable, [] { lsb_map(Image(4, 3, 4), Image(3, 3, 4), {}); });
  images::refusal(ExitCode::Usage, [] { compare(Image(1, 1, 1), Image(1, 1, 1), {.lsb_bits = 0}); });
  images::refusal(ExitCode::Usage, [] { compare(Image(1, 1, 1), Image(1, 1, 1), {.peak = 0.0}); });
  images::refusal(ExitCode::Usage, [] { compare(Image(1, 1, 1), Image(1, 1, 1), {.clusters = -1}); });
  images::refusal(ExitCode::Usage, [] { compare(Image(1, 1, 1), Image(1, 1, 1), {.min_psnr_db = NAN}); });
}

}  // namespace
}  // namespace fastsplat::analysis
