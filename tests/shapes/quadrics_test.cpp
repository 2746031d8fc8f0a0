// Quadrics in the cases where arithmetic is hardest, against a solution in 113 bits.

#include "tests/shapes/quadrics.h"

namespace pbrt {
namespace {

using test::Crossing;
using test::number;
using test::Quad;
using test::Revolved;

class Quadrics : public testing::TestWithParam<float> {
 protected:
  const std::vector<Revolved> all_ = test::revolved(GetParam());
  Rng rng_{11};

  DVec3 direction() {
    DVec3 w(uniformSphere({rng_.uniform(), rng_.uniform()}));
    // Some lie in a plane of the coordinates, some along an axis.
    for (int i = 0; i < 3; ++i)
      if (rng_.uniform() < 0.1F) w[i] = 0;
    return lengthSquared(w) > 0 ? glm::normalize(w) : DVec3(0, 0, 1);
  }
  // A point of the surface, or as many radii farther from the axis.
  DPoint3 target(const Revolved& r, double radii = 1) {
    const double z = r.lo + rng_.uniform() * (r.hi - r.lo);
    const double rho = radii * std::sqrt(static_cast<double>(r.radius2(z)));
    const double phi = 2 * std::numbers::pi * rng_.uniform();
    return {rho * std::cos(phi), rho * std::sin(phi), z};
  }
};
INSTANTIATE_TEST_SUITE_P(Scale, Quadrics, testing::Values(1e-6F, 1.F, 1e6F));

TEST_P(Quadrics, AgreeWithTheOracleFromNearAndFar) {
  for (const Revolved& r : all_) {
    const auto shape = r.make();
    for (const double distance : {1.001, 3.0, 1e6}) {
      int hits = 0, doubtful = 0;
      const int count = 5000;
      const double rounding = 1e-15 * distance * r.size;
      for (int i = 0; i < count; ++i) {
        const DPoint3 o = r.centre() + distance * r.size * direction();
        const DPoint3 to = target(r, 1.2 * rng_.uniform());  // through the surface or past it
        const ObjectRay ray{o, (to - o) * (0.5 + rng_.uniform())};
        const Crossing expected = test::nearestCrossing(r, ray, rounding);
        if (!expected.certain) {
          ++doubtful;
          continue;
        }
        const auto hit = shape->intersect(ray, 0);
        ASSERT_EQ(hit.has_value(), expected.hit)
            << r.shape << " from " << distance << " sizes, t " << double(expected.t);
        if (!hit) continue;
        ++hits;
        const SurfacePoint s = shape->surface(ray, *hit);
        const Quad t = expected.t;
        const DPoint3 truth(static_cast<double>(ray.o.x + t * ray.d.x),
                            static_cast<double>(ray.o.y + t * ray.d.y),
                            static_cast<double>(ray.o.z + t * ray.d.z));
        EXPECT_LE(glm::distance(s.p, truth), 30 * rounding / expected.cosine) << r.shape;
        EXPECT_LE(r.height(s.p), s.error) << r.shape;
        EXPECT_LE(s.error, 1e-14 * r.size);
        const DVec3 g = r.gradient(s.p);
        EXPECT_LE(glm::length(glm::cross(DVec3(s.n), g)), 1e-6 * glm::length(g)) << r.shape;
      }
      EXPECT_GT(hits, count / 4) << r.shape << " " << distance;
      EXPECT_LT(doubtful, count / 50) << r.shape << " " << distance;
    }
  }
}

// A ray leaves a point from either side and meets nothing at once but what the oracle also sees:
// from a point of the surface one root of the quadratic is 0, the other -2 b / a.
TEST_P(Quadrics, NeverMeetThemselvesWhereTheRayBegan) {
  const int count = 1000000 / (3 * static_cast<int>(all_.size()));
  for (const Revolved& r : all_) {
    const auto shape = r.make();
    int starts = 0;
    for (int i = 0; i < 2 * count && starts < count; ++i) {
      const DPoint3 o = r.centre() + 3 * r.size * direction();
      const ObjectRay ray{o, target(r) - o};
      const auto hit = shape->intersect(ray, 0);
      if (!hit) continue;
      ++starts;
      const SurfacePoint s = shape->surface(ray, *hit);
      DVec3 w = direction();
      const DVec3 n = DVec3(s.n) * (rng_.uniform() < 0.5F ? -1.0 : 1.0);
      if (glm::dot(w, n) < 0) w = -w;
      const auto again = shape->intersect({s.p + s.error * n, w}, 0);
      if (!again || again->t > 1e-7 * r.size) continue;
      const double a = w.x * w.x + w.y * w.y - static_cast<double>(r.square) * w.z * w.z;
      const double other = -2 * glm::dot(r.gradient(s.p), w) / a;
      EXPECT_LT(std::abs(other), 1e-6 * r.size)
          << r.shape << " met itself after " << again->t / r.size << " of its size";
    }
    EXPECT_GE(starts, count / 2);
  }
}

// Across the axis the line lies in the plane of one circle: it crosses if it passes within.
TEST_P(Quadrics, GrazedAtATenMillionth) {
  for (const Revolved& r : all_) {
    const auto shape = r.make();
    for (int i = 0; i < 2000; ++i) {
      const double z = r.lo + (0.01 + 0.98 * rng_.uniform()) * (r.hi - r.lo);
      const double rho = std::sqrt(static_cast<double>(r.radius2(z)));
      const double phi = 2 * std::numbers::pi * rng_.uniform();
      const DVec3 x(std::cos(phi), std::sin(phi), 0), along(-x.y, x.x, 0);
      for (const double side : {1.0, -1.0}) {
        const DPoint3 past = rho * (1 + side * 1e-7) * x + DVec3(0, 0, z);
        const auto hit = shape->intersect({past - 3 * rho * along, along}, 0);
        ASSERT_EQ(hit.has_value(), side < 0) << r.shape;
        if (!hit) continue;
        EXPECT_NEAR(hit->t, rho * (3 - std::sqrt(1 - sqr(1 - 1e-7))), 1e-6 * rho);
      }
    }
  }
}

TEST(Quadrics, TheTipOfACone) {
  const auto shape = test::make<Shape>("cone", {number("radius", 2), number("height", 3)});
  const Revolved r = test::revolved(1)[2];
  Rng rng(5);
  int hits = 0;
  for (const double aside : {0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3})
    for (int i = 0; i < 1000; ++i) {
      const DVec3 w(uniformSphere({rng.uniform(), rng.uniform()}));
      const DPoint3 at =
          DPoint3(0, 0, 3) + aside * DVec3(uniformSphere({rng.uniform(), rng.uniform()}));
      const ObjectRay ray{at - 5.0 * w, w};
      const auto hit = shape->intersect(ray, 0);
      const Crossing expected = test::nearestCrossing(r, ray, 1e-14);
      EXPECT_TRUE(hit.has_value() == expected.hit || !expected.certain) << aside;
      if (!hit) continue;
      ++hits;
      const SurfacePoint s = shape->surface(ray, *hit);
      EXPECT_NEAR(glm::length(s.n), 1, 1e-6);
      EXPECT_NEAR(s.n.z, 2 / std::sqrt(13), 1e-6);
      for (const Vec3& v : {s.dpdu, s.dpdv, s.dndu, s.dndv}) EXPECT_TRUE(isFinite(v));
      EXPECT_TRUE(s.uv.x >= 0 && s.uv.x <= 1 && s.uv.y >= 0 && s.uv.y <= 1)
          << s.uv.x << " " << s.uv.y;
      EXPECT_LE(s.p.z, 3);
    }
  EXPECT_GT(hits, 1500);
}

// As pbrt has them: u about the axis, v along the profile; the normal is dp/du x dp/dv.
TEST(Quadrics, ParametrisationIsThatOfTheBook) {
  struct Row {
    const char* shape;
    ParamList params;
    DPoint3 (*at)(double u, double v);
  };
  const auto turned = [](double phi, double x, double y, double z) {
    return DPoint3(x * std::cos(phi) - y * std::sin(phi), x * std::sin(phi) + y * std::cos(phi), z);
  };
  static const auto turn = turned;
  const std::vector<Row> rows{
      {"cylinder",
       {number("radius", 2), number("zmin", 3), number("zmax", -1), number("phimax", 180)},
       [](double u, double v) { return turn(u * std::numbers::pi, 2, 0, -1 + 4 * v); }},
      {"cone",
       {number("radius", 2), number("height", 5), number("phimax", 90)},
       [](double u, double v) { return turn(u * std::numbers::pi / 2, 2 * (1 - v), 0, 5 * v); }},
      {"paraboloid",
       {number("radius", 3), number("zmin", 1), number("zmax", 4), number("phimax", 270)},
       [](double u, double v) {
         const double z = 1 + 3 * v;
         return turn(u * 1.5 * std::numbers::pi, 1.5 * std::sqrt(z), 0, z);
       }},
      {"hyperboloid",
       {test::points("p1", {1, 2, -1}), test::points("p2", {3, -1, 2}), number("phimax", 120)},
       [](double u, double v) {
         return turn(u * 2 / 3 * std::numbers::pi, 1 + 2 * v, 2 - 3 * v, -1 + 3 * v);
       }},
  };
  for (const Row& row : rows) {
    const auto shape = test::make<Shape>(row.shape, row.params);
    for (const double u : {0.1, 0.5, 0.9})
      for (const double v : {0.1, 0.5, 0.9}) {
        const double h = 1e-4;
        const DPoint3 p = row.at(u, v);
        const DVec3 dpdu = (row.at(u + h, v) - row.at(u - h, v)) / (2 * h);
        const DVec3 dpdv = (row.at(u, v + h) - row.at(u, v - h)) / (2 * h);
        const DVec3 n = glm::normalize(glm::cross(dpdu, dpdv));
        const ObjectRay ray{p + 0.1 * n, -n};
        const auto hit = shape->intersect(ray, 0);
        ASSERT_TRUE(hit) << row.shape;
        EXPECT_NEAR(hit->t, 0.1, 1e-6);
        const SurfacePoint s = shape->surface(ray, *hit);
        EXPECT_NEAR(s.uv.x, u, 1e-6);
        EXPECT_NEAR(s.uv.y, v, 1e-6);
        EXPECT_LE(glm::length(DVec3(s.n) - n), 1e-6);
        EXPECT_LE(glm::length(DVec3(s.dpdu) - dpdu), 1e-6 * glm::length(dpdu));
        EXPECT_LE(glm::length(DVec3(s.dpdv) - dpdv), 1e-6 * glm::length(dpdv));
      }
    // Beyond the sweep and beyond the ends there is nothing.
    for (const auto& [u, v] : {std::pair(1.05, 0.5), {-0.05, 0.5}, {0.5, 1.05}, {0.5, -0.05}}) {
      const DPoint3 p = row.at(u, v);
      const DVec3 n = glm::normalize(glm::cross(row.at(u + 1e-4, v) - p, row.at(u, v + 1e-4) - p));
      EXPECT_FALSE(shape->intersect({p + 0.05 * n, -n, 0, 0.1}, 0)) << row.shape << u << v;
    }
  }
}

TEST(Quadrics, AreasInClosedForm) {
  const auto area = [](const char* name, const ParamList& list) {
    return test::make<Shape>(name, list)->areaSampler()->area();
  };
  const double pi = std::numbers::pi;
  EXPECT_NEAR(area("cylinder", {number("radius", 2), number("phimax", 90)}), 2 * pi, 1e-14);
  EXPECT_NEAR(area("cone", {number("radius", 3), number("height", 4)}), 15 * pi, 1e-13);
  EXPECT_NEAR(area("paraboloid", {number("radius", 2), number("zmax", 3)}),
              pi * 2 / (6 * 9) * (std::pow(4 + 36, 1.5) - 8), 1e-13);
  // A flat dish is a disk, a flat cone as well; a bowl that opens downward is as large.
  EXPECT_NEAR(area("paraboloid", {number("zmax", 1e-9F)}), pi, 1e-12);
  EXPECT_NEAR(area("cone", {number("height", 1e-9F)}), pi, 1e-12);
  EXPECT_NEAR(
      area("paraboloid", {number("zmin", -3), number("zmax", -1)}),
      area("paraboloid", {number("radius", std::sqrt(3.F)), number("zmin", 1), number("zmax", 3)}),
      1e-6);
  // A hyperboloid, by the midpoint rule over its circles: between two of them a cone's frustum.
  double sum = 0;
  const int n = 20000;
  const auto rho = [](double z) { return std::sqrt(1 + z * z); };
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * i / n, b = 2.0 * (i + 1) / n;
    sum += pi * (rho(a) + rho(b)) * std::hypot(b - a, rho(b) - rho(a));
  }
  EXPECT_NEAR(area("hyperboloid", {test::points("p1", {1, 0, 0}), test::points("p2", {1, 2, 2})}),
              sum, 1e-7);
}

// Half of the samples of a flat dish and of a cone lie within half of the area.
TEST(Quadrics, SamplesAreUniformByArea) {
  const auto median = [](const char* name, const ParamList& list) {
    const AreaSample s =
        test::make<Shape>(name, list)->areaSampler()->sample({0, 0, 9}, {0.5F, 0.3F});
    return std::hypot(s.p.x, s.p.y);
  };
  EXPECT_NEAR(median("paraboloid", {number("zmax", 1e-7F)}), std::sqrt(0.5), 1e-7);
  EXPECT_NEAR(median("cone", {number("height", 4)}), std::sqrt(0.5), 1e-7);
  EXPECT_NEAR(
      median("hyperboloid", {test::points("p1", {2, 0, -1}), test::points("p2", {-2, 0, 1})}), 0,
      1e-7);
}

TEST(Quadrics, SayWhatIsWrong) {
  const auto blames = [](const char* shape, const ParamList& list, const char* text) {
    try {
      test::make<Shape>(shape, list);
      ADD_FAILURE() << shape << " accepts that " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  using test::points;
  blames("cylinder", {number("radius", 0)}, "\"radius\"");
  blames("cylinder", {number("zmin", 1)}, "\"zmax\" must differ from zmin");
  blames("cylinder", {number("phimax", 361)}, "\"phimax\"");
  blames("cone", {number("height", 0)}, "\"height\"");
  blames("cone", {number("radius", -1)}, "\"radius\"");
  blames("paraboloid", {number("zmin", -1), number("zmax", 0)}, "\"zmax\" must not be 0");
  blames("paraboloid", {number("zmin", 1)}, "\"zmax\" must differ from zmin");
  blames("hyperboloid", {points("p1", {1, 0, 1})}, "a flat ring is a disk");
  blames("hyperboloid", {points("p2", {0, 0, 1})}, "lies on the z axis");
  blames("hyperboloid", {points("p1", {kInfinity, 0, 0})}, "\"p1\" is not finite");
}

}  // namespace
}  // namespace pbrt
