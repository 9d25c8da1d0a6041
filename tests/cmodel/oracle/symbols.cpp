// SPDX-License-Identifier: Apache-2.0
#include "tests/cmodel/oracle/symbols.hpp"

namespace fastsplat::oracle {
namespace {

constexpr Key kKeys[] = {
    {"array.lanes", &Symbols::P},
    {"tile.width", &Symbols::W},
    {"tile.height", &Symbols::H},
    {"position.int_bits", &Symbols::pi},
    {"position.frac_bits", &Symbols::pf},
    {"snap.phases", &Symbols::k},
    {"rlut.sets", &Symbols::sets},
    {"rlut.columns", &Symbols::columns},
    {"rlut.guard_bits", &Symbols::g},
    {"radial.entries", &Symbols::N},
    {"radial.int_bits", &Symbols::wi},
    {"radial.frac_bits", &Symbols::wf},
    {"colour.frac_bits", &Symbols::cf},
    {"slices.phase_bits", &Symbols::zf},
    {"slices.frac_bits", &Symbols::hf},
    {"sheet.int_bits", &Symbols::si},
    {"sheet.frac_bits", &Symbols::sf},
    {"opacity.segments", &Symbols::G},
    {"opacity.frac_bits", &Symbols::of},
    {"composite.frac_bits", &Symbols::tf},
    {"composite.freeze_below", &Symbols::eps},
    {"pixel.int_bits", &Symbols::xi},
    {"pixel.frac_bits", &Symbols::xf},
};

constexpr RoundingKey kRoundingKeys[] = {
    {"rounding.snap", &Symbols::Rs}, {"rounding.product", &Symbols::Rp}, {"rounding.fall", &Symbols::Rf},
    {"rounding.slab", &Symbols::Ra}, {"rounding.light", &Symbols::Rl},   {"rounding.pixel", &Symbols::Ro},
};

}  // namespace

std::span<const Key> keys() { return kKeys; }
std::span<const RoundingKey> rounding_keys() { return kRoundingKeys; }

const char* word_of(Rounding rounding) {
  if (rounding == Rounding::RndConv) return "rnd_conv";
  return rounding == Rounding::Trn ? "trn" : "rnd";
}

std::uint64_t hash(const Symbols& symbols) {
  std::uint64_t state = 0xcbf29ce484222325U;
  const auto line = [&](const std::string& key, const std::string& value) {
    for (const char c : key + '=' + value + '\n') {
      state ^= static_cast<unsigned char>(c);
      state *= 0x100000001b3U;
    }
  };
  for (const Key& key : kKeys) line(key.name, std::to_string(symbols.*key.member));
  for (const RoundingKey& key : kRoundingKeys)
    if (symbols.*key.member != Rounding::Rnd) line(key.name, word_of(symbols.*key.member));
  if (symbols.carry != "xray") line("rounding.carry", symbols.carry);
  if (symbols.index != "rlut") line("index.kind", symbols.index);
  if (symbols.symmetry != "off") line("index.symmetry", symbols.symmetry);
  if (symbols.f != 0) line("ellipse.frac_bits", std::to_string(symbols.f));
  if (symbols.C != 0) line("composite.lanes", std::to_string(symbols.C));
  if (symbols.counter_bits != 64) line("counters.bits", std::to_string(symbols.counter_bits));
  if (symbols.every_sample != 0) line("composite.every_sample", "1");
  if (symbols.cull != "off") line("cull.map", symbols.cull);
  if (symbols.interpolate != 0) line("radial.interpolate", "1");
  if (symbols.segment_bits != 0) line("classify.segment_bits", std::to_string(symbols.segment_bits));
  if (symbols.node_bits != 0) line("pattern.node_bits", std::to_string(symbols.node_bits));
  if (symbols.ci != 0) line("colour.int_bits", std::to_string(symbols.ci));
  return state;
}

std::uint32_t crc32(std::span<const std::uint8_t> bytes) {
  std::uint32_t remainder = ~std::uint32_t{0};
  for (const std::uint8_t byte : bytes)
    for (int bit = 0; bit < 8; ++bit) {
      const bool subtract = ((remainder ^ (std::uint32_t{byte} >> bit)) & 1) != 0;
      remainder >>= 1;
      if (subtract) remainder ^= 0xEDB88320U;
    }
  return ~remainder;
}

}  // namespace fastsplat::oracle
