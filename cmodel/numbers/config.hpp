// SPDX-License-Identifier: Apache-2.0
// A hardware configuration: every key of docs/numerics.md, section 2, and the formats derived from them.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "cmodel/numbers/narrow.hpp"

namespace fastsplat::cmodel {

/// Index kinds: methods of footprint evaluation (docs/numerics.md, section 4).
enum class IndexKind { Linear, Squared, SquaredElliptic, Blit2d, Rlut, Separable };
/// The stored footprints of a blit2d set: all, or one of each class of mirror images (N-4.4-3).
enum class IndexSymmetry { Off, Eightfold };

/// Cells of the map that finds hidden splats (N-6.1-3).
enum class CullMap { Off, Block, Pixel };

/// Methods for which the driver diffuses rounding errors along the traversal (N-8-38).
enum class Carry { Off, XRay, On };

// Limits of an ellipse's record (docs/stream.md) and of its arithmetic, which has to fit 62 bits.
inline constexpr int kEllipsePositionBits = 22, kEllipsePositionFracBits = 9;
inline constexpr int kEllipseTermBits = 22;  ///< A and C; |B| is below 2^23
inline constexpr int kEllipseMostShift = 63;
inline constexpr int kEllipseWindows = 32;  ///< along a side
inline constexpr int kEllipseReach = 510;   ///< pixels from the centre to the first or last one
inline constexpr int kEllipseMostBits = 60;

inline constexpr int kMostPatternNodeBits = 7;  ///< 16 MB of nodes, in one record

struct Config {
  std::string name;         ///< not hashed
  std::string description;  ///< not hashed
  std::string verified;     ///< not hashed: what it was verified on ("model", "rtl")

  int lanes = 0;               ///< P
  int tile_width = 0;          ///< W
  int tile_height = 0;         ///< H
  int position_int_bits = 0;   ///< pi
  int position_frac_bits = 0;  ///< pf
  int phases = 0;              ///< k
  int rlut_sets = 0;
  int rlut_columns = 0;
  int rlut_guard_bits = 0;      ///< g
  int radial_entries = 0;       ///< N
  int radial_int_bits = 0;      ///< wi
  int radial_frac_bits = 0;     ///< wf
  int colour_frac_bits = 0;     ///< cf
  int slice_phase_bits = 0;     ///< zf
  int slice_frac_bits = 0;      ///< hf
  int sheet_int_bits = 0;       ///< si
  int sheet_frac_bits = 0;      ///< sf
  int opacity_segments = 0;     ///< G
  int opacity_frac_bits = 0;    ///< of
  int composite_frac_bits = 0;  ///< tf
  int freeze_below = 0;         ///< eps
  int pixel_int_bits = 0;       ///< xi
  int pixel_frac_bits = 0;      ///< xf

  // Each a Rounding.
  int rounding_snap = static_cast<int>(Rounding::RND);     ///< R_s
  int rounding_product = static_cast<int>(Rounding::RND);  ///< R_p
  int rounding_fall = static_cast<int>(Rounding::RND);     ///< R_f
  int rounding_slab = static_cast<int>(Rounding::RND);     ///< R_a
  int rounding_light = static_cast<int>(Rounding::RND);    ///< R_l
  int rounding_pixel = static_cast<int>(Rounding::RND);    ///< R_o

  int rounding_carry = static_cast<int>(Carry::XRay);  ///< a Carry; for the driver only, like slice_*

  int index_kind = static_cast<int>(IndexKind::Rlut);
  int index_symmetry = static_cast<int>(IndexSymmetry::Off);

  int ellipse_frac_bits = 0;  ///< f; 0: no ellipses

  int composite_lanes = 0;  ///< C as configured; 0: P^2
  int counter_bits = 64;
  int composite_every_sample = 0;  ///< 1: tiles may composite every sample (modes 4, 5)
  int cull_map = static_cast<int>(CullMap::Off);
  int radial_interpolate = 0;     ///< 1: weights are interpolated between entries
  int classify_segment_bits = 0;  ///< log2 Q; 0: densities are not classified
  int pattern_node_bits = 0;      ///< log2 M; 0: no solid patterns
  int colour_int_bits = 0;        ///< ci; 0: colours are below 1

  bool operator==(const Config&) const = default;

