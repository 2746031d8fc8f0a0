// A bowl about the z axis, z = zmax (x^2 + y^2) / radius^2, between two heights.

#include "core/base/warp.h"
#include "core/plugin/plugin.h"
#include "core/plugin/sweep.h"

namespace pbrt {

class Paraboloid final : public Shape, public AreaSampler {
 public:
  explicit Paraboloid(Params& p) : Paraboloid(p, Heights(p)) {}

  Bounds3 bounds(std::uint32_t) const override {
    const double r = std::sqrt(std::max(lo_ / steepness_, hi_ / steepness_));
    return roundOutward({-r, -r, lo_}, {r, r, hi_});
  }

  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t) const override {
    const auto value = [&](const DPoint3& p) { return p.x * p.x + p.y * p.y - p.z / steepness_; };
    const auto slope = [&](const DPoint3& p, const DVec3& d) {
      return p.x * d.x + p.y * d.y - d.z * half_;
    };
    const auto covers = [&](const DPoint3& p) {
      return p.z >= lo_ && p.z <= hi_ && sweep_.covers(p.x, p.y);
    };
    return intersectQuadric(ray, 1, 0, value, slope, {0, 0, lo_ * 0.5 + hi_ * 0.5}, reach_, covers);
  }

  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    const DPoint3 p = pointOf(ray, hit);
    // In the plane through the axis: one step of Newton along the gradient (rho, -half) of
    // (rho^2 - z / steepness) / 2, from far nearer than the surface is round.
    const double rho = std::hypot(p.x, p.y);
    const double excess = (rho * rho - p.z / steepness_) / 2;
    const glm::dvec2 axis = rho > 0 ? glm::dvec2(p.x, p.y) / rho : glm::dvec2(1, 0);
    SurfacePoint s = at(axis, std::max(0.0, rho - rho * excess / (rho * rho + half_ * half_)));
    s.uv = Point2(azimuth(p.x, p.y) / sweep_.angle(), (s.p.z - begin_) / (end_ - begin_));
    return s;
  }

  const AreaSampler* areaSampler() const override { return this; }
  double area() const override {
    return sweep_.angle() * std::abs(strip(hi_) - strip(lo_)) * half_ * half_ / 3;
  }
  AreaSample sample(const DPoint3& from, Point2 u) const override {
    const double phi = sweep_.angle() * u.y;
    const double share = (1 - u.x) * strip(lo_) + u.x * strip(hi_);
    const double rho2 = half_ * half_ * std::expm1(std::log1p(share) / 1.5);
    const SurfacePoint s = at({std::cos(phi), std::sin(phi)}, std::sqrt(std::max(0.0, rho2)));
    return {s.p, s.error, s.n, uniformAreaPdf(from, s.p, s.n, area())};
  }
  float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const override {
    return uniformAreaPdf(from, p, n, area());
  }
  bool mayHit(const DPoint3& from, const DVec3& w) const override {
    return intersect({from, w}, 0).has_value();
  }

 private:
  struct Heights {
    explicit Heights(Params& p)
        : a(p.number("zmin", 0, "height where it begins", "scene units")),
          b(p.number("zmax", 1, "height where it ends", "scene units")) {}
    float a, b;
    double begin() const { return std::min(a, b); }
    double end() const { return std::max(a, b); }
  };

  Paraboloid(Params& p, const Heights& z)
      : begin_(z.begin()),
        end_(z.end()),
        steepness_(end_ / sqr(double{p.positive("radius", 1, "radius at zmax", "scene units")})),
        // Of a bowl that opens downward zmax is the height nearest to the tip.
        lo_(end_ > 0 ? std::max(begin_, 0.0) : begin_),
        hi_(end_),
        sweep_(p) {
    if (end_ == 0) p.fail("zmax", "must not be 0, where the bowl has its tip");
    if (begin_ == end_) p.fail("zmax", "must differ from zmin");
  }

  // All but uv of the point at the distance rho from the axis, in the direction `axis`.
  SurfacePoint at(const glm::dvec2& axis, double rho) const {
    // dP/du x dP/dv is along (x, y, -1 / (2 steepness)).
    const double length = std::hypot(rho, half_);
    const DVec3 n(rho / length * axis, -half_ / length);
    const DVec3 p(rho * axis, steepness_ * rho * rho);
    const double angle = sweep_.angle(), height = end_ - begin_;
    // drho/dz = 1 / (2 steepness rho), which has no bound at the tip; dn/drho is half / length^3
    // times (half, rho) in the plane through the axis.
    const double slope = half_ / std::max(rho, 1e-9 * std::abs(half_));
    const double turn = height * slope * half_ / length / length / length;
    return {p,
            2e-15 * (rho * rho / length + std::abs(p.z * n.z)),
            n,
            Normal3(0),
            {},
            angle * DVec3(-p.y, p.x, 0),
            height * DVec3(slope * axis, 1),
            angle * DVec3(-n.y, n.x, 0),
            turn * DVec3(half_ * axis, rho)};
  }

  // The area from the tip to the height z is angle half^2 / 3 times this: the integral of rho
  // sqrt(1 + (rho / half)^2), with (rho / half)^2 = 4 steepness z; less 1, which would cancel.
  double strip(double z) const { return std::expm1(1.5 * std::log1p(4 * steepness_ * z)); }

  double begin_, end_;  // the heights between which v runs from 0 to 1
  double steepness_;    // z over squared distance from the axis
  double lo_, hi_;      // the heights between which there is a surface
  Sweep sweep_;
  double half_ = 0.5 / steepness_;  // of a downward bowl below 0
  double reach_ = std::sqrt(std::max(lo_ / steepness_, hi_ / steepness_)) + hi_ - lo_;
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::Paraboloid, "paraboloid", "a bowl, or a part of it")
