#include "core/api/interaction.h"

namespace pbrt {

// The footprint of a pixel on the tangent plane: the neighbouring rays cut the plane in p + dpdx
// and p + dpdy; du and dv follow by least squares from dpdx = dpdu dudx + dpdv dvdx (Igehy 1999).
void setFootprint(SurfaceInteraction& s, const RayDifferential& ray) {
  const auto onPlane = [&](const Point3& o, const Vec3& d) {
    const float along = glm::dot(s.n, d);
    return along == 0 ? Vec3(0) : o + d * (glm::dot(s.n, s.p - o) / along) - s.p;
  };
  s.dpdx = onPlane(ray.rxOrigin, ray.rxDirection);
  s.dpdy = onPlane(ray.ryOrigin, ray.ryDirection);
  const float uu = lengthSquared(s.dpdu), uv = glm::dot(s.dpdu, s.dpdv), vv = lengthSquared(s.dpdv);
  const float determinant = uu * vv - uv * uv;
  const float inverse = determinant > 0 ? 1 / determinant : 0;
  const auto solve = [&](const Vec3& dp, float& du, float& dv) {
    const float a = glm::dot(s.dpdu, dp), b = glm::dot(s.dpdv, dp);
    du = (vv * a - uv * b) * inverse;
    dv = (uu * b - uv * a) * inverse;
    // Near an edge seen from the side the footprint has no end.
    du = std::isfinite(du) ? std::clamp(du, -1e8F, 1e8F) : 0;
    dv = std::isfinite(dv) ? std::clamp(dv, -1e8F, 1e8F) : 0;
  };
  solve(s.dpdx, s.dudx, s.dvdx);
  solve(s.dpdy, s.dudy, s.dvdy);
}

}  // namespace pbrt
