// Spheres in the cases where arithmetic is hardest, against a solution in 113 bits.

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt {
namespace {

__extension__ using Quad = __float128;

Quad squareRoot(Quad x) {
  Quad y = std::sqrt(static_cast<double>(x));
  for (int i = 0; i < 3 && y > 0; ++i) y = (y + x / y) / 2;
  return y;
}

struct QuadVec {
  Quad x, y, z;
  explicit QuadVec(const DVec3& v) : x(v.x), y(v.y), z(v.z) {}
};
Quad dot(const QuadVec& a, const QuadVec& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// The nearer crossing of a ray from outside with a whole sphere, by the plain quadratic formula.
// `margin` is the discriminant, as the square of half the chord over that of the radius.
struct Oracle {
  Quad t = -1;
  double margin = 0;
};
Oracle solve(const ObjectRay& ray, double r) {
  const QuadVec o(ray.o), d(ray.d);
  const Quad a = dot(d, d), b = dot(o, d), c = dot(o, o) - Quad(r) * r;
  const Quad discriminant = b * b - a * c;
  Oracle s;
  s.margin = static_cast<double>(discriminant / a / (Quad(r) * r));
  if (discriminant >= 0) s.t = (-b - squareRoot(discriminant)) / a;
  return s;
}

// How far a point is from where the oracle says, and from the sphere.
double apart(const DPoint3& p, const ObjectRay& ray, Quad t) {
  const QuadVec o(ray.o), d(ray.d), q(p);
  const Quad x = o.x + t * d.x - q.x, y = o.y + t * d.y - q.y, z = o.z + t * d.z - q.z;
  return static_cast<double>(squareRoot(x * x + y * y + z * z));
}
double height(const DPoint3& p, double r) {
  const QuadVec q(p);
  return std::abs(static_cast<double>(squareRoot(dot(q, q)) - r));
}

std::unique_ptr<Shape> sphere(float radius) {
  return test::make<Shape>("sphere", {test::number("radius", radius)});
}

// Rays from `distance` radii away that pass the centre at up to 1.2 radii.
void seenFrom(double distance, float radius) {
  const auto shape = sphere(radius);
  const double r = radius;
  Rng rng(hash(distance * 1000, radius * 1e7));
  int hits = 0;
  for (int i = 0; i < 20000; ++i) {
    const DVec3 w(uniformSphere({rng.uniform(), rng.uniform()}));
    const Frame frame = Frame::fromZ(w);
    const DVec3 aside = 1.2 * rng.uniform() * DVec3(frame.x);
    const DPoint3 o = r * distance * w;
    const ObjectRay ray{o, (r * aside - o) * (0.5 + rng.uniform())};
    const Oracle expected = solve(ray, r);
    const auto hit = shape->intersect(ray, 0);
    const double rounding = 1e-15 * distance;  // of the ray's place against the sphere, in radii
    if (std::abs(expected.margin) < 10 * rounding) continue;
    ASSERT_EQ(hit.has_value(), expected.margin > 0) << "margin " << expected.margin;
    if (!hit) continue;
    ++hits;
    const SurfacePoint s = shape->surface(ray, *hit);
    const double cosine = std::sqrt(expected.margin);
    EXPECT_LE(apart(s.p, ray, expected.t), 10 * rounding / cosine * r);
    EXPECT_LE(height(s.p, r), s.error);
    EXPECT_LE(s.error, 1e-14 * r);
    EXPECT_NEAR(glm::length(s.n), 1, 1e-6);
    EXPECT_LE(glm::length(DVec3(s.n) - s.p / r), 1e-6);
  }
  EXPECT_GT(hits, 12000);
}

TEST(Sphere, OfMicrometresFromAMillionRadii) {
  seenFrom(1e6, 1e-6F);
}
TEST(Sphere, OfMegametresFromAMillionRadii) {
  seenFrom(1e6, 1e6F);
}
TEST(Sphere, FromNearby) {
  seenFrom(1.001, 1e-6F);
  seenFrom(3, 1);
  seenFrom(3, 1e6F);
}

TEST(Sphere, RaysInCoordinatePlanes) {
  const auto shape = sphere(2);
  for (int axis = 0; axis < 3; ++axis)
    for (const double sign : {-1.0, 1.0})
      for (const double aside : {0.0, 1.0, -1.5}) {
        ObjectRay ray;
        ray.o[axis] = -5 * sign;
        ray.o[(axis + 1) % 3] = aside;
        ray.d[axis] = sign;
        const auto hit = shape->intersect(ray, 0);
        ASSERT_TRUE(hit);
        const SurfacePoint s = shape->surface(ray, *hit);
        EXPECT_NEAR(s.p[axis], -sign * std::sqrt(4 - aside * aside), 1e-15 * 4);
        EXPECT_NEAR(s.p[(axis + 1) % 3], aside, 1e-15 * 4);
        for (const float x : {s.uv.x, s.uv.y, s.dpdu.x, s.dpdv.x, s.dpdu.y, s.dpdv.y, s.dpdv.z})
          EXPECT_TRUE(std::isfinite(x));
        EXPECT_GT(glm::length(s.dpdv), 1);
      }
}

TEST(Sphere, RaysThatStartOnIt) {
  const auto shape = sphere(1);
  // Exactly on it: outward and along it there is nothing, inward there is the other side.
  for (int axis = 0; axis < 3; ++axis) {
    ObjectRay ray;
    ray.o[axis] = 1;
    ray.d[axis] = 1;
    EXPECT_FALSE(shape->intersect(ray, 0));
    ray.d[axis] = -1;
    ASSERT_TRUE(shape->intersect(ray, 0));
    EXPECT_EQ(shape->intersect(ray, 0)->t, 2);
    ray.d = DVec3(0);
    ray.d[(axis + 1) % 3] = 1;
    EXPECT_FALSE(shape->intersect(ray, 0));
  }
}

TEST(Sphere, GrazedAtATenMillionth) {
  for (const float radius : {1e-6F, 1.F, 1e6F}) {
    const auto shape = sphere(radius);
    const double r = radius;
    Rng rng(1);
    for (int i = 0; i < 2000; ++i) {
      const Frame frame = Frame::fromZ(uniformSphere({rng.uniform(), rng.uniform()}));
      // The axes of the frame are at right angles only to a float's precision.
      const DVec3 x = glm::normalize(DVec3(frame.x));
      const DVec3 z = glm::normalize(glm::cross(x, DVec3(frame.y)));
      const ObjectRay outside{r * (1 + 1e-7) * x - 3 * r * z, z};
      const ObjectRay inside{r * (1 - 1e-7) * x - 3 * r * z, z};
      EXPECT_FALSE(shape->intersect(outside, 0));
      const auto hit = shape->intersect(inside, 0);
      ASSERT_TRUE(hit);
      const SurfacePoint s = shape->surface(inside, *hit);
      EXPECT_LE(apart(s.p, inside, solve(inside, r).t), 1e-11 * r);
      EXPECT_LE(height(s.p, r), s.error);
      // cos = half the chord over the radius = sqrt(2e-7)
      EXPECT_NEAR(glm::dot(DVec3(s.n), z), -std::sqrt(2e-7), 1e-6);
    }
  }
}

TEST(Sphere, ParametrisationIsThatOfTheBook) {
  const auto shape =
      test::make<Shape>("sphere", {test::number("radius", 2), test::number("zmin", -1),
                                   test::number("zmax", 1.5F), test::number("phimax", 180)});
  const double thetaMin = std::acos(-0.5), thetaMax = std::acos(0.75);
  for (const double u : {0.1, 0.5, 0.9})
    for (const double v : {0.1, 0.5, 0.9}) {
      const double phi = u * std::numbers::pi, theta = thetaMin + v * (thetaMax - thetaMin);
      const DVec3 n(std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi),
                    std::cos(theta));
      const ObjectRay ray{5.0 * n, -n};
      const auto hit = shape->intersect(ray, 0);
      ASSERT_TRUE(hit);
      const SurfacePoint s = shape->surface(ray, *hit);
      EXPECT_NEAR(s.uv.x, u, 1e-6);
      EXPECT_NEAR(s.uv.y, v, 1e-6);
      EXPECT_GT(glm::dot(glm::cross(s.dpdu, s.dpdv), s.n), 0);
    }
  EXPECT_FALSE(shape->intersect({{0, -5, 0.3}, {0, 1, 0}, 0, 4}, 0));  // phi > 180 degrees
  EXPECT_FALSE(shape->intersect({{0, 5, 1.6}, {0, -1, 0}}, 0));        // above zmax
}

TEST(Sphere, FarLightsAreSampledExactly) {
  // From 1e6 radii a cosine of the cone would round to 1: the density would be infinite.
  const auto shape = sphere(1);
  const AreaSampler& sampler = *shape->areaSampler();
  const DPoint3 from(0, 6e5, 8e5);
  const AreaSample s = sampler.sample(from, {0.3F, 0.6F});
  EXPECT_NEAR(s.pdf * std::numbers::pi * 1e-12, 1, 1e-6);
  // On the sphere in its seen half, and uniform over the disk that is seen.
  double sum = 0;
  const int n = 1024;
  for (int i = 0; i < n; ++i) {
    const AreaSample a = sampler.sample(from, {(static_cast<float>(i) + 0.5F) / n, 0.25F});
    EXPECT_LE(height(a.p, 1), a.error);
    EXPECT_GE(glm::dot(a.p, from), 0);
    sum += 1 - sqr(glm::dot(a.p, from) / 1e6);  // squared distance from the axis: mean 1/2
  }
  EXPECT_NEAR(sum / n, 0.5, 1e-4);
}

TEST(Sphere, SaysWhatIsWrong) {
  EXPECT_THROW(sphere(0), Error);
  EXPECT_THROW(sphere(-1), Error);
  EXPECT_THROW(test::make<Shape>("sphere", {test::number("phimax", 400)}), Error);
  EXPECT_THROW(test::make<Shape>("sphere", {test::number("zmin", 2), test::number("zmax", 3)}),
               Error);
  EXPECT_THROW(test::make<Shape>("sphere", {test::number("raduis", 2)}), Error);
}

}  // namespace
}  // namespace pbrt
