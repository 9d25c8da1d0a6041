// SPDX-License-Identifier: Apache-2.0
// A second witness of the bound's lemmas: Gappa computes how far each step of a configuration can move a value, from
// the widths and roundings that also make the RTL's package. The bound's own numbers (roundings.hpp) must be as large.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "analysis/errors/roundings.hpp"
#include "base/called.hpp"
#include "cmodel/numbers/sites.hpp"
#include "driver/tables/quantise.hpp"
#include "tests/cmodel/configs_helper.hpp"
#include "tests/process/process_helper.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config, cmodel::Narrowing, cmodel::Rounding, cmodel::Site;
using stages::Chain, stages::Mixture;

/// A claim "|deviation| <= most" under hypotheses, in Gappa's language.
struct Lemma {
  std::string name, definitions, hypotheses, deviation;
  double most = 0.0;
};

/// A word with `frac` fraction bits.
std::string fixed(int frac, const char* mode, const std::string& value) {
  return fmt::format("fixed<{},{}>({})", -frac, mode, value);
}
std::string nearest(int frac, const std::string& value) { return fixed(frac, "nu", value); }
/// The site's rounding. "nu" is floor(x + 1/2), the RTL's half added before bits are dropped.
std::string at(const Config& config, Site site, const std::string& value) {
  const Narrowing how = cmodel::narrowing(config, site);
  const char* mode = how.rounding() == Rounding::TRN ? "dn" : how.rounding() == Rounding::RND ? "nu" : "ne";
  return fixed(how.to().frac_bits, mode, value);
}
std::string in(const std::string& name, double most) { return fmt::format("{} in [0,{}]", name, most); }

/// Words of a colour, a weight, a sheet's sums, a factor and a transmittance.
std::string words(const Config& c) {
  return fmt::format("colour = {};\nweight = {};\nsum = {};\nfactor = {};\nlight = {};\nseen = {};\n",
                     fixed(c.colour_frac_bits, "dn", "colour_"), fixed(c.radial_frac_bits, "dn", "weight_"),
                     fixed(c.sheet_frac_bits, "dn", "sum_"), fixed(c.opacity_frac_bits, "dn", "factor_"),
                     fixed(c.composite_frac_bits, "dn", "light_"), fixed(c.composite_frac_bits, "dn", "seen_"));
}
std::string all_words(const Config& c) {
  return fmt::format("{} /\\ {} /\\ {} /\\ {} /\\ {} /\\ {}", in("colour_", std::exp2(c.colour_int_bits)),
                     in("weight_", std::exp2(c.radial_int_bits)), in("sum_", std::exp2(c.sheet_int_bits)),
                     in("factor_", 1.0), in("light_", std::exp2(c.colour_int_bits)), in("seen_", 1.0));
}

/// The table of docs/errors.md, section 3, as far as it is about words.
std::vector<Lemma> lemmas(const Config& c, const Roundings& r) {
  std::vector<Lemma> out;
  const std::string reach = fmt::format("x in [-{0},{0}]", std::exp2(c.position_int_bits - 1));
  const bool once = driver::target(driver::Site::Position, c).rounding == driver::Target::Rounding::Down;
  // Rounded down and then to the grid, a centre is rounded to the grid once.
  out.push_back(
      {"place", "", reach, at(c, Site::Snap, once ? "x" : nearest(c.position_frac_bits, "x")) + " - x", r.place});
  const int q = c.rlut_guard_bits;
  out.push_back({"distance", "", "qx in [0,1024] /\\ qy in [0,1024]",
                 fmt::format("({} + {}) - (qx + qy)", nearest(q, "qx"), nearest(q, "qy")), r.distance});
  if (!c.interpolates())
    out.push_back({"index", "", "q in [0,1024]", "(" + fixed(0, "dn", "q") + " - q) + 1b-1", r.index});
  if (c.has_ellipses()) {
    // The polynomial at column 37 and row 21 of a record.
    const int f = q + c.ellipse_format().frac_bits;
    const double i = 37, j = 21;
    std::string word, real, where;
    for (const auto& [name, times] :
         {std::pair{"u0", 1.0}, {"u1", i}, {"u2", i * i}, {"v1", j}, {"v2", j * j}, {"e", i * j}}) {
      word += fmt::format("{}{} * {}", word.empty() ? "" : " + ", times, nearest(f, name));
      real += fmt::format("{}{} * {}", real.empty() ? "" : " + ", times, name);
      where += fmt::format("{}{} in [-64,64]", where.empty() ? "" : " /\\ ", name);
    }
    out.push_back({"coefficients", "", where, fmt::format("({}) - ({})", word, real),
                   r.coefficient * (1 + i + i * i + j + j * j + i * j)});
  }
  const int z = c.slice_phase_bits;
  out.push_back({"depth", "", "b in [0,1024] /\\ z in [0,1024]",
                 fmt::format("({} - {}) - (b - z)", nearest(z, "b"), nearest(z, "z")), r.depth});
  out.push_back({"phi", "", in("x", 1.0), nearest(c.slice_frac_bits, "x") + " - x", r.phi});
  out.push_back({"share", "", in("x", 1.0), nearest(c.colour_frac_bits, "x") + " - x", r.share});
  out.push_back(
      {"product", words(c), all_words(c), at(c, Site::Product, "colour * weight") + " - colour * weight", r.product});
  // Both ends of a segment are words within half an ulp of the function; the mean of two errors, weighted by place and
  // 1 - place, is at most the greater of them. The chord is above the function by at most h^2/24. The start of
  // the segment is in both and left out.
  const double ulp = std::ldexp(0.5, -c.opacity_frac_bits), h = std::exp2(c.sheet_int_bits) / c.opacity_segments;
  out.push_back({"factor",
                 fmt::format("fall = {};\nplace = {};\n", fixed(c.opacity_frac_bits, "dn", "fall_"),
                             fixed(c.opacity_remainder_bits(), "dn", "place_")),
                 fmt::format("fall_ in [0,1] /\\ place_ in [0,1] /\\ ends in [-{0},{0}] /\\ "
                             "chord in [0,{1}]",
                             ulp, h * h / 24.0),
                 fmt::format("(fall * place - {}) + ends - chord", at(c, Site::Fall, "fall * place")), r.factor});
  out.push_back({"slab", words(c), all_words(c), at(c, Site::SlabColour, "sum * factor") + " - sum * factor", r.slab});
  const std::string shown = at(c, Site::Light, "seen * light"), gone = at(c, Site::Absorbed, "seen * light");
  out.push_back({"composite", words(c), all_words(c), shown + " - seen * light", r.composite});
  // One layer in front of what lies behind it, B: each of both roundings once, the latter times B.
  out.push_back(
      {"layer", words(c), all_words(c) + " /\\ C in [0,2] /\\ B in [0,1]",
       fmt::format("((C + {}) + (seen - {}) * B) - (C + seen * light + (seen - seen * light) * B)", shown, gone),
       2.0 * r.composite});
  out.push_back({"pixel", words(c), all_words(c), at(c, Site::PixelOut, "light") + " - light", r.pixel});
  return out;
}

