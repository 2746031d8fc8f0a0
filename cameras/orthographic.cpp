// A camera with parallel rays along +z: size does not depend on distance.

#include "core/plugin/plugin.h"
#include "core/plugin/projective_camera.h"

namespace pbrt {

class OrthographicCamera final : public ProjectiveCamera {
 public:
  OrthographicCamera(Params& p, const Setup& setup)
      : ProjectiveCamera(p, setup),
        centre_(origin() + window().centre().x * x() + window().centre().y * y()),
        right_(window().pixel().x * x()),
        down_(window().pixel().y * y()),
        forward_(z()) {}

  CameraRay generate(const CameraSample& sample, bool differentials) const override {
    CameraRay result;
    RayDifferential& ray = result.ray;
    const Point2 film = fromMiddle(sample.film);
    ray.o = centre_ + film.x * right_ + film.y * down_;
    Vec3 d = forward_;
    if (!pinhole()) {
      const Vec3 offset = lens(sample.lens);
      ray.o += offset;
      d -= inverseFocus() * offset;
    }
    finish(ray, d, sample.time);
    if (differentials) {
      ray.hasDifferentials = true;
      ray.rxOrigin = ray.o + right_;
      ray.ryOrigin = ray.o + down_;
      ray.rxDirection = ray.ryDirection = ray.d;
    }
    return result;
  }

  std::optional<glm::dmat4> screenFromCamera() const override { return window().toNdc(); }

 private:
  Point3 centre_;  // of the screen, in render space
  Vec3 right_, down_, forward_;
};

}  // namespace pbrt

PBRT_PLUGIN(Camera, pbrt::OrthographicCamera, "orthographic",
            "sees by parallel rays, as in a plan: distance does not change the size")
