// SPDX-License-Identifier: Apache-2.0
// Unit "decode": beats in, checked records out. The only place that checks the rules of StreamRule.
#pragma once

#include <cstdint>
#include <vector>

#include "cmodel/cull/cull_sets.hpp"
#include "cmodel/cull/cull_table.hpp"
#include "cmodel/numbers/config.hpp"
#include "cmodel/splat/snap.hpp"
#include "cmodel/stream/crc32.hpp"
#include "cmodel/stream/records.hpp"
#include "cmodel/stream/stream_rules.hpp"

namespace fastsplat::cmodel {

/// The beats are a whole recorded stream (tiles, beats and CRC checked) or any subset of a stream's tiles. For a device
/// that culls, a subset may lack splats of hidden cull groups (S-cull-10).
enum class StreamScope { Whole, Subset };

class StreamDecode {
 public:
  StreamDecode(const Config& config, StreamScope scope);

  /// Returns the record that this beat completes, or nullptr inside a table; valid until the next call. Throws
  /// StreamRefusal, a UserError (Input), with where = "beat N (byte offset M)". If several rules are broken, it is for
  /// the first one in the order of StreamRule.
  const Record* feed(const Beat& beat);

  /// Throws unless the stream ended properly: end_frame seen (Whole), no tile or table left open (both).
  void finish() const;

  std::uint64_t beats() const { return beats_; }

 private:
  enum class State { Start, Tables, Payload, Tile, Sheet, Ended };

  /// Refuses the beat for rule_. `fix` null: the advice for a stream whose writer broke a rule.
  [[noreturn]] void refuse(const std::string& what, const std::string& expected, const std::string& got,
                           const char* fix = nullptr) const;
  void expect(bool holds, const char* what, std::int64_t expected, std::int64_t got) const;
  void expect_least(std::int64_t got, std::int64_t least, const char* what) const;
  void expect_most(std::int64_t got, std::int64_t most, const char* what) const;
  void expect_within(std::int64_t got, std::int64_t least, std::int64_t most, const char* what) const;
  /// The records that may come next, as text.
  const char* wanted() const;
  void check_reserved(const Beat& beat, const RecordLayout& record) const;
  void check_order(Opcode opcode, const char* name) const;
  void check(const BeginFrame& record, const Beat& beat);
  void check(const LoadTable& header, std::uint32_t words);
  void check(const BeginTile& record);
  void check(const BeginSheet& record);
  void check(const SplatRecord& record);
  void check(const EllipseRecord& record);
  void check_splat(std::int32_t x, std::int32_t y, const std::array<std::uint32_t, 4>& colour, std::uint32_t tag);
  void check(const CullBlock& record);
  void check_announced(const CullBlock& record);
  /// Checks the next splat, columns x rows windows from pixel (x,y) on, against the rectangle of its cull group
  /// (S-cull-7).
  void check_announced(std::uint32_t tag, std::int32_t x, std::int32_t y, std::uint32_t columns, std::uint32_t rows);
  void check(const EndSheet& record);
  void check(const EndTile& record);
  void check(const EndFrame& record);
  const Record* payload(const Beat& beat);

  Config config_;
  StreamScope scope_;
  std::uint64_t config_hash_;
  State state_ = State::Start;
  Record record_;
  mutable StreamRule rule_ = StreamRule::None;  ///< being checked
  std::uint64_t beats_ = 0;                     ///< complete beats taken
  Crc32 crc_;                                   ///< of these beats; for whole streams only
  BeginFrame frame_;
  std::uint32_t words_left_ = 0;
  std::vector<bool> sets_loaded_;
  bool radial_loaded_ = false, factor_loaded_ = false;
  std::uint32_t loaded_ = 0;         ///< bit n: table n of densities or patterns was loaded
  std::uint32_t scaled_sheets_ = 0;  ///< sheets that SHEETS describes
  std::uint32_t tiles_seen_ = 0, tile_ = 0, sheets_seen_ = 0, sheet_ = 0, splats_seen_ = 0;
  std::uint32_t next_tag_ = 0;
  bool jumps_;                      ///< splats of hidden cull groups may be missing
  BeginTile in_;                    ///< the open tile
  Snap snap_;
  struct Footprint {
    std::uint32_t rho = 0, windows = 0;  ///< support radius, windows along a side
  };
  std::vector<Footprint> footprints_;  ///< of each radius set; used for stream invariants
  CullSets<CullBlock> sets_;
};

}  // namespace fastsplat::cmodel
