// SPDX-License-Identifier: Apache-2.0
// Cameras: orthographic and perspective, orbiting the volume's centre; perspective ones anywhere.
#pragma once

#include <glm/glm.hpp>

#include "scene/volume/volume.hpp"

namespace fastsplat::scene {

/// Content that fits the picture at zoom 1: the volume's bounding sphere, in any view, or the non-empty voxels.
enum class Fit { Sphere, Content };
enum class Projection { Orthographic, Perspective };

/// The user's camera settings.
struct CameraParams {
  Projection projection = Projection::Orthographic;
  double azimuth = 30.0;    ///< degrees about the vertical (volume z) axis; 0 looks along -y (at the face of a head in
                            ///< NIfTI axes), 90 along -x
  double elevation = 15.0;  ///< degrees, positive looks down from above
  double roll = 0.0;        ///< degrees about the view axis
  double zoom = 1.0;        ///< 1: the bounding sphere (plus the kernel's radius) fits the smaller image side
  Fit fit = Fit::Sphere;    ///< Content: see scene/content_fit; zoom then enlarges the picture, the eye stays
  double fov = 30.0;        ///< degrees across the smaller image side, perspective only
};

/// The projection of a world point. Pixel centres are at integer coordinates: pixel (0,0) covers [-0.5,0.5)^2.
struct ScreenPoint {
  double x = 0.0;      ///< pixels, right
  double y = 0.0;      ///< pixels, down
  double depth = 0.0;  ///< mm along the view axis, relative to the volume's centre; larger is farther
  double scale = 0.0;  ///< pixels per mm at this depth, to the right
};

/// A ray through a pixel: world position at depth 0 of `ScreenPoint`'s axis and unit direction.
struct Ray {
  glm::dvec3 origin;     ///< on the plane depth = 0
  glm::dvec3 direction;  ///< unit, away from the eye
  double depth_per_mm;   ///< view-axis depth gained per mm along the ray (1 for orthographic)
};

/// A perspective camera anywhere. Its axes are unit vectors at right angles.
struct Pinhole {
  glm::dvec3 eye{0.0}, right{1.0, 0.0, 0.0}, down{0.0, 1.0, 0.0}, forward{0.0, 0.0, 1.0};
  glm::dvec2 focal{0.0};   ///< pixels, right and down
  glm::dvec2 centre{0.0};  ///< where the view axis meets the picture, pixels
  int width = 0, height = 0;
};

class Camera {
 public:
  /// Perspective zoom moves the eye nearer and keeps the field of view. Throws UserError (Usage) for zoom <= 0, fov
  /// outside (1,150), an eye inside the bounding sphere, or sizes < 1.
  Camera(const CameraParams& params, const volume::Volume& volume, double kernel_radius_mm, int width, int height);
  /// The same for content within a sphere of `radius` about the origin, in any unit.
  Camera(const CameraParams& params, double radius, int width, int height);
  /// Depths are relative to the plane at distance 1 from the eye.
  explicit Camera(const Pinhole& pinhole);

  /// The same view with picture point `middle` moved to the picture's middle and everything `factor` times as large.
  Camera enlarged(double factor, const glm::dvec2& middle) const;

  /// Perspective: valid for points in front of the eye, such as all of the bounding sphere.
  ScreenPoint project(const glm::dvec3& world) const;
  double scale_at(double depth) const;  ///< ScreenPoint::scale of a point at ScreenPoint::depth
  Ray ray(double x, double y) const;    ///< through pixel coordinates (x,y)

  glm::dvec3 direction() const { return forward_; }  ///< unit view axis in world space, away from the eye
  glm::dvec3 right() const { return right_; }        ///< unit, image +x
  glm::dvec3 down() const { return down_; }          ///< unit, image +y
  Projection projection() const { return projection_; }
  /// From the eye to depth 0 along the view axis, mm; infinity for orthographic cameras.
  double eye_distance() const { return eye_distance_; }
  glm::dvec3 eye() const { return eye_; }        ///< perspective only
  double stretch() const { return stretch_; }    ///< pixels down for a pixel right; 1 unless a Pinhole says otherwise
  glm::dvec3 depth_zero() const { return at_; }  ///< along right, down, forward: where the view axis has depth 0
  glm::dvec2 centre() const { return centre_; }  ///< where the view axis meets the picture, pixels
  int width() const { return width_; }
  int height() const { return height_; }

 private:
  Projection projection_;
  glm::dvec3 forward_, right_, down_;
  double scale_ = 1.0;  ///< pixels per mm at the centre
  double eye_distance_ = 0.0;
  int width_ = 0, height_ = 0;
  glm::dvec2 centre_{0.0};
  glm::dvec3 eye_{0.0};
  glm::dvec3 at_{0.0};  ///< depth_zero()
  double stretch_ = 1.0;
};

}  // namespace fastsplat::scene
