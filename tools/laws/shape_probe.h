#pragma once
// A shape under test, and the rays that are sent at it.

#include "core/base/ray.h"
#include "core/base/rng.h"
#include "core/base/warp.h"
#include "law.h"
#include "show.h"
#include "tally.h"

namespace pbrt::laws {

inline std::string show(const DVec3& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}
inline std::string show(const ObjectRay& r) {
  return fmt::format("the ray o {} d {} with t from {} to {}", show(r.o), show(r.d), r.tMin,
                     r.tMax);
}

// A hit, and the primitive that reported it.
struct Found {
  ShapeHit hit;
  std::uint32_t primitive = 0;
};

class ShapeProbe {
 public:
  static constexpr int kHits = 5000;

  // Throws Error if the shape cannot be made.
  explicit ShapeProbe(const Subject& subject);

  Shape& shape() { return *shape_; }
  const Shape& shape() const { return *shape_; }
  const Traits& traits() const { return traits_; }
  const DPoint3& centre() const { return centre_; }  // of the box around all primitives
  double size() const { return size_; }              // half of that box's diagonal
  const Bounds3& box() const { return box_; }
  // Nothing to aim at: no primitive is there, or the bounds have no size.
  bool empty() const { return !(size_ > 0 && std::isfinite(size_)); }

  float uniform() { return rng_.uniform(); }
  Point2 uniform2() { return {rng_.uniform(), rng_.uniform()}; }
  DVec3 direction() { return uniformSphere(uniform2()); }
  DPoint3 around(double radii) { return centre_ + radii * size_ * direction(); }
  DPoint3 inBox();
  // In the box of any primitive: where primitives are sparse, most of the whole box is empty.
  DPoint3 inPrimitive();
  // Half the diagonal of the primitive's box.
  double sizeOf(std::uint32_t primitive) const {
    return glm::length(DVec3(shape_->bounds(primitive).diagonal())) / 2;
  }
  // How many lines to follow through all of it: each may meet many primitives.
  int lines() const {
    return std::clamp(static_cast<int>(2'000'000 / shape_->primitives()), kHits / 20, kHits);
  }
  // One that is likely to hit: from outside, sometimes from within.
  ObjectRay ray();

  // How much farther than rounding a point may be from where its ray saw it.
  double errorOf(const SurfacePoint& s) const { return traits_.facingWidth > 0 ? 0 : s.error; }

  // Visits the primitives that a ray may meet: all of a few; of many, those whose boxes it passes
  // at no more than their size, so that bounds that are too small still show. Visits may shorten
  // the ray.
  template <class Visit>
  void primitives(const ObjectRay& ray, Visit visit) const {
    const DVec3 inverse = 1.0 / ray.d;
    for (const Group& group : groups_)
      if (boxes_.empty() || group.box.isPassed(ray, inverse))
        for (std::uint32_t i = group.begin; i < group.end; ++i)
          if (boxes_.empty() || boxes_[i].isPassed(ray, inverse)) visit(i);
  }
  std::optional<Found> nearest(const ObjectRay& ray) const;
  // Visits all crossings along a ray, each once: visit(point).
  template <class Visit>
  void crossings(ObjectRay ray, Visit visit) const {
    while (const auto found = nearest(ray)) {
      visit(shape_->surface(ray, found->hit));
      if (!(found->hit.t >= ray.tMin)) return;  // another law tells that
      ray.tMin = std::nextafter(found->hit.t, kInfinity);
    }
  }
  // Calls visit(ray, found, point) for so many hits.
  template <class Visit>
  void forHits(int count, Judge& judge, Visit visit) {
    int hits = 0;
    for (int tries = 0; hits < count && tries < 100 * count; ++tries) {
      const ObjectRay r = ray();
      const auto found = nearest(r);
      if (!found) continue;
      ++hits;
      visit(r, *found, shape_->surface(r, found->hit));
    }
    judge.expect(hits == count,
                 "the shape is hardly ever hit within its bounds: {} times by {} rays at points of "
                 "the boxes of its primitives, all about {}, of half the diagonal {}",
                 hits, 100 * count, show(centre_), size_);
  }

 private:
  // About a primitive, at a distance as large as itself.
  struct Box {
    DPoint3 lo, hi;

    bool isPassed(const ObjectRay& ray, const DVec3& inverse) const {
      double t0 = ray.tMin, t1 = ray.tMax;
      for (int i = 0; i < 3; ++i) {
        const double a = (lo[i] - ray.o[i]) * inverse[i], b = (hi[i] - ray.o[i]) * inverse[i];
        t0 = std::max(t0, std::min(a, b));
        t1 = std::min(t1, std::max(a, b));
      }
      return t0 <= t1 && t0 < kInfinity;
    }
  };
  static Box grown(const Bounds3& b);

  // Primitives that follow one another are mostly neighbours.
  struct Group {
    Box box;
    std::uint32_t begin, end;
  };

  Traits traits_;
  std::unique_ptr<Shape> shape_;
  std::vector<Group> groups_;
  std::vector<Box> boxes_;  // for each primitive of many; of a few none
  Bounds3 box_;
  DPoint3 centre_{0};
  double size_ = 0;
  Rng rng_{7};
};

// Laws of shapes that are asked ray by ray, as functions of a probe. Where wrong bounds leave no
// place to aim at, one law tells, and the others have nothing to say.
template <void (*body)(ShapeProbe&, Judge&), bool tellsOfBounds = false>
void traced(const Subject& subject, Judge& judge) {
  ShapeProbe probe(subject);
  if (probe.shape().triangles()) return judge.skip("it is handed over as triangles");
  if (probe.empty() && !tellsOfBounds) return judge.skip("its bounds are wrong");
  body(probe, judge);
}

}  // namespace pbrt::laws
