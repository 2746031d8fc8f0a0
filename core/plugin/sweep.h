#pragma once
// What shapes of revolution about the z axis have in common.

#include "core/api/shape.h"
#include "core/plugin/params.h"

namespace pbrt {

// The angle about z from +x to (x, y), in [0, 2 pi].
inline double azimuth(double x, double y) {
  const double angle = std::atan2(y, x);
  return angle < 0 ? angle + 2 * std::numbers::pi : angle;
}

// How far a profile is turned about the z axis.
class Sweep {
 public:
  // Parameter phimax.
  explicit Sweep(Params& p)
      : degrees_(p.inRange("phimax", 360, 0.01F, 360, "sweep about z", "degrees")) {}

  double angle() const { return angle_; }
  bool whole() const { return degrees_ == 360; }
  bool covers(double x, double y) const { return whole() || azimuth(x, y) <= angle_; }

 private:
  float degrees_;
  double angle_ = glm::radians(double{degrees_});
};

// A hit keeps t in two floats: u holds what the first one loses.
inline ShapeHit hitAt(double t) {
  return {float(t), float(t - float(t))};
}
inline DPoint3 pointOf(const ObjectRay& ray, const ShapeHit& hit) {
  return ray.at(double{hit.t} + hit.u);
}

// The nearest crossing, where covers(p) holds, of a ray with the surface of second order about z
//   value(p) = radial (x^2 + y^2) - axial z^2 + (terms of first and no order in z) = 0,
// slope(p, d) being half of its derivative along d. Both are to be worked out so that they are
// small near the surface but for rounding. What is covered lies within `reach` of `centre`.
template <class Value, class Slope, class Covers>
std::optional<ShapeHit> intersectQuadric(const ObjectRay& ray, double radial, double axial,
                                         Value value, Slope slope, const DPoint3& centre,
                                         double reach, Covers covers) {
  const DVec3& d = ray.d;
  const double length2 = lengthSquared(d), near2 = 4 * reach * reach;
  // value(o + t d) = a t^2 + 2 b t + c. From afar that cancels: there t begins at the point of the
  // line that is nearest to the centre. Else it begins with the ray, and c tells on which side of
  // the surface this is.
  double start = glm::dot(centre - ray.o, d) / length2;
  if (start * start * length2 <= near2) start = 0;
  const DPoint3 o = ray.at(start);
  const double a = radial * (d.x * d.x + d.y * d.y) - axial * d.z * d.z;
  const double b = slope(o, d), c = value(o), vertex = -b / a;
  // b^2 - a c is the same wherever t begins; where b vanishes nothing is left to cancel.
  const bool vertexNear = vertex * vertex * length2 <= near2;
  const DPoint3 p = vertexNear ? o + vertex * d : o;
  const double discriminant = sqr(slope(p, d)) - a * value(p);
  if (!(discriminant >= 0)) return {};
  // The root that does not cancel, and the other one by t0 t1 = c / a. As a vanishes the first goes
  // to infinity.
  const double q = -b - std::copysign(std::sqrt(discriminant), b);
  const double t0 = start + q / a, t1 = start + c / q;
  for (const double t : {std::min(t0, t1), std::max(t0, t1)})
    if (t > ray.tMin && t <= ray.tMax && covers(ray.at(t))) return hitAt(t);
  return {};
}

}  // namespace pbrt
