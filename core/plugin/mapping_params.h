#pragma once
// The parameters of 2D texture mappings, the same for every texture that has one.

#include "core/api/mapping.h"
#include "core/plugin/params.h"

namespace pbrt {

// `placement` maps texture space, `world` world space to render space.
inline Mapping2D readMapping(Params& p, const Transform& placement, const Transform& world) {
  constexpr std::string_view kinds[] = {"uv", "spherical", "cylindrical", "planar"};
  const std::string kind =
      p.choice("mapping", kinds, "uv",
               "where texture coordinates come from: the surface's own, the angles about the z "
               "axis of texture space (sphere or cylinder), or a plane in world space");
  if (kind == "spherical") return {SphericalMapping{placement.inverse()}};
  if (kind == "cylindrical") return {CylindricalMapping{placement.inverse()}};

  const Vec2 offset{p.number("udelta", 0, "added to the first coordinate (uv, planar)"),
                    p.number("vdelta", 0, "added to the second coordinate (uv, planar)")};
  if (kind == "planar" || p.describing()) {
    const DVec3 v1 = p.vector("v1", {1, 0, 0}, "direction of the first coordinate (planar)");
    const DVec3 v2 = p.vector("v2", {0, 1, 0}, "direction of the second coordinate (planar)");
    if (!p.describing()) return {PlanarMapping{world.inverse(), v1, v2, offset}};
  }
  const Vec2 scale{p.number("uscale", 1, "repeats of the texture along u (uv)"),
                   p.number("vscale", 1, "repeats of the texture along v (uv)")};
  return {UvMapping{scale, offset}};
}

}  // namespace pbrt
