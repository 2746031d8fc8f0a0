// Curves against an oracle that looks for every crossing, and as the formats have them.

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using test::integers;
using test::number;
using test::points;
using test::text;

using LVec = glm::vec<3, long double>;
using LPair = glm::vec<2, long double>;

// A strip about a cubic Bezier curve, by its definition: at each u a straight piece across.
struct Strip {
  std::array<LVec, 4> p;
  long double half0 = 0, half1 = 0;
  LVec n0{0}, n1{0};  // zero: it faces the ray

  LVec point(long double u) const {
    const long double v = 1 - u;
    return v * v * v * p[0] + 3 * v * v * u * p[1] + 3 * v * u * u * p[2] + u * u * u * p[3];
  }
  LVec tangent(long double u) const {
    const long double v = 1 - u;
    return 3 * v * v * (p[1] - p[0]) + 6 * v * u * (p[2] - p[1]) + 3 * u * u * (p[3] - p[2]);
  }
  // The unit vector across, as seen by a ray along the unit vector d.
  LVec across(long double u, const LVec& d) const {
    LVec n = d;
    if (n0 != LVec(0)) {
      const long double angle = std::acos(glm::dot(n0, n1));
      n = angle > 0 ? (std::sin((1 - u) * angle) * n0 + std::sin(u * angle) * n1) / std::sin(angle)
                    : n0;
    }
    return glm::normalize(glm::cross(n, tangent(u)));
  }

  struct Crossing {
    long double t = -1;   // of the nearest; below 0: none
    bool certain = true;  // no crossing begins or ends within rounding
  };
  Crossing nearest(const ObjectRay& ray) const {
    const LVec o(ray.o), d = glm::normalize(LVec(ray.d));
    const LVec x =
        glm::normalize(glm::cross(std::abs(d.x) < 0.5L ? LVec(1, 0, 0) : LVec(0, 1, 0), d));
    const LVec y = glm::cross(d, x);
    const auto flat = [&](const LVec& v) { return LPair(glm::dot(x, v), glm::dot(y, v)); };
    const auto f = [&](long double u) {
      const LPair c = flat(point(u) - o), e = flat(across(u, d));
      return c.x * e.y - c.y * e.x;
    };
    Crossing best;
    const int steps = 800;
    std::array<long double, steps + 1> values;
    for (int i = 0; i <= steps; ++i) values[i] = f(i / static_cast<long double>(steps));
    for (int i = 0; i < steps; ++i) {
      long double a = i / static_cast<long double>(steps),
                  b = (i + 1) / static_cast<long double>(steps);
      long double fa = values[i], fb = values[i + 1];
      if (i == 0 && std::abs(fa) < 1e-9L) best.certain = false;
      if (i + 1 == steps && std::abs(fb) < 1e-9L) best.certain = false;
      // A pair that is about to be born.
      if (i > 0 && (fa < 0) == (fb < 0) && (fa < 0) == (values[i - 1] < 0) &&
          std::abs(fa) <= std::abs(fb) && std::abs(fa) <= std::abs(values[i - 1]) &&
          std::abs(fa) < 1e-4L)
        best.certain = false;
      if ((fa < 0) == (fb < 0)) continue;
      for (int k = 0; k < 70; ++k) {
        const long double m = (a + b) / 2;
        ((f(m) < 0) == (fa < 0) ? a : b) = m;
      }
      const long double u = (a + b) / 2, h = half0 + u * (half1 - half0);
      const LVec c = point(u) - o, e = across(u, d);
      const LPair ce = flat(c), ee = flat(e);
      const long double s = -glm::dot(ce, ee) / glm::dot(ee, ee);
      if (std::abs(std::abs(s) - h) < 1e-9L) best.certain = false;
      if (std::abs(s) > h) continue;
      const long double t = glm::dot(c + s * e, d) / glm::length(LVec(ray.d));
      if (t > ray.tMin && t <= ray.tMax && (best.t < 0 || t < best.t)) best.t = t;
    }
    return best;
  }
};

