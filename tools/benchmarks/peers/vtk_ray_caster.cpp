// SPDX-License-Identifier: Apache-2.0
#include "tools/benchmarks/peers/vtk_ray_caster.hpp"

#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkFixedPointRayCastImage.h>
#include <vtkFixedPointVolumeRayCastMapper.h>
#include <vtkImageData.h>
#include <vtkLight.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <cstdint>

namespace fastsplat::bench {
namespace {

template <class Voxel>
void copy_voxels(const volume::Volume& volume, vtkImageData& grid, int type) {
  grid.AllocateScalars(type, 1);
  auto* out = static_cast<Voxel*>(grid.GetScalarPointer());
  std::transform(volume.voxels.begin(), volume.voxels.end(), out, [](float v) { return static_cast<Voxel>(v); });
}

/// Keeps the stored type, on which the mapper's tables depend.
void fill(const volume::Volume& volume, vtkImageData& grid) {
  const glm::dvec3 first = -0.5 * glm::dvec3(volume.dims - 1) * volume.spacing;
  grid.SetDimensions(volume.dims.x, volume.dims.y, volume.dims.z);
  grid.SetSpacing(volume.spacing.x, volume.spacing.y, volume.spacing.z);
  grid.SetOrigin(first.x, first.y, first.z);
  switch (volume.stored) {
    case volume::VoxelType::U8:
      return copy_voxels<std::uint8_t>(volume, grid, VTK_UNSIGNED_CHAR);
    case volume::VoxelType::U16:
      return copy_voxels<std::uint16_t>(volume, grid, VTK_UNSIGNED_SHORT);
    case volume::VoxelType::I8:
    case volume::VoxelType::I16:
      return copy_voxels<std::int16_t>(volume, grid, VTK_SHORT);
    case volume::VoxelType::F32:
      return copy_voxels<float>(volume, grid, VTK_FLOAT);
  }
}

/// As in docs/guide/vtk.md, "The same view".
void place(const scene::Scene& scene, vtkCamera& camera) {
  const scene::Camera& ours = scene.camera;
  const glm::dvec3 eye = -4.0 * scene.volume->bounding_radius() * ours.direction();
  camera.SetParallelProjection(1);
  camera.SetParallelScale(0.5 * ours.height() / ours.scale_at(0.0));
  camera.SetFocalPoint(0.0, 0.0, 0.0);
  camera.SetPosition(eye.x, eye.y, eye.z);
  camera.SetViewUp(-ours.down().x, -ours.down().y, -ours.down().z);
}

/// scene/shading.hpp: above and to the left of the eye.
void aim(const scene::Scene& scene, vtkLight& light) {
  const glm::dvec3 at = -scene.camera.direction() - 0.35 * scene.camera.right() - 0.5 * scene.camera.down();
  light.SetLightTypeToSceneLight();
  light.SetFocalPoint(0.0, 0.0, 0.0);
  light.SetPosition(at.x, at.y, at.z);
}

void classify(const scene::Scene& scene, vtkVolumeProperty& property) {
  vtkNew<vtkColorTransferFunction> colour;
  vtkNew<vtkPiecewiseFunction> opacity;
  const scene::TransferFunction raw = scene::resolved(scene.transfer_function, *scene.volume);
  for (const scene::ControlPoint& point : raw.points) {
    colour->AddRGBPoint(point.at, point.colour.r, point.colour.g, point.colour.b);
    opacity->AddPoint(point.at, point.opacity);
  }
  property.SetColor(colour);
  property.SetScalarOpacity(opacity);
  property.SetScalarOpacityUnitDistance(raw.reference_length * scene.volume->kernel_unit());
  property.SetInterpolationTypeToLinear();
  property.SetShade(scene.shading.on ? 1 : 0);
  property.SetAmbient(scene.shading.ambient);
  property.SetDiffuse(scene.shading.diffuse);
  property.SetSpecular(scene.shading.specular);
  property.SetSpecularPower(scene.shading.shininess);
}

}  // namespace

struct VtkRayCaster::Pipeline {
  vtkNew<vtkImageData> grid;
  vtkNew<vtkFixedPointVolumeRayCastMapper> mapper;
  vtkNew<vtkVolume> volume;
  vtkNew<vtkVolumeProperty> property;
  vtkNew<vtkRenderer> renderer;
  vtkNew<vtkRenderWindow> window;  ///< only defines the picture's size; never opened
  vtkNew<vtkLight> light;
};

VtkRayCaster::VtkRayCaster(const scene::Scene& scene) : VtkRayCaster(scene, *scene.volume, 1.0) {}

VtkRayCaster::VtkRayCaster(const scene::Scene& scene, const volume::Volume& densities, double step)
    : pipeline_(std::make_unique<Pipeline>()) {
  Pipeline& p = *pipeline_;
  fill(densities, *p.grid);
  classify(scene, *p.property);
  look(scene);

  const auto distance = static_cast<float>(step * scene.volume->kernel_unit());
  p.mapper->SetInputData(p.grid);
  p.mapper->SetNumberOfThreads(1);
  p.mapper->SetAutoAdjustSampleDistances(0);
  p.mapper->SetLockSampleDistanceToInputSpacing(0);
  p.mapper->SetSampleDistance(distance);
  p.mapper->SetInteractiveSampleDistance(distance);
  p.mapper->SetImageSampleDistance(1.0f);
  p.mapper->SetBlendModeToComposite();

  p.volume->SetMapper(p.mapper);
  p.volume->SetProperty(p.property);
  p.window->SetSize(scene.camera.width(), scene.camera.height());
  p.window->AddRenderer(p.renderer);
  p.renderer->AddVolume(p.volume);
  p.renderer->AddLight(p.light);
}

VtkRayCaster::~VtkRayCaster() = default;

void VtkRayCaster::look(const scene::Scene& scene) {
  Pipeline& p = *pipeline_;
  place(scene, *p.renderer->GetActiveCamera());
  aim(scene, *p.light);
}

/// The mapper's Render without the texture that carries the picture to a window.
void VtkRayCaster::draw() {
  Pipeline& p = *pipeline_;
  p.renderer->ResetCameraClippingRange(p.volume->GetBounds());
  // Matters only if several volumes share a picture.
  double first[3] = {0.0, 0.0, 0.0}, spacing[3] = {1.0, 1.0, 1.0};
  int extent[6] = {0, 0, 0, 0, 0, 0};
  p.mapper->PerImageInitialization(p.renderer, p.volume, 0, first, spacing, extent);
  p.mapper->PerVolumeInitialization(p.renderer, p.volume);
  p.mapper->PerSubVolumeInitialization(p.renderer, p.volume, 0);
  p.mapper->RenderSubVolume();
}

Image VtkRayCaster::picture() const {
  vtkFixedPointRayCastImage& cast = *pipeline_->mapper->GetRayCastImage();
  int size[2], used[2], memory[2], origin[2];
  cast.GetImageViewportSize(size);
  cast.GetImageInUseSize(used);
  cast.GetImageMemorySize(memory);
  cast.GetImageOrigin(origin);
  Image out(size[0], size[1]);
  for (int y = 0; y < used[1]; ++y) {
    for (int x = 0; x < used[0]; ++x) {
      const unsigned short* words = cast.GetImage() + 4 * (static_cast<std::ptrdiff_t>(y) * memory[0] + x);
      float* pixel = out.pixel(origin[0] + x, size[1] - 1 - (origin[1] + y));
      for (int c = 0; c < 4; ++c) pixel[c] = static_cast<float>(words[c]) / 32767.0f;
    }
  }
  return out;
}

}  // namespace fastsplat::bench
