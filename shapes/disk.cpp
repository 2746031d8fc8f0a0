// A disk across the z axis; with an inner radius a ring, with less than a full turn a sector.

#include "core/base/warp.h"
#include "core/plugin/plugin.h"
#include "core/plugin/sweep.h"

namespace pbrt {

class Disk final : public Shape, public AreaSampler {
 public:
  explicit Disk(Params& p)
      : z_(p.number("height", 0, "where it crosses the z axis", "scene units")),
        radius_(p.positive("radius", 1, "radius", "scene units")),
        inner_(p.nonNegative("innerradius", 0, "radius of the hole", "scene units")),
        sweep_(p) {
    if (!(inner_ < radius_)) p.fail("innerradius", "must be below the radius");
  }

  Bounds3 bounds(std::uint32_t) const override {
    return roundOutward({-radius_, -radius_, z_}, {radius_, radius_, z_});
  }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t) const override {
    const double t = (z_ - ray.o.z) / ray.d.z;
    if (!(t > ray.tMin && t <= ray.tMax)) return {};  // parallel rays have no t, or infinity
    const DPoint3 p = ray.at(t);
    const double rho2 = p.x * p.x + p.y * p.y;
    if (!(rho2 <= radius_ * radius_ && rho2 >= inner_ * inner_)) return {};
    if (!sweep_.covers(p.x, p.y)) return {};
    return hitAt(t);
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    const DPoint3 p = pointOf(ray, hit);
    const double rho = std::sqrt(p.x * p.x + p.y * p.y);
    const DVec3 outward = rho > 0 ? DVec3(p.x, p.y, 0) / rho : DVec3(1, 0, 0);
    const DVec3 dpdu = sweep_.angle() * rho * DVec3(-outward.y, outward.x, 0);
    const DVec3 dpdv = (inner_ - radius_) * outward;
    const Point2 uv(azimuth(p.x, p.y) / sweep_.angle(), (radius_ - rho) / (radius_ - inner_));
    return {{p.x, p.y, z_}, 0, {0, 0, 1}, Normal3(0), uv, dpdu, dpdv};
  }

  const AreaSampler* areaSampler() const override { return this; }
  double area() const override {
    return sweep_.angle() / 2 * (radius_ * radius_ - inner_ * inner_);
  }
  AreaSample sample(const DPoint3& from, Point2 u) const override {
    // Rings of equal area: rho^2 is uniform.
    const double rho = std::sqrt((1 - u.x) * inner_ * inner_ + u.x * radius_ * radius_);
    const DPoint3 p(rho * std::cos(sweep_.angle() * u.y), rho * std::sin(sweep_.angle() * u.y), z_);
    return {p, 0, {0, 0, 1}, pdf(from, p, {0, 0, 1})};
  }
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    return uniformAreaPdf(from, p, n, area());
  }
  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    return intersect({from, w}, 0).has_value();
  }
  DirectionCone normals() const override { return {{0, 0, 1}, 1}; }

 private:
  double z_, radius_, inner_;
  Sweep sweep_;
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::Disk, "disk", "a disk, a ring or a sector of one")