std::optional<ShapeHit> nearest(const Shape& shape, const ObjectRay& ray) {
  std::optional<ShapeHit> best;
  for (std::uint32_t i = 0; i < shape.primitives(); ++i)
    if (const auto hit = shape.intersect(ray, i); hit && (!best || hit->t < best->t)) best = hit;
  return best;
}

Param normals(std::vector<float> v) {
  return test::value(ParamType::normal, "N", std::move(v));
}

DVec3 uniform(Rng& rng) {
  return 2.0 * DVec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.0;
}

class Curves : public testing::TestWithParam<bool> {};

// Of every bend, thin and wide, from near and from a million lengths away.
TEST_P(Curves, AgreeWithTheOracle) {
  Rng rng(GetParam() ? 5 : 6);
  int hits = 0, doubtful = 0, count = 0;
  for (int i = 0; i < 24; ++i) {
    Strip strip;
    std::vector<float> p;
    for (LVec& c : strip.p) {
      const Vec3 v(uniform(rng));
      c = LVec(v);
      for (int k = 0; k < 3; ++k) p.push_back(v[k]);
    }
    const float w0 = std::pow(10.F, -3 * rng.uniform()), w1 = i % 3 ? w0 * rng.uniform() : 0;
    strip.half0 = 0.5L * w0, strip.half1 = 0.5L * w1;
    ParamList list{points("P", p), number("width0", w0), number("width1", w1)};
    if (GetParam()) {
      const Vec3 a(glm::normalize(uniform(rng))), b(glm::normalize(uniform(rng)));
      strip.n0 = glm::normalize(LVec(a)), strip.n1 = glm::normalize(LVec(b));
      list.push_back(text("type", "ribbon"));
      list.push_back(normals({a.x, a.y, a.z, b.x, b.y, b.z}));
    }
    for (const double distance : {2.0, 1e6}) {
      // From afar floats cannot tell which piece is nearer: there it is one.
      list.push_back(integers("splitdepth", {distance > 10 ? 0 : i % 5}));
      const auto shape = test::make<Shape>("curve", list);
      list.pop_back();
      for (int k = 0; k < 50; ++k, ++count) {
        const DPoint3 o = distance * DVec3(uniformSphere({rng.uniform(), rng.uniform()}));
        const DPoint3 to = DVec3(strip.point(rng.uniform())) + 0.6 * double(w0) * uniform(rng);
        const ObjectRay ray{o, (to - o) * (0.5 + rng.uniform())};
        const Strip::Crossing expected = strip.nearest(ray);
        if (!expected.certain) {
          ++doubtful;
          continue;
        }
        const auto hit = nearest(*shape, ray);
        ASSERT_EQ(hit.has_value(), expected.t >= 0) << "curve " << i << " from " << distance;
        if (!hit) continue;
        ++hits;
        const double length = glm::length(ray.d);
        EXPECT_NEAR(hit->t * length, static_cast<double>(expected.t) * length,
                    1e-7 * hit->t * length + 1e-9)
            << "curve " << i;
        const SurfacePoint s = shape->surface(ray, *hit);
        EXPECT_LE(glm::length(s.p - DPoint3(LVec(ray.o) + expected.t * LVec(ray.d))),
                  1e-7 * (distance > 10 ? 1 : 1e-3))
            << "curve " << i << " from " << distance;
      }
    }
  }
  EXPECT_GT(hits, count / 3);
  EXPECT_LT(doubtful, count / 10);
}
INSTANTIATE_TEST_SUITE_P(Types, Curves, testing::Bool(),
                         [](const auto& test) { return test.param ? "Ribbon" : "Facing"; });