/// A named configuration, or `base` with one rounding everywhere.
Config configured(const std::string& name) {
  if (name != "trn" && name != "rnd_conv") return test::named_config(name);
  Config out = test::named_config("base");
  const int rounding = static_cast<int>(name == "trn" ? Rounding::TRN : Rounding::RND_CONV);
  for (int Config::*key : {&Config::rounding_snap, &Config::rounding_product, &Config::rounding_fall,
                           &Config::rounding_slab, &Config::rounding_light, &Config::rounding_pixel})
    out.*key = rounding;
  return out;
}

struct Answer {
  bool proved = false;
  double most = 0.0;  ///< that Gappa found by itself
};

/// Asks Gappa to prove the claim with `most`, and what it finds without a claim.
Answer ask(const Lemma& lemma, double most) {
  const auto run = [&](const std::string& goal) {
    const cli_test::TempFolder folder;
    const std::string text =
        fmt::format("{}{{ {} -> |{}| in {} }}\n", lemma.definitions, lemma.hypotheses, lemma.deviation, goal);
    return call({"gappa", "-Munconstrained", "-Wno-unbound-variable", folder.write("lemma.g", text)}, 60);
  };
  Answer out;
  out.proved = run(fmt::format("[0,{:.17g}]", most)).code == 0;
  const std::string found = run("?").err;
  const auto comma = found.rfind("in [0, ");
  const auto brace = found.find('{', comma);
  if (comma != std::string::npos)
    out.most = std::strtod(found.c_str() + (brace != std::string::npos ? brace + 1 : comma + 7), nullptr);
  return out;
}

TEST(Gappa, FindsNoStepFartherOffThanTheBoundSays) {
  ASSERT_EQ(call({"gappa", "--version"}, 10).code, 0) << "apt-get install gappa";
  int proved = 0, refused = 0;
  std::vector<std::string> names = test::config_names();
  for (const char* rounding : {"trn", "rnd_conv"}) names.push_back(rounding);
  for (const std::string& name : names) {
    const Config config = configured(name);
    scene::SceneDescription description;
    description.volume = "shells:8";
    description.width = description.height = 8;
    if (config.has_ellipses()) {
      description.camera.projection = scene::Projection::Perspective;
      description.footprint.shape = scene::FootprintShape::Ellipse;
    }
    const scene::Scene scene = scene::build_scene(description);
    const Chain chain(scene, config);
    const Roundings roundings(chain, Mixture{}, Mixture::all_device());
    for (const Lemma& lemma : lemmas(config, roundings)) {
      // A double cannot hold h^2/24 exactly.
      const Answer answer = ask(lemma, lemma.most * (1.0 + std::ldexp(1.0, -40)));
      std::printf("[figure] %s %s: Gappa %.6g, bound %.6g\n", name.c_str(), lemma.name.c_str(), answer.most,
                  lemma.most);
      EXPECT_TRUE(answer.proved) << name << " " << lemma.name << ": |" << lemma.deviation << "| <= " << lemma.most;
      proved += answer.proved ? 1 : 0;
      // Nine tenths of what it finds is refused.
      if (answer.most == 0.0) continue;
      EXPECT_FALSE(ask(lemma, 0.9 * answer.most).proved) << name << " " << lemma.name;
      ++refused;
    }
  }
  std::printf("[figure] lemmas proved = %d, refused with a tenth less = %d\n", proved, refused);
  EXPECT_GE(proved, 100);
  EXPECT_GE(refused, 80);
}

}  // namespace
}  // namespace fastsplat::analysis
