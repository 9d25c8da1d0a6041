// SPDX-License-Identifier: Apache-2.0
// The configuration by the symbols of docs/numerics.md, section 2, its hash, and the CRC of a stream.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "tests/cmodel/oracle/number.hpp"

namespace fastsplat::oracle {

struct Symbols {
  int P = 0, W = 0, H = 0;
  int pi = 0, pf = 0;
  int k = 0;
  int sets = 0, columns = 0, g = 0;
  int N = 0, wi = 0, wf = 0;
  int cf = 0;
  int zf = 0, hf = 0;
  int si = 0, sf = 0;
  int G = 0, of = 0;
  int tf = 0, eps = 0;
  int xi = 0, xf = 0;
  Rounding Rs = Rounding::Rnd, Rp = Rounding::Rnd, Rf = Rounding::Rnd;
  Rounding Ra = Rounding::Rnd, Rl = Rounding::Rnd, Ro = Rounding::Rnd;
  std::string carry = "xray";
  std::string index = "rlut", symmetry = "off";
  int f = 0;  ///< 0: no ellipses
  // For time and registers; no word depends on them (N-2-4).
  int C = 0;  ///< 0: P^2
  int counter_bits = 64;
  int every_sample = 0;
  std::string cull = "off";  ///< the map's cells
  int interpolate = 0;       ///< of the radial table
  int segment_bits = 0;      ///< q, of CLASSIFY; 0: no sheets of densities
  int node_bits = 0;         ///< of NODES; 0: no solid patterns
  int ci = 0;                ///< 0: colours are below 1
  /// N-4.7-1: one more where weights are interpolated.
  int radial_words() const { return N + interpolate; }

  /// Weights depend on window phases: centres lie on the snap's grid (N-3-1).
  bool has_phases() const { return index == "rlut" || index == "blit2d" || index == "separable"; }
  /// Steps of the centres' grid per pixel (N-3-1).
  int K() const { return has_phases() ? k : 1 << pf; }
};

struct Key {
  const char* name;
  int Symbols::*member;
};
/// In the order of the page's table, which is the order of the hash (N-2-1).
std::span<const Key> keys();

/// The optional keys, which follow the others (N-2-1, N-2-3).
struct RoundingKey {
  const char* name;
  Rounding Symbols::*member;
};
std::span<const RoundingKey> rounding_keys();
const char* word_of(Rounding rounding);

/// 64-bit FNV-1a over the lines "key=value\n" (N-2-5); optional keys only if they are not neutral (N-2-6).
std::uint64_t hash(const Symbols& symbols);

/// CRC-32 of IEEE 802.3, bit by bit.
std::uint32_t crc32(std::span<const std::uint8_t> bytes);

}  // namespace fastsplat::oracle
