#pragma once
// A stack of spherical surfaces, and how light from the film goes through it.

#include <optional>
#include <span>

#include "cameras/realistic/lens_file.h"
#include "core/base/error.h"
#include "core/base/ray.h"

namespace pbrt {

// In millimetres; the origin is the vertex of the surface that faces the film, +z points to the
// scene. The direction has unit length.
struct LensRay {
  DPoint3 o{};
  DVec3 d{};
};

// What a lens does to rays near its axis: height y and slope u on the last vertex are
// a y + b u and c y + d u on the first one, for light from the film.
struct Paraxial {
  double a = 1, b = 0, c = 0, d = 1;
};

class Lens {
 public:
  // Rows as readLensFile gives them. Throws Error unless just one of them is the stop: flat, with
  // the same medium on both sides.
  explicit Lens(std::span<const LensRow> rows);

  double stopRadius() const { return stopRadius_; }
  void setStopRadius(double radius) { stopRadius_ = radius; }
  double length() const { return surfaces_.back().z; }  // from the first to the last vertex
  double rearRadius() const { return surfaces_.front().rim; }
  // How far beyond the vertex the rim of the surface lies that faces the film; < 0: nearer to it.
  double rearSag() const;
  const Paraxial& paraxial() const { return paraxial_; }
  // The distance from film to last vertex for which what is `distance` ahead of the film is sharp;
  // empty if it is too near for this lens, or the lens does not gather light.
  std::optional<double> focused(double distance) const;

  // Follows a ray from the film out to the scene, and tells where it goes through the stop, in
  // radii of it. Empty: it meets a rim, misses a surface or is totally reflected.
  std::optional<glm::dvec2> trace(LensRay& ray) const;
  // The same with rims and stop of any width; false: there is no way.
  bool traceUnbounded(LensRay& ray) const;
  // The x at which a ray meets the plane of the stop, rims and stop of any width.
  std::optional<double> stopHeight(LensRay ray) const;

 private:
  struct Surface {
    double z = 0;          // of the vertex
    double curvature = 0;  // 1 / radius, > 0 if the centre lies on the side of the scene
    double ratio = 1;      // of the indices on the sides of the film and the scene
    double rim = 0;        // radius
  };

  static bool refract(const Surface& surface, LensRay& ray);

  std::vector<Surface> surfaces_;  // as light from the film meets them
  std::size_t stop_ = 0;
  double stopRadius_ = 0;
  Paraxial paraxial_;
};

}  // namespace pbrt
