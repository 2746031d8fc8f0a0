#pragma once
// A point where a ray meets a surface, and how rays leave it.

#include <cstdint>

#include "core/base/frame.h"
#include "core/base/spectrum.h"
#include "core/base/transform.h"

namespace pbrt {

class Light;
class Material;
struct MediumInterface;

// The colours that a shape itself brings along, for textures to ask for.
class SurfaceColor {
 public:
  virtual ~SurfaceColor();
  // At the point p of the surface, in the shape's object space, within the primitive.
  virtual Spectrum at(const DPoint3& p, std::uint32_t primitive) const = 0;
};

// The point of a shape that a hit names, in the shape's object space.
struct SurfacePoint {
  DPoint3 p{};
  double error = 0;  // the true surface is no farther from p than this, along the normal
  Normal3 n{};       // unit, outward
  Normal3 ns{};      // unit, for shading; zero means n
  Point2 uv{};
  Vec3 dpdu{}, dpdv{};
  Normal3 dndu{}, dndv{};  // derivatives of the shading normal
};

// The same in render space, with all that shading asks for.
struct SurfaceInteraction {
  Point3 p{};
  float error = 0;  // as SurfacePoint::error, with the rounding of p
  Normal3 n{};      // geometric, unit, outward (turned by ReverseOrientation)
  Normal3 ns{};     // shading, unit, in the hemisphere of n
  Vec3 wo{};        // unit, towards where the ray came from
  Point2 uv{};
  Vec3 dpdu{}, dpdv{};
  Normal3 dndu{}, dndv{};
  Vec3 tangent{};  // x axis of the shading frame, not normalised; dpdu unless a mesh says more
  // Footprint of a pixel; zero when rays carry no differentials.
  Vec3 dpdx{}, dpdy{};
  float dudx = 0, dvdx = 0, dudy = 0, dvdy = 0;
  float time = 0;
  const Material* material = nullptr;      // null: nothing to shade, rays go on
  const Light* light = nullptr;            // the area light that the surface is, or null
  const MediumInterface* media = nullptr;  // null: the same medium on both sides
  // The shape's own colours, or null, and what they ask for: worked out only if a texture does.
  const SurfaceColor* color = nullptr;
  DPoint3 objectP{};
  std::uint32_t primitive = 0;

  Frame frame() const { return Frame::fromZX(ns, tangent); }
};

// Sets where the neighbours of the ray, which must have differentials, meet the tangent plane.
void setFootprint(SurfaceInteraction& s, const RayDifferential& ray);

// The one rule by which rays start: off the surface by its error bound, along the geometric
// normal to the side of w, then rounded away, so that the start is certainly on that side.
inline Point3 offsetOrigin(const Point3& p, float error, const Normal3& n, const Vec3& w) {
  const Vec3 offset = (glm::dot(w, n) < 0 ? -error : error) * n;
  Point3 o = p + offset;
  // |o| epsilon is one to two units in the last place.
  for (int i = 0; i < 3; ++i)
    o[i] += std::copysign(std::abs(o[i]) * std::numeric_limits<float>::epsilon(), offset[i]);
  return o;
}

inline Ray spawnRay(const SurfaceInteraction& from, const Vec3& direction) {
  return {offsetOrigin(from.p, from.error, from.n, direction), 0, direction, kInfinity, from.time};
}

// A ray to just before the point `to`, for visibility; what lies nearer than the error of the
// end (`toError`, with its geometric normal `toN`) does not count as an occluder.
inline Ray spawnRayTo(const SurfaceInteraction& from, const Point3& to, float toError = 0,
                      const Normal3& toN = Normal3(0)) {
  const Vec3 w = to - from.p;
  const Point3 o = offsetOrigin(from.p, from.error, from.n, w);
  const Vec3 d = offsetOrigin(to, toError, toN, -w) - o;
  // Any crossing in the last millionth of the way is the end itself, rounded.
  return {o, 0, d, 1 - 1e-6F, from.time};
}

}  // namespace pbrt
