// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file: the elements that follow it and their layout.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace fastsplat::scene {

enum class PlyFormat { Ascii, LittleEndian, BigEndian };
enum class PlyType { Int8, UInt8, Int16, UInt16, Int32, UInt32, Float32, Float64 };
std::size_t size_of(PlyType type);

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
};
struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  bool has_list = false;  ///< its length is only in the data

  std::size_t row_bytes() const;
  std::optional<std::size_t> find(std::string_view property) const;  ///< its index in a row
};
struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> comments;  ///< text of comment and obj_info lines
  std::size_t size = 0;               ///< bytes, to the end of the line end_header
  std::size_t lines = 0;              ///< of the header

  const PlyElement* find(std::string_view element) const;
};

/// `text` is the whole file, `where` its name. UserError (Input) names the line.
PlyHeader read_ply_header(std::string_view text, const std::string& where);

}  // namespace fastsplat::scene
