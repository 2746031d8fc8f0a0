#include "view.h"

#include "core/base/error.h"

namespace pbrt {

namespace {

struct Axes {
  DVec3 right, up, forward;
};

Axes axesOf(const DVec3& forward, const DVec3& up) {
  const DVec3 z = glm::normalize(forward), x = glm::normalize(glm::cross(glm::normalize(up), z));
  return {x, glm::cross(z, x), z};
}

// Half the picture's extent at distance 1.
glm::dvec2 halfExtent(double fov, Point2i size) {
  const double shorter = std::min(size.x, size.y);
  return std::tan(glm::radians(fov / 2)) * glm::dvec2(size) / shorter;
}

}  // namespace

View viewOf(const Bounds3& given, const DVec3& up, Point2i size, double fov) {
  const Bounds3 box = given.empty() ? Bounds3{Point3(-1), Point3(1)} : given;
  View view;
  view.up = up;
  view.fov = fov;
  view.look = 0.5 * (DPoint3(box.lo) + DPoint3(box.hi));
  const bool zIsUp = std::abs(up.z) > std::max(std::abs(up.x), std::abs(up.y));
  const Axes front = axesOf(zIsUp ? DVec3(0, 1, 0) : DVec3(0, 0, 1), up);
  const DVec3 level = glm::cross(front.right, glm::normalize(up));
  const DVec3 back = glm::normalize(0.35 * front.right + 0.4 * glm::normalize(up) - level);
  const Axes axes = axesOf(-back, up);
  const glm::dvec2 half = halfExtent(fov, size);
  // A corner at (x, y, z) from the middle is seen at x / (z + distance), y / (z + distance).
  double distance = 0;
  for (int corner = 0; corner < 8; ++corner) {
    DVec3 p;
    for (int i = 0; i < 3; ++i) p[i] = (corner >> i & 1 ? box.hi[i] : box.lo[i]) - view.look[i];
    const double z = glm::dot(p, axes.forward);
    distance = std::max({distance, std::abs(glm::dot(p, axes.right)) / half.x - z,
                         std::abs(glm::dot(p, axes.up)) / half.y - z});
  }
  constexpr double kMargin = 1.05;
  view.eye = view.look + kMargin * std::max(distance, 1e-6) * back;
  return view;
}

PinholeCamera::PinholeCamera(const View& view, Point2i size)
    : eye_(view.eye), middle_(0.5F * Point2(size) - 0.5F) {
  const Axes axes = axesOf(view.look - view.eye, view.up);
  right_ = axes.right, up_ = axes.up, forward_ = axes.forward;
  const auto isUnit = [](const Vec3& v) { return std::abs(lengthSquared(v) - 1) < 1e-3F; };
  if (!isUnit(right_) || !isUnit(up_) || !isUnit(forward_))
    throw Error(
        "the camera looks nowhere: the eye, the place that it looks at and the way up must not lie "
        "on one line",
        Failure::usage);
  const glm::dvec2 half = halfExtent(view.fov, size), pixel = 2.0 * half / glm::dvec2(size);
  stepRight_ = pixel.x * axes.right;
  stepDown_ = -pixel.y * axes.up;
}

Ray PinholeCamera::ray(int x, int y) const {
  Ray ray;
  ray.d = glm::normalize(direction(x, y));
  return ray;
}

}  // namespace pbrt
