#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using test::integers;
using test::points;
using test::value;

// z = x y over the unit square: P(u, v) = (u, v, u v).
const Param kSaddle = points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 1});

std::unique_ptr<Shape> mesh(const ParamList& list) {
  return test::make<Shape>("bilinearmesh", list);
}
SurfacePoint hitFrom(const Shape& shape, const ObjectRay& ray) {
  const auto hit = shape.intersect(ray, 0);
  EXPECT_TRUE(hit);
  return hit ? shape.surface(ray, *hit) : SurfacePoint{};
}

TEST(BilinearMesh, IsTheSurfaceBetweenItsCorners) {
  const auto shape = mesh({kSaddle});
  for (const double u : {0.0, 0.2, 0.5, 1.0})
    for (const double v : {0.0, 0.3, 0.9, 1.0}) {
      const SurfacePoint s = hitFrom(*shape, {{u, v, 5}, {0, 0, -2}});
      EXPECT_LE(glm::distance(s.p, DPoint3(u, v, u * v)), 1e-15);
      EXPECT_NEAR(s.uv.x, u, 1e-7);
      EXPECT_NEAR(s.uv.y, v, 1e-7);
      const DVec3 n = glm::normalize(DVec3(-v, -u, 1));
      EXPECT_LE(glm::length(DVec3(s.n) - n), 1e-7);
      EXPECT_LE(glm::length(s.dpdu - Vec3(1, 0, v)), 1e-7F);
      EXPECT_LE(glm::length(s.dpdv - Vec3(0, 1, u)), 1e-7F);
    }
}

TEST(BilinearMesh, IsCrossedTwiceByALineAcrossTheSaddle) {
  // Along x = y at height 1/4 the saddle is met at x = 1/2, and on x = 1 - y at two places.
  const auto shape = mesh({kSaddle});
  const ObjectRay ray{{1.5, -0.5, 0.21}, {-1, 1, 0}};  // x (1 - x) = 0.21: x = 0.7 and 0.3
  EXPECT_LE(glm::distance(hitFrom(*shape, ray).p, DPoint3(0.7, 0.3, 0.21)), 1e-15);
  ObjectRay later = ray;
  later.tMin = 1;
  EXPECT_LE(glm::distance(hitFrom(*shape, later).p, DPoint3(0.3, 0.7, 0.21)), 1e-15);
  later.tMin = 1.3;
  EXPECT_FALSE(shape->intersect(later, 0));
}

TEST(BilinearMesh, IsFoundFromFarAway) {
  for (const float scale : {1e-6F, 1.F, 1e6F}) {
    const auto shape =
        mesh({points("P", {0, 0, 0, scale, 0, 0, 0, scale, 0, scale, scale, scale})});
    Rng rng(1);
    for (int i = 0; i < 3000; ++i) {
      const double u = 0.01 + 0.98 * rng.uniform(), v = 0.01 + 0.98 * rng.uniform();
      const DPoint3 p = double{scale} * DPoint3(u, v, u * v);
      const DVec3 w(uniformSphere({rng.uniform(), rng.uniform()}));
      const double cosine = std::abs(glm::dot(glm::normalize(w), glm::normalize(DVec3(-v, -u, 1))));
      if (cosine < 0.1) continue;
      const ObjectRay ray{p - 1e6 * scale * w, w * 3.0};
      const auto hit = shape->intersect(ray, 0);
      ASSERT_TRUE(hit);
      const SurfacePoint s = shape->surface(ray, *hit);
      EXPECT_LE(std::abs(s.p.z - s.p.x * s.p.y / scale), s.error);
      // There may be a nearer crossing.
      const double apart = glm::length(glm::cross(s.p - p, glm::normalize(w)));
      EXPECT_LE(apart, 3e-9 * scale);
    }
  }
}

TEST(BilinearMesh, NeverMeetsItselfWhereTheRayBegan) {
  const auto shape = mesh({kSaddle});
  Rng rng(2);
  for (int i = 0; i < 1000000; ++i) {
    const double u = rng.uniform(), v = rng.uniform();
    const DVec3 down(0.2 * rng.uniform(), 0.3 * rng.uniform(), -1);
    const SurfacePoint s = hitFrom(*shape, {DPoint3(u, v, u * v) * 0.8 + 0.1 - down, down});
    DVec3 w(uniformSphere({rng.uniform(), rng.uniform()}));
    const DVec3 n = DVec3(s.n) * (i % 2 ? 1.0 : -1.0);
    if (glm::dot(w, n) < 0) w = -w;
    const auto again = shape->intersect({s.p + s.error * n, w}, 0);
    if (!again || again->t > 1e-7) continue;
    // f = z - x y along the ray from the surface: f' t - wx wy t^2.
    const double other = (w.z - s.p.x * w.y - s.p.y * w.x) / (w.x * w.y);
    ASSERT_LT(std::abs(other), 1e-6) << again->t;
  }
}

