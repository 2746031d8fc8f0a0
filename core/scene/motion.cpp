#include "core/scene/motion.h"

#include "core/base/error.h"
#include "core/scene/placement.h"

namespace pbrt {

namespace {

using Matrix = glm::dmat4x3;

DPoint3 corner(const Bounds3& b, int i) {
  return {i & 1 ? b.hi.x : b.lo.x, i & 2 ? b.hi.y : b.lo.y, i & 4 ? b.hi.z : b.lo.z};
}

// Whether the linear blend of two maps keeps its handedness all the way. Its determinant is a cubic
// of the Bernstein coefficients |A|, |A| tr(A^-1 B) / 3, |B| tr(B^-1 A) / 3 and |B|; if they are of
// one sign, then so is it.
bool canBlend(const Matrix& from, const Matrix& to) {
  const glm::dmat3 a(from), b(to);
  const auto trace = [](const glm::dmat3& m) { return m[0][0] + m[1][1] + m[2][2]; };
  return glm::determinant(a) * glm::determinant(b) > 0 && trace(glm::inverse(a) * b) > 0 &&
         trace(glm::inverse(b) * a) > 0;
}

// Whether the chain of keys is as near to the way `at` as Motion promises. The distance of two
// affine maps is convex, so it is largest in a corner. A bow is tried at a third, where a parabola
// is at 8/9 of its height, not in the middle, where an S-shaped way crosses its chord.
template <class Way>
bool isNear(const std::vector<Matrix>& keys, const Way& at, const Bounds3& extent) {
  const std::size_t steps = keys.size() - 1;
  double longest2 = 0, worst2 = 0;
  for (std::size_t k = 0; k < steps; ++k) {
    constexpr double kPlace = 1.0 / 3;
    const Matrix bow = at((static_cast<double>(k) + kPlace) / static_cast<double>(steps)) -
                       ((1 - kPlace) * keys[k] + kPlace * keys[k + 1]);
    const Matrix way = keys[k + 1] - keys[0];
    for (int i = 0; i < 8; ++i) {
      const glm::dvec4 p(corner(extent, i), 1);
      worst2 = std::max(worst2, lengthSquared(bow * p));
      longest2 = std::max(longest2, lengthSquared(way * p));
    }
  }
  return sqr(9.0 / 8) * worst2 <= sqr(0x1p-12) * longest2;
}

}  // namespace

Motion::Motion(const AnimatedTransform& outer, const AnimatedTransform& inner,
               const Bounds3& extent) {
  const auto at = [&](double f) { return Matrix((outer.at(f) * inner.at(f)).matrix()); };
  for (int steps = 1;; steps *= 2) {
    std::vector<Matrix> keys;
    for (int k = 0; k <= steps; ++k) keys.push_back(at(static_cast<double>(k) / steps));
    bool blends = true;
    for (int k = 0; k < steps; ++k) blends = blends && canBlend(keys[k], keys[k + 1]);
    if (steps < kMostSteps && !(blends && (extent.empty() || isNear(keys, at, extent)))) continue;
    if (!blends) throw Error("the two transforms of this motion cannot be blended");
    keys_.assign(keys.begin(), keys.end());
    return;
  }
}

Motion::Blend Motion::blend(float fraction) const {
  // Embree, too, finds the step in floats.
  const auto steps = static_cast<int>(keys_.size()) - 1;
  const float at = fraction * static_cast<float>(steps);
  const int k = std::min(static_cast<int>(at), steps - 1);
  return {keys_[k], keys_[k + 1], at - static_cast<float>(k)};
}

Transform Motion::at(float fraction) const {
  const auto [from, to, weight] = blend(fraction);
  return Transform(glm::dmat4((1 - weight) * Matrix(from) + weight * Matrix(to)));
}

// As instanceError(), but Embree also blends the keys in floats: two products and a sum, of numbers
// that may be larger than what comes out.
float Motion::error(float fraction, const Transform& placement, const Point3& p) const {
  const auto [from, to, weight] = blend(fraction);
  const auto stretch2 = [](const Key& k) {
    return lengthSquared(k[0]) + lengthSquared(k[1]) + lengthSquared(k[2]);
  };
  const double stretched =
      std::sqrt(std::max(stretch2(from), stretch2(to))) * stretch(placement.inverse());
  const float reach = glm::length(p) + std::max(glm::length(from[3]), glm::length(to[3]));
  return gammaBound(16) * static_cast<float>(stretched) * reach;
}

}  // namespace pbrt
