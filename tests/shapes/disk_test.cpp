#include "tests/support.h"

namespace pbrt {
namespace {

std::unique_ptr<Shape> ring() {
  return test::make<Shape>("disk", {test::number("height", 2), test::number("radius", 3),
                                    test::number("innerradius", 1), test::number("phimax", 270)});
}

TEST(Disk, ParametrisationIsThatOfTheBook) {
  const auto shape = ring();
  for (const double u : {0.1, 0.5, 0.9})
    for (const double v : {0.1, 0.5, 0.9}) {
      const double phi = u * 1.5 * std::numbers::pi, rho = 3 - v * 2;  // v = 0 at the rim
      const ObjectRay ray{{rho * std::cos(phi), rho * std::sin(phi), 7}, {0, 0, -2}};
      const auto hit = shape->intersect(ray, 0);
      ASSERT_TRUE(hit);
      EXPECT_EQ(hit->t, 2.5F);
      const SurfacePoint s = shape->surface(ray, *hit);
      EXPECT_NEAR(s.uv.x, u, 1e-6);
      EXPECT_NEAR(s.uv.y, v, 1e-6);
      EXPECT_EQ(s.n, Normal3(0, 0, 1));
      EXPECT_GT(glm::cross(s.dpdu, s.dpdv).z, 0);
    }
}

TEST(Disk, EndsAtItsEdges) {
  const auto shape = ring();
  const auto hit = [&](double x, double y) {
    return shape->intersect({{x, y, 0}, {0, 0, 1}}, 0).has_value();
  };
  EXPECT_TRUE(hit(0, 2.9999999));
  EXPECT_FALSE(hit(0, 3.0000001));
  EXPECT_TRUE(hit(0, 1.0000001));
  EXPECT_FALSE(hit(0, 0.9999999));
  EXPECT_TRUE(hit(2, 1e-7));
  EXPECT_FALSE(hit(2, -1e-7));  // beyond 270 degrees
  EXPECT_TRUE(hit(-1e-7, -2));
  EXPECT_FALSE(hit(1e-7, -2));
}

TEST(Disk, IsNotThereEdgeOnOrFromItsOwnPlane) {
  const auto shape = ring();
  EXPECT_FALSE(shape->intersect({{-9, 0, 2}, {1, 0, 0}}, 0));
  EXPECT_FALSE(shape->intersect({{-9, 0, 1}, {1, 0, 0}}, 0));
  EXPECT_FALSE(shape->intersect({{2, 2, 2}, {0.1, 0.2, 0.3}}, 0));
  EXPECT_FALSE(shape->intersect({{2, 1, 2}, {0, 0, 0}}, 0));
}

// A point far off along a grazing ray is as near to the plane as one nearby: exactly on it.
TEST(Disk, PointsAreExact) {
  const auto shape = test::make<Shape>("disk", {test::number("height", 0.1F)});
  const double height = 0.1F;
  const ObjectRay ray{{1e6 + 0.25, 0.5, height + 0.1}, {-1e6, 0, -0.1}};  // 1e-7 off the plane
  const auto hit = shape->intersect(ray, 0);
  ASSERT_TRUE(hit);
  const SurfacePoint s = shape->surface(ray, *hit);
  EXPECT_EQ(s.p.z, height);
  EXPECT_EQ(s.error, 0);
  EXPECT_NEAR(s.p.x, 0.25, 1e-8);
  EXPECT_EQ(s.p.y, 0.5);
}

TEST(Disk, CentreHasAFrame) {
  const auto shape = test::make<Shape>("disk");
  const ObjectRay ray{{0, 0, 1}, {0, 0, -1}};
  const auto hit = shape->intersect(ray, 0);
  ASSERT_TRUE(hit);
  const SurfacePoint s = shape->surface(ray, *hit);
  EXPECT_EQ(s.uv, Point2(0, 1));
  EXPECT_TRUE(isFinite(s.dpdu) && isFinite(s.dpdv));
}

TEST(Disk, SaysWhatIsWrong) {
  EXPECT_THROW(test::make<Shape>("disk", {test::number("radius", 0)}), Error);
  EXPECT_THROW(test::make<Shape>("disk", {test::number("innerradius", 1)}), Error);
  EXPECT_THROW(test::make<Shape>("disk", {test::number("innerradius", -1)}), Error);
  EXPECT_THROW(test::make<Shape>("disk", {test::number("phimax", 0)}), Error);
}

}  // namespace
}  // namespace pbrt
