#include "core/base/animated_transform.h"

#include "core/base/error.h"

namespace pbrt {

namespace {

// The orthogonal matrix nearest to m: the limit of Q <- (g Q + (g Q)^-T) / 2 (Higham 1986,
// "Computing the Polar Decomposition"). Of all factors g that which brings the determinant to 1
// saves nearly all steps where m is ill-conditioned (Byers and Xu 2008).
glm::dmat3 nearestOrthogonal(const glm::dmat3& m) {
  glm::dmat3 q = m;
  constexpr int kMost = 100;
  for (int i = 0; i < kMost; ++i) {
    q /= std::cbrt(std::abs(glm::determinant(q)));
    const glm::dmat3 next = 0.5 * (q + glm::transpose(glm::inverse(q)));
    const glm::dmat3 step = next - q;
    q = next;
    if (lengthSquared(step[0]) + lengthSquared(step[1]) + lengthSquared(step[2]) < sqr(1e-15))
      break;
  }
  return q;
}

}  // namespace

AnimatedTransform::AnimatedTransform(const TransformPair& pair)
    : ends_(pair), moves_(pair.moves()) {
  if (!moves_) return;
  if (pair.start.swapsHandedness() != pair.end.swapsHandedness())
    throw Error(
        "this moves from a transform to its mirror image: no way between them can be shown");
  start_ = decompose(pair.start);
  end_ = decompose(pair.end);
}

AnimatedTransform::Parts AnimatedTransform::decompose(const Transform& t) {
  const glm::dmat3 m(t.matrix());
  glm::dmat3 q = nearestOrthogonal(m);
  if (t.swapsHandedness()) q = -q;
  const glm::dmat3 s = glm::transpose(q) * m;
  // Symmetric but for rounding.
  return {DVec3(t.matrix()[3]), glm::quat_cast(q), 0.5 * (s + glm::transpose(s))};
}

Transform AnimatedTransform::at(double fraction) const {
  if (!moves_ || fraction <= 0) return ends_.start;
  if (fraction >= 1) return ends_.end;
  const double f = fraction;
  const glm::dquat rotation =
      glm::normalize(glm::slerp(start_.rotation, end_.rotation, f));  // the short way
  glm::dmat4 m(glm::mat3_cast(rotation) * ((1 - f) * start_.stretch + f * end_.stretch));
  m[3] = glm::dvec4(glm::mix(start_.translation, end_.translation, f), 1);
  return Transform(m);
}

}  // namespace pbrt
