#pragma once
// Shapes in place: from a shape's object space to the space of its scene.

#include <memory>

#include "core/api/shape.h"

namespace pbrt {

// How much a map can stretch an error: the norm of its linear part, bounded by Frobenius'.
double stretch(const Transform& t);

// The point that a hit of a render-space ray names; `reverse` turns the normals. Everything that
// depends on space is set.
SurfaceInteraction placedSurface(const Shape& shape, const Transform& toRender, bool reverse,
                                 const Ray& ray, const ShapeHit& hit);

// Carries points, directions and derivatives of an interaction to another space.
void transformInteraction(SurfaceInteraction& s, const Transform& t);

// How far off the point p of an instance a ray may start or end because it is traced in the
// instance's own space.
float instanceError(const Transform& toRender, const Point3& p);

// A shape's sampler in another space.
std::unique_ptr<AreaSampler> placedSampler(const AreaSampler& sampler, const Transform& toRender,
                                           bool reverse);

}  // namespace pbrt
