// The laws of every shape: what core/api/shape.h promises, for each shape plug-in of the build.

#include "tests/shapes/conformance.h"

#include <bit>
#include <thread>

namespace pbrt {
namespace {

using test::Found;

class Traced : public test::Shapes {};  // asked ray by ray
class Meshes : public test::Shapes {};  // handed over as triangles

TEST_P(Traced, HitsLieWithinBoundsAndOnTheRay) {
  forHits(5000, [&](const ObjectRay& r, const Found& f, const SurfacePoint& s) {
    EXPECT_EQ(f.hit.primitive, f.primitive);
    EXPECT_GT(f.hit.t, 0);
    const Bounds3 b = shape_->bounds(f.primitive);
    const bool facing = GetParam().row.facingWidth > 0;  // there this ray saw it, but for rounding
    const double slack = (facing ? 0 : s.error) + 1e-9 * size_;
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(s.p[i], b.lo[i] - slack);
      EXPECT_LE(s.p[i], b.hi[i] + slack);
    }
    const DVec3 d = glm::normalize(r.d);
    const double cosine = std::max(1e-3, std::abs(glm::dot(d, DVec3(s.n))));
    const double rounding = 0x1p-23 * f.hit.t * glm::length(r.d);  // of t to float
    EXPECT_LE(glm::length(s.p - r.at(f.hit.t)), rounding + slack / cosine);
  });
}

TEST_P(Traced, PointsLieOnTheSurfaceWithinTheirError) {
  int lost = 0;
  const int count = 5000;
  forHits(count, [&](const ObjectRay& r, const Found& f, const SurfacePoint& s) {
    EXPECT_GE(s.error, 0);
    EXPECT_LE(s.error, GetParam().row.facingWidth + 1e-5 * size_);
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

TEST_P(Traced, FramesAreConsistent) {
  forHits(5000, [&](const ObjectRay&, const Found&, const SurfacePoint& s) {
    EXPECT_NEAR(glm::length(s.n), 1, 1e-5);
    if (s.ns != Normal3(0)) {
      EXPECT_NEAR(glm::length(s.ns), 1, 1e-5);
      EXPECT_GT(glm::dot(s.n, s.ns), 0);
    }
    for (const Vec3& t : {s.dpdu, s.dpdv, s.dndu, s.dndv}) {
      ASSERT_TRUE(isFinite(t));
      EXPECT_LE(std::abs(glm::dot(t, s.n)), 1e-4F * glm::length(t) + 1e-30F);
    }
    EXPECT_GE(std::min(s.uv.x, s.uv.y), -1e-6F);
    EXPECT_LE(std::max(s.uv.x, s.uv.y), 1 + 1e-6F);
  });
}

// p and n at a neighbouring point are what the derivatives foretell, but for seams and poles.
TEST_P(Traced, DerivativesForetellTheNeighbourhood) {
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
    const bool flat = !GetParam().row.looksRound;
    if ((flat && glm::length(foretold - moved) > 0.05F * glm::length(moved)) ||
        glm::length(foretoldTurn - turned) > 0.1F * glm::length(turned) + 1e-5F)
      ++wrong;
  });
  EXPECT_GT(tested, 1000);
  EXPECT_LE(wrong, tested / 10);
}

// Rays that leave a point, off by no more than its error, do not meet the surface they leave.
TEST_P(Traced, RaysLeaveTheSurface) {
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
      EXPECT_FALSE(side > 0 && GetParam().row.convex) << "at t = " << found->hit.t;
      // From inside or over a hollow the way to the surface grows with the cosine; what faces all
      // rays is left by far already.
      const double far = (GetParam().row.facingWidth > 0 ? 0.01 : 100) * s.error;
      if (found->hit.t < far + 1e-9 * size_) ++stuck;
    }
  });
  EXPECT_LE(stuck, count / 1000);
}

TEST_P(Traced, ShadowRaysAgreeAndTheRangeOfTIsKept) {
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
      const auto later = shape_->intersect(cut, k);
      EXPECT_TRUE(!later || later->t > cut.tMin);
    }
  }
}

TEST_P(Traced, ThreadsSeeTheSame) {
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

TEST_P(Meshes, AreSound) {
  const TriangleMesh* mesh = shape_->triangles();
  const std::size_t n = mesh->positions.size();
  ASSERT_EQ(mesh->indices.size() % 3, 0U);
  ASSERT_GT(mesh->triangles(), 0U);
  for (const std::uint32_t i : mesh->indices) ASSERT_LT(i, n);
  EXPECT_TRUE(mesh->normals.empty() || mesh->normals.size() == n);
  EXPECT_TRUE(mesh->tangents.empty() || mesh->tangents.size() == n);
  EXPECT_TRUE(mesh->uv.empty() || mesh->uv.size() == n);
  for (const Point3& p : mesh->positions) EXPECT_TRUE(isFinite(p));
  for (const Normal3& m : mesh->normals) EXPECT_TRUE(isFinite(m));
  for (const Vec3& t : mesh->tangents) EXPECT_TRUE(isFinite(t));
  for (const Point2& uv : mesh->uv) EXPECT_TRUE(std::isfinite(uv.x) && std::isfinite(uv.y));
  if (mesh->normals.empty()) return;
  // Normals lie on the side from which the triangles run counter-clockwise.
  std::size_t against = 0;
  for (std::size_t i = 0; i < mesh->indices.size(); ++i) {
    const std::uint32_t* t = &mesh->indices[i - i % 3];
    const Point3 a = mesh->positions[t[0]], b = mesh->positions[t[1]], c = mesh->positions[t[2]];
    const Vec3 facet = glm::cross(b - a, c - a);
    const bool agrees = glm::dot(facet, mesh->normals[mesh->indices[i]]) > 0;
    against += lengthSquared(facet) > 0 && !agrees ? 1 : 0;
  }
  EXPECT_LE(against, mesh->indices.size() / 100);
}

TEST(Shapes, DescribeTheirParameters) {
  for (const std::string& name : test::loader().available(PluginKind::shape)) {
    std::vector<Declaration> declarations;
    Params params = Params::describing(name, declarations);
    EXPECT_NO_THROW(create<Shape>(test::loader().open(PluginKind::shape, name), params, {}));
    EXPECT_FALSE(declarations.empty()) << name;
    for (const Declaration& d : declarations) EXPECT_FALSE(d.meaning.empty()) << d.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Every, Traced, testing::ValuesIn(test::casesWhere([](Shape& s) {
                           return !s.triangles();
                         })),
                         test::caseName);
INSTANTIATE_TEST_SUITE_P(Every, Meshes, testing::ValuesIn(test::casesWhere([](Shape& s) {
                           return s.triangles();
                         })),
                         test::caseName);

}  // namespace
}  // namespace pbrt
