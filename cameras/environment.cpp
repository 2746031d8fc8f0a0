// Sees all around at once: the picture is the whole sphere of directions.

#include <array>

#include "core/base/sphere_map.h"
#include "core/plugin/params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class EnvironmentCamera final : public Camera {
 public:
  EnvironmentCamera(Params& p, const Setup& setup)
      : eye_(setup.toRender.point(DPoint3(0))),
        axes_{setup.toRender.vector({1, 0, 0}), setup.toRender.vector({0, 1, 0}),
              setup.toRender.vector({0, 0, 1})},
        resolution_(setup.resolution),
        map_(map(p)),
        open_(p.number("shutteropen", 0, "when the shutter opens", "scene time")),
        close_(p.number("shutterclose", 1, "when the shutter closes", "scene time")),
        near_(p.nonNegative("hither", 0, "what lies nearer is not seen", "scene units")),
        far_(p.positive("yon", kInfinity, "what lies farther is not seen", "scene units")) {
    if (!(open_ <= close_)) p.fail("shutterclose", "must not be before shutteropen");
    if (!(near_ < far_)) p.fail("yon", "must be above hither");
    p.nonNegative("lensradius", 0, "not used: all is sharp", "scene units");
    p.positive("focaldistance", 1e30F, "not used", "scene units");
    p.positive("frameaspectratio", 1, "not used");
    p.numbers("screenwindow", "not used");
  }

  CameraRay generate(const CameraSample& sample, bool differentials) const override {
    CameraRay result;
    RayDifferential& ray = result.ray;
    ray.o = eye_;
    ray.d = direction(sample.film);
    ray.tMin = near_;
    ray.tMax = far_;
    ray.time = lerp(sample.time, open_, close_);
    if (differentials) {
      ray.hasDifferentials = true;
      ray.rxOrigin = ray.ryOrigin = ray.o;
      ray.rxDirection = direction(sample.film + Point2(1, 0));
      ray.ryDirection = direction(sample.film + Point2(0, 1));
    }
    return result;
  }
  bool usesLens() const override { return false; }

 private:
  static SphereMap map(Params& p) {
    static constexpr std::array<std::string_view, 2> kNames{"equirectangular", "equalarea"};
    const std::string name =
        p.choice("mapping", kNames, "equirectangular",
                 "longitude across and latitude down, or Clarberg's square of equal areas");
    return name == "equalarea" ? SphereMap::equalarea : SphereMap::latlong;
  }

  // The y axis of the camera points to the middle of the square, or to the top of the picture.
  Vec3 direction(Point2 film) const {
    DVec2 st = DVec2(film) / DVec2(resolution_);
    if (map_ == SphereMap::equalarea) st = folded(st);
    const DVec3 w = sphereFromSquare(map_, st);
    return glm::normalize(w.x * axes_[0] + w.z * axes_[1] + w.y * axes_[2]);
  }
  // A neighbour beyond a side is on the other half of that side.
  static DVec2 folded(DVec2 st) {
    for (int i = 0; i < 2; ++i)
      if (st[i] > 1) st = i == 0 ? DVec2(2 - st.x, 1 - st.y) : DVec2(1 - st.x, 2 - st.y);
    return st;
  }

  Point3 eye_;
  std::array<DVec3, 3> axes_;  // of the camera, in render space
  Point2i resolution_;
  SphereMap map_;
  float open_, close_;
  float near_, far_;
};

}  // namespace pbrt

PBRT_PLUGIN(Camera, pbrt::EnvironmentCamera, "environment",
            "sees all around at once, as in a map of the world")
