// SPDX-License-Identifier: Apache-2.0
// The rows of a PLY element as numbers, for all formats and types.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "scene/gaussians/ply_header.hpp"

namespace fastsplat::scene {

/// Reads the elements of a file in order. Every refusal is a UserError (Input) that names the place.
class PlyRows {
 public:
  PlyRows(const PlyHeader& header, std::string_view text, std::string where)
      : header_(header), text_(text), where_(std::move(where)), at_(header.size), line_(header.lines) {}

  /// Checks that the file can hold the next element as its header declares it; call it before allocating memory.
  void require(const PlyElement& element) const;
  void skip(const PlyElement& element);
  /// One row of the element; `row` has room for its properties. Numbers need not be finite.
  void read(const PlyElement& element, std::uint64_t number, std::span<double> row);
  /// Checks the remaining bytes: blanks and zeros only, else the file is longer than its header declares.
  std::size_t require_end() const;

 private:
  double binary(PlyType type);
  double word(const PlyElement& element, std::uint64_t number);

  const PlyHeader& header_;
  std::string_view text_;
  std::string where_;
  std::size_t at_;
  std::size_t line_;  ///< ascii: lines that were read
};

}  // namespace fastsplat::scene
