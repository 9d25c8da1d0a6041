// SPDX-License-Identifier: Apache-2.0
#include "analysis/pipeline/step.hpp"

#include "driver/tables/quantise.hpp"

namespace fastsplat::stages {
namespace {

constexpr std::array<StepFacts, kStepCount> kFacts{{
    {"position", Group::Place, true, "centres as words", "position.frac_bits"},
    {"snap", Group::Place, false, "centres onto the 1/k grid", "snap.phases, rounding.snap"},
    {"radius", Group::Place, true, "the nearest radius set", "rlut.sets, rlut.columns"},
    {"emission", Group::Material, true, "colour and optical depth of splats as words",
     "colour.frac_bits, rounding.carry"},
    {"depth", Group::Material, true, "depths and slab boundaries as words", "slices.phase_bits"},
    {"phi", Group::Material, true, "cumulative slice weights as words", "slices.frac_bits"},
    {"share", Group::Material, true, "slabs' parts of splats as words", "colour.frac_bits"},
    {"distance", Group::Footprint, true, "squared distances as words", "rlut.guard_bits"},
    {"index", Group::Footprint, false, "squared distances as positions in the radial table", "radial.entries"},
    {"weight", Group::Footprint, true, "radial weights as words", "radial.frac_bits, radial.int_bits"},
    {"product", Group::Sheets, false, "products as sheet words", "sheet.frac_bits, rounding.product"},
    {"sheet", Group::Sheets, false, "sums clamped at the largest sheet word", "sheet.int_bits"},
    {"transfer", Group::Classification, false, "the transfer function as straight segments", "classify.segment_bits"},
    {"slope", Group::Classification, false, "gradients as words", ""},
    {"normal", Group::Classification, false, "lengths of gradients from a table", ""},
    {"facing", Group::Classification, false, "cosines to light and half vector as words", ""},
    {"phong", Group::Classification, false, "diffuse and specular light as words", ""},
    {"blend", Group::Classification, false, "share of shading as a word", ""},
    {"shaded", Group::Classification, false, "shaded colours as words", ""},
    {"colour", Group::Classification, false, "shaded colours times optical depth as sheet words", "sheet.frac_bits"},
    {"factor", Group::Picture, false, "slab factor from a table", "opacity.segments, opacity.frac_bits, rounding.fall"},
    {"slab", Group::Picture, false, "slab colour and opacity as words", "composite.frac_bits, rounding.slab"},
    {"composite", Group::Picture, false, "transmittance times slab as words", "composite.frac_bits, rounding.light"},
    {"freeze", Group::Picture, false, "early termination of pixels", "composite.freeze_below"},
    {"pixel", Group::Picture, false, "output words", "pixel.frac_bits, pixel.int_bits, rounding.pixel"},
}};

}  // namespace

const StepFacts& facts(Step step) { return kFacts[static_cast<std::size_t>(step)]; }

const char* to_string(Group group) {
  constexpr const char* kNames[kGroupCount] = {"place", "material", "footprint", "sheets", "classification", "picture"};
  return kNames[static_cast<std::size_t>(group)];
}

std::string FloatNumbers::text() const {
  std::string text(operands.name);
  if (sums != operands) text += ", sums " + std::string(sums.name);
  if (tile_centres) text += ", centres in the tile";
  if (!subnormals) text += ", without subnormals";
  return text;
}

std::string Mixture::text() const {
  if (device_.all()) return "all";
  if (device_.none() && floats_.none()) return "none";
  std::string text;
  for (const Step step : all_steps()) {
    if (!device(step) && !floats(step)) continue;
    text += (text.empty() ? "" : ", ") + std::string(facts(step).name);
    if (floats(step)) text += " " + std::string(numbers_.operands.name);
  }
  return text;
}

std::vector<StepSet> step_sets(const cmodel::Config& config, bool carried, bool densities) {
  const bool once = config.grid_bits() == config.position_frac_bits ||
                    driver::target(driver::Site::Position, config).rounding == driver::Target::Rounding::Down;
  const auto by = [](Step step) { return facts(step).driver ? "driver" : "device"; };
  std::vector<StepSet> sets;
  for (const Step step : all_steps()) {
    if (of_densities(step) && !densities) continue;
    if (step == Step::Snap && once) {
      if (config.grid_bits() < config.position_frac_bits) sets.back().by = "both";
      sets.back().name += std::string("+") + facts(step).name;
      sets.back().steps.push_back(step);
    } else if (step == Step::Product && carried) {
      sets.push_back(
          {std::string(facts(Step::Emission).name) + "+" + facts(step).name, {Step::Emission, step}, "both"});
    } else if (step != Step::Emission || !carried) {
      sets.push_back({facts(step).name, {step}, by(step)});
    }
  }
  return sets;
}

std::vector<StepSet> gaussian_sets(const cmodel::Config& config) {
  std::vector<StepSet> sets = step_sets(config, false, false);
  std::erase_if(sets, [](const StepSet& set) {
    const Step step = set.steps.front();
    return step == Step::Depth || step == Step::Phi || step == Step::Share || step == Step::Sheet ||
           step == Step::Factor;
  });
  return sets;
}

std::vector<StepSet> float_sets(std::vector<StepSet> sets) {
  for (StepSet& set : sets) {
    std::erase_if(set.steps,
                  [](Step step) { return step == Step::Snap || step == Step::Index || step == Step::Freeze; });
    set.by = "float";
    set.name.clear();
    for (const Step step : set.steps) set.name += (set.name.empty() ? "" : "+") + std::string(facts(step).name);
  }
  std::erase_if(sets, [](const StepSet& set) { return set.steps.empty(); });
  return sets;
}

std::vector<StepSet> group_sets(bool densities) {
  std::vector<StepSet> sets;
  for (std::size_t group = 0; group < kGroupCount; ++group) {
    if (static_cast<Group>(group) == Group::Classification && !densities) continue;
    sets.push_back({to_string(static_cast<Group>(group)), {}, ""});
    for (const Step step : all_steps()) {
      if (facts(step).group == static_cast<Group>(group)) sets.back().steps.push_back(step);
    }
  }
  return sets;
}

}  // namespace fastsplat::stages
