// The key functions of the interfaces: one vtable and one type_info each, in the core library, so
// that casts and catches work across shared objects.

#include "core/api/camera.h"
#include "core/api/filter.h"
#include "core/api/integrator.h"
#include "core/api/light.h"
#include "core/api/material.h"
#include "core/api/sampler.h"
#include "core/api/shape.h"
#include "core/api/world.h"
#include "core/base/error.h"

namespace pbrt {

Shape::~Shape() = default;
MeshShape::~MeshShape() = default;
SurfaceColor::~SurfaceColor() = default;
Light::~Light() = default;
Camera::~Camera() = default;
Filter::~Filter() = default;
Sampler::~Sampler() = default;
Material::~Material() = default;
World::~World() = default;
Integrator::~Integrator() = default;
SamplingIntegrator::~SamplingIntegrator() = default;
VolumeIntegrator::~VolumeIntegrator() = default;

namespace {

const SamplingIntegrator& given(const SamplingIntegrator* surface) {
  if (!surface)
    throw Error("it adds volumes to another integrator: it belongs to VolumeIntegrator");
  return *surface;
}

}  // namespace

VolumeIntegrator::VolumeIntegrator(const Setup& setup) : surface_(given(setup.surface)) {}

}  // namespace pbrt