// Seen along -z a straight hair is a rectangle, to its last digits.
TEST(Curve, AStraightOneIsARectangle) {
  const auto shape = test::make<Shape>(
      "curve", {points("P", {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}), number("width", 0.5F)});
  const auto hit = [&](double x, double y) {
    return nearest(*shape, {{x, y, 7}, {0, 0, -1}}).has_value();
  };
  for (const double x : {1e-12, 1.0, 1.7, 3 - 1e-12})
    for (const double y : {0.0, 0.25 - 1e-12, -0.25 + 1e-12})
      EXPECT_TRUE(hit(x, y)) << x << " " << y;
  for (const double x : {-1e-12, 3 + 1e-12}) EXPECT_FALSE(hit(x, 0.1));
  for (const double y : {0.25 + 1e-12, -0.25 - 1e-12}) EXPECT_FALSE(hit(1.7, y));
  const ObjectRay ray{{1.2, 0.1, 7}, {0, 0, -1}};
  const SurfacePoint s = shape->surface(ray, *nearest(*shape, ray));
  EXPECT_EQ(s.n, Normal3(0, 0, 1)) << "towards the ray";
  EXPECT_NEAR(s.uv.x, 0.4, 1e-7);
  EXPECT_NEAR(s.uv.y, 0.3, 1e-7) << "v grows along d x c', as in pbrt";
  EXPECT_NEAR(s.error, 0.25, 1e-6) << "where other rays may see it";
}

// The normal of a cylinder turns evenly from one rim to the other, outward.
TEST(Curve, ACylinderIsShadedLikeOne) {
  const auto shape = test::make<Shape>(
      "curve", {points("P", {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0}), text("type", "cylinder")});
  for (const double y : {-0.45, -0.25, 0.0, 0.1, 0.4}) {
    const ObjectRay ray{{1.2, y, 7}, {0, 0, -1}};
    const SurfacePoint s = shape->surface(ray, *nearest(*shape, ray));
    EXPECT_NEAR(s.n.y, std::sin(y * std::numbers::pi), 1e-6);
    EXPECT_NEAR(s.n.z, std::cos(y * std::numbers::pi), 1e-6);
    EXPECT_NEAR(s.p.z, 0, 1e-12);
    EXPECT_NEAR(s.error, 0.5 + std::abs(y * s.n.y), 1e-6);
  }
}

// Where control points coincide the curve begins in the direction of the next ones.
TEST(Curve, DoubledControlPointsEndSquarely) {
  const auto shape = test::make<Shape>(
      "curve", {points("P", {0, 0, 0, 0, 0, 0, 3, 0, 0, 3, 0, 0}), number("width", 0.5F)});
  Rng rng(3);
  for (int i = 0; i < 2000; ++i) {
    const double x = -0.5 + 4 * rng.uniform(), y = -0.5 + rng.uniform();
    EXPECT_EQ(nearest(*shape, {{x, y, 7}, {0, 0, -1}}).has_value(),
              x > 0 && x < 3 && std::abs(y) < 0.25)
        << x << " " << y;
  }
  const auto point = test::make<Shape>("curve", {points("P", std::vector<float>(12, 1))});
  for (int i = 0; i < 100; ++i) EXPECT_FALSE(nearest(*point, {{0, 0, 0}, uniform(rng)}));
}

// Neighbouring segments, and the pieces of each, leave no gap between them, and a ray along the
// curve or in its plane finds no wrong thing.
TEST(Curve, IsWholeAcrossItsPieces) {
  for (const char* type : {"flat", "cylinder", "ribbon"}) {
    const auto shape = test::make<Shape>(
        "curve", {points("P", {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0}),
                  number("width", 0.5F), text("basis", "bspline"), text("type", type),
                  normals({0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1})});
    EXPECT_EQ(shape->primitives(), 3U * 8);
    for (int i = 1; i < 24; ++i) {
      double x = 1 + i / 8.0;
      for (int k = 0; k < 3; ++k, x = std::nextafter(x, 9.0))
        EXPECT_TRUE(nearest(*shape, {{x, 0.2, 7}, {0, 0, -1}})) << type << " " << x;
    }
    for (const double z : {0.0, 0.1}) nearest(*shape, {{-5, 0, z}, {1, 0, 0}});
    const auto edgeOn = nearest(*shape, {{2.5, -5, 1e-3}, {0, 1, 0}});
    EXPECT_EQ(edgeOn.has_value(), std::string(type) != "ribbon");
  }
}

