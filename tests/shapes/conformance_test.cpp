// The laws of every shape: what core/api/shape.h promises, for each shape plug-in of the build.
// A new shape is tested with its defaults; a row of the table gives it better parameters.

#include <map>
#include <thread>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using test::integers;
using test::number;
using test::points;

struct Row {
  std::string label;
  ParamList params;
  bool convex = false;  // no ray that leaves outward meets it again
};

const std::map<std::string, std::vector<Row>> kTable = {
    {"sphere",
     {{"whole", {number("radius", 2)}, true},
      {"tiny", {number("radius", 1e-6F)}, true},
      {"huge", {number("radius", 1e6F)}, true},
      {"part", {number("zmin", -0.5F), number("zmax", 0.8F), number("phimax", 250)}}}},
    {"disk",
     {{"whole", {}, true},
      {"sector",
       {number("height", 3), number("radius", 2), number("innerradius", 0.5F),
        number("phimax", 100)},
       true}}},
    {"trianglemesh", {{"triangle", {points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0})}}}},
    {"loopsubdiv",
     {{"tetrahedron",
       {points("P", {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1}),
        integers("indices", {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2})}}}},
    {"nurbs",
     {{"saddle",
       {integers("nu", {2}), integers("nv", {2}), integers("uorder", {2}),
        integers("vorder", {2}), test::value(ParamType::number, "uknots", {0, 0, 1, 1}),
        test::value(ParamType::number, "vknots", {0, 0, 1, 1}),
        points("P", {0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 0})}}}},
    {"metaballs",
     {{"ball", {points("P", {1, 2, 3})}},
      {"bridge", {points("P", {0, 0, 0, 0.8F, 0, 0, 0.3F, 0.7F, 0})}}}},
};

struct Case {
  std::string shape;
  Row row;
};

std::vector<Case> allCases() {
  std::vector<Case> cases;
  for (const std::string& shape : test::loader().available(PluginKind::shape)) {
    const auto rows = kTable.find(shape);
    if (rows == kTable.end())
      cases.push_back({shape, {"defaults", {}}});
    else
      for (const Row& row : rows->second) cases.push_back({shape, row});
  }
  return cases;
}

struct Found {
  ShapeHit hit;
  std::uint32_t primitive = 0;
};

class Shapes : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    try {
      shape_ = test::make<Shape>(GetParam().shape, GetParam().row.params);
    } catch (const Error& error) {
      FAIL() << "give \"" << GetParam().shape << "\" parameters in the table: " << error.what();
    }
    for (std::uint32_t i = 0; i < shape_->primitives(); ++i)
      if (!shape_->bounds(i).empty()) box_.add(shape_->bounds(i));
    centre_ = DPoint3(box_.lo) * 0.5 + DPoint3(box_.hi) * 0.5;
    size_ = glm::length(DVec3(box_.hi) - DVec3(box_.lo)) / 2;
  }
  // Whether the laws of traced shapes apply.
  bool traced() const { return !shape_->triangles() && !box_.empty(); }

  DPoint3 around(double radii) {
    return centre_ + radii * size_ * DVec3(uniformSphere({rng_.uniform(), rng_.uniform()}));
  }
  DPoint3 inBox() {
    const DVec3 u(rng_.uniform(), rng_.uniform(), rng_.uniform());
    return DPoint3(box_.lo) + u * (DVec3(box_.hi) - DVec3(box_.lo));
  }
  // A ray that is likely to hit: from outside, sometimes from within.
  ObjectRay ray() {
    const DPoint3 o = rng_.uniform() < 0.8F ? around(1.01 + 4 * rng_.uniform()) : inBox();
    return {o, (inBox() - o) * (0.2 + 2 * rng_.uniform())};
  }

  std::optional<Found> nearest(const ObjectRay& ray) const {
    std::optional<Found> best;
    for (std::uint32_t i = 0; i < shape_->primitives(); ++i)
      if (const auto hit = shape_->intersect(ray, i); hit && (!best || hit->t < best->hit.t))
        best = Found{*hit, i};
    return best;
  }
  // All crossings along a ray, each once.
  template <class Visit>
  void crossings(ObjectRay ray, Visit visit) const {
    while (const auto found = nearest(ray)) {
      visit(shape_->surface(ray, found->hit));
      ray.tMin = std::nextafter(found->hit.t, kInfinity);
    }
  }
  // Calls visit(ray, found, point) for `count` hits.
  template <class Visit>
  void forHits(int count, Visit visit) {
    int hits = 0;
    for (int tries = 0; hits < count && tries < 100 * count; ++tries) {
      const ObjectRay r = ray();
      const auto found = nearest(r);
      if (!found) continue;
      ++hits;
      visit(r, *found, shape_->surface(r, found->hit));
      if (HasFatalFailure()) return;
    }
    EXPECT_EQ(hits, count) << "the shape is hardly ever hit within its bounds";
  }

  std::unique_ptr<Shape> shape_;
  Bounds3 box_;
  DPoint3 centre_{0};
  double size_ = 0;
  Rng rng_{7};
};

