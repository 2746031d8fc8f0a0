#include "core/scene/moving_camera.h"

namespace pbrt {

// An affine map keeps the parameter t of a ray, so what lies near or far stays so.
CameraRay MovingCamera::generate(const CameraSample& sample, bool differentials) const {
  CameraRay result = camera_->generate(sample, differentials);
  RayDifferential& ray = result.ray;
  const Transform since =
      toRender_.at(times_.fraction(ray.time)) * toRender_.ends().start.inverse();
  const auto move = [&](Point3& o, Vec3& d) {
    o = Point3(since.point(DPoint3(o)));
    d = Vec3(since.vector(DVec3(d)));
  };
  move(ray.o, ray.d);
  if (ray.hasDifferentials) {
    move(ray.rxOrigin, ray.rxDirection);
    move(ray.ryOrigin, ray.ryDirection);
  }
  return result;
}

}  // namespace pbrt
