// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

#include "analysis/compare.hpp"
#include "analysis/figures.hpp"

namespace fastsplat::analysis {
namespace {

constexpr std::size_t kMostRows = 10;  // rows of the histogram
constexpr int kBarLength = 30;

std::string number(double value, int decimals) {
  if (std::isnan(value)) return "n/a";
  if (std::isinf(value)) return value > 0 ? "inf" : "-inf";
  if (value != 0 && std::abs(value) < 0.5 * std::pow(10.0, -decimals)) return fmt::format("{:.1e}", value);
  return fmt::format("{:.{}f}", value, decimals);
}

/// Counts in full, figures with six digits.
std::string plain(double value) {
  return value == std::floor(value) && std::abs(value) < 1e15 ? fmt::format("{:.0f}", value)
                                                              : fmt::format("{:.6g}", value);
}

std::string channel_name(int channel, int channels) {
  return channels == 1 ? "Y" : std::string(1, "RGBA"[static_cast<std::size_t>(channel)]);
}

std::string place_text(const Place& place, int channels) {
  return fmt::format("({}, {}) {}: ref {:.6g}, test {:.6g}, error {:+.3f} LSB", place.x, place.y,
                     channel_name(place.channel, channels), place.ref, place.test, place.error_lsb);
}

class Text {
 public:
  explicit Text(const CompareReport& report) : report_(report) {}

  std::string write() {
    heading();
    figures();
    worst();
    histogram();
    clusters();
    limits();
    return std::move(out_);
  }

 private:
  template <typename... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out_), format, std::forward<Args>(args)...);
    out_ += '\n';
  }

  void heading() {
    line("{} x {} x {} channels, {} values compared; 1 LSB = 1/{:.0f}, peak {:g}", report_.width, report_.height,
         report_.channels, report_.values, std::ldexp(1.0, report_.options.lsb_bits) - 1, report_.options.peak);
    if (report_.nonfinite_ref + report_.nonfinite_test > 0) {
      line("NOT FINITE: {} values in REF, {} in TEST, excluded from every figure", report_.nonfinite_ref,
           report_.nonfinite_test);
    }
    line("");
  }

  void row(const char* name, double measured, double floor, int decimals) {
    line("{:<20}{:>12}{:>12}", name, number(measured, decimals), number(floor, decimals));
  }

  void figures() {
    const Figures& got = report_.figures;
    const Figures& floor = report_.floor;
    line("{:<20}{:>12}{:>12}", "", "measured", "floor");
    row("PSNR        dB", got.psnr_db, floor.psnr_db, 2);
    row("max |error| LSB", got.max_abs_lsb, floor.max_abs_lsb, 3);
    row("mean |err|  LSB", got.mean_abs_lsb, floor.mean_abs_lsb, 3);
    row("RMSE        LSB", got.rmse_lsb, floor.rmse_lsb, 3);
    row("bias        LSB", got.bias_lsb, floor.bias_lsb, 3);
    for (std::size_t p = 0; p < percentiles().size(); ++p) {
      row(fmt::format("{:<12}LSB", percentiles()[p].name).c_str(), got.percentiles_lsb[p], floor.percentiles_lsb[p], 3);
    }
    row("SSIM", got.ssim, floor.ssim, 6);
    line("floor: REF rounded once to this LSB, the error of storing the result alone");
    line("");
  }

  void worst() {
    if (report_.values > 0) line("worst  {}", place_text(report_.worst, report_.channels));
    line("");
  }

  void histogram_row(const std::string& range, std::uint64_t count) {
    const double share = static_cast<double>(count) / static_cast<double>(report_.values);
    const int bar = count == 0 ? 0 : std::max(1, static_cast<int>(share * kBarLength));
    line("  {:<16}{:>12}{:>9.3f} %  {}", range, count, 100 * share, std::string(static_cast<std::size_t>(bar), '#'));
  }

  void histogram() {
    const auto& bins = report_.histogram;
    if (bins.empty()) return;
    line("|error| in LSB");
    const std::size_t rows = std::min(bins.size(), kMostRows);
    for (std::size_t bin = 0; bin < rows; ++bin) {
      const double from = bin == 0 ? 0.0 : static_cast<double>(bin) - 0.5;
      histogram_row(fmt::format("[{:g}, {:g})", from, static_cast<double>(bin) + 0.5), bins[bin]);
    }
    if (bins.size() > rows) {
      std::uint64_t rest = 0;
      for (std::size_t bin = rows; bin < bins.size(); ++bin) rest += bins[bin];
      histogram_row(fmt::format("{:g} and more", static_cast<double>(rows) - 0.5), rest);
    }
    line("");
  }

  void clusters() {
    if (report_.clusters.empty()) return;
    line("worst clusters of pixels at {:.3g} LSB or more", report_.cluster_threshold_lsb);
    for (const auto& cluster : report_.clusters) {
      line("  x {}..{} y {}..{}: {} pixel{}, max {:.3f}, sum {:.1f} LSB; worst {}", cluster.x0, cluster.x1, cluster.y0,
           cluster.y1, cluster.pixels, cluster.pixels == 1 ? "" : "s", cluster.max_lsb, cluster.sum_lsb,
           place_text(cluster.worst, report_.channels));
    }
    line("");
  }

  void limits() {
    line("limits");
    for (const auto& limit : report_.limits) {
      const char* sense = limit.name.starts_with("min_") ? "at least" : "at most";
      line("  {:<16}{:<9}{:<8}got {:<10}{}", limit.name, sense, plain(limit.limit), plain(limit.got),
           limit.ok ? "PASS" : "FAIL");
    }
    line("verdict: {}", report_.pass ? "PASS" : "FAIL");
  }

  const CompareReport& report_;
  std::string out_;
};

}  // namespace

std::string to_text(const CompareReport& report) { return Text(report).write(); }

}  // namespace fastsplat::analysis
