// Shapes in place, under maps of every affine kind.

#include "core/scene/placement.h"

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt {
namespace {

struct Named {
  std::string name;
  Transform map;
};

std::vector<Named> maps() {
  const glm::dmat4 shear(1, 0, 0, 0, 0.5, 1, 0, 0, 0.2, -0.4, 1, 0, 0, 0, 0, 1);
  return {{"identity", {}},
          {"rotation", Transform::rotate(50, {1, 2, 3})},
          {"large", Transform::scale(DVec3(20))},
          {"mirrored", Transform::scale({1, -1, 1}) * Transform::rotate(20, {1, 0, 0})},
          {"stretched", Transform::translate({1, 2, 3}) * Transform::scale({2, 0.5, 1})},
          {"shear", Transform::rotate(30, {0, 1, 1}) * Transform(shear)}};
}

struct Sphere {
  std::unique_ptr<Shape> shape = test::make<Shape>("sphere");

  // Where the ray from outside towards `object` meets the placed sphere.
  SurfaceInteraction at(const Transform& map, const DPoint3& object, bool reverse) const {
    const Ray ray{Point3(map.point(object * 3.0)), 0, Vec3(map.vector(-object)), kInfinity, 0};
    const auto hit = shape->intersect(map.inverse().ray(ray), 0);
    EXPECT_TRUE(hit);
    return placedSurface(*shape, map, reverse, ray, hit.value_or(ShapeHit{}));
  }
};

TEST(Placement, DerivativesAreFiniteDifferences) {
  const Sphere sphere;
  const auto direction = [](double theta, double phi) {
    return DPoint3(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                   std::cos(theta));
  };
  for (const auto& [name, map] : maps())
    for (const bool reverse : {false, true})
      for (const double theta : {0.7, 1.4, 2.3}) {
        const double phi = 1.1, h = 0.01;
        const SurfaceInteraction s = sphere.at(map, direction(theta, phi), reverse);
        const auto expectSlope = [&](const SurfaceInteraction& a, const SurfaceInteraction& b,
                                     bool inU) {
          const float step = inU ? b.uv.x - a.uv.x : b.uv.y - a.uv.y;
          const Vec3 dp = (b.p - a.p) / step, dn = (b.ns - a.ns) / step;
          const Vec3 gotP = inU ? s.dpdu : s.dpdv, gotN = inU ? s.dndu : s.dndv;
          EXPECT_LT(glm::length(gotP - dp), 2e-3F * glm::length(dp)) << name;
          EXPECT_LT(glm::length(gotN - dn), 2e-3F * glm::length(dn) + 1e-3F) << name << reverse;
        };
        expectSlope(sphere.at(map, direction(theta, phi - h), reverse),
                    sphere.at(map, direction(theta, phi + h), reverse), true);
        expectSlope(sphere.at(map, direction(theta - h, phi), reverse),
                    sphere.at(map, direction(theta + h, phi), reverse), false);
        EXPECT_NEAR(glm::dot(s.n, s.dpdu), 0, 1e-5F * glm::length(s.dpdu)) << name;
        EXPECT_NEAR(glm::dot(s.n, s.dpdv), 0, 1e-5F * glm::length(s.dpdv)) << name;
        const double outward = glm::dot(DVec3(s.n), map.vector(direction(theta, phi)));
        EXPECT_EQ(outward > 0, !reverse) << name;
      }
}

TEST(Placement, AnInteractionIsCarriedAsTheShapeItself) {
  // Two maps one after the other are their product.
  const Sphere sphere;
  const DPoint3 object = glm::normalize(DVec3(1, -2, 0.5));
  for (const auto& [name, first] : maps())
    for (const auto& [name2, second] : maps()) {
      SurfaceInteraction s = sphere.at(first, object, false);
      transformInteraction(s, second);
      const SurfaceInteraction wanted = sphere.at(second * first, object, false);
      const auto near = [&](const Vec3& a, const Vec3& b) {
        EXPECT_LT(glm::length(a - b), 1e-4F * (1 + glm::length(b))) << name << ' ' << name2;
      };
      near(s.p, wanted.p);
      near(s.n, wanted.n);
      near(s.ns, wanted.ns);
      near(s.dpdu, wanted.dpdu);
      near(s.dpdv, wanted.dpdv);
      near(s.dndu, wanted.dndu);
      near(s.dndv, wanted.dndv);
      EXPECT_GT(s.error, 0);
    }
}

TEST(Placement, TheSamplersDensityIntegratesToTheSolidAngle) {
  const Sphere sphere;
  Rng rng(9);
  for (const auto& [name, map] : maps())
    for (const bool reverse : {false, true}) {
      const auto sampler = placedSampler(*sphere.shape->areaSampler(), map, reverse);
      const DPoint3 from = map.point({1.5, 0.8, -2});
      // By the sampler: E[1 / pdf]. By chance: the part of all directions that hit.
      constexpr int kSamples = 100'000;
      double sum = 0;
      for (int i = 0; i < kSamples; ++i) {
        const AreaSample s = sampler->sample(from, {rng.uniform(), rng.uniform()});
        ASSERT_GT(s.pdf, 0) << name;
        sum += 1 / double(s.pdf);
        if (i < 100) {
          EXPECT_NEAR(sampler->pdf(from, s.p, s.n), s.pdf, 1e-3F * s.pdf) << name;
          EXPECT_NEAR(glm::length(s.n), 1, 1e-5F) << name;
        }
      }
      int hits = 0;
      for (int i = 0; i < kSamples; ++i) {
        const Vec3 w = uniformSphere({rng.uniform(), rng.uniform()});
        const bool hit =
            sphere.shape->intersect(map.inverse().ray({Point3(from), 0, w, kInfinity, 0}), 0)
                .has_value();
        hits += hit;
        if (hit) {
          EXPECT_TRUE(sampler->mayHit(from, w)) << name;
        }
      }
      const double p = double(hits) / kSamples;
      EXPECT_NEAR(sum / kSamples, 4 * kPi * p, 4 * kPi * 5 * std::sqrt(p * (1 - p) / kSamples))
          << name;
    }
}

}  // namespace
}  // namespace pbrt