TEST_P(Shapes, HitsLieWithinBoundsAndOnTheRay) {
  if (!traced()) GTEST_SKIP();
  forHits(5000, [&](const ObjectRay& r, const Found& f, const SurfacePoint& s) {
    EXPECT_EQ(f.hit.primitive, f.primitive);
    EXPECT_GT(f.hit.t, 0);
    const Bounds3 b = shape_->bounds(f.primitive);
    const double slack = s.error + 1e-9 * size_;
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(s.p[i], b.lo[i] - slack);
      EXPECT_LE(s.p[i], b.hi[i] + slack);
    }
    const DVec3 d = glm::normalize(r.d);
    const double cosine = std::max(1e-3, std::abs(glm::dot(d, DVec3(s.n))));
    const double rounding = 0x1p-23 * f.hit.t * glm::length(r.d);  // of t to float
    EXPECT_LE(glm::length(s.p - r.at(f.hit.t)), rounding + (s.error + 1e-9 * size_) / cosine);
  });
}

TEST_P(Shapes, PointsLieOnTheSurfaceWithinTheirError) {
  if (!traced()) GTEST_SKIP();
  int lost = 0;
  const int count = 5000;
  forHits(count, [&](const ObjectRay& r, const Found& f, const SurfacePoint& s) {
    EXPECT_GE(s.error, 0);
    EXPECT_LE(s.error, 1e-5 * size_);
    // Along the normal, from h away: the surface is h away, give or take the error and rounding.
    const double h = std::max(64 * s.error, 1e-5 * size_);
    const DVec3 n(s.n);
    const double slack = s.error + 1e-6 * h + 1e-15 * glm::length(s.p);
    const ObjectRay probe{s.p + h * n, -n, h - slack, h + slack};
    lost += nearest(probe) ? 0 : 1;
    // From a little before the hit: the same hit.
    ObjectRay late = r;
    late.tMin = 0.999 * f.hit.t;
    const auto again = nearest(late);
    ASSERT_TRUE(again);
    EXPECT_NEAR(again->hit.t, f.hit.t, 1e-6 * f.hit.t);
  });
  EXPECT_LE(lost, count / 1000) << "points that are off the surface by more than they say";
}

TEST_P(Shapes, FramesAreConsistent) {
  if (!traced()) GTEST_SKIP();
  forHits(5000, [&](const ObjectRay&, const Found&, const SurfacePoint& s) {
    EXPECT_NEAR(glm::length(s.n), 1, 1e-5);
    if (s.ns != Normal3(0)) {
      EXPECT_NEAR(glm::length(s.ns), 1, 1e-5);
      EXPECT_GT(glm::dot(s.n, s.ns), 0);
    }
    for (const Vec3& t : {s.dpdu, s.dpdv, s.dndu, s.dndv}) {
      ASSERT_TRUE(isFinite(t));
      EXPECT_LE(std::abs(glm::dot(t, s.n)), 1e-4F * glm::length(t));
    }
    EXPECT_GE(std::min(s.uv.x, s.uv.y), -1e-6F);
    EXPECT_LE(std::max(s.uv.x, s.uv.y), 1 + 1e-6F);
  });
}

