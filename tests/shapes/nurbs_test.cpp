// Patches whose true surface is known: conics, which rational curves follow exactly, and the
// identity, which every knot vector must reproduce.

#include "core/base/rng.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using test::integers;
using test::points;

Param floats(std::string name, std::vector<float> v) {
  return test::value(ParamType::number, std::move(name), std::move(v));
}
ParamList axis(const std::string& u, int count, int order, std::vector<float> knots) {
  return {integers("n" + u, {count}), integers(u + "order", {order}),
          floats(u + "knots", std::move(knots))};
}
ParamList operator+(ParamList a, const ParamList& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

const std::vector<float> kCircleKnots{0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4};

// A unit sphere: a full circle of nine points times a half circle of five, from pole to pole.
ParamList sphere() {
  const float s = std::sqrt(0.5F);
  const std::vector<Vec3> circle{{1, 0, 1},   {1, 1, s},  {0, 1, 1},  {-1, 1, s}, {-1, 0, 1},
                                 {-1, -1, s}, {0, -1, 1}, {1, -1, s}, {1, 0, 1}};
  const std::vector<Vec3> half{{0, -1, 1}, {1, -1, s}, {1, 0, 1}, {1, 1, s}, {0, 1, 1}};
  std::vector<float> weighted;
  for (const Vec3& v : half)
    for (const Vec3& u : circle) {
      const float w = u.z * v.z;
      weighted.insert(weighted.end(), {u.x * v.x * w, u.y * v.x * w, v.y * w, w});
    }
  return axis("u", 9, 3, kCircleKnots) + axis("v", 5, 3, {0, 0, 0, 1, 1, 2, 2, 2}) +
         ParamList{floats("Pw", weighted)};
}

TEST(Nurbs, SphereIsExactPolesIncluded) {
  const auto shape = test::make<Shape>("nurbs", sphere());
  const TriangleMesh& m = *shape->triangles();
  EXPECT_EQ(m.positions.size(), 900U);
  EXPECT_EQ(m.triangles(), 2U * 29 * 29);
  for (std::size_t i = 0; i < m.positions.size(); ++i) {
    EXPECT_NEAR(glm::length(m.positions[i]), 1, 1e-6);
    EXPECT_LE(glm::distance(m.normals[i], m.positions[i]), 2e-4) << "vertex " << i;
  }
  for (std::size_t i = 60; i + 60 < m.positions.size(); ++i)  // away from the poles exactly
    EXPECT_LE(glm::distance(m.normals[i], m.positions[i]), 2e-6) << "vertex " << i;
}

TEST(Nurbs, UvAreTheParametersAndTheRangeCanBeCut) {
  const auto shape = test::make<Shape>(
      "nurbs",
      sphere() + ParamList{test::number("u0", 1), test::number("u1", 2), test::number("v1", 1)});
  const TriangleMesh& m = *shape->triangles();
  EXPECT_EQ(m.uv.front(), Point2(1, 0));
  EXPECT_EQ(m.uv.back(), Point2(2, 1));
  for (const Point3& p : m.positions) {  // a quarter of the lower half
    EXPECT_LE(p.x, 1e-6);
    EXPECT_GE(p.y, -1e-6);
    EXPECT_LE(p.z, 1e-6);
  }
}

// Control points at the Greville abscissae (the mean of degree successive knots) make the spline
// the identity, whatever the knots and the order are.
TEST(Nurbs, ReproducesTheIdentityForAnyKnots) {
  Rng rng(11);
  for (int order = 2; order <= 6; ++order)
    for (int trial = 0; trial < 10; ++trial) {
      const auto makeKnots = [&](int count) {
        std::vector<float> knots;
        float t = 0;
        for (int i = 0; i < count + order; ++i) {
          if (i >= order && rng.uniform() < 0.7F) t += rng.uniform();
          knots.push_back(t);
        }
        for (int i = 0; i < order - 1; ++i) knots[knots.size() - 1 - i] = t + 1;
        knots[knots.size() - order] = t + 1;
        return knots;
      };
      const int nu = order + 4, nv = order + 1;
      const auto u = makeKnots(nu), v = makeKnots(nv);
      const auto greville = [&](const std::vector<float>& knots, int i) {
        float sum = 0;
        for (int k = 1; k < order; ++k) sum += knots[i + k];
        return sum / static_cast<float>(order - 1);
      };
      std::vector<float> p;
      for (int j = 0; j < nv; ++j)
        for (int i = 0; i < nu; ++i) p.insert(p.end(), {greville(u, i), greville(v, j), 0});
      const auto shape = test::make<Shape>(
          "nurbs", axis("u", nu, order, u) + axis("v", nv, order, v) + ParamList{points("P", p)});
      const TriangleMesh& m = *shape->triangles();
      for (std::size_t i = 0; i < m.positions.size(); ++i) {
        EXPECT_LE(glm::distance(Point2(m.positions[i]), m.uv[i]), 1e-5);
        EXPECT_LE(glm::distance(m.normals[i], Normal3(0, 0, 1)), 1e-6);
      }
    }
}

TEST(Nurbs, SaysWhatIsWrong) {
  const ParamList u = axis("u", 2, 2, {0, 0, 1, 1}), v = axis("v", 2, 2, {0, 0, 1, 1});
  const Param p = points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0});
  const auto blames = [](const ParamList& list, const char* text) {
    try {
      test::make<Shape>("nurbs", list);
      ADD_FAILURE() << "nothing was said of " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  EXPECT_NO_THROW(test::make<Shape>("nurbs", u + v + ParamList{p}));
  blames({}, "\"nu\"");
  blames(u + ParamList{p}, "\"nv\"");
  blames(u + v, "\"Pw\"");
  blames(axis("u", 2, 3, {0, 0, 0, 1, 1}) + v + ParamList{p}, "\"uorder\"");
  blames(axis("u", 2, 2, {0, 0, 1}) + v + ParamList{p}, "\"uknots\" has 3");
  blames(axis("u", 2, 2, {0, 1, 0, 1}) + v + ParamList{p}, "never fall");
  blames(axis("u", 2, 2, {0, 1, 1, 2}) + v + ParamList{p}, "no range");
  blames(u + v + ParamList{p, test::number("u0", -1)}, "\"u0\"");
  blames(u + v + ParamList{p, test::number("v1", 0)}, "\"v1\"");
  blames(u + v + ParamList{points("P", {0, 0, 0})}, "\"P\" must be 4 points");
  blames(u + v + ParamList{floats("Pw", {0, 0, 0, 1, 1})}, "\"Pw\"");
  blames(u + v + ParamList{floats("Pw", {0, 0, 0, 1, 1, 0, 0, 0, 0, 1, 0, 1, 1, 1, 0, 1})},
         "weight of 0");
}

}  // namespace
}  // namespace pbrt
