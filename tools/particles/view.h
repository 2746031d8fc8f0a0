#pragma once
// From where the frames are seen.

#include "core/base/bounds.h"
#include "core/base/ray.h"

namespace pbrt {

// What LookAt and the perspective camera of a scene take, in the same sense: x is to the right and
// y up if one looks along +z.
struct View {
  DPoint3 eye{0, 0, -1}, look{};
  DVec3 up{0, 1, 0};
  double fov = 40;  // over the shorter side, in degrees
};

// Looks at the box from the front, a little from above and from the right, from where all of it is
// in the picture.
View viewOf(const Bounds3& box, const DVec3& up, Point2i size, double fov);

// A pinhole, the eye, and one ray through the middle of each pixel.
class PinholeCamera {
 public:
  // Throws Error, Failure::usage, if the view looks nowhere: eye and look in one place, or up along
  // the line between them, or something so large that it is lost in rounding.
  PinholeCamera(const View& view, Point2i size);

  const DPoint3& eye() const { return eye_; }
  // Unit; up is across forward.
  const Vec3& right() const { return right_; }
  const Vec3& up() const { return up_; }
  const Vec3& forward() const { return forward_; }
  // From a direction() to that of the next pixel in the row.
  const Vec3& stepRight() const { return stepRight_; }
  // From the eye towards a pixel, as far as the plane at distance 1.
  Vec3 direction(int x, int y) const {
    return forward_ + (static_cast<float>(x) - middle_.x) * stepRight_ +
           (static_cast<float>(y) - middle_.y) * stepDown_;
  }
  // The ray's space has its origin at the eye; its direction is unit.
  Ray ray(int x, int y) const;

 private:
  DPoint3 eye_;
  Vec3 right_, up_, forward_;
  Point2 middle_;              // of the picture, from the middle of its first pixel
  Vec3 stepRight_, stepDown_;  // from a pixel to the next
};

}  // namespace pbrt
