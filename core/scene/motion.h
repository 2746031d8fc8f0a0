#pragma once
// How the ray tree moves an instance.

#include <span>
#include <vector>

#include "core/base/animated_transform.h"

namespace pbrt {

// The way of an instance as a chain of matrices, at even steps and blended linearly between them.
// Both the ray tree and the surface of a hit go by these very numbers, so they agree.
class Motion {
 public:
  using Key = glm::mat4x3;  // the four columns of an affine map, as Embree reads them
  static constexpr int kMostSteps = 128;

  // First `inner`, then `outer`; `extent` is what moves, in the space before. No point of it leaves
  // its true way by more than 2^-12 of the longest way that any goes, as far as 128 steps can do
  // that: they do for half a turn. Throws Error (without a place) if a blend flattens space.
  Motion(const AnimatedTransform& outer, const AnimatedTransform& inner, const Bounds3& extent);

  std::span<const Key> keys() const { return keys_; }
  // At a fraction from 0 to 1.
  Transform at(float fraction) const;
  // How far off the point p, placed by `placement` = at(fraction), a ray may start or end because
  // it is traced in the instance's own space.
  float error(float fraction, const Transform& placement, const Point3& p) const;

 private:
  struct Blend {
    const Key &from, &to;
    double weight;  // of `to`
  };
  Blend blend(float fraction) const;

  std::vector<Key> keys_;
};

}  // namespace pbrt