TEST(Curve, BasesAndDegreesAreOfOneCurve) {
  // x^2 as a parabola over [0, 2]: quadratic and cubic, Bezier and B-spline.
  const std::vector<ParamList> all{
      {points("P", {0, 0, 0, 1, 0, 0, 2, 4, 0}), integers("degree", {2})},
      {points("P", {0, 0, 0, 2 / 3.F, 0, 0, 4 / 3.F, 4 / 3.F, 0, 2, 4, 0})},
      {points("P", {-0.5F, 0, 0, 0.5F, 0, 0, 1.5F, 2, 0, 2.5F, 6, 0}), integers("degree", {2}),
       text("basis", "bspline")},
      // A uniform cubic B-spline draws x^2 if its points are (i, i^2 - 1/3).
      {points("P", {-1, 2 / 3.F, 0, 0, -1 / 3.F, 0, 1, 2 / 3.F, 0, 2, 11 / 3.F, 0, 3, 26 / 3.F, 0}),
       text("basis", "bspline")}};
  for (std::size_t i = 0; i < all.size(); ++i) {
    ParamList list = all[i];
    list.push_back(number("width", 1e-4F));
    const auto shape = test::make<Shape>("curve", list);
    for (const double x : {0.3, 0.9, 1.4, 1.9}) {
      EXPECT_TRUE(nearest(*shape, {{x, x * x, 7}, {0, 0, -1}})) << i << " " << x;
      EXPECT_FALSE(nearest(*shape, {{x, x * x + 1e-3, 7}, {0, 0, -1}})) << i << " " << x;
    }
  }
}

TEST(Curve, WidthsRunOverAllSegments) {
  const auto shape = test::make<Shape>(
      "curve", {points("P", {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 0, 4, 0, 0, 5, 0, 0, 6, 0, 0}),
                number("width0", 2), number("width1", 0)});
  for (const double x : {0.5, 2.5, 3.5, 5.5})
    for (const double side : {-1.0, 1.0})
      for (const double off : {-1e-6, 1e-6})
        EXPECT_EQ(nearest(*shape, {{x, side * (1 - x / 6 + off), 7}, {0, 0, -1}}).has_value(),
                  off < 0);
}

TEST(Curve, SaysWhatIsWrong) {
  const auto blames = [](ParamList list, const char* what) {
    try {
      test::make<Shape>("curve", list);
      ADD_FAILURE() << "accepts that " << what;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(what), std::string::npos) << error.what();
    }
  };
  const Param p = points("P", {0, 0, 0, 1, 0, 0, 2, 0, 0, 3, 0, 1});
  blames({}, "\"P\" is missing");
  blames({points("P", {0, 0, 0})}, "\"P\" has 1 points");
  blames({points("P", std::vector<float>(15, 1))}, "\"P\" has 5 points");
  blames({points("P", {0, 0, 0, 1, 0, 0, 2, 0, kInfinity, 3, 0, 1})}, "\"P\" is not finite");
  blames({p, integers("degree", {4})}, "\"degree\"");
  blames({p, text("basis", "catmull")}, "\"basis\"");
  blames({p, text("type", "round")}, "\"type\"");
  blames({p, number("width", -1)}, "\"width\"");
  blames({p, number("width", 0)}, "must not be 0 at both ends");
  blames({p, text("type", "ribbon")}, "\"N\" is missing");
  blames({p, text("type", "ribbon"), normals({0, 0, 1})}, "\"N\" has 1 entries for 2");
  blames({p, text("type", "ribbon"), normals({0, 0, 1, 0, 0, 0})}, "\"N\" is 0 at number 1");
  blames({p, text("type", "ribbon"), normals({0, 0, 1, 0, 0, -1})}, "turns by 180 degrees");
}

}  // namespace
}  // namespace pbrt
