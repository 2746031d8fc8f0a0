#pragma once
// The surface that a straight segment sweeps as it turns about the z axis: a cylinder, a cone, or a
// hyperboloid of one sheet if the segment is skew to the axis.

#include "core/base/warp.h"
#include "core/plugin/sweep.h"

namespace pbrt {

// P(u, v) is begin + v (end - begin), turned by u times the whole sweep; the normal is that of
// dP/du x dP/dv, which points away from the axis if the segment rises.
class SweptSegment : public Shape, public AreaSampler {
 public:
  Bounds3 bounds(std::uint32_t) const final {
    return roundOutward({-radius_, -radius_, std::min(begin_.z, end_.z)},
                        {radius_, radius_, std::max(begin_.z, end_.z)});
  }

  // At height z the segment is at begin + d (z - begin.z) / dz: there x^2 + y^2 is its squared
  // distance from the axis. Times dz^2, so that flat cones are no harder than steep ones.
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t) const final {
    const auto profile = [&](double z) {
      return d_.z * Plane(begin_) + (z - begin_.z) * Plane(d_);
    };
    const auto value = [&](const DPoint3& p) {
      return dz2_ * lengthSquared(Plane(p)) - lengthSquared(profile(p.z));
    };
    const auto slope = [&](const DPoint3& p, const DVec3& d) {
      return dz2_ * glm::dot(Plane(p), Plane(d)) - glm::dot(profile(p.z), Plane(d_)) * d.z;
    };
    const auto covers = [&](const DPoint3& p) {
      const double v = (p.z - begin_.z) / d_.z;
      if (!(v >= 0 && v <= 1)) return false;
      const Plane turn = turnTo(p, v);
      return sweep_.covers(turn.x, turn.y);
    };
    return intersectQuadric(ray, dz2_, spread2_, value, slope, {0, 0, begin_.z + 0.5 * d_.z},
                            reach_, covers);
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const final {
    const DPoint3 p = pointOf(ray, hit);
    const Plane turn = turnTo(p, (p.z - begin_.z) / d_.z);
    const double length = glm::length(turn);
    const Plane cosSin = length > 0 ? turn / length : Plane(1, 0);
    // The point of the turned segment that is nearest to p.
    const double v = std::clamp(
        glm::dot(rotated({cosSin.x, -cosSin.y}, p) - begin_, d_) / lengthSquared(d_), 0.0, 1.0);
    SurfacePoint s = at(cosSin, v);
    s.uv = Point2(azimuth(turn.x, turn.y) / sweep_.angle(), v);
    return s;
  }

  const AreaSampler* areaSampler() const final { return this; }
  double area() const final { return sweep_.angle() * (strip(1) - strip(0)); }
  AreaSample sample(const DPoint3& from, Point2 u) const final {
    const double phi = sweep_.angle() * u.y;
    const SurfacePoint s = at({std::cos(phi), std::sin(phi)}, stripEnd(u.x));
    return {s.p, s.error, s.n, uniformAreaPdf(from, s.p, s.n, area())};
  }
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const final {
    return uniformAreaPdf(from, p, n, area());
  }
  bool mayHit(const DPoint3& from, const DVec3& w) const final {
    return intersect({from, w}, 0).has_value();
  }

 protected:
  // The ends must differ in z, and not both lie on the axis.
  SweptSegment(const DPoint3& begin, const DPoint3& end, const Sweep& sweep)
      : begin_(begin), end_(end), sweep_(sweep) {}

 private:
  using Plane = glm::dvec2;  // x and y

  static DVec3 rotated(const Plane& cosSin, const DVec3& p) {
    return {cosSin.x * p.x - cosSin.y * p.y, cosSin.y * p.x + cosSin.x * p.y, p.z};
  }

  // A vector whose angle is that from the segment's point at v to p.
  Plane turnTo(const DPoint3& p, double v) const {
    const DPoint3 m = begin_ + v * d_;
    return {m.x * p.x + m.y * p.y, m.x * p.y - m.y * p.x};
  }

  // All but uv of the point at v of the segment, turned.
  SurfacePoint at(const Plane& cosSin, double v) const {
    const DVec3 m = begin_ + v * d_;
    // dP/du x dP/dv over the sweep's angle, before the turn. Where the segment meets the axis it
    // vanishes: the normal is that of the segment's other points.
    DVec3 n(m.x * d_.z, m.y * d_.z, -(m.x * d_.x + m.y * d_.y));
    const double length = glm::length(n);
    if (!(length > 0)) n = (v < 0.5 ? 1.0 : -1.0) * DVec3(d_.x * d_.z, d_.y * d_.z, -spread2_);
    // dn/dv = (N x dN/dv) x N / |N|^3, and N x dN/dv is twist times the segment.
    const DVec3 twisting =
        length > 0 ? twist_ / length / length / length * glm::cross(d_, n) : n * 0.0;
    n = rotated(cosSin, glm::normalize(n));
    const DVec3 p = rotated(cosSin, m);
    const double angle = sweep_.angle();
    const double error = 2e-15 * (radius_ * glm::length(Plane(n)) +
                                  std::max(std::abs(begin_.z), std::abs(end_.z)) * std::abs(n.z));
    return {p,
            error,
            n,
            Normal3(0),
            {},
            angle * DVec3(-p.y, p.x, 0),
            rotated(cosSin, d_),
            angle * DVec3(-n.y, n.x, 0),
            rotated(cosSin, twisting)};
  }

  // Area of the surface from v = 0 to v, up to a constant, a unit of angle: the integral of |N| =
  //   spread |d| sqrt(w^2 + waist^2), w = v - nearest,
  // where the segment's line is nearest to the axis at v = nearest.
  double strip(double v) const {
    return spread2_ > 0 ? stripScale_ * stripIntegral(v - nearest_)
                        : std::abs(d_.z) * glm::length(Plane(begin_)) * v;
  }
  double stripIntegral(double w) const {
    const double hypotenuse = std::sqrt(w * w + waist_ * waist_);
    return (w * hypotenuse + (waist_ > 0 ? waist_ * waist_ * std::asinh(w / waist_) : 0)) / 2;
  }
  // The v up to which there is the share u of the area.
  double stripEnd(double u) const {
    if (!(spread2_ > 0)) return u;
    const double target = (1 - u) * stripIntegral(-nearest_) + u * stripIntegral(1 - nearest_);
    // The integral is odd, and convex above 0: Newton's steps from above stay above.
    const double t = std::abs(target);
    double w = waist_ > 0 ? std::min(std::sqrt(2 * t), t / waist_) : std::sqrt(2 * t);
    for (int i = 0; i < 6 && w > 0; ++i)
      w -= (stripIntegral(w) - t) / std::sqrt(w * w + waist_ * waist_);
    return std::clamp(nearest_ + std::copysign(w, target), 0.0, 1.0);
  }

  DPoint3 begin_, end_;
  Sweep sweep_;
  DVec3 d_ = end_ - begin_;
  double dz2_ = d_.z * d_.z, spread2_ = lengthSquared(Plane(d_));
  double radius_ = std::max(glm::length(Plane(begin_)), glm::length(Plane(end_)));
  double reach_ = radius_ + std::abs(d_.z);
  // N x dN/dv over the segment: d.z times the moment about the axis, the same all along a line.
  double twist_ = d_.z * (begin_.x * d_.y - begin_.y * d_.x);
  double nearest_ = spread2_ > 0 ? -glm::dot(Plane(begin_), Plane(d_)) / spread2_ : 0;
  double stripScale_ = std::sqrt(spread2_) * glm::length(d_);
  double waist_ = spread2_ > 0 ? std::abs(twist_) / (spread2_ * glm::length(d_)) : 0;
};

}  // namespace pbrt
