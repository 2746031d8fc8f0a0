// The chain of matrices by which instances move.

#include "core/scene/motion.h"

#include <gtest/gtest.h>

#include "core/base/error.h"
#include "core/base/rng.h"

namespace pbrt {
namespace {

const Bounds3 kBox{{-2, -1, 0}, {1, 1, 3}};

DPoint3 pointIn(const Bounds3& box, Rng& rng) {
  return DPoint3(box.lo) +
         DVec3(box.diagonal()) * DVec3(rng.uniform(), rng.uniform(), rng.uniform());
}

AnimatedTransform way(const Transform& start, const Transform& end) {
  return AnimatedTransform({start, end});
}

// The largest distance of moved points from where they should be, over the longest way that any
// point goes.
double deviation(const Motion& motion, const AnimatedTransform& outer,
                 const AnimatedTransform& inner) {
  Rng rng(1);
  double worst = 0, longest = 0;
  const Transform start = outer.at(0) * inner.at(0);
  for (int i = 0; i < 4000; ++i) {
    const float f = rng.uniform();
    const Transform truth = outer.at(f) * inner.at(f), got = motion.at(f);
    const DPoint3 p = pointIn(kBox, rng);
    worst = std::max(worst, glm::distance(got.point(p), truth.point(p)));
    longest = std::max(longest, glm::distance(truth.point(p), start.point(p)));
  }
  return worst / longest;
}

TEST(Motion, ATranslationTakesOneStep) {
  const AnimatedTransform t = way(Transform::translate({1, 2, 3}), Transform::translate({5, 0, 2}));
  const Motion motion(t, {}, kBox);
  EXPECT_EQ(motion.keys().size(), 2U);
  EXPECT_EQ(motion.at(0.25F).matrix(), Transform::translate({2, 1.5, 2.75}).matrix());
  EXPECT_EQ(motion.at(0).matrix(), t.ends().start.matrix());
  EXPECT_EQ(motion.at(1).matrix(), t.ends().end.matrix());
}

TEST(Motion, KeepsToItsWay) {
  Rng rng(2);
  const auto number = [&](double lo, double hi) { return lo + (hi - lo) * rng.uniform(); };
  const auto random = [&] {
    return Transform::translate({number(-3, 3), number(-3, 3), number(-3, 3)}) *
           Transform::rotate(number(-90, 90), {number(-1, 1), number(-1, 1), 1}) *
           Transform::scale({number(0.2, 2), number(0.2, 2), number(0.2, 2)});
  };
  for (int i = 0; i < 60; ++i) {
    const AnimatedTransform outer = i % 3 ? way(random(), random()) : AnimatedTransform(random());
    const AnimatedTransform inner = i % 3 == 1 ? AnimatedTransform() : way(random(), random());
    const Motion motion(outer, inner, kBox);
    EXPECT_LE(motion.keys().size(), Motion::kMostSteps + 1U);
    // The longest way is sampled here, so it may come out shorter.
    const double most = motion.keys().size() <= Motion::kMostSteps ? 1.5 : 4;
    EXPECT_LT(deviation(motion, outer, inner), most * 0x1p-12);
  }
}

TEST(Motion, HalfATurnStaysNearItsCircle) {
  const AnimatedTransform t = way({}, Transform::rotate(180, {1, 1, 1}));
  EXPECT_LT(deviation(Motion(t, {}, kBox), t, {}), 1.2 * 0x1p-12);
}

TEST(Motion, AWayThatIsNearlyFlatAllAlongIsRefused) {
  const auto flat = [](double degrees) {
    const Transform q = Transform::rotate(degrees, {0, 0, 1});
    return q * Transform::scale({1, 1e-9, 1}) * q.inverse();
  };
  // A plate that tilts by half a degree within itself while it turns: the blend of two steps turns
  // it inside out, one way round.
  const auto isRefused = [&](double degrees) {
    try {
      Motion(way(flat(0), Transform::rotate(degrees, {0, 0, 1}) * flat(0.5)), {}, kBox);
    } catch (const Error&) {
      return true;
    }
    return false;
  };
  EXPECT_NE(isRefused(-170), isRefused(170));
}

TEST(Motion, OfNothingIsAllowed) {
  EXPECT_NO_THROW(Motion(way({}, Transform::rotate(90, {1, 0, 0})), {}, Bounds3()));
}

// What the error bound is for: the point that a ray tracer finds, which blends the keys in floats.
TEST(Motion, ItsErrorCoversABlendInFloats) {
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const auto far = [&] { return 1000.0 * (2.0 * rng.uniform() - 1); };
    const AnimatedTransform t =
        way(Transform::translate({far(), far(), far()}) * Transform::rotate(far(), {1, 2, 3}),
            Transform::translate({far(), far(), far()}) * Transform::rotate(far(), {3, 1, 2}));
    const Motion motion(t, {}, kBox);
    const float f = rng.uniform();
    const int steps = static_cast<int>(motion.keys().size()) - 1;
    const float at = f * static_cast<float>(steps);
    const int k = std::min(static_cast<int>(at), steps - 1);
    const float weight = at - static_cast<float>(k);
    const Motion::Key blend = (1 - weight) * motion.keys()[k] + weight * motion.keys()[k + 1];
    const DPoint3 p = pointIn(kBox, rng);
    const Point3 got = blend * glm::vec4(Point3(p), 1);
    const Transform placement = motion.at(f);
    const DPoint3 wanted = placement.point(DPoint3(Point3(p)));
    EXPECT_LT(glm::distance(DPoint3(got), wanted), motion.error(f, placement, Point3(wanted)));
  }
}

}  // namespace
}  // namespace pbrt
