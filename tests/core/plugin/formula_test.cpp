// Fields from formulas: their ranges, over boxes and along lines, hold what they are.

#include "core/plugin/formula.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/core/plugin/formulas.h"

namespace pbrt {
namespace {

template <class F>
class Formulas : public testing::Test {
 protected:
  DPoint3 inBounds() {
    const Bounds3 box = field_.bounds();
    return DPoint3(box.lo) +
           DVec3(rng_.uniform(), rng_.uniform(), rng_.uniform()) * DVec3(box.diagonal());
  }
  Formula<F> field_{F{}};
  Rng rng_{2};
};

using All = testing::Types<test::Ball, test::Torus, test::Gyroid, test::BarthSextic, test::Heart,
                           test::Sheets, test::Steep, test::Solid, test::Logarithm, test::Pole>;
TYPED_TEST_SUITE(Formulas, All);

TYPED_TEST(Formulas, HaveRangesThatHoldThem) {
  for (int i = 0; i < 3000; ++i) {
    const DPoint3 lo = this->inBounds();
    const DPoint3 hi = lo + std::exp2(-20.0 * this->rng_.uniform()) *
                                DVec3(this->rng_.uniform(), this->rng_.uniform(), 0.5);
    const FieldRange range = this->field_.over(lo, hi);
    const DPoint3 p = glm::clamp(lo + (hi - lo) * double{this->rng_.uniform()}, lo, hi);
    const FieldPoint at = this->field_.at(p);
    if (std::isnan(at.value)) continue;
    EXPECT_TRUE(range.value.contains(at.value));
    for (int k = 0; k < 3; ++k)
      EXPECT_TRUE(std::isnan(at.gradient[k]) || range.gradient[k].contains(at.gradient[k]))
          << at.gradient[k] << " at " << p.x << " " << p.y << " " << p.z;
  }
}

// The range along a line is within that over the box about it, and holds what is on the line.
TYPED_TEST(Formulas, HaveNarrowerRangesAlongLines) {
  for (int i = 0; i < 3000; ++i) {
    const DPoint3 o = this->inBounds();
    const DVec3 u =
        glm::normalize(DVec3(uniformSphere({this->rng_.uniform(), this->rng_.uniform()})));
    const double length = std::exp2(-20.0 * this->rng_.uniform());
    const Range s(-0.5 * length, length);
    const double error = 1e-14;
    const LineRange line = this->field_.along(o, u, s, error);
    const LineRange box = this->field_.ImplicitField::along(o, u, s, error);
    const double slack = 1e-12 * (line.slope.magnitude() + 1);
    EXPECT_FALSE(line.slope.lo < box.slope.lo - slack || line.slope.hi > box.slope.hi + slack);
    const double at = std::clamp(s.lo + this->rng_.uniform() * s.width(), s.lo, s.hi);
    const FieldPoint f = this->field_.at(o + at * u);
    if (std::isnan(f.value)) continue;
    EXPECT_TRUE(line.value.contains(f.value));
    const double slope = glm::dot(f.gradient, u);
    EXPECT_TRUE(std::isnan(slope) ||
                (slope >= line.slope.lo - slack && slope <= line.slope.hi + slack));
  }
}

TYPED_TEST(Formulas, HaveTheHessianOfDifferences) {
  int compared = 0;
  for (int i = 0; i < 300; ++i) {
    const DPoint3 p = this->inBounds();
    const glm::dmat3 exact = this->field_.hessian(p);
    const glm::dmat3 near = this->field_.ImplicitField::hessian(p);
    double off = 0, size = 1;
    for (int k = 0; k < 3; ++k) {
      off = std::max(off, glm::length(exact[k] - near[k]));
      size = std::max(size, glm::length(exact[k]));
    }
    compared += off < 1e-3 * size;
  }
  // Not at kinks, steps and poles, and not where there is no value.
  EXPECT_GT(compared, 60);
}

}  // namespace
}  // namespace pbrt
