#include "shapes/metaballs/surfels/draw.h"

#include <gtest/gtest.h>

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

TEST(Draw, NothingIsSeenOfNothing) {
  const std::vector<Surfel> some = ball(100);
  Discs(some, {}).draw(Beam(), {});
  Discs(some, {}).draw(Beam({}, 0), {});
  const Ray towards{{0, 0, 3}, 0, {0, 0, -1}};
  EXPECT_LT(seenBy(towards, some).t, kInfinity);
  EXPECT_EQ(seenBy(towards, {}).t, kInfinity);
  Fragment f;
  Discs().draw(Beam({&towards, 1}, 1), {&f, 1});
  EXPECT_EQ(f.t, kInfinity);

  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const Ray nonsense[] = {{{0, 0, 3}, 0, {0, 0, 0}},          {{0, 0, 3}, 0, {0, nan, -1}},
                          {{nan, 0, 3}, 0, {0, 0, -1}},       {{0, 0, kInfinity}, 0, {0, 0, -1}},
                          {{0, 0, 3}, 0, {0, 0, -kInfinity}}, {{0, 0, 3}, nan, {0, 0, -1}},
                          {{0, 0, 3}, 0, {0, 0, -1}, nan},    {{0, 0, 3}, 5, {0, 0, -1}, 1}};
  std::vector<Ray> rays;
  for (const Ray& ray : nonsense) rays.insert(rays.end(), {ray, towards});
  std::vector<Fragment> seen(rays.size());
  Discs(some, {}).draw(Beam(rays, 4), seen);
  for (std::size_t i = 0; i < rays.size(); ++i)
    EXPECT_EQ(seen[i].t < kInfinity, i % 2 == 1) << "the others are not disturbed: " << i;
}

TEST(Draw, SurfelsThatAreNoDiscsAreLeftOut) {
  constexpr float nan = std::numeric_limits<float>::quiet_NaN();
  const std::vector<Surfel> sound = ball(1000);
  std::vector<Surfel> mixed;
  for (std::size_t i = 0; i < sound.size(); ++i) {
    Surfel wrong = sound[(i * 7) % sound.size()];
    wrong.n = {0, 1, 0};  // would be seen
    switch (i % 7) {
      case 0:
        wrong.radius = 0;
        break;
      case 1:
        wrong.radius = nan;
        break;
      case 2:
        wrong.radius = -1;
        break;
      case 3:
        wrong.radius = kInfinity;
        break;
      case 4:
        wrong.p.y = std::numeric_limits<double>::quiet_NaN();
        break;
      case 5:
        wrong.n.z = nan;
        break;
      case 6:
        wrong.bend[i % 6] = i % 2 ? nan : kInfinity;
        break;
    }
    mixed.insert(mixed.end(), {wrong, sound[i]});
  }
  const Picture one = draw(Discs(sound, {}), pinhole({1, 2, 3}), 64, 64, 32);
  const Picture other = draw(Discs(mixed, {}), pinhole({1, 2, 3}), 64, 64, 32);
  for (std::size_t i = 0; i < one.seen.size(); ++i) {
    EXPECT_EQ(one.seen[i].t, other.seen[i].t);
    EXPECT_EQ(one.seen[i].n, other.seen[i].n);
    if (one.seen[i].t < kInfinity) {
      EXPECT_EQ(2 * one.seen[i].surfel + 1, other.seen[i].surfel);
    }
  }
}

TEST(Draw, DiscsAreSetAnewWithNothingLeftOfTheOld) {
  Discs discs(ball(5000), {});
  for (const std::size_t n : {0U, 1U, 40U, 3000U, 7U}) {
    const std::vector<Surfel> surfels = ball(n);
    discs.set(surfels, {});
    const Picture again = draw(discs, pinhole({1, 2, 3}), 48, 48, 32);
    const Picture fresh = draw(Discs(surfels, {}), pinhole({1, 2, 3}), 48, 48, 32);
    for (std::size_t i = 0; i < again.seen.size(); ++i) {
      EXPECT_EQ(again.seen[i].t, fresh.seen[i].t);
      EXPECT_EQ(again.seen[i].surfel, fresh.seen[i].surfel);
    }
  }
}

