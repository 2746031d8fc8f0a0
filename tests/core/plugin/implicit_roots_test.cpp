// Roots along rays through whole fields, with no cells to help, against fine sampling in long
// double.

#include "core/plugin/implicit_roots.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/core/plugin/formulas.h"

namespace pbrt {
namespace {

using Long = long double;

template <class F>
Long exactly(const F& f, const ObjectRay& ray, Long t) {
  using T = Dual<Long, 0>;
  const auto coordinate = [&](int i) { return T(Long(ray.o[i]) + t * Long(ray.d[i]), {}); };
  return f(coordinate(0), coordinate(1), coordinate(2)).v;
}

// Every change of sign between neighbours of `samples` places, bisected.
template <class F>
std::vector<Long> signChanges(const F& f, const ObjectRay& ray, int samples) {
  std::vector<Long> roots;
  const auto place = [&](int i) { return ray.tMin + (Long(ray.tMax) - ray.tMin) * i / samples; };
  Long last = exactly(f, ray, place(0));
  for (int i = 1; i <= samples; ++i) {
    const Long now = exactly(f, ray, place(i));
    if ((last < 0 && now > 0) || (last > 0 && now < 0)) {
      Long a = place(i - 1), b = place(i);
      for (int k = 0; k < 70; ++k) {
        const Long m = (a + b) / 2;
        ((exactly(f, ray, m) < 0) == (last < 0) ? a : b) = m;
      }
      // Not poles.
      if (std::abs(exactly(f, ray, a)) < std::abs(last) + std::abs(now)) roots.push_back(a);
    }
    last = now;
  }
  return roots;
}

std::optional<double> first(const ImplicitField& field, const ObjectRay& ray, bool any = false) {
  const Bounds3 box = field.bounds();
  const Segment piece = clip(ray, DPoint3(box.lo), DPoint3(box.hi));
  const auto s = firstZero(field, piece, any);
  return s ? std::optional(piece.t(*s)) : std::nullopt;
}

DVec3 direction(Rng& rng) {
  return glm::normalize(DVec3(uniformSphere({rng.uniform(), rng.uniform()})));
}

ObjectRay randomRay(Rng& rng, const Bounds3& box) {
  const auto inBox = [&] {
    const DVec3 u(rng.uniform(), rng.uniform(), rng.uniform());
    return DPoint3(box.lo) + u * DVec3(box.diagonal());
  };
  const DPoint3 from =
      DPoint3(box.centre()) + 2.0 * glm::length(DVec3(box.diagonal())) * direction(rng);
  return {from, inBox() - from, 0, 2};
}

template <class F>
void findsAll(const F& f, int rays, int samples = 3000) {
  const Formula<F> field(f);
  Rng rng(11);
  int crossings = 0, failures = 0;
  for (int i = 0; i < rays && failures < 5; ++i) {
    ObjectRay ray = randomRay(rng, field.bounds());
    // Only what lies within the bounds.
    const Segment piece = clip(ray, DPoint3(field.bounds().lo), DPoint3(field.bounds().hi));
    ray.tMin = piece.t(-piece.half), ray.tMax = piece.t(piece.half);
    std::vector<double> ours;
    ObjectRay rest = ray;
    while (const auto t = first(field, rest)) {
      EXPECT_TRUE(first(field, rest, true));
      ours.push_back(*t);
      rest.tMin = *t + 1e-9;
      if (ours.size() > 100) break;
    }
    EXPECT_EQ(first(field, rest, true).has_value(), first(field, rest).has_value());
    const std::vector<Long> truth = signChanges(f, ray, samples);
    crossings += static_cast<int>(truth.size());
    for (const Long t : truth) {
      const bool found = std::ranges::any_of(ours, [&](double x) {
        return std::abs(x - t) * piece.speed < 1e-11 * glm::length(ray.o) + 2e-9 * piece.speed;
      });
      if (!found && ++failures) ADD_FAILURE() << "ray " << i << " misses the crossing at " << t;
    }
    // None is invented: f vanishes there, or changes its sign nearby, as far as doubles tell.
    for (const double t : ours) {
      const double near = 1e-13 * glm::length(ray.o) / piece.speed;
      const Long at = exactly(f, ray, t), a = exactly(f, ray, t - near),
                 b = exactly(f, ray, t + near);
      const double blur = field.along(ray.at(t), piece.u, 0, 4 * piece.error).value.width();
      if (!(std::abs(at) <= 2 * blur || (a < 0) != (b < 0)) && ++failures)
        ADD_FAILURE() << "ray " << i << " invents a crossing at " << t << ": f is " << at;
    }
  }
  EXPECT_GT(crossings, rays / 5);
}

TEST(FirstZero, OfABall) {
  findsAll(test::Ball{}, 2000);
}
TEST(FirstZero, OfATinyBall) {
  findsAll(test::Ball{1e-6}, 500);
}
TEST(FirstZero, OfAHugeBall) {
  findsAll(test::Ball{1e8}, 500);
}
TEST(FirstZero, OfATorus) {
  findsAll(test::Torus{}, 1000);
}
TEST(FirstZero, OfAGyroid) {
  findsAll(test::Gyroid{}, 300);
}
TEST(FirstZero, OfABarthSextic) {
  findsAll(test::BarthSextic{}, 500);
}
TEST(FirstZero, OfAHeart) {
  findsAll(test::Heart{}, 500);
}
TEST(FirstZero, OfASolidWithKinks) {
  findsAll(test::Solid{}, 1000);
}
TEST(FirstZero, OfASteepStep) {
  findsAll(test::Steep{}, 500);
}
TEST(FirstZero, OfALogarithm) {
  findsAll(test::Logarithm{}, 500);
}
TEST(FirstZero, OfABarrelWithoutValuesAround) {
  findsAll(test::Barrel{}, 500);
}
TEST(FirstZero, BesideASolidWithoutValues) {
  const Formula field(test::Cut{});
  for (const double from : {-1.4, -1.0, -0.3, 0.0, 0.2}) {
    const auto hit = first(field, {{from, 0.1, 0.2}, {1, 0, 0}});
    ASSERT_TRUE(hit) << from;
    EXPECT_NEAR(*hit, 0.4 - from, 1e-14);
  }
  findsAll(test::Cut{}, 500);
}
TEST(FirstZero, PassesAPole) {
  findsAll(test::Pole{}, 500);
  const Formula field(test::Pole{});
  const auto hit = first(field, {{-0.9, 0.1, 0.2}, {1, 0.1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(*hit, 1.4, 1e-14);
  EXPECT_FALSE(first(field, {{0.4, 0.1, 0.2}, {-1, 0.1, 0}}));
}

// Both of two sheets that are a millionth apart, at all angles.
TEST(FirstZero, OfTwoSheets) {
  const Formula field(test::Sheets{});
  Rng rng(3);
  for (int i = 0; i < 1000; ++i) {
    const DVec3 d = direction(rng);
    if (std::abs(d.z) < 1e-3) continue;
    ObjectRay ray{-0.3 * d, d, 0, 2};
    const double t0 = 0.3, t1 = 0.3 + 1e-6 / d.z;
    const auto near = first(field, ray);
    ASSERT_TRUE(near);
    EXPECT_NEAR(*near, std::min(t0, t1), 1e-14);
    ray.tMin = 0.5 * (t0 + t1);
    const auto far = first(field, ray);
    ASSERT_TRUE(far);
    EXPECT_NEAR(*far, std::max(t0, t1), 1e-14);
  }
}

// Rays that pass a ball by, or cut it, by ever less, until rounding hides which.
TEST(FirstZero, OfRaysThatGraze) {
  const Formula field(test::Ball{});
  Rng rng(4);
  for (int i = 0; i < 300; ++i) {
    const DVec3 n = direction(rng);
    const DVec3 d = glm::normalize(glm::cross(n, direction(rng)));
    for (int k = 1; k < 17; ++k) {
      const double gap = std::pow(10, -k);
      const auto hit = first(field, {(1 - gap) * n - 3.0 * d, d});
      if (k < 14) {
        ASSERT_TRUE(hit) << k;
        EXPECT_NEAR(*hit, 3 - std::sqrt(2 * gap - gap * gap), 1e-14 / std::sqrt(gap));
        EXPECT_FALSE(first(field, {(1 + gap) * n - 3.0 * d, d})) << k;
      }
    }
  }
}

// From 1e9 radii away the ray is rounded, but no root is lost.
TEST(FirstZero, FromFarAway) {
  const Formula field(test::Ball{});
  Rng rng(5);
  for (int i = 0; i < 1000; ++i) {
    const DVec3 w = direction(rng);
    for (const double far : {1e3, 1e6, 1e9}) {
      const auto hit = first(field, {far * w, -w});
      ASSERT_TRUE(hit);
      EXPECT_NEAR(*hit, far - 1, 1e-15 * far + 1e-15);
    }
  }
}

TEST(FirstZero, IsNotWhereTheRayStarts) {
  const Formula field(test::Ball{});
  Rng rng(6);
  for (int i = 0; i < 1000; ++i) {
    const DPoint3 p = direction(rng);
    DVec3 w = direction(rng);
    if (glm::dot(w, p) < 0) w = -w;
    if (glm::dot(w, p) < 1e-3) continue;
    EXPECT_FALSE(first(field, {p, w}));
    const auto across = first(field, {p, -w});
    ASSERT_TRUE(across);
    EXPECT_NEAR(*across, 2 * glm::dot(w, p), 1e-13);
  }
}

// -- fields that tell little or nothing -----------------------------------------------------------

// A ball whose ranges are of no use, counting the questions.
class Vague final : public ImplicitField {
 public:
  explicit Vague(FieldRange range) : range_(range) {}
  Bounds3 bounds() const override { return test::cube(1.1F); }
  FieldPoint at(const DPoint3& p) const override {
    ++questions;
    return {1 - lengthSquared(p), -2.0 * p};
  }
  FieldRange over(const DPoint3&, const DPoint3&) const override {
    ++questions;
    return range_;
  }
  mutable int questions = 0;

 private:
  FieldRange range_;
};

TEST(FirstZero, TakesBoundedWorkWhereNothingIsKnown) {
  const Range all = Range::all();
  for (const FieldRange& range :
       {FieldRange{all, {all, all, all}}, FieldRange{{-1, 1}, {all, all, all}},
        FieldRange{all, {{-9, 9}, {-9, 9}, {-9, 9}}}}) {
    const Vague field(range);
    Rng rng(7);
    for (int i = 0; i < 100; ++i) {
      const ObjectRay ray = randomRay(rng, field.bounds());
      field.questions = 0;
      first(field, ray);
      EXPECT_LE(field.questions, kMostLooks + 8000);
    }
    // Signs tell the most of it.
    const auto hit = first(field, {{0, 0, 3}, {0, 0, -1}});
    EXPECT_TRUE(hit);
  }
}

struct Nothing {
  template <class T>
  T operator()(const T& x, const T&, const T&) const {
    return 0 * x;
  }
  Bounds3 bounds() const { return test::cube(1); }
};
struct Nowhere {
  template <class T>
  T operator()(const T& x, const T&, const T&) const {
    return log(-1 - sqr(x));
  }
  Bounds3 bounds() const { return test::cube(1); }
};

TEST(FirstZero, OfFieldsThatAreZeroEverywhereOrNowhere) {
  Rng rng(8);
  for (int i = 0; i < 1000; ++i) {
    const ObjectRay ray = randomRay(rng, test::cube(1));
    EXPECT_FALSE(first(Formula(Nowhere{}), ray));
    first(Formula(Nothing{}), ray);
  }
}

TEST(FirstZero, OfRaysThatAreNone) {
  const Formula field(test::Ball{});
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = 1 / 0.0;
  for (const DVec3& d : {DVec3(0), DVec3(nan), DVec3(inf), DVec3(nan, 0, 1), DVec3(0, inf, 0)})
    EXPECT_FALSE(first(field, {{0, 0, 3}, d}));
  EXPECT_FALSE(first(field, {{nan, 0, 3}, {0, 0, -1}}));
  EXPECT_FALSE(first(field, {{0, 0, inf}, {0, 0, -1}}));
}

}  // namespace
}  // namespace pbrt
