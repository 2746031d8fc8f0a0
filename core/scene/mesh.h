#pragma once
// Triangle meshes in place: all that the scene knows about triangles beside tracing them.

#include <memory>

#include "core/api/shape.h"
#include "core/api/world.h"

namespace pbrt {

// Moves a mesh into the space of its scene. Normals come out with unit length; triangles without
// area go.
void transformMesh(TriangleMesh& mesh, const Transform& toScene);

// The point that a hit names, in the mesh's space: p, error, n, ns, uv, derivatives and tangent are
// set. `flip` turns the winding's normal; interpolated normals, where there are any, are turned by
// `reverse` alone and decide the side of n.
SurfaceInteraction meshSurface(const TriangleMesh& mesh, const Hit& hit, bool flip, bool reverse);

// Chooses points uniformly over the area of a mesh, with the normals of meshSurface(). Null if it
// has no area.
std::unique_ptr<AreaSampler> meshSampler(const TriangleMesh& mesh, bool flip, bool reverse);

}  // namespace pbrt
