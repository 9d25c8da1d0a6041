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

}  // namespace

std::span<const Key> keys() { return kKeys; }

std::uint64_t hash(const Symbols& symbols) {
  std::uint64_t state = 0xcbf29ce484222325U;
  for (const Key& key : kKeys) {
    const std::string line = std::string(key.name) + '=' + std::to_string(symbols.*key.member) + '\n';
    for (const char c : line) {
      state ^= static_cast<unsigned char>(c);
      state *= 0x100000001b3U;
    }
  }
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
