// SPDX-License-Identifier: Apache-2.0
#include "analysis/errors/area.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string_view>

#include "analysis/errors/area_model_text.hpp"
#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/rtl_package/sv_package.hpp"

namespace fastsplat::analysis {
namespace {

using cmodel::Config;
using Json = nlohmann::ordered_json;
using Row = std::vector<double>;

int ceil_div(int a, int b) { return (a + b - 1) / b; }
/// Bits that hold 0..largest, at least one.
int bits_for(int largest) { return std::max(1, static_cast<int>(std::bit_width(static_cast<unsigned>(largest)))); }
/// Bits of an index below `count`.
int index_bits(int count) { return count > 1 ? bits_for(count - 1) : 0; }

struct Memory {
  int copies = 0, words = 0, bits = 0;
};

/// What a copy of a memory becomes.
struct Mapped {
  int luts = 0, halves = 0, wholes = 0;
};

/// The choice of Yosys (memory_libmap) for one read and one write port: the cheapest of look-up tables and block RAMs,
/// multiplexers included. The costs are those of its library for 7-series.
Mapped mapped(const Memory& memory) {
  Mapped best;
  double least = 0.0;
  const auto offer = [&](double cost, int deep, const Mapped& cells) {
    cost += 0.5 * memory.bits * (deep - 1);
    if (least > 0.0 && cost >= least) return;
    least = cost;
    best = cells;
  };
  for (const auto& [depth, width] : {std::pair{32, 6}, {64, 3}}) {  // RAM32M, RAM64M: four look-up tables each
    const int deep = ceil_div(memory.words, depth), part = memory.bits % width;
    const double row = 8.0 * (memory.bits / width) + (part > 0 ? 1.0 + 7.0 * part / width : 0.0);
    offer(deep * row, deep, {.luts = 4 * deep * ceil_div(memory.bits, width)});
  }
  int depth = 16384;
  for (const int width : {1, 2, 4, 9, 18, 36}) {
    const int deep = ceil_div(memory.words, depth), count = deep * ceil_div(memory.bits, width);
    offer(129.0 * count, deep, {.halves = count});
    depth /= 2;
  }
  depth = 32768;
  for (const int width : {1, 2, 4, 9, 18, 36, 72}) {
    const int deep = ceil_div(memory.words, depth), count = deep * ceil_div(memory.bits, width);
    offer(257.0 * count, deep, {.wholes = count});
    depth /= 2;
  }
  return best;
}

/// The widths of cmodel/rtl_package, and what decides cells.
struct Widths {
  const Config& c;
  int lanes = c.lanes, banks = lanes * lanes, composited = c.composited_at_once();
  int blocks_x = c.tile_width / lanes, blocks_y = c.tile_height / lanes, blocks = blocks_x * blocks_y;
  int address = bits_for(blocks - 1), origin = c.origin_bits();
  int position = c.position_int_bits + c.position_frac_bits, column = bits_for(c.rlut_columns),
      radius = bits_for(c.rlut_columns * c.phases), set = radius + 2 * column;
  int rlut = c.radial_index_bits() + c.rlut_guard_bits + 1, weight = c.radial_int_bits + c.radial_frac_bits,
      colour = c.colour_bits(), sheet = c.sheet_int_bits + c.sheet_frac_bits;
  int factor = c.opacity_frac_bits + 1, rest = c.opacity_remainder_bits(), unit = c.composite_frac_bits + 1,
      state = std::max(sheet, unit + c.colour_int_bits), out = c.pixel_int_bits + c.pixel_frac_bits;
  int ellipse = c.has_ellipses() ? c.ellipse_format().word_bits : 0, samples = c.composite_every_sample,
      densities = c.classifies() ? 1 : 0, culls = c.culls() ? 1 : 0;
  int cull_words = c.cull_cell() == 1 ? lanes : blocks_x,
      cull_word = bits_for(c.tile_width / c.cull_cell() * (c.tile_height / c.cull_cell()));