// p and n at a neighbouring point are what the derivatives foretell, but for seams and poles.
TEST_P(Shapes, DerivativesForetellTheNeighbourhood) {
  if (!traced()) GTEST_SKIP();
  int tested = 0, wrong = 0;
  forHits(5000, [&](const ObjectRay& r, const Found&, const SurfacePoint& s) {
    if (std::abs(glm::dot(glm::normalize(r.d), DVec3(s.n))) < 0.3) return;
    const double step = 1e-3 * size_;
    ObjectRay aside = r;
    aside.o += step * DVec3(uniformSphere({rng_.uniform(), rng_.uniform()}));
    const auto found = nearest(aside);
    if (!found) return;
    const SurfacePoint q = shape_->surface(aside, found->hit);
    const Vec3 moved = q.p - s.p;
    const Vec2 d = q.uv - s.uv;
    if (glm::length(moved) > 10 * step || glm::length(moved) < 0.1 * step) return;
    ++tested;
    const Vec3 foretold = d.x * s.dpdu + d.y * s.dpdv;
    const Vec3 turned = q.n - s.n, foretoldTurn = d.x * s.dndu + d.y * s.dndv;
    if (glm::length(foretold - moved) > 0.05F * glm::length(moved) ||
        glm::length(foretoldTurn - turned) > 0.1F * glm::length(turned) + 1e-5F)
      ++wrong;
  });
  EXPECT_GT(tested, 1000);
  EXPECT_LE(wrong, tested / 10);
}

// Rays that leave a point, off by no more than its error, do not meet the surface they leave.
TEST_P(Shapes, RaysLeaveTheSurface) {
  if (!traced()) GTEST_SKIP();
  int stuck = 0;
  const int count = 5000;
  forHits(count, [&](const ObjectRay&, const Found&, const SurfacePoint& s) {
    const DVec3 n(s.n);
    for (const double side : {1.0, -1.0}) {
      DVec3 w(uniformSphere({rng_.uniform(), rng_.uniform()}));
      const double cosine = glm::dot(w, n);
      if (cosine * side < 0) w -= 2 * cosine * n;
      const auto found = nearest({s.p + side * s.error * n, w});
      if (!found) continue;
      if (side > 0) EXPECT_FALSE(GetParam().row.convex) << "at t = " << found->hit.t;
      // From inside or over a hollow the way to the surface grows with the cosine.
      if (found->hit.t < 100 * s.error + 1e-9 * size_) ++stuck;
    }
  });
  EXPECT_LE(stuck, count / 1000);
}

TEST_P(Shapes, ShadowRaysAgreeAndTheRangeOfTIsKept) {
  if (!traced()) GTEST_SKIP();
  for (int i = 0; i < 5000; ++i) {
    const ObjectRay r = ray();
    for (std::uint32_t k = 0; k < shape_->primitives(); ++k) {
      const auto hit = shape_->intersect(r, k);
      EXPECT_EQ(shape_->occluded(r, k), hit.has_value());
      if (!hit) continue;
      ObjectRay cut = r;
      cut.tMax = 0.9999F * hit->t;
      EXPECT_FALSE(shape_->intersect(cut, k));
      EXPECT_FALSE(shape_->occluded(cut, k));
      cut.tMax = 1.0001F * hit->t;
      EXPECT_TRUE(shape_->intersect(cut, k));
      cut = r;
      cut.tMin = 1.0001F * hit->t;
      if (const auto later = shape_->intersect(cut, k)) EXPECT_GT(later->t, cut.tMin);
    }
  }
}

TEST_P(Shapes, ThreadsSeeTheSame) {
  if (!traced()) GTEST_SKIP();
  std::vector<ObjectRay> rays(1000);
  for (ObjectRay& r : rays) r = ray();
  const auto trace = [&] {
    std::uint64_t sum = 0;
    for (const ObjectRay& r : rays)
      if (const auto f = nearest(r)) {
        const SurfacePoint s = shape_->surface(r, f->hit);
        sum = hash(sum, std::bit_cast<std::uint32_t>(f->hit.t), f->primitive,
                   std::bit_cast<std::uint64_t>(s.p.x), std::bit_cast<std::uint32_t>(s.n.y));
      }
    return sum;
  };
  const std::uint64_t expected = trace();
  std::vector<std::uint64_t> sums(8);
  std::vector<std::thread> threads;
  for (std::uint64_t& sum : sums) threads.emplace_back([&] { sum = trace(); });
  for (std::thread& t : threads) t.join();
  for (const std::uint64_t sum : sums) EXPECT_EQ(sum, expected);
}
