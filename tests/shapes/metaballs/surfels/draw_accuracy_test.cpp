// How true the drawn surfaces are: balls, discs seen from all sides, sheets.

#include <gtest/gtest.h>

#include "shapes/metaballs/surfels/draw.h"
#include "tests/shapes/metaballs/surfels/drawn.h"

namespace pbrt::surfels {
namespace {

using namespace test;

// Errors of a ball's distances (in radii of the ball) and normals (radians), and of its silhouette.
struct Errors {
  double distance = 0, normal = 0;  // root of the mean square, where the cosine is above 0.1
  double lost = 0, gained = 0;      // greatest distance from the silhouette, inside and outside
};
Errors errorsOfBall(std::size_t n, bool bent) {
  const Picture picture = draw(Discs(ball(n, {}, 1, bent), {}), parallel(1.05), 401, 401, 32);
  Errors e;
  int hits = 0;
  for (std::size_t i = 0; i < picture.rays.size(); ++i) {
    const DPoint3 o(picture.rays[i].o);
    const double off2 = o.x * o.x + o.y * o.y, off = std::sqrt(off2);
    const Fragment& f = picture.seen[i];
    if (f.t == kInfinity && off < 1) e.lost = std::max(e.lost, 1 - off);
    if (f.t < kInfinity && off > 1) e.gained = std::max(e.gained, off - 1);
    if (f.t == kInfinity || off2 > 0.99) continue;
    const DVec3 m{o.x, o.y, std::sqrt(1 - off2)};
    ++hits;
    e.distance += sqr(3 - static_cast<double>(f.t) - m.z);
    e.normal += lengthSquared(DVec3(f.n) - m);
  }
  e.distance = std::sqrt(e.distance / hits), e.normal = std::sqrt(e.normal / hits);
  return e;
}

// Four times the discs are half as wide. Tangent discs are off by second order in distance, by
// first order in direction; bent ones by two orders less (on a ball, whose third-order terms are
// zero). A pixel is 0.005 wide.
TEST(DrawAccuracy, BendMakesDiscsOfHigherOrder) {
  for (const std::size_t n : {256U, 1024U}) {
    const Errors flat = errorsOfBall(n, false), flat4 = errorsOfBall(4 * n, false);
    const Errors bent = errorsOfBall(n, true), bent4 = errorsOfBall(4 * n, true);
    EXPECT_NEAR(flat.distance / flat4.distance, 4, 0.5);
    EXPECT_NEAR(flat.normal / flat4.normal, 2, 0.5);
    EXPECT_NEAR(bent.distance / bent4.distance, 16, 2);
    EXPECT_NEAR(bent.normal / bent4.normal, 8, 4);
  }
  const Errors few = errorsOfBall(256, true), many = errorsOfBall(4096, true);
  EXPECT_LT(few.distance, 1e-4);
  EXPECT_LT(few.normal, 1e-3);
  EXPECT_LT(many.distance, 1e-6);
  EXPECT_LT(many.normal, 1e-5);
}

// (sqrt(1 + r^2) - 1 is how far a tangent disc reaches over the silhouette.)
TEST(DrawAccuracy, ABallHasNoHolesAndItsSilhouetteIsSharp) {
  for (const std::size_t n : {64U, 256U, 4096U}) {
    const double r = coveringRadius(n);
    const Errors flat = errorsOfBall(n, false), bent = errorsOfBall(n, true);
    EXPECT_EQ(flat.lost, 0);
    EXPECT_EQ(bent.lost, 0);
    EXPECT_LT(flat.gained, r * r / 2);
    EXPECT_LT(bent.gained, r * r * r / 20);
  }
}

Surfel disc(const DPoint3& p, const Normal3& n, float radius) {
  Surfel s;
  s.p = p, s.n = n, s.radius = radius;
  return s;
}
TEST(DrawAccuracy, ADiscIsSeenWithinItsRadiusFromTheFront) {
  const Surfel one[] = {disc({0, 0, 1}, {0, 0, 1}, 0.5F)};
  for (const float scale : {1.F, 1e-10F, 1e10F}) {
    const Vec3 down{0, 0, -scale};
    const Fragment f = seenBy({{0.3F, 0.2F, 3}, 0, down}, one);
    EXPECT_NEAR(f.t * scale, 2, 1e-6);
    EXPECT_NEAR(glm::distance(f.n, {0, 0, 1}), 0, 1e-6);
    EXPECT_EQ(seenBy({{0.4F, 0.4F, 3}, 0, down}, one).t, kInfinity);
    EXPECT_EQ(seenBy({{0, 0, 0}, 0, -down}, one).t, kInfinity) << "from behind";
    EXPECT_EQ(seenBy({{0, 0, 3}, 0, -down}, one).t, kInfinity) << "away from it";
    EXPECT_EQ(seenBy({{0, 0, 3}, 2.1F / scale, down}, one).t, kInfinity) << "tMin";
    EXPECT_EQ(seenBy({{0, 0, 3}, 0, down, 1.9F / scale}, one).t, kInfinity) << "tMax";
    EXPECT_LT(seenBy({{0, 0, 3}, 1.9F / scale, down, 2.1F / scale}, one).t, kInfinity);
  }
}

TEST(DrawAccuracy, ADiscSeenEdgeOnIsNotThere) {
  const Surfel one[] = {disc({0, 0, 0}, {0, 0, 1}, 1)};
  for (const float z : {0.F, 1e-9F, -1e-9F, 0.1F})
    EXPECT_EQ(seenBy({{-3, 0, z}, 0, {1, 0, 0}}, one).t, kInfinity);
  // A hair above the edge it is, and the answer is finite.
  for (const float slope : {0.01F, 0.1F}) {
    const Fragment f = seenBy({{-3, 0, 3 * slope}, 0, {1, 0, -slope}}, one);
    EXPECT_NEAR(f.t, 3, 1e-4);
    EXPECT_NEAR(f.n.z, 1, 1e-6);
  }
}

// A lattice of discs in the plane of a height.
void addSheet(std::vector<Surfel>& surfels, double z, float facing) {
  for (int x = -20; x <= 20; ++x)
    for (int y = -20; y <= 20; ++y)
      surfels.push_back(disc({0.1 * x, 0.1 * y, z}, {0, 0, facing}, 0.1F));
}
TEST(DrawAccuracy, SheetsCloseTogetherDoNotMix) {
  std::vector<Surfel> surfels;
  addSheet(surfels, 0, 1);  // a film, far thinner than the discs are wide,
  addSheet(surfels, -0.002, -1);
  addSheet(surfels, -0.06, 1);  // and another drop half a disc behind
  for (const Camera& camera : {parallel(1), pinhole({2, 0, 2}, 2), pinhole({5, 1, 1}, 5)}) {
    const Picture picture = draw(Discs(surfels, {}), camera, 64, 64, 32);
    int hits = 0;
    for (std::size_t i = 0; i < picture.rays.size(); ++i) {
      const Point3 p = picture.rays[i].at(picture.seen[i].t);
      if (!(std::max(std::abs(p.x), std::abs(p.y)) < 1.9F)) continue;
      ++hits;
      EXPECT_NEAR(p.z, 0, 1e-5);
      EXPECT_NEAR(picture.seen[i].n.z, 1, 1e-6);
      EXPECT_LT(picture.seen[i].surfel, 1681U);
    }
    EXPECT_GT(hits, 1000);
  }
}

}  // namespace
}  // namespace pbrt::surfels
