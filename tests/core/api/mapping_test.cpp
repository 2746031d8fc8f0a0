#include "core/api/mapping.h"

#include <gtest/gtest.h>

#include "core/base/rng.h"

namespace pbrt {
namespace {

const Transform kPlacement = Transform::translate({0.5, -1, 2}) * Transform::rotate(40, {1, 2, 3}) *
                             Transform::scale({2, 3, 0.5});

SurfaceInteraction somewhere(Rng& rng) {
  const auto vec = [&] { return 2.F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.F; };
  SurfaceInteraction at;
  at.p = 3.F * vec();
  at.uv = Point2(rng.uniform(), rng.uniform());
  at.dpdx = vec();
  at.dpdy = vec();
  at.dudx = rng.uniform();
  at.dvdx = rng.uniform();
  at.dudy = rng.uniform();
  at.dvdy = rng.uniform();
  return at;
}

// The same point a step of the footprint to the side.
SurfaceInteraction step(const SurfaceInteraction& at, float x, float y) {
  SurfaceInteraction moved = at;
  moved.p += x * at.dpdx + y * at.dpdy;
  moved.uv += Vec2(x * at.dudx + y * at.dudy, x * at.dvdx + y * at.dvdy);
  return moved;
}

void checkDerivatives(const Mapping2D& map, float turn) {
  Rng rng(7);
  constexpr float h = 0.01F;
  for (int i = 0; i < 500; ++i) {
    SurfaceInteraction at = somewhere(rng);
    at.dpdx *= 0.1F;
    at.dpdy *= 0.1F;
    const TexturePoint m = map(at);
    if (glm::any(glm::greaterThan(glm::abs(m.dx), Vec2(0.5F)))) continue;  // near a pole
    if (glm::any(glm::greaterThan(glm::abs(m.dy), Vec2(0.5F)))) continue;
    const auto difference = [&](float x, float y) {
      Vec2 d = map(step(at, x, y)).st - map(step(at, -x, -y)).st;
      // Across the seam.
      if (turn > 0) d -= turn * glm::round(d / turn);
      return d / (2 * h);
    };
    const Vec2 dx = difference(h, 0), dy = difference(0, h);
    for (int c = 0; c < 2; ++c) {
      ASSERT_NEAR(m.dx[c], dx[c], 2e-3) << i;
      ASSERT_NEAR(m.dy[c], dy[c], 2e-3) << i;
    }
  }
}

TEST(Mapping, DerivativesAreThoseOfTheCoordinates) {
  checkDerivatives(UvMapping{{0.3F, 0.2F}, {0.1F, 0.7F}}, 0);
  checkDerivatives(SphericalMapping{kPlacement.inverse()}, 1);
  checkDerivatives(CylindricalMapping{kPlacement.inverse()}, 1);
  checkDerivatives(PlanarMapping{kPlacement.inverse(), {1, 0.5, 0}, {0, 1, -1}, {1, 2}}, 0);
}

TEST(Mapping, Uv) {
  SurfaceInteraction at;
  at.uv = {0.25F, 0.5F};
  EXPECT_EQ(UvMapping({{8, 4}, {1, 2}})(at).st, Point2(3, 4));
}

// Places on the unit sphere of texture space.
TEST(Mapping, SphereAndCylinder) {
  const auto at = [](const DPoint3& p) {
    SurfaceInteraction s;
    s.p = kPlacement.point(p);
    return s;
  };
  const Mapping2D sphere = SphericalMapping{kPlacement.inverse()};
  const Mapping2D cylinder = CylindricalMapping{kPlacement.inverse()};
  const auto near = [](Point2 a, Point2 b) { EXPECT_NEAR(glm::length(a - b), 0, 1e-6); };
  near(sphere(at({0, 2, 0})).st, {0.5F, 0.25F});
  near(sphere(at({0, -1, 1})).st, {0.25F, 0.75F});
  near(sphere(at({1, 1, 0})).st, {0.5F, 0.125F});
  near(cylinder(at({3, 0, 0})).st, {0.5F, 0});
  near(cylinder(at({0, 3, 4})).st, {0.75F, 0.8F});
}

TEST(Mapping, PolesAndCentreAreFinite) {
  for (const Point3 p : {Point3(0), Point3(0, 0, 1), Point3(0, 0, -1), Point3(1e-30F, 0, 1)}) {
    SurfaceInteraction at;
    at.p = p;
    at.dpdx = {1, 2, 3};
    at.dpdy = {-3, 2, 1};
    for (const Mapping2D& map : {Mapping2D(SphericalMapping{}), Mapping2D(CylindricalMapping{})}) {
      const TexturePoint m = map(at);
      for (const float x : {m.st.x, m.st.y, m.dx.x, m.dx.y, m.dy.x, m.dy.y})
        EXPECT_TRUE(std::isfinite(x) && std::abs(x) <= 1) << x;
    }
  }
}

}  // namespace
}  // namespace pbrt
