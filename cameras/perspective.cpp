// A pinhole or thin-lens camera that looks along +z.

#include "core/plugin/plugin.h"
#include "core/plugin/projective_camera.h"

namespace pbrt {

class PerspectiveCamera final : public ProjectiveCamera {
 public:
  PerspectiveCamera(Params& p, const Setup& setup)
      : ProjectiveCamera(p, setup), tangent_(tangent(p)), eye_(origin()) {
    const glm::dvec2 centre = tangent_ * window().centre();
    const glm::dvec2 pixel = tangent_ * window().pixel();
    forward_ = centre.x * x() + centre.y * y() + z();
    right_ = pixel.x * x();
    down_ = pixel.y * y();
  }

  CameraRay generate(const CameraSample& sample, bool differentials) const override {
    // Through the film's place on the plane z = 1.
    const Point2 film = fromMiddle(sample.film);
    Vec3 d = forward_ + film.x * right_ + film.y * down_;
    CameraRay result;
    RayDifferential& ray = result.ray;
    ray.o = eye_;
    if (!pinhole()) {
      const Vec3 offset = lens(sample.lens);
      ray.o += offset;
      d -= inverseFocus() * offset;
    }
    finish(ray, d, sample.time);
    if (differentials) {
      ray.hasDifferentials = true;
      ray.rxOrigin = ray.ryOrigin = ray.o;
      ray.rxDirection = unit(d + right_);
      ray.ryDirection = unit(d + down_);
    }
    return result;
  }

  // z becomes 1 - 1 / z: it grows with the depth.
  std::optional<glm::dmat4> screenFromCamera() const override {
    const double s = 1 / tangent_;
    return window().toNdc() * glm::dmat4({s, 0, 0, 0}, {0, s, 0, 0}, {0, 0, 1, 1}, {0, 0, -1, 0});
  }

 private:
  // The length of the screen's unit at z = 1.
  static double tangent(Params& p) {
    const float fov = p.number("fov", 90, "angle of view over the shorter side", "degrees");
    const auto half =
        p.optionalNumber("halffov", "half the angle of view; goes before fov", "degrees");
    if (!(fov > 0 && fov < 180)) p.fail("fov", "must be above 0 and below 180");
    if (half && !(*half > 0 && *half < 90)) p.fail("halffov", "must be above 0 and below 90");
    return std::tan(glm::radians(half ? double{*half} : double{fov} / 2));
  }

  double tangent_;
  Point3 eye_;
  Vec3 forward_, right_, down_;  // to the screen's centre at camera-space z = 1; one pixel on it
};

}  // namespace pbrt

PBRT_PLUGIN(Camera, pbrt::PerspectiveCamera, "perspective",
            "sees as an eye or a photo camera does: what is near is large")
