// The plug-in: its parameters and errors, and what a hit tells the renderer.

#include <gmock/gmock.h>

#include <thread>

#include "core/base/frame.h"
#include "shapes/metaballs/field.h"
#include "tests/shapes/metaballs/clouds.h"
#include "tests/support.h"

namespace pbrt::metaballs::test {
namespace {

using pbrt::test::make;
using pbrt::test::number;
using pbrt::test::points;
using pbrt::test::text;
using pbrt::test::value;

std::string errorOf(const ParamList& list) {
  try {
    make<Shape>("metaballs", list);
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

Param numbers(const std::string& name, std::vector<float> v) {
  return value(ParamType::number, name, std::move(v));
}

std::optional<ShapeHit> hitOf(const Shape& shape, ObjectRay ray) {
  std::optional<ShapeHit> best;
  for (std::uint32_t i = 0; i < shape.primitives(); ++i)
    if (const auto hit = shape.intersect(ray, i)) {
      best = hit;
      ray.tMax = hit->t;
    }
  return best;
}

bool occluded(const Shape& shape, const ObjectRay& ray) {
  for (std::uint32_t i = 0; i < shape.primitives(); ++i)
    if (shape.occluded(ray, i)) return true;
  return false;
}

struct Cloud {
  std::vector<float> p, radii, strengths;
};

Cloud someAtoms(int count, double carving, std::uint64_t seed) {
  Cloud c;
  const Field field = cloud(count, Kernel::wyvill, carving, 1, seed);
  for (const Atom& a : field.atoms()) {
    for (int k = 0; k < 3; ++k) c.p.push_back(a.centre[k]);
    c.radii.push_back(a.radius);
    c.strengths.push_back(static_cast<float>(a.weight / 2));
  }
  return c;
}

std::unique_ptr<Shape> shapeOf(const Cloud& c, const std::string& kernel, float threshold = 0.5F) {
  return make<Shape>(
      "metaballs", {points("P", c.p), numbers("radius", c.radii), numbers("strength", c.strengths),
                    text("kernel", kernel), number("threshold", threshold)});
}

ObjectRay someRay(Random& random, double extent) {
  const DVec3 d = random.direction();
  return {0.5 * extent * random.cube() - 2 * extent * d, random.in(0.2, 5) * d};
}

TEST(Metaballs, OneAtomIsABall) {
  const struct {
    const char* kernel;
    double radius;  // of the surface over h, from K(q) = threshold
  } cases[] = {{"poly6", std::sqrt(1 - std::cbrt(0.5 * 64 * std::numbers::pi / 315))},
               {"wyvill", std::sqrt(1 - std::cbrt(0.5))},
               {"blob", std::sqrt(1 - std::sqrt(0.5))},
               {"gaussian", std::sqrt(-std::log(0.5 + std::exp(-4.0)) / 4)}};
  for (const auto& [kernel, r] : cases)
    for (const float h : {1e-6F, 1.F, 2.5F, 1e6F}) {  // default strength and threshold
      const auto shape = make<Shape>(
          "metaballs", {points("P", {h, 0, 0}), number("radius", h), text("kernel", kernel)});
      const auto hit = hitOf(*shape, {{h, 0, -3.0 * h}, {0, 0, h}});
      ASSERT_TRUE(hit) << kernel << h;
      EXPECT_NEAR(hit->t, 3 - r, 1e-6);
      const SurfacePoint at = shape->surface({{h, 0, -3.0 * h}, {0, 0, h}}, *hit);
      EXPECT_NEAR(at.p.z, -r * h, 1e-7 * h);
      EXPECT_LT(at.error, 1e-11 * h);
      EXPECT_NEAR(at.n.z, -1, 1e-6);
    }
}

TEST(Metaballs, NamesTheAtomAtFault) {
  using testing::HasSubstr;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Param two = points("P", {0, 0, 0, 1, 0, 0});
  EXPECT_THAT(errorOf({}), HasSubstr("P"));
  EXPECT_THAT(errorOf({points("P", {0, 0, 0, 1, nan, 0})}), HasSubstr("atom 1"));
  EXPECT_THAT(errorOf({two, numbers("radius", {1, -1})}), HasSubstr("atom 1"));
  EXPECT_THAT(errorOf({two, numbers("radius", {0, 1})}), HasSubstr("atom 0"));
  EXPECT_THAT(errorOf({two, numbers("radius", {nan})}), HasSubstr("atom 0"));
  EXPECT_THAT(errorOf({two, numbers("radius", {1, 1e-16F})}), HasSubstr("atom 1"));
  EXPECT_THAT(errorOf({two, numbers("radius", {1, 3e38F})}), HasSubstr("atom 1"));
  EXPECT_THAT(errorOf({two, numbers("strength", {1, kInfinity})}), HasSubstr("atom 1"));
  EXPECT_THAT(errorOf({two, numbers("radius", {1, 2, 3})}), HasSubstr("3 values for 2 atoms"));
  EXPECT_THAT(errorOf({two, numbers("strength", {1, 2, 3})}), HasSubstr("3 values for 2 atoms"));
  EXPECT_THAT(errorOf({two, number("threshold", 0)}), HasSubstr("threshold"));
  EXPECT_THAT(errorOf({two, number("threshold", -1)}), HasSubstr("would have no end"));
  EXPECT_THAT(errorOf({two, text("kernel", "poly7")}), HasSubstr("poly6"));
  EXPECT_EQ(errorOf({two, numbers("radius", {1, 2}), numbers("strength", {-1, 1})}), "");
}

TEST(Metaballs, MayBeNothing) {
  for (const ParamList& list :
       {ParamList{points("P", {0, 0, 0}), number("strength", 0.1F)},
        ParamList{points("P", {0, 0, 0}), number("strength", 0)}, ParamList{points("P", {})}}) {
    const auto shape = make<Shape>("metaballs", list);
    const ObjectRay ray{{0, 0, -3}, {0, 0, 1}};
    EXPECT_TRUE(shape->bounds(0).empty());
    EXPECT_FALSE(shape->intersect(ray, 0));
    EXPECT_FALSE(shape->occluded(ray, 0));
  }
}

// What a surface point says is true of the field itself.
TEST(Metaballs, SurfacePointsHold) {
  for (const std::string kernel : {"wyvill", "blob", "gaussian"})
    for (const double carving : {0.0, 0.3}) {
      const Cloud c = someAtoms(12, carving, 12);
      const auto shape = shapeOf(c, kernel);
      std::vector<Atom> atoms;
      std::vector<std::uint32_t> all;
      for (std::uint32_t i = 0; i < c.radii.size(); ++i) {
        atoms.push_back(
            {{c.p[3 * i], c.p[3 * i + 1], c.p[3 * i + 2]}, c.radii[i], c.strengths[i] / 0.5});
        all.push_back(i);
      }
      const Field field(static_cast<Kernel>(std::ranges::find(kKernels, kernel) - kKernels.begin()),
                        atoms);
      const auto f = [&](const DPoint3& p) { return field.sample(p, all).value; };

      Random random(77);
      int hits = 0;
      double worst = 0;
      for (int i = 0; i < 2000; ++i) {
        const ObjectRay ray = someRay(random, 3);
        const auto hit = hitOf(*shape, ray);
        EXPECT_EQ(hit.has_value(), occluded(*shape, ray));
        if (!hit) continue;
        ++hits;
        const SurfacePoint at = shape->surface(ray, *hit);
        EXPECT_LT(glm::length(at.p - ray.at(hit->t)), 1e-5 * glm::length(ray.d) * hit->t);
        const Bounds3 box = shape->bounds(hit->primitive);
        for (int k = 0; k < 3; ++k) {
          EXPECT_GE(at.p[k], box.lo[k] - 1e-12);
          EXPECT_LE(at.p[k], box.hi[k] + 1e-12);
        }
        // The surface lies between p - error n (inside) and p + error n (outside).
        const DVec3 n(at.n);
        EXPECT_GT(f(at.p - at.error * n), 0);
        EXPECT_LT(f(at.p + at.error * n), 0);
        worst = std::max(worst, at.error);
        // The normal is the field's, by differences.
        const double d = 1e-6;
        const DVec3 g(f(at.p + DVec3(d, 0, 0)) - f(at.p - DVec3(d, 0, 0)),
                      f(at.p + DVec3(0, d, 0)) - f(at.p - DVec3(0, d, 0)),
                      f(at.p + DVec3(0, 0, d)) - f(at.p - DVec3(0, 0, d)));
        EXPECT_LT(glm::length(n + glm::normalize(g)), 1e-5);
        EXPECT_NEAR(glm::dot(n, DVec3(at.dpdu)) / glm::length(at.dpdu), 0, 1e-6);
        EXPECT_NEAR(glm::dot(n, DVec3(at.dpdv)) / glm::length(at.dpdv), 0, 1e-6);
      }
      std::printf("%s: %d hits, largest error %.1e\n", kernel.c_str(), hits, worst);
      EXPECT_GT(hits, 200);
      EXPECT_LT(worst, 1e-9);
    }
}

// A ray from p + error n outwards, or p - error n inwards, does not meet the surface where it
// starts; a ray from inside finds the way out.
TEST(Metaballs, RaysLeaveTheSurface) {
  const Cloud c = someAtoms(12, 0.2, 3);
  for (const std::string kernel : {"poly6", "blob", "gaussian"})
    for (const double shift : {0.0, 1e4}) {
      Cloud moved = c;
      for (float& x : moved.p) x += static_cast<float>(shift);
      const auto shape = shapeOf(moved, kernel);
      Random random(4);
      int rays = 0;
      for (int i = 0; i < 600; ++i) {
        ObjectRay ray = someRay(random, 3);
        ray.o += shift;
        const auto hit = hitOf(*shape, ray);
        if (!hit) continue;
        const SurfacePoint at = shape->surface(ray, *hit);
        const DVec3 n(at.n);
        for (int k = 0; k < 4; ++k) {
          DVec3 w = random.direction();
          if (std::abs(glm::dot(w, n)) < 0.05) continue;
          const bool out = glm::dot(w, n) > 0;
          const ObjectRay from{at.p + (out ? at.error : -at.error) * n, w};
          const auto next = hitOf(*shape, from);
          EXPECT_TRUE(next || out) << kernel;
          EXPECT_TRUE(!next || next->t > 1e-4)
              << kernel << " " << shift << " t " << next->t << " +" << next->u << " cos "
              << glm::dot(w, n) << " e " << at.error << " cell " << next->primitive << " of "
              << hit->primitive;
          ++rays;
        }
      }
      EXPECT_GT(rays, 300);
    }
}

// dpdu and dpdv, dndu and dndv are the derivatives of p and n by uv: step along a tangent, go back
// to the surface, and compare.
TEST(Metaballs, DerivativesMatchTheParametrisation) {
  const Cloud c = someAtoms(6, 0, 8);
  const auto shape = shapeOf(c, "wyvill");
  Random random(6);
  int checked = 0;
  for (int i = 0; i < 500; ++i) {
    const ObjectRay ray = someRay(random, 2.5);
    const auto hit = hitOf(*shape, ray);
    if (!hit) continue;
    const SurfacePoint at = shape->surface(ray, *hit);
    if (at.uv.y < 0.05F || at.uv.y > 0.95F || at.uv.x < 0.01F || at.uv.x > 0.99F) continue;
    // Where the atom sees the surface from the side, the derivatives change within a step.
    const double turn = 2 * std::numbers::pi * static_cast<double>(at.uv.x);
    const double fall = std::numbers::pi * (1 - static_cast<double>(at.uv.y));
    const DVec3 fromAtom(std::sin(fall) * std::cos(turn), std::sin(fall) * std::sin(turn),
                         std::cos(fall));
    if (glm::dot(DVec3(at.n), fromAtom) < 0.3) continue;
    const double step = 2e-4;
    for (int k = 0; k < 2; ++k) {
      const DVec3 along(k == 0 ? at.dpdu : at.dpdv);
      const DVec3 n(at.n);
      const DPoint3 target = at.p + step * along;
      const double back = 0.05;
      const ObjectRay to{target + back * n, -n};
      const auto other = hitOf(*shape, to);
      if (!other || std::abs(other->t - back) > 1e-3) continue;
      const SurfacePoint near = shape->surface(to, *other);
      const Point2 moved = (near.uv - at.uv) / static_cast<float>(step);
      if (glm::length(moved) > 3) continue;  // another atom took over
      EXPECT_NEAR(moved[k], 1, 0.03);
      EXPECT_NEAR(moved[1 - k], 0, 0.03);
      const Normal3 turned = (near.n - at.n) / static_cast<float>(step);
      EXPECT_LT(glm::length(turned - (k == 0 ? at.dndu : at.dndv)),
                0.05 * (1 + glm::length(turned)));
      ++checked;
    }
  }
  EXPECT_GT(checked, 100);
}

TEST(Metaballs, RoundedTStaysInTheInterval) {
  const auto shape = make<Shape>("metaballs", {points("P", {0, 0, 0}), text("kernel", "wyvill")});
  Random random(14);
  for (int i = 0; i < 3000; ++i) {
    ObjectRay ray = someRay(random, 1);
    const auto hit = hitOf(*shape, ray);
    if (!hit) continue;
    const double exact = static_cast<double>(hit->t) + hit->u;
    for (const double tMax : {exact, exact + 1e-12}) {
      ray.tMin = 0, ray.tMax = tMax;
      const auto again = hitOf(*shape, ray);
      EXPECT_TRUE(!again || again->t <= tMax);
    }
    for (const double tMin : {exact - 1e-9, exact + 1e-9}) {
      ray.tMin = tMin, ray.tMax = std::numeric_limits<double>::infinity();
      const auto again = hitOf(*shape, ray);
      EXPECT_TRUE(!again || again->t > tMin);
    }
  }
}

TEST(Metaballs, GiveTheSameAnswersInEightThreads) {
  const auto shape = shapeOf(someAtoms(40, 0.2, 2), "poly6");
  const auto answers = [&] {
    Random random(99);
    std::vector<float> all;
    for (int i = 0; i < 500; ++i) {
      const ObjectRay ray = someRay(random, 4);
      if (const auto hit = hitOf(*shape, ray)) {
        const SurfacePoint at = shape->surface(ray, *hit);
        all.insert(all.end(), {hit->t, hit->u, at.n.x, at.n.y, at.n.z, at.uv.x, at.dpdu.x});
      } else {
        all.push_back(-1);
      }
    }
    return all;
  };
  const std::vector<float> expected = answers();
  std::vector<std::vector<float>> got(8);
  std::vector<std::thread> threads;
  for (auto& g : got) threads.emplace_back([&g, &answers] { g = answers(); });
  for (auto& t : threads) t.join();
  for (const auto& g : got) EXPECT_EQ(g, expected);
}

}  // namespace
}  // namespace pbrt::metaballs::test
