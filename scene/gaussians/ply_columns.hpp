// SPDX-License-Identifier: Apache-2.0
// Which properties of a PLY's vertices hold a Gaussian's numbers, and how to read a row.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "scene/gaussians/gaussian_rows.hpp"
#include "scene/gaussians/ply_header.hpp"

namespace fastsplat::scene {

class PlyColumns {
 public:
  /// Throws UserError (Input) if the vertices are not the Gaussians of a scene; the message names what they are.
  PlyColumns(const PlyElement& vertices, std::string where);

  int degree() const { return degree_; }
  /// Assumptions about the properties and unused ones, a sentence each; call it after the last row.
  std::vector<std::string> remarks() const;
  /// A row as a Gaussian. UserError (Input) for a colour property beyond its range.
  void read(std::span<const double> row, GaussianRows& to);

 private:
  std::size_t column(const PlyElement& vertices, const std::string& name) const;
  void find_colour(const PlyElement& vertices);
  double white_of(const PlyProperty& property) const;
  void find_rest(const PlyElement& vertices);
  void find_unused(const PlyElement& vertices);

  std::string where_;
  std::array<std::size_t, 3> position_{}, constant_{};
  std::array<std::size_t, 4> rotation_{};
  std::array<std::optional<std::size_t>, 3> scale_{};  ///< without the third: a disc
  std::size_t opacity_ = 0;
  std::optional<std::size_t> filter_{};  ///< the deviation of Mip-Splatting's smoothing filter
  std::vector<std::size_t> rest_{};      ///< f_rest_0 ..
  std::array<double, 3> white_{};        ///< value of red, green and blue that means 1; 0: constant_ are harmonics
  int degree_ = 0;
  bool encoded_ = false;  ///< some scale is not above 0 or some opacity not in 0..1: they are logarithms and logits
  std::vector<std::string> remarks_{};
  std::vector<glm::vec3> harmonics_{};  ///< harmonics of the current row
};

}  // namespace fastsplat::scene
