// A square about the origin, in the plane z = 0; fails by the x of the ray.

#include "fault.h"

namespace pbrt {

class FaultyShape final : public Shape {
 public:
  explicit FaultyShape(Params& p)
      : fault_(p), in_(p.choice("in", kWhere, "intersect", "the function that fails")) {}

  Bounds3 bounds(std::uint32_t) const override {
    if (in_ == "bounds") fault_.number(0);
    return {Point3(-1, -1, -0.01F), Point3(1, 1, 0.01F)};
  }
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t) const override {
    const double t = -ray.o.z / ray.d.z;
    const DPoint3 p = ray.at(t);
    if (!(t > ray.tMin && t <= ray.tMax) || std::abs(p.x) > 1 || std::abs(p.y) > 1) return {};
    if (in_ == "intersect") fault_.number(ray.o.x);
    return ShapeHit{static_cast<float>(t)};
  }
  bool occluded(const ObjectRay& ray, std::uint32_t primitive) const override {
    if (in_ == "occluded") fault_.number(ray.o.x);
    return in_ != "occluded" && intersect(ray, primitive);
  }
  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    SurfacePoint s;
    s.p = ray.at(hit.t);
    s.p.z = 0;
    s.n = {0, 0, in_ == "surface" ? -fault_.number(ray.o.x) : -1};
    s.dpdu = {1, 0, 0}, s.dpdv = {0, 1, 0};
    s.uv = Point2(s.p);
    return s;
  }

 private:
  static constexpr std::array kWhere =
      std::to_array<std::string_view>({"bounds", "intersect", "occluded", "surface"});

  Fault fault_;
  std::string in_;
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::FaultyShape, "faulty", "a square that fails")