  Memory rlut_table{2 * lanes, c.phases << std::max(1, index_bits(c.rlut_columns / lanes)), rlut};
  Memory radial{banks, c.radial_entries, weight*(1 + c.radial_interpolate)};
  Memory factors{composited, c.opacity_segments, 2 * factor};
  Memory sheets{2 * banks, blocks, 4 * sheet};
  Memory picture{banks, blocks, 4 * state};
};

std::vector<Memory> memories(const Widths& w) {
  std::vector<Memory> all{w.rlut_table, w.radial, w.factors, w.sheets, w.picture};
  if (w.densities) {  // the ring of three densities; CLASSIFY, ROOT, GLINT and SHEETS; the blocks to come
    const int segments = 1 << w.c.classify_segment_bits;
    for (const Memory& memory : {Memory{3 * w.banks, w.blocks, w.sheet},
                                 {3 * w.composited, segments, 30},
                                 {w.composited, segments, 2 * w.sheet},
                                 {w.composited, 96, 30},
                                 {w.composited, 128, 26},
                                 {1, 4096, 64},
                                 {1, 2 << w.address, w.address}})
      all.push_back(memory);
  }
  if (w.culls) {  // two tables, by corner; groups; terminated pixels
    const int cells_x = w.c.tile_width / w.c.cull_cell(), chunks = cells_x / w.cull_words;
    all.push_back({chunks > 1 ? 8 : 4, w.c.tile_height / w.c.cull_cell() * chunks, w.cull_words * w.cull_word});
    all.push_back({1, 1 << bits_for(static_cast<int>(cmodel::cull_sets(w.c)) - 1), 64});
    if (w.c.cull_cell() == 1) all.push_back({3, w.blocks, w.banks});
  }
  return all;
}

/// DSP48E1 of a product of two signed words (mul2dsp): 25 x 18 bits, wider words in parts of 17.
int dsp(int a, int b) {
  if (a < b) std::swap(a, b);
  return (a > 25 ? ceil_div(a - 25, 17) + 1 : 1) * (b > 18 ? ceil_div(b - 18, 17) + 1 : 1);
}
/// Products of fewer bits are logic.
constexpr int kLeastProduct = 9;
/// Of two unsigned words.
int unsigned_dsp(int a, int b) { return a < 2 || b < 2 || a + b < kLeastProduct ? 0 : dsp(a + 1, b + 1); }

int multipliers(const Widths& w) {
  const int unit = w.unit + w.c.colour_int_bits;
  int all = w.banks * (4 * unsigned_dsp(w.colour, w.weight) +
                       (w.c.interpolates() && w.weight + w.c.rlut_guard_bits >= kLeastProduct
                            ? dsp(w.weight + 1, w.c.rlut_guard_bits + 1)
                            : 0)) +
            w.composited *
                (unsigned_dsp(w.factor, w.rest) + 4 * unsigned_dsp(w.sheet, w.factor) + 4 * unsigned_dsp(unit, unit));
  if (w.densities) {  // a lane: interpolations of CLASSIFY, the gradient, three channels; 40 of fixed widths
    const int rest = w.c.classify_rest_bits();
    all += w.composited * (3 * dsp(16, rest + 2) + dsp(w.sheet + 1, rest + 2) + 2 * dsp(w.sheet + 2, 17) +
                           dsp(w.sheet + 1, 17) + 3 * unsigned_dsp(w.sheet, 17) + 40);
  }
  if (w.culls && w.cull_word >= 9) ++all;  // cells of a window
  if (w.ellipse) {
    const int way = 11 + w.c.position_frac_bits;
    all += 2 * dsp(23, way) + 2 * dsp(24, way) + 2 * dsp(25 + way, way);
    // Multiples of a lane's place: products by constants, powers of two apart.
    const auto constant = [&](int k) {
      return k == 0 || std::has_single_bit(static_cast<unsigned>(k)) ? 0 : dsp(w.ellipse + 1, bits_for(k) + 1);
    };
    for (int g = 0; g < w.lanes; ++g) {
      all += 5 * constant(g) + 2 * constant(g * g);
      for (int h = 0; h < w.lanes; ++h) all += constant(g * h);
    }
  }
  return all;
}

/// Bits of a memory in look-up tables: registered behind it, and selected where it is deeper than 64 words.
double registered(const Memory& m) { return mapped(m).luts > 0 ? static_cast<double>(m.copies) * m.bits : 0.0; }
double selected(const Memory& m) { return registered(m) * (ceil_div(m.words, 64) - 1); }

/// Modules of rtl/ whose cells are fitted together, and what they are proportional to.
struct Part {
  std::vector<std::string_view> modules;
  Row features;
};

std::vector<Part> parts(const Widths& w) {
  const Config& c = w.c;
  const double p = w.lanes, n = w.banks, lane = w.composited, s = w.sheet, d = w.state, e = w.ellipse;
  const double words = w.position + w.set, sides = w.blocks_x + w.blocks_y, counters = c.counter_bits,
               index = c.radial_index_bits(), product = 4.0 * std::min(w.sheet, w.colour + w.weight);
  const double ellipses = c.has_ellipses() ? 1 : 0, densities = w.densities, culls = w.culls, samples = w.samples;
  const double window = ellipses > 0 ? bits_for(std::max(c.rlut_columns, cmodel::kEllipseWindows * w.lanes)) : w.column;
  const bool pixel_cells = c.cull_cell() == 1;  // they lie in a memory
  const bool rounds = c.rounding_product != 0 && c.colour_frac_bits + c.radial_frac_bits > c.sheet_frac_bits;
  return {
      {{"csr", "core", "popcount", "stream_check", "stream_decode", "record_rules", "word_rules", "overlap"},
       {1, counters, n, words, ellipses * words, densities, culls, samples}},
      {{"splat_array", "snap", "axis", "rlut"},
       {1, n * (4 * s + w.weight),
        2 * p * (w.rlut + bits_for(std::max(w.blocks_x, w.blocks_y) - 1) + 1) + registered(w.rlut_table), n * w.rlut,
        words, ellipses * words}},
      {{"lane"},
       {n, n * (4 * s + index + w.weight) + registered(w.radial), n * (index + w.weight), rounds ? n * product : 0,
        n * c.radial_interpolate * (w.weight + c.rlut_guard_bits), n * w.ellipse, selected(w.radial)}},
      {{"sheet_bank"},
       {n * (20 * s + 5 * w.address + 15) + registered(w.sheets), n * w.address, n * 4 * s, selected(w.sheets)}},
      {{"slab_opacity"},
       {lane * (8 * s + 4 * d + 4) + registered(w.factors), lane * 4 * d, lane * w.factor,
        c.rounding_slab != 0 ? lane * 4 * d : 0, selected(w.factors)}},
      {{"composite_lane"},
       {lane * (12 * d + 6), lane * d, c.rounding_light != 0 ? lane * 4 * w.unit : 0, samples * lane * 4 * d}},
      // Slices: registers of a block's earlier ones. Their multiplexers cost no measurable LUT.
      {{"compositor", "sample_places"},
       {1, lane * (4 * d + 8) + (n - lane) * 4 * d + registered(w.picture), p, n * 4 * d, samples * n * 4 * d,
        densities * lane * s, selected(w.picture)}},
      {{"pixel_out"}, {1, p * (4 * w.out + 5), p * 4 * d}},
      {{"dirty_map"}, {1, 2.0 * w.blocks, sides, p * sides}},
      {{"cull_map", "cull", "cull_pixels", "cull_sets", "cull_table", "cull_test", "cull_windows"},
       {culls, culls * w.cull_words * w.cull_word, culls * w.blocks, pixel_cells ? 0 : culls * w.blocks,
        pixel_cells ? culls * n : 0}},
      {{"delay"},
       {ellipses * (35 + 2 * w.position + w.radius + w.column + 2 * window + 4 * w.colour), densities * lane}},
      {{"ellipse_setup", "ellipse_walk", "ellipse"}, {e}},
      {{"ellipse_lanes"}, {e * (14 * p + 3 * n)}},
      {{"classify_normal", "classify_lane", "classify_line", "classify_shade"}, {densities * lane}},
      {{"density_ring"}, {densities * n * s}},
      {{"densities", "density_walk", "classify_tables"}, {densities}},
  };
}

/// Least squares of the relative error with coefficients of at least 0, one after another until they rest: more bits
/// never cost less.
Row fitted(const std::vector<Row>& rows, const std::vector<double>& cells) {
  const std::size_t count = rows.front().size();
  std::vector<Row> products(count, Row(count));
  Row goal(count), out(count);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    for (std::size_t j = 0; j < count; ++j) {
      goal[j] += rows[i][j] / cells[i];
      for (std::size_t k = 0; k < count; ++k) products[j][k] += rows[i][j] * rows[i][k] / (cells[i] * cells[i]);
    }
  }
  constexpr int kSweeps = 3000;
  for (int sweep = 0; sweep < kSweeps; ++sweep) {
    for (std::size_t j = 0; j < count; ++j) {
      if (products[j][j] <= 0.0) continue;
      double gradient = goal[j];
      for (std::size_t k = 0; k < count; ++k) gradient -= products[j][k] * out[k];
      out[j] = std::max(0.0, out[j] + gradient / products[j][j]);
    }
  }
  return out;
}

const Json& model_text() {
  static const Json model = Json::parse(kAreaModelText);
  return model;
}

double cells_of(const Json& modules, const std::vector<std::string_view>& names, std::size_t kind) {
  double sum = 0.0;
  for (const std::string_view name : names)
    if (const auto found = modules.find(std::string(name)); found != modules.end())
      sum += found->at(kind).get<double>();
  return sum;
}

/// Coefficients of look-up tables and flip-flops, by part.
using Model = std::vector<std::array<Row, 2>>;

/// The fit to all samples that are not held out, but not to the one named.
Model fit(std::string_view without = {}) {
  std::vector<std::vector<Part>> of_samples;
  std::vector<const Json*> cells;
  std::map<std::string, Json> cells_by_name;
  for (const Json& entry : model_text().at("samples"))
    if (entry.contains("cells")) cells_by_name[entry.at("name")] = entry.at("cells");
  for (const AreaSample& sample : area_samples()) {
    if (sample.held_out || sample.name == without) continue;
    of_samples.push_back(parts({sample.config}));
    cells.push_back(&cells_by_name.at(sample.name));
  }
  Model out(of_samples.front().size());
  for (std::size_t part = 0; part < out.size(); ++part) {
    for (std::size_t kind = 0; kind < 2; ++kind) {
      std::vector<Row> rows;
      std::vector<double> counts;
      for (std::size_t i = 0; i < cells.size(); ++i) {
        const Part& here = of_samples[i][part];
        if (const double count = cells_of(*cells[i], here.modules, kind); count > 0.0) {
          rows.push_back(here.features);
          counts.push_back(count);
        }
      }
      out[part][kind] = rows.empty() ? Row{} : fitted(rows, counts);
    }
  }
  return out;
}

double estimate(const Row& features, const Row& coefficients) {
  double sum = 0.0;
  for (std::size_t i = 0; i < std::min(features.size(), coefficients.size()); ++i) sum += features[i] * coefficients[i];
  return sum;
}

}  // namespace

