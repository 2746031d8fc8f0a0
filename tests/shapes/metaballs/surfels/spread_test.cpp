// How surfels spread: evenness, coverage, shares, holes.

#include <gtest/gtest.h>

#include "shapes/metaballs/surfels/atom_field.h"
#include "shapes/metaballs/surfels/landing.h"
#include "shapes/metaballs/surfels/simulation.h"
#include "tests/shapes/metaballs/surfels/fields.h"

namespace pbrt::surfels::test {
namespace {

// The share of places on the surface that a disc of the same sheet covers.
double coverage(const Simulation& simulation, const MovingField& field) {
  std::vector<DPoint3> seeds(1000);
  std::vector<Landing> places(seeds.size());
  field.seeds(1U << 30U, seeds);
  for (std::size_t i = 0; i < seeds.size(); ++i) places[i].p = seeds[i];
  land(field, places);
  std::erase_if(places, [](const Landing& l) { return !l.there; });
  const auto covered = std::count_if(places.begin(), places.end(), [&](const Landing& l) {
    const auto surfels = simulation.surfels();
    return std::any_of(surfels.begin(), surfels.end(), [&](const Surfel& s) {
      return glm::length(s.p - l.p) <= s.radius && glm::dot(DVec3(s.n), l.gradient) < 0;
    });
  });
  return static_cast<double>(covered) / static_cast<double>(places.size());
}

// Steps until 99 % are covered; at most 100.
int stepsToCover(Simulation& simulation, const MovingField& field) {
  for (int i = 1; i < 100; ++i) {
    simulation.step(field, 0.01);
    if (coverage(simulation, field) >= 0.99) return i;
  }
  return 100;
}

double shareOfFirst(const Simulation& simulation, const Balls& balls) {
  std::size_t first = 0;
  for (const Surfel& s : simulation.surfels()) first += balls.nearest(s.p) == 0 ? 1 : 0;
  return static_cast<double>(first) / static_cast<double>(simulation.surfels().size());
}

TEST(Spread, IsEvenAtRestAndWithoutHoles) {
  const Balls ball({{{0, 0, 0}, 1}});
  // What a simulation of a fluid leaves, and a film.
  std::vector<metaballs::Atom> drop, film;
  Rng rng(1);
  for (int i = 0; i < 512; ++i) {
    const auto random = [&] { return 0.3F * (2 * rng.uniform() - 1); };
    const Vec3 jitter{random(), random(), random()};
    drop.push_back({Point3(i % 8, i / 8 % 8, i / 64) + jitter, 2, 0.3});
    film.push_back({Point3(i % 23, i / 23, 0), 2, 0.7});
  }
  AtomField fluid, sheet;
  fluid.set(metaballs::Kernel::wyvill, drop, {});
  sheet.set(metaballs::Kernel::wyvill, film, {});
  for (const MovingField* field :
       {static_cast<const MovingField*>(&ball), static_cast<const MovingField*>(&fluid),
        static_cast<const MovingField*>(&sheet)}) {
    Simulation simulation({.count = 6000});
    double last = 1;
    for (int i = 0; i < 60; ++i) {
      simulation.step(*field, 0.01);
      if (i % 20 != 19) continue;
      const auto& report = simulation.report();
      EXPECT_LT(report.evenness, 0.15);
      EXPECT_LT(report.evenness, last);
      last = report.evenness;
      EXPECT_EQ(report.holes, 0U);
      EXPECT_EQ(report.moved, 0U);
      EXPECT_EQ(coverage(simulation, *field), 1);
    }
  }
}

TEST(Spread, FromOneSideAllIsCoveredInFewSteps) {
  Simulation simulation({.count = 6000});
  simulation.step(Balls({{{0.9, 0, 0}, 0.1}}), 0);
  const Balls ball({{{0, 0, 0}, 1}});
  simulation.step(ball, 0);
  EXPECT_LE(stepsToCover(simulation, ball), 8);
  for (int i = 0; i < 60; ++i) simulation.step(ball, 0);
  EXPECT_LT(simulation.report().evenness, 0.15);
}

TEST(Spread, APieceThatSplitsOffIsCoveredInFewSteps) {
  Simulation simulation({.count = 6000});
  for (int i = 0; i < 30; ++i) simulation.step(Balls({{{0, 0, 0}, 1}}), 0.01);
  // One that holds no surfel, far away.
  const Balls both({{{0, 0, 0}, 1}, {{1e4, 0, 0}, 0.5}});
  EXPECT_LE(stepsToCover(simulation, both), 6);
  for (int i = 0; i < 40; ++i) simulation.step(both, 0.01);
  EXPECT_LT(simulation.report().evenness, 0.15);
  EXPECT_NEAR(1 - shareOfFirst(simulation, both), 0.2, 0.05 * 0.2);
}

// Surfels of which half are to be elsewhere, and back: dispersion goes on until densities agree.
TEST(Spread, DispersionEndsWithSharesByArea) {
  const Balls one({{{0, 0, 0}, 1}}), same({{{0, 0, 0}, 1}, {{1e4, 0, 0}, 1}});
  Simulation simulation({.count = 6000});
  for (int i = 0; i < 30; ++i) simulation.step(one, 0.01);
  for (int i = 0; i < 15; ++i) simulation.step(same, 0.01);
  EXPECT_NEAR(shareOfFirst(simulation, same), 0.5, 0.05 * 0.5);
  const Balls unlike({{{0, 0, 0}, 1}, {{1e4, 0, 0}, 0.5}});
  for (int i = 0; i < 15; ++i) simulation.step(unlike, 0.01);
  EXPECT_NEAR(shareOfFirst(simulation, unlike), 0.8, 0.05 * 0.2);
}

TEST(Spread, FarPiecesHaveSharesByArea) {
  const Balls balls({{{0, 0, 0}, 1}, {{-1e4, 3e3, 1e6}, 0.5}});
  Simulation simulation({.count = 6000});
  for (int i = 0; i < 40; ++i) simulation.step(balls, 0.01);
  EXPECT_NEAR(shareOfFirst(simulation, balls), 0.8, 0.01);
  EXPECT_LT(simulation.report().evenness, 0.12);
  EXPECT_EQ(coverage(simulation, balls), 1);
}

TEST(Spread, IsAsGoodFarFromTheOriginAndWhenSmall) {
  for (const DPoint3& c : {DPoint3(0), DPoint3(1e6, -1e6, 1e6)}) {
    const Balls ball({{c, 0.25}});
    Simulation simulation({.count = 3000});
    for (int i = 0; i < 40; ++i) simulation.step(ball, 0.01);
    EXPECT_LT(simulation.report().evenness, 0.06);
    EXPECT_EQ(coverage(simulation, ball), 1);
  }
}

// Neighbours on the other side of a film do not count: with them the sheets would share the
// distances of one.
TEST(Spread, SheetsDoNotSeeEachOther) {
  const auto reachOf = [](double gap) {
    // Two halves of a lens: a film about the plane z = 0, of nearly the same area for every gap.
    Simulation simulation({.count = 4000});
    const Balls ball({{{0, 0, 0}, 1}, {{0, 0, 0}, 1 - gap}});
    for (int i = 0; i < 30; ++i) simulation.step(ball, 0.01);
    return simulation.report().reach;
  };
  EXPECT_NEAR(reachOf(0.001), reachOf(0.5), 0.01 * reachOf(0.5));
}

// Surfels go with what turns and flies: in its own frame they stay where they were.
TEST(Spread, IsCarriedWithTheFluid) {
  const double angle = 0.05, dt = 0.1;
  const DVec3 velocity(3, 0, 0);
  Simulation simulation({.count = 2000});
  for (int i = 0; i < 150; ++i) simulation.step(Balls({{{0, 0, 0}, 1}}), dt);
  simulation.step(Balls({{{0, 0, 0}, 1, velocity, {0, 0, angle / dt}}}), 0);
  const std::vector<Surfel> before(simulation.surfels().begin(), simulation.surfels().end());
  const int steps = 20;
  for (int i = 1; i <= steps; ++i)
    simulation.step(Balls({{velocity * (dt * i), 1, velocity, {0, 0, angle / dt}}}), dt);
  const double c = std::cos(angle * steps), s = std::sin(angle * steps);
  double sum = 0;
  for (const Surfel& now : simulation.surfels()) {
    const DPoint3 x = now.p - velocity * (dt * steps);
    const DPoint3 back(c * x.x + s * x.y, c * x.y - s * x.x, x.z);
    double nearest = 1;
    for (const Surfel& then : before) nearest = std::min(nearest, glm::length(then.p - back));
    sum += nearest;
  }
  // Half the reach is between neighbours: by chance it would be a quarter of that and more.
  EXPECT_LT(sum / 2000, 0.02 * simulation.report().reach);
}

}  // namespace
}  // namespace pbrt::surfels::test
