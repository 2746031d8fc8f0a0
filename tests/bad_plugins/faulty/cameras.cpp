// Sees the square of side 2 about the z axis by parallel rays; fails by the x of the ray.

#include "fault.h"

namespace pbrt {

class FaultyCamera final : public Camera {
 public:
  FaultyCamera(Params& p, const Setup& setup)
      : fault_(p),
        in_(p.choice("in", kWhere, "ray", "what fails")),
        toRender_(setup.toRender),
        resolution_(setup.resolution) {}
  CameraRay generate(const CameraSample& sample, bool) const override {
    Point2 p = 2.F * sample.film / Vec2(resolution_) - 1.F;
    const float number = fault_.number(p.x);
    CameraRay c;
    c.ray.o = Point3(toRender_.point(DPoint3(p.x, -p.y * (in_ == "ray" ? number : 1), 0)));
    c.ray.d = Vec3(toRender_.vector(DVec3(0, 0, 1)));
    if (in_ == "weight") c.weight = number;
    return c;
  }
  bool usesLens() const override { return false; }

 private:
  static constexpr std::array kWhere = std::to_array<std::string_view>({"ray", "weight"});

  Fault fault_;
  std::string in_;
  Transform toRender_;
  Vec2 resolution_;
};

}  // namespace pbrt

PBRT_PLUGIN(Camera, pbrt::FaultyCamera, "faulty", "a camera that fails")