double Area::equivalent_luts() const {
  // Kintex-7 XC7K325T.
  constexpr double kLuts = 203800, kFlipFlops = 407600, kHalfBlockRams = 890, kDsps = 840;
  return lut + memory_lut + ff * kLuts / kFlipFlops + half_bram * kLuts / kHalfBlockRams + dsp * kLuts / kDsps;
}

std::vector<AreaSample> area_samples() {
  const Json& model = model_text();
  const auto apply = [](Config& config, const Json& keys) {
    for (const auto& [key, value] : keys.items())
      if (const auto error = cmodel::set(config, key, value.is_string() ? value.get<std::string>() : value.dump()))
        throw UserError(ExitCode::Internal, *error);
  };
  std::vector<AreaSample> out;
  for (const Json& entry : model.at("samples")) {
    if (!entry.contains("cells")) continue;  // not synthesised yet
    AreaSample sample{.name = entry.at("name"),
                      .hash = entry.at("configuration"),
                      .config = {},
                      .held_out = entry.value("held_out", false),
                      .cells = {}};
    apply(sample.config, model.at("base"));
    apply(sample.config, entry.at("set"));
    double* const kinds[] = {&sample.cells.lut, &sample.cells.ff, &sample.cells.bram, &sample.cells.dsp};
    for (const auto& [module, cells] : entry.at("cells").items())
      for (std::size_t i = 0; i < std::size(kinds); ++i) *kinds[i] += cells.at(i).get<double>();
    out.push_back(std::move(sample));
  }
  return out;
}