template <class T>
bool sameBits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof a) == 0;
}

TEST(DrawLoops, AllInstructionSetsGiveTheSameBits) {
  Random random(8);
  const auto fill = [&](Floats& lanes, double lo, double hi) {
    for (int i = 0; i < kLanes; ++i) lanes[i] = static_cast<float>(random.in(lo, hi));
  };
  std::vector<Balls> balls(500);
  for (Balls& b : balls) {
    for (Floats* lanes : {&b.x, &b.y, &b.z, &b.nx, &b.ny, &b.nz}) fill(*lanes, -1, 1);
    fill(b.radius, 0, 0.2), fill(b.turn, 0, 0.5);
  }
  std::vector<Disc> discs(200);
  std::vector<std::uint32_t> list(discs.size());
  for (std::uint32_t i = 0; i < discs.size(); ++i) {
    discs[i] = {Point3(0.3 * random.cube()), Normal3(random.direction())};
    for (float& b : discs[i].bend) b = static_cast<float>(random.in(-1, 1));
    const double radius = random.in(0.05, 0.4);
    discs[i].rim2 = static_cast<float>(0.999 * sqr(radius));
    discs[i].inverse2 = static_cast<float>(1 / sqr(radius));
    list[i] = i;
  }
  std::size_t met = 0, seen = 0;
  for (int trial = 0; trial < 300; ++trial) {
    const DVec3 axis = random.direction();
    const double angle = random.in(0, 1);
    const Bound bound{Point3(random.cube()),
                      static_cast<float>(random.in(0, 0.1)),
                      Vec3(axis),
                      static_cast<float>(std::cos(angle)),
                      static_cast<float>(std::sin(angle)),
                      static_cast<float>(2 * std::sin(angle / 2))};
    Rays rays;
    for (int i = 0; i < kLanes; ++i) {
      const DVec3 d = random.direction();
      const DPoint3 o = random.cube() - 2.0 * d;
      rays.ox[i] = static_cast<float>(o.x), rays.oy[i] = static_cast<float>(o.y);
      rays.oz[i] = static_cast<float>(o.z), rays.dx[i] = static_cast<float>(d.x);
      rays.dy[i] = static_cast<float>(d.y), rays.dz[i] = static_cast<float>(d.z);
      rays.tMax[i] = i % 3 ? kInfinity : 2;
    }
    std::vector<std::uint32_t> expected(balls.size() * kLanes);
    Seen expectedSeen{};
    bool first = true;
    for (const DrawLoops* loops : allDrawLoops()) {
      std::vector<std::uint32_t> out(balls.size() * kLanes), near(list.size());
      out.resize(loops->narrow(bound, balls, out.data()));
      Seen own{};
      loops->look(rays, discs.data(), list, near.data(), own);
      if (first) expected = out, expectedSeen = own, met += out.size();
      EXPECT_EQ(out, expected);
      EXPECT_TRUE(sameBits(own.t, expectedSeen.t));
      for (int i = 0; i < kLanes; ++i) {
        if (!(own.t[i] < kInfinity)) continue;
        seen += first;
        EXPECT_TRUE(sameBits(own.nx[i], expectedSeen.nx[i]));
        EXPECT_TRUE(sameBits(own.ny[i], expectedSeen.ny[i]));
        EXPECT_TRUE(sameBits(own.nz[i], expectedSeen.nz[i]));
        EXPECT_EQ(own.surfel[i], expectedSeen.surfel[i]);
      }
      first = false;
    }
  }
  EXPECT_GT(met, 10000U);
  EXPECT_GT(seen, 300U);
}

}  // namespace
}  // namespace pbrt::surfels