TEST(BilinearMesh, NeighboursLeaveNoGap) {
  const auto shape =
      mesh({points("P", {0, 0, 0, 1, 0, 0.3F, 0, 1, 0.2F, 1.3F, 1, -0.1F, 0, 2, 1, 1, 2.2F, 0.7F}),
            integers("indices", {0, 1, 2, 3, 2, 3, 4, 5})});
  ASSERT_EQ(shape->primitives(), 2U);
  Rng rng(3);
  const DPoint3 a(0, 1, 0.2F), b(1.3F, 1, -0.1F);
  for (int i = 0; i < 200000; ++i) {
    const double x = 0.01 + 0.98 * rng.uniform();
    DVec3 w(uniformSphere({rng.uniform(), rng.uniform()}));
    w.z = -1 - std::abs(w.z);
    const ObjectRay ray{(1 - x) * a + x * b - w * (1 + 10.0 * rng.uniform()), w};
    EXPECT_TRUE(shape->intersect(ray, 0) || shape->intersect(ray, 1));
  }
}

TEST(BilinearMesh, TakesTextureCoordinatesAndNormals) {
  // (s, t) = (2 v, 3 u): the derivatives change places.
  const auto shape =
      mesh({points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0}),
            value(ParamType::point2, "uv", {0, 0, 0, 3, 2, 0, 2, 3}),
            value(ParamType::normal, "N", {-1, 0, -1, 1, 0, -1, -1, 0, -1, 1, 0, -1})});
  const SurfacePoint s = hitFrom(*shape, {{0.25, 0.5, 1}, {0, 0, -1}});
  EXPECT_LE(glm::length(s.uv - Point2(1, 0.75F)), 1e-6F);
  EXPECT_LE(glm::length(s.dpdu - Vec3(0, 0.5F, 0)), 1e-6F);
  EXPECT_LE(glm::length(s.dpdv - Vec3(1 / 3.F, 0, 0)), 1e-6F);
  EXPECT_EQ(s.n, Normal3(0, 0, -1));  // on the side of the shading normal
  EXPECT_LE(glm::length(s.ns - glm::normalize(Vec3(-0.5F, 0, -1))), 1e-6F);
  // ns = (2 x - 1, 0, -1) / |.|: its x runs with dx by 2 cos^3, and t = 3 x.
  const float cosine = 1 / std::sqrt(1.25F);
  EXPECT_NEAR(s.dndv.x, 2 * cosine * cosine * cosine / 3, 1e-6);
  EXPECT_LE(glm::length(s.dndu), 1e-6F);
}

TEST(BilinearMesh, AreaOfASaddle) {
  double sum = 0;
  const int n = 1000;
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) sum += std::sqrt(1 + sqr((i + 0.5) / n) + sqr((j + 0.5) / n));
  EXPECT_NEAR(mesh({kSaddle})->areaSampler()->area(), sum / (n * n), 1e-6);
}

TEST(BilinearMesh, OfAParallelogramSamplesFollowTheSquare) {
  const auto shape = mesh({points("P", {0, 0, 0, 2, 0, 1, 1, 3, 0, 3, 3, 1})});
  const AreaSampler& sampler = *shape->areaSampler();
  EXPECT_NEAR(sampler.area(), glm::length(glm::cross(Vec3(2, 0, 1), Vec3(1, 3, 0))), 1e-6);
  for (const float x : {0.F, 0.3F, 0.9F})
    for (const float y : {0.1F, 0.8F})
      EXPECT_LE(glm::distance(sampler.sample({5, 5, 5}, {x, y}).p,
                              double{x} * DVec3(2, 0, 1) + double{y} * DVec3(1, 3, 0)),
                1e-6);
}

TEST(BilinearMesh, DegeneratePatchesDoNoHarm) {
  // A triangle, a line and a point.
  const auto triangle = mesh({points("P", {0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 0})});
  const SurfacePoint s = hitFrom(*triangle, {{0.2, 0.7, 1}, {0, 0, -1}});
  EXPECT_LE(glm::distance(s.p, DPoint3(0.2, 0.7, 0)), 1e-15);
  EXPECT_NEAR(std::abs(s.n.z), 1, 1e-6);
  EXPECT_NEAR(triangle->areaSampler()->area(), 0.5, 1e-12);
  for (const Param& p : {points("P", {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}),
                         points("P", std::vector<float>(12, 1.F))}) {
    const auto shape = mesh({p});
    EXPECT_EQ(shape->areaSampler(), nullptr);
    for (const DPoint3& o : {DPoint3(0.5, 0, 1), DPoint3(1, 1, 1), DPoint3(0.3, 0.2, 1)})
      EXPECT_FALSE(shape->intersect({o, {0, 0, -1}}, 0));
  }
}

TEST(BilinearMesh, SaysWhatIsWrong) {
  const auto blames = [](const ParamList& list, const char* text) {
    try {
      mesh(list);
      ADD_FAILURE() << "accepts that " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  blames({}, "\"P\" is missing");
  blames({points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0})}, "only 4 points need none");
  blames({kSaddle, integers("indices", {0, 1, 2})}, "has 3 numbers, not 4 a face");
  blames({kSaddle, integers("indices", {0, 1, 2, 4})}, "number 3 is 4");
  blames({kSaddle, value(ParamType::normal, "N", {0, 0, 1})}, "\"N\" has 1 entries");
  blames({points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, kInfinity})}, "not finite at vertex 3");
}

}  // namespace
}  // namespace pbrt
