#include "shapes/metaballs/surfels/draw.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "tests/shapes/metaballs/surfels/drawn.h"

namespace pbrt::surfels {
namespace {

using namespace test;

// What is drawn is what the reference sees, where rounding does not decide.
void expectAsInDouble(std::span<const Surfel> surfels, const Camera& camera, int block,
                      const DPoint3& origin = {}) {
  const Discs discs(surfels, origin);
  const Picture picture = draw(discs, camera, 61, 43, block);
  int hits = 0, certain = 0;
  for (std::size_t i = 0; i < picture.rays.size(); ++i) {
    const Sight sight = see(picture.rays[i], surfels, origin);
    if (!sight.certain) continue;
    ++certain;
    const Fragment& f = picture.seen[i];
    ASSERT_EQ(std::isfinite(sight.t), f.t < kInfinity)
        << "ray " << i << " t " << sight.t << " " << f.t;
    if (!std::isfinite(sight.t)) continue;
    ++hits;
    const double length = glm::length(DVec3(picture.rays[i].d));
    EXPECT_NEAR(f.t * length, sight.t * length, 0.002 * sight.radius) << "ray " << i;
    EXPECT_LT(glm::distance(DVec3(f.n), sight.n), 0.002) << "ray " << i;
    EXPECT_NEAR(glm::length(f.n), 1, 1e-6);
    if (sight.lead > 0.01) {
      EXPECT_EQ(f.surfel, sight.surfel);
    }
  }
  EXPECT_GT(hits, 100);
  EXPECT_GT(certain, 1900);  // of 2623
}

TEST(Draw, SeesWhatTheReferenceSees) {
  const Camera cameras[] = {pinhole({1, 2, 3}),
                            pinhole({30, 10, 5}, 24),
                            pinhole({0.2, 0.1, 0.1}),
                            parallel(1.3),
                            surroundings({1.5, 0, 0}),
                            surroundings({0.1, 0.3, 0}),
                            lens(0.05),
                            lens(1.5),
                            any()};
  for (std::size_t i = 0; i < std::size(cameras); ++i)
    for (const int block : {8, 32, 100}) {
      SCOPED_TRACE("camera " + std::to_string(i) + ", blocks of " + std::to_string(block));
      expectAsInDouble(confetti(700, 5), cameras[i], block);
      if (i != 2 && i != 5) expectAsInDouble(ball(500), cameras[i], block);
    }
}

TEST(Draw, PlacesAreFromTheOriginOfTheRays) {
  const DPoint3 origin{1e6, -2e6, 3e6};
  std::vector<Surfel> surfels = ball(500);
  for (Surfel& s : surfels) s.p += origin;
  expectAsInDouble(surfels, pinhole({1, 2, 3}), 32, origin);
}

TEST(Draw, PowersOfTwoOfScaleChangeNoBit) {
  const Picture once = draw(Discs(confetti(2000, 6), {}), pinhole({1, 2, 3}), 48, 48, 16);
  for (const int exponent : {-20, 20}) {
    const double scale = std::ldexp(1.0, exponent);
    std::vector<Surfel> surfels = confetti(2000, 6);
    for (Surfel& s : surfels) {
      s.p *= scale;
      s.radius *= static_cast<float>(scale);
      for (float& b : s.bend) b /= static_cast<float>(scale);
    }
    const Camera camera = [&](double x, double y, Random& random) {
      Ray ray = pinhole({1, 2, 3})(x, y, random);
      ray.o *= static_cast<float>(scale);
      return ray;
    };
    const Picture scaled = draw(Discs(surfels, {}), camera, 48, 48, 16);
    for (std::size_t i = 0; i < once.seen.size(); ++i) {
      EXPECT_EQ(once.seen[i].t * static_cast<float>(scale), scaled.seen[i].t);
      EXPECT_EQ(once.seen[i].n, scaled.seen[i].n);
      EXPECT_EQ(once.seen[i].surfel, scaled.seen[i].surfel);
    }
  }
}

TEST(Draw, BlocksAndTheOrderOfSurfelsDoNotMatter) {
  const std::vector<Surfel> surfels = ball(3000);
  std::vector<std::size_t> order(surfels.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  Random random(3);
  for (std::size_t i = order.size(); i > 1; --i) std::swap(order[i - 1], order[random.below(i)]);
  std::vector<Surfel> shuffled;
  for (const std::size_t i : order) shuffled.push_back(surfels[i]);
  const Picture one = draw(Discs(surfels, {}), pinhole({1, 2, 3}), 96, 80, 32);
  const Picture whole = draw(Discs(surfels, {}), pinhole({1, 2, 3}), 96, 80, 96);
  const Picture other = draw(Discs(shuffled, {}), pinhole({1, 2, 3}), 96, 80, 32);
  for (std::size_t i = 0; i < one.seen.size(); ++i) {
    EXPECT_EQ(one.seen[i].t, whole.seen[i].t);
    EXPECT_EQ(one.seen[i].n, whole.seen[i].n);
    EXPECT_EQ(one.seen[i].surfel, whole.seen[i].surfel);
    if (one.seen[i].t == kInfinity) {
      EXPECT_EQ(other.seen[i].t, kInfinity);
      continue;
    }
    EXPECT_NEAR(other.seen[i].t / one.seen[i].t, 1, 1e-5);
    EXPECT_LT(glm::distance(one.seen[i].n, other.seen[i].n), 1e-5F);
    EXPECT_EQ(order[other.seen[i].surfel], one.seen[i].surfel);
  }
}

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
  std::printf("%6zu %s: r %.4f distance %.2e normal %.2e lost %.2e gained %.2e\n", n,
              bent ? "bent" : "flat", coveringRadius(n), e.distance, e.normal, e.lost, e.gained);
  return e;
}

TEST(Draw, ErrorsOfABall) {
  for (const bool bent : {false, true})
    for (const std::size_t n : {256U, 1024U, 4096U, 16384U}) errorsOfBall(n, bent);
}

}  // namespace
}  // namespace pbrt::surfels
