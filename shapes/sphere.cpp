// A sphere about the origin, or the part of it between two heights and up to an angle.

#include "core/base/warp.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class Sphere final : public Shape, public AreaSampler {
 public:
  explicit Sphere(Params& p) : r_(p.positive("radius", 1, "radius", "scene units")) {
    const double a = p.number("zmin", -float(r_), "height where it begins", "scene units");
    const double b = p.number("zmax", float(r_), "height where it ends", "scene units");
    const float phiMax = p.inRange("phimax", 360, 0.01F, 360, "sweep about z", "degrees");
    z0_ = std::max(std::min(a, b), -r_), z1_ = std::min(std::max(a, b), r_);
    if (!(z0_ < z1_)) p.fail("zmax", "leaves nothing of the sphere above zmin");
    theta0_ = std::acos(z0_ / r_), theta1_ = std::acos(z1_ / r_);  // v runs from 0 to 1 there
    phiMax_ = glm::radians(double{phiMax}), whole_ = z0_ == -r_ && z1_ == r_ && phiMax == 360;
  }

  Bounds3 bounds(std::uint32_t) const override {
    return roundOutward({-r_, -r_, z0_}, {r_, r_, z1_});
  }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t) const override {
    // |o + t d|^2 = r^2 by the line's point nearest to the centre, as b^2 - a c cancels from afar
    // (Haines et al. 2019, "Precision Improvements for Ray/Sphere Intersection"); t0 t1 = c / a.
    const double a = lengthSquared(ray.d), b = glm::dot(ray.o, ray.d);
    const double discriminant = a * (r_ * r_ - lengthSquared(ray.o - b / a * ray.d));
    if (!(discriminant >= 0)) return {};
    const double q = -b - std::copysign(std::sqrt(discriminant), b);
    const double t0 = q / a, t1 = (lengthSquared(ray.o) - r_ * r_) / q;
    for (const double t : {std::min(t0, t1), std::max(t0, t1)})
      if (t > ray.tMin && t <= ray.tMax && (whole_ || covers(ray.at(t))))
        return ShapeHit{float(t), float(t - float(t))};  // u keeps what t loses
    return {};
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    const DVec3 n = glm::normalize(ray.at(double{hit.t} + hit.u));
    const double rho = std::sqrt(n.x * n.x + n.y * n.y), theta = std::atan2(rho, n.z);
    const DVec3 east = rho > 0 ? DVec3(-n.y, n.x, 0) / rho : DVec3(0, 1, 0);
    const DVec3 dndu = phiMax_ * rho * east, dndv = (theta1_ - theta0_) * glm::cross(east, n);
    const Point2 uv(phi(n) / phiMax_, (theta - theta0_) / (theta1_ - theta0_));
    return {r_ * n, 1e-15 * r_, n, Normal3(0), uv, r_ * dndu, r_ * dndv, dndu, dndv};
  }

  const AreaSampler* areaSampler() const override { return this; }
  double area() const override { return phiMax_ * r_ * (z1_ - z0_); }
  AreaSample sample(const DPoint3& from, Point2 u) const override {
    if (seenInCone(from)) {
      const auto [n, density] = uniformSphereCone(u, from, r_);
      return {r_ * DVec3(n), 1e-6 * r_, n, density};
    }
    const DVec3 n = uniformZone(u, z0_ / r_, z1_ / r_, phiMax_);
    return {r_ * n, 1e-15 * r_, n, uniformAreaPdf(from, r_ * n, n, area())};
  }
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    if (!seenInCone(from)) return uniformAreaPdf(from, p, n, area());
    return glm::dot(from - p, DVec3(n)) > 0 ? uniformConePdf(sphereConeHeight(from, r_)) : 0;
  }
  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    return intersect({from, w}, 0).has_value();
  }

 private:
  static double phi(const DVec3& p) {
    const double angle = std::atan2(p.y, p.x);
    return angle < 0 ? angle + 2 * std::numbers::pi : angle;
  }
  bool covers(const DPoint3& p) const { return p.z >= z0_ && p.z <= z1_ && phi(p) <= phiMax_; }
  bool seenInCone(const DPoint3& from) const { return whole_ && lengthSquared(from) > r_ * r_; }

  double r_, z0_, z1_, theta0_, theta1_, phiMax_;
  bool whole_;
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::Sphere, "sphere", "a sphere, or a part of it")
