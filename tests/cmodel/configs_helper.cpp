// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/configs_helper.hpp"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "tests/paths.hpp"

namespace fastsplat::test {
namespace {

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r");
  return first == std::string::npos ? "" : text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

}  // namespace

std::map<std::string, std::string> read_keys(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::map<std::string, std::string> keys;
  std::string table;
  for (std::string line; std::getline(file, line);) {
    line = trimmed(line);
    if (line.empty() || line[0] == '#') continue;
    if (line[0] == '[') {
      table = line.substr(1, line.find(']') - 1) + '.';
      continue;
    }
    const auto equals = line.find('=');
    if (equals == std::string::npos) throw std::runtime_error(path + ": no key in: " + line);
    keys[table + trimmed(line.substr(0, equals))] = trimmed(line.substr(equals + 1));
  }
  return keys;
}

/// Numbers that may be absent.
constexpr std::array kNumbers{std::pair{"ellipse.frac_bits", &oracle::Symbols::f},
                              std::pair{"composite.lanes", &oracle::Symbols::C},
                              std::pair{"counters.bits", &oracle::Symbols::counter_bits},
                              std::pair{"composite.every_sample", &oracle::Symbols::every_sample},
                              std::pair{"radial.interpolate", &oracle::Symbols::interpolate},
                              std::pair{"classify.segment_bits", &oracle::Symbols::segment_bits},
                              std::pair{"pattern.node_bits", &oracle::Symbols::node_bits},
                              std::pair{"colour.int_bits", &oracle::Symbols::ci}};

cmodel::Config named_config(const std::string& name) {
  const auto read = read_keys(std::string(FASTSPLAT_SOURCE_DIR) + "/configs/" + name + ".toml");
  oracle::Symbols symbols;
  for (const oracle::Key& key : oracle::keys()) symbols.*key.member = std::stoi(read.at(key.name));
  for (const oracle::RoundingKey& key : oracle::rounding_keys()) {
    if (!read.contains(key.name)) continue;
    for (const auto rounding : {oracle::Rounding::Trn, oracle::Rounding::Rnd, oracle::Rounding::RndConv})
      if (read.at(key.name) == '"' + std::string(oracle::word_of(rounding)) + '"') symbols.*key.member = rounding;
  }
  if (read.contains("rounding.carry"))
    symbols.carry = read.at("rounding.carry").substr(1, read.at("rounding.carry").size() - 2);
  for (const auto& [key, member] : {std::pair{"index.kind", &oracle::Symbols::index},
                                    {"index.symmetry", &oracle::Symbols::symmetry},
                                    {"cull.map", &oracle::Symbols::cull}})
    if (read.contains(key)) symbols.*member = read.at(key).substr(1, read.at(key).size() - 2);
  for (const auto& [key, member] : kNumbers)
    if (read.contains(key)) symbols.*member = std::stoi(read.at(key));
  return config_of(symbols, name);
}

cmodel::Config sampling(const std::string& name) {
  cmodel::Config config = named_config(name);
  config.composite_every_sample = 1;
  return config;
}

std::string name_of(cmodel::IndexKind kind) {
  return cmodel::find_key("index.kind")->names[static_cast<std::size_t>(kind)];
}

std::vector<std::string> config_names() {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(std::string(FASTSPLAT_SOURCE_DIR) + "/configs"))
    if (entry.path().extension() == ".toml") names.push_back(entry.path().stem().string());
  std::sort(names.begin(), names.end());
  return names;
}

oracle::Symbols symbols_of(const cmodel::Config& config) {
  oracle::Symbols symbols;
  for (const cmodel::ConfigKey& theirs : cmodel::config_keys())
    for (const oracle::Key& ours : oracle::keys())
      if (std::string(theirs.name) == ours.name) symbols.*ours.member = config.*theirs.member;
  for (const oracle::RoundingKey& ours : oracle::rounding_keys())
    for (const auto rounding : {oracle::Rounding::Trn, oracle::Rounding::Rnd, oracle::Rounding::RndConv})
      if (cmodel::text_of(config, *cmodel::find_key(ours.name)) == oracle::word_of(rounding))
        symbols.*ours.member = rounding;
  symbols.carry = cmodel::text_of(config, *cmodel::find_key("rounding.carry"));
  symbols.cull = cmodel::text_of(config, *cmodel::find_key("cull.map"));
  symbols.index = cmodel::text_of(config, *cmodel::find_key("index.kind"));
  symbols.symmetry = cmodel::text_of(config, *cmodel::find_key("index.symmetry"));
  for (const auto& [key, member] : kNumbers) symbols.*member = config.*cmodel::find_key(key)->member;
  return symbols;
}

cmodel::Config config_of(const oracle::Symbols& symbols, const std::string& name) {
  cmodel::Config config;
  config.name = name;
  for (const cmodel::ConfigKey& theirs : cmodel::config_keys())
    for (const oracle::Key& ours : oracle::keys())
      if (std::string(theirs.name) == ours.name) config.*theirs.member = symbols.*ours.member;
  for (const oracle::RoundingKey& ours : oracle::rounding_keys())
    if (const auto wrong = cmodel::set(config, ours.name, oracle::word_of(symbols.*ours.member)))
      throw std::runtime_error(one_line(*wrong));
  for (const auto& [key, word] : {std::pair{"rounding.carry", symbols.carry},
                                  {"index.kind", symbols.index},
                                  {"index.symmetry", symbols.symmetry},
                                  {"cull.map", symbols.cull}})
    if (const auto wrong = cmodel::set(config, key, word)) throw std::runtime_error(one_line(*wrong));
  for (const auto& [key, member] : kNumbers)
    if (const auto wrong = cmodel::set(config, key, std::to_string(symbols.*member)))
      throw std::runtime_error(one_line(*wrong));
  return config;
}