  // Derived values; valid if the configuration passed first_violation().
  int phase_bits() const { return log2_exact(phases); }  ///< kl
  IndexKind index() const { return static_cast<IndexKind>(index_kind); }
  /// Centres lie on a grid of K = 2^Kl steps a pixel: the snap's, or without phases that of positions (N-3-1).
  int grid_bits() const { return has_phases() ? phase_bits() : position_frac_bits; }  ///< Kl
  int grid() const { return 1 << grid_bits(); }                                       ///< K
  /// Whether weights are read by window phase. If not, they are computed from the unsnapped centre.
  bool has_phases() const {
    return index() == IndexKind::Blit2d || index() == IndexKind::Rlut || index() == IndexKind::Separable;
  }
  /// Whether radius sets occupy columns of one shared memory, from their `base` on.
  bool has_columns() const { return index() == IndexKind::Rlut || index() == IndexKind::Separable; }
  int radial_index_bits() const { return log2_exact(radial_entries); }  ///< nl
  bool interpolates() const { return radial_interpolate != 0; }
  int radial_words() const { return radial_entries + radial_interpolate; }  ///< words of load_table 1
  /// The rim: RLUT words saturate here, and sums at or above it lie outside the footprint.
  std::int64_t rlut_rim() const { return std::int64_t{1} << (radial_index_bits() + rlut_guard_bits); }
  /// Low bits of a sheet word that interpolate within one segment of the slab factor table (b in numerics.md).
  int opacity_remainder_bits() const { return sheet_int_bits + sheet_frac_bits - log2_exact(opacity_segments); }
  /// A tile's sheets may hold densities, which are classified and shaded pixel by pixel.
  bool classifies() const { return classify_segment_bits > 0; }
  /// Low bits of a density within one segment of CLASSIFY.
  int classify_rest_bits() const { return sheet_frac_bits - classify_segment_bits; }
  /// A solid pattern may tint sheets and lean normals.
  bool has_patterns() const { return pattern_node_bits > 0; }
  bool has_ellipses() const { return ellipse_frac_bits > 0; }
  /// q of an ellipse, in steps of 2^-g radial table entries with f fraction bits: up to 512 P^2 times the rim.
  Format ellipse_format() const {
    return signed_format(radial_index_bits() + rlut_guard_bits + 2 * log2_exact(lanes) + 10, ellipse_frac_bits);
  }
  /// Bits of a window's first pixel, tile-relative: at most half a footprint, or an ellipse's 512 pixels, from a
  /// centre.
  int origin_bits() const {
    constexpr int kBesideEllipse = 11;
    return (has_ellipses() && position_int_bits < kBesideEllipse ? kBesideEllipse : position_int_bits) + 2;
  }
  bool culls() const { return cull_map != static_cast<int>(CullMap::Off); }
  int cull_cell() const { return cull_map == static_cast<int>(CullMap::Pixel) ? 1 : lanes; }         ///< u, pixels
  int composited_at_once() const { return composite_lanes == 0 ? lanes * lanes : composite_lanes; }  ///< C, pixels
  /// Slices of a dirty block, P^2 / C: the compositor takes one in each cycle.
  int slices() const { return lanes * lanes / composited_at_once(); }
  /// `count` as a counter's registers show it (N-9-7).
  std::uint64_t counter_word(std::uint64_t count) const {
    return counter_bits < 64 ? count & ((std::uint64_t{1} << counter_bits) - 1) : count;
  }
  /// Largest extent in pixels that the RLUT can hold.
  int max_extent() const { return rlut_columns; }

  Format position_format() const { return signed_format(position_int_bits, position_frac_bits); }
  Format snapped_format() const { return signed_format(position_int_bits, grid_bits()); }
  Format weight_format() const { return unsigned_format(radial_int_bits, radial_frac_bits); }
  /// separable: weight along one axis, at most 1 and at most the largest weight, with g more fraction bits.
  Format axis_weight_format() const {
    const std::int64_t one = std::int64_t{1} << radial_frac_bits, most = weight_format().max;
    return {0, (most < one ? most : one) << rlut_guard_bits, radial_frac_bits + rlut_guard_bits, 0};
  }
  int colour_bits() const { return colour_int_bits + colour_frac_bits; }
  Format colour_format() const { return unsigned_format(colour_int_bits, colour_frac_bits); }
  Format sheet_format() const { return unsigned_format(sheet_int_bits, sheet_frac_bits); }
  Format factor_format() const { return unit_format(opacity_frac_bits); }
  Format transmittance_format() const { return unit_format(composite_frac_bits); }
  /// A slab's colour, and what is seen of it.
  Format slab_format() const {
    return colour_int_bits == 0 ? transmittance_format() : unsigned_format(colour_int_bits, composite_frac_bits);
  }
  Format composited_format() const { return unsigned_format(1 + colour_int_bits, composite_frac_bits); }
  Format pixel_format() const { return unsigned_format(pixel_int_bits, pixel_frac_bits); }

  static int log2_exact(int power_of_two);
};

/// One key of the configuration file. The table order is the order of the hash.
struct ConfigKey {
  const char* name;  ///< "table.key"
  int Config::*member;
  int min, max;
  bool power_of_two;
  const char* meaning;
  std::span<const char* const> names = {};  ///< named values: value i is names[i], min = 0; empty for numbers
  std::optional<int> neutral = {};          ///< value of an absent key, not hashed; empty: the key is required
};
std::span<const ConfigKey> config_keys();
/// Null for an unknown key.
const ConfigKey* find_key(std::string_view name);

/// The key's own range: "1..32", "trn, rnd or rnd_conv".
std::string allowed(const ConfigKey& key);
/// The key's value as in the hash and, apart from the quotes of a named value, in a file.
std::string text_of(const Config& config, const ConfigKey& key);
/// Sets the key. Returns the error, and changes nothing, for an unknown key or an invalid value. first_violation()
/// checks limits between keys.
std::optional<ErrorParts> set(Config& config, std::string_view key, std::string_view value);

/// The first violated limit, with both numbers; empty for a valid configuration.
std::optional<ErrorParts> first_violation(const Config& config);

/// 64-bit FNV-1a over "key=value\n" in table order, without keys at their neutral value (N-2-5, N-2-6).
std::uint64_t config_hash(const Config& config);

}  // namespace fastsplat::cmodel
