#pragma once
// What cameras with a flat film and a thin lens have in common.

#include <fmt/format.h>

#include "core/api/camera.h"
#include "core/base/warp.h"
#include "core/plugin/params.h"

namespace pbrt {

// Screens and lenses are not wider, nor ratios of lengths greater, so that floats hold all rays.
inline constexpr float kWidest = 1e18F;

// The rectangle of the screen (a plane across the camera's z axis; x right, y up) that the film
// shows, and its resolution: maps film places, in pixels from the upper left corner, to the screen.
class ScreenWindow {
 public:
  // Parameters frameaspectratio and screenwindow. The shorter side is [-1, 1] by default.
  ScreenWindow(Params& p, Point2i resolution) : resolution_(resolution) {
    const float aspect =
        p.inRange("frameaspectratio", float(resolution.x) / float(resolution.y), 1 / kWidest,
                  kWidest, "width by height of the screen; from the resolution if absent");
    hi_ = aspect > 1 ? glm::dvec2(aspect, 1) : glm::dvec2(1, 1 / double{aspect});
    lo_ = -hi_;
    const auto window =
        p.numbers("screenwindow",
                  "left, right, lower and upper edge of the picture, whose shorter side is from -1 "
                  "to 1 if absent: that is fov, or scene units if orthographic");
    if (window.empty()) return;
    if (window.size() != 4) p.fail("screenwindow", "needs 4 numbers: x0 x1 y0 y1");
    for (const float side : window)
      if (!(std::abs(side) <= kWidest))
        p.fail("screenwindow", fmt::format("lies beyond {}: nothing is seen there", kWidest));
    lo_ = {window[0], window[2]};
    hi_ = {window[1], window[3]};
    if (!(lo_.x < hi_.x && lo_.y < hi_.y))
      p.fail("screenwindow", "is empty: x0 must be below x1, and y0 below y1");
  }

  glm::dvec2 centre() const { return 0.5 * (lo_ + hi_); }
  // One pixel to the right and down.
  glm::dvec2 pixel() const {
    return {(hi_.x - lo_.x) / resolution_.x, (lo_.y - hi_.y) / resolution_.y};
  }
  // Screen to normalised device coordinates; z is kept.
  glm::dmat4 toNdc() const {
    const glm::dvec2 scale = 1.0 / glm::dvec2(hi_.x - lo_.x, lo_.y - hi_.y);
    const glm::dvec2 offset = -glm::dvec2(lo_.x, hi_.y) * scale;
    return {{scale.x, 0, 0, 0}, {0, scale.y, 0, 0}, {0, 0, 1, 0}, {offset.x, offset.y, 0, 1}};
  }

 private:
  Point2i resolution_;
  glm::dvec2 lo_{-1}, hi_{1};
};

// A camera whose rays all reach a common plane: ray (film, lens) starts on the lens, which lies
// about the camera's origin, and goes through the place of the focal plane that `film` shows.
class ProjectiveCamera : public Camera {
 public:
  bool usesLens() const final { return !pinhole(); }

 protected:
  ProjectiveCamera(Params& p, const Setup& setup)
      : window_(p, setup.resolution),
        middle_(0.5F * Point2(setup.resolution)),
        origin_(setup.toRender.point(DPoint3(0))),
        x_(setup.toRender.vector({1, 0, 0})),
        y_(setup.toRender.vector({0, 1, 0})),
        z_(setup.toRender.vector({0, 0, 1})),
        open_(p.number("shutteropen", 0, "when the shutter opens", "scene time")),
        close_(p.number("shutterclose", 1, "when the shutter closes", "scene time")),
        lensRadius_(p.inRange("lensradius", 0, 0, kWidest, "0: all is sharp", "scene units")),
        focus_(
            p.positive("focaldistance", 1e6F, "what lies this far ahead is sharp", "scene units")),
        near_(p.nonNegative("hither", 0, "what lies nearer ahead is not seen", "scene units")),
        far_(p.positive("yon", kInfinity, "what lies farther ahead is not seen", "scene units")) {
    if (!(lensRadius_ <= kWidest * focus_))
      p.fail("focaldistance", "is too short for so wide a lens");
    if (!(open_ <= close_)) p.fail("shutterclose", "must not be before shutteropen");
    if (!(near_ < far_)) p.fail("yon", "must be above hither");
  }

  const ScreenWindow& window() const { return window_; }
  // Pixels from the film's middle: small numbers where the eye is sharpest, with nothing rounded.
  Point2 fromMiddle(Point2 film) const { return film - middle_; }
  // The camera's origin and axes in render space.
  DPoint3 origin() const { return origin_; }
  const DVec3& x() const { return x_; }
  const DVec3& y() const { return y_; }
  const DVec3& z() const { return z_; }
  bool pinhole() const { return lensRadius_ == 0; }

  // From the centre of the lens to the sampled point of it, in render space. A ray that starts
  // there must bend back by this much over the focal distance.
  Vec3 lens(Point2 u) const {
    const Point2 p = lensRadius_ * concentricDisk(u);
    return p.x * lensX_ + p.y * lensY_;
  }
  float inverseFocus() const { return inverseFocus_; }

  // Of any length: in float its square might be beyond all numbers.
  static Vec3 unit(const Vec3& d) { return Vec3(glm::normalize(DVec3(d))); }
  // Completes a ray along d, whose camera-space z is 1: the direction gets unit length.
  void finish(Ray& ray, const Vec3& d, float time) const {
    const auto length = static_cast<float>(glm::length(DVec3(d)));
    ray.d = unit(d);
    ray.tMin = near_ * length;
    ray.tMax = far_ * length;
    ray.time = lerp(time, open_, close_);
  }

 private:
  ScreenWindow window_;
  Point2 middle_;
  DPoint3 origin_;
  DVec3 x_, y_, z_;
  float open_, close_;
  float lensRadius_, focus_;
  float near_, far_;
  Vec3 lensX_{x_}, lensY_{y_};
  float inverseFocus_ = 1 / focus_;
};

}  // namespace pbrt