namespace {

Area area_by(const Model& model, const Config& config) {
  const Widths w{config};
  Area out;
  const std::vector<Part> of = parts(w);
  for (std::size_t i = 0; i < of.size(); ++i) {
    out.lut += estimate(of[i].features, model[i][0]);
    out.ff += estimate(of[i].features, model[i][1]);
  }
  for (const Memory& memory : memories(w)) {
    const Mapped cells = mapped(memory);
    out.memory_lut += memory.copies * cells.luts;
    out.bram += memory.copies * (cells.halves + cells.wholes);
    out.half_bram += memory.copies * (cells.halves + 2 * cells.wholes);
  }
  out.dsp = multipliers(w);
  return out;
}

}  // namespace

Area area(const Config& config) {
  if (const auto violation = cmodel::rtl_violation(config)) throw_input(*violation);
  static const Model model = fit();
  return area_by(model, config);
}

Area area_without(const AreaSample& sample) { return area_by(fit(sample.name), sample.config); }

Json area_json(const Config& config) {
  if (cmodel::rtl_violation(config)) return nullptr;
  const Area a = area(config);
  return {{"family", "xc7"},
          {"lut", std::round(a.lut)},
          {"ff", std::round(a.ff)},
          {"memory_lut", a.memory_lut},
          {"bram", a.bram},
          {"half_bram", a.half_bram},
          {"dsp", a.dsp},
          {"equivalent_luts", std::round(a.equivalent_luts())},
          {"fitted_to", model_text().at("tool")}};
}

}  // namespace fastsplat::analysis