namespace {

/// Limits of N-2-7 for a configuration with ellipses, as often at the limits as not.
void draw_ellipses(cmodel::Config& config, Random& random) {
  const auto draw = [&](std::int64_t least, std::int64_t most) {
    if (most <= least) return static_cast<int>(least);
    return static_cast<int>(random.once_in(3) ? random.one_of({least, most}) : random.between(least, most));
  };
  config.position_frac_bits = draw(0, 9);
  config.position_int_bits = draw(cmodel::find_key("position.int_bits")->min,
                                  std::min(cmodel::find_key("position.int_bits")->max, 22 - config.position_frac_bits));
  config.phases = std::min(config.phases, 1 << config.position_frac_bits);
  const int nl = cmodel::Config::log2_exact(config.radial_entries), pl = cmodel::Config::log2_exact(config.lanes);
  config.rlut_columns = std::min(config.rlut_columns, 32 * config.lanes);
  config.rlut_guard_bits = std::min(config.rlut_guard_bits, std::max(18 + 2 * config.position_frac_bits - nl, 0));
  const int room = 50 - nl - config.rlut_guard_bits - 2 * pl;
  config.*cmodel::find_key("ellipse.frac_bits")->member =
      draw(1, std::min(cmodel::find_key("ellipse.frac_bits")->max, room));
}

cmodel::Config drawn_config(Random& random, cmodel::IndexKind kind, bool ellipses) {
  while (true) {
    cmodel::Config config;
    config.name = "random";
    for (const cmodel::ConfigKey& key : cmodel::config_keys()) {
      if (key.neutral && !std::string(key.name).starts_with("rounding.")) continue;  // drawn below
      const bool at_an_end = random.once_in(3);
      std::int64_t value = at_an_end ? random.one_of({key.min, key.max}) : random.between(key.min, key.max);
      if (key.power_of_two) {
        int bits = 0;
        while ((std::int64_t{key.min} << (bits + 1)) <= key.max) ++bits;
        value = std::int64_t{key.min} << (at_an_end ? random.one_of({0, bits}) : random.between(0, bits));
      }
      config.*key.member = static_cast<int>(value);
    }
    config.lanes = std::min(config.lanes, 8);
    config.tile_width = config.lanes * static_cast<int>(random.between(1, 40 / config.lanes));
    config.tile_height = config.lanes * static_cast<int>(random.between(1, 40 / config.lanes));
    config.rlut_columns = config.lanes * static_cast<int>(random.between(1, 64 / config.lanes));
    config.phases = std::min(config.phases, 1 << config.position_frac_bits);
    if (config.phases > 256) config.phases = 256;
    config.index_kind = static_cast<int>(kind);
    if (kind == cmodel::IndexKind::Blit2d) {
      config.index_symmetry = static_cast<int>(random.between(0, 1));
      config.phases = std::min(config.phases, 16);  // streams of less than a million words
      config.rlut_columns = std::min(config.rlut_columns, 32 / config.lanes * config.lanes);
    }
    if (ellipses) draw_ellipses(config, random);
    if (cmodel::first_violation(config)) continue;
    Random beside = random;  // so that these change no other draw
    config.composite_lanes =
        beside.once_in(2) ? 0 : 1 << beside.between(0, 2 * cmodel::Config::log2_exact(config.lanes));
    config.counter_bits = static_cast<int>(beside.between(16, 64));
    config.composite_every_sample = static_cast<int>(beside.between(0, 1));
    if (config.composite_every_sample != 0) config.composite_lanes = 0;
    config.radial_interpolate = static_cast<int>(beside.between(0, 1));
    if (cmodel::first_violation(config)) config.radial_interpolate = 0;
    config.colour_int_bits =
        static_cast<int>(beside.once_in(2) ? 0 : beside.between(0, std::min(4, 16 - config.colour_frac_bits)));
    return config;
  }
}

}  // namespace

cmodel::Config random_config(Random& random, cmodel::IndexKind kind) { return drawn_config(random, kind, false); }

cmodel::Config random_ellipse_config(Random& random, cmodel::IndexKind kind) {
  return drawn_config(random, kind, true);
}

cmodel::Config random_density_config(Random& random, cmodel::IndexKind kind) {
  while (true) {
    const bool ellipses = random.once_in(3) && kind != cmodel::IndexKind::Linear;
    cmodel::Config config = drawn_config(random, kind, ellipses);
    config.sheet_int_bits = static_cast<int>(random.between(1, 4));
    config.sheet_frac_bits = static_cast<int>(random.between(4, std::min(16, 18 - config.sheet_int_bits)));
    config.opacity_segments = std::min(config.opacity_segments, 1 << config.sheet_frac_bits);
    config.classify_segment_bits =
        static_cast<int>(random.between(1, std::min(config.sheet_frac_bits, random.once_in(2) ? 4 : 12)));
    if (!cmodel::first_violation(config)) return config;
  }
}

}  // namespace fastsplat::test
