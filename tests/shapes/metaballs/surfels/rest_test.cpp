// What surfels must reach on fluids: an even cover without holes at rest, nearly all of the surface
// soon after a bad start and after a split, and never off the surface.

#include <gtest/gtest.h>

#include <numeric>

#include "core/base/parallel.h"
#include "shapes/metaballs/surfels/atom_field.h"
#include "tests/shapes/metaballs/surfels/uniform_places.h"

namespace pbrt::surfels::test {
namespace {

using metaballs::Atom;
using metaballs::Kernel;

constexpr double kFrame = 1.0 / 60;

// About as many atoms as a glass of water in a simulation has: a block of them on a jittered grid
// of spacing 1 with a support of 2 and a threshold of half the interior density.
std::vector<Atom> water(int x, int y, int z) {
  Rng rng(7);
  std::vector<Atom> atoms;
  for (int i = 0; i < x * y * z; ++i) {
    const Vec3 jitter = 0.6F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.3F;
    const Point3 p(i % x, i / x % y, i / (x * y));
    // poly6 integrates to one.
    atoms.emplace_back(p + jitter, 2.F, metaballs::scale(Kernel::poly6, 2) / 0.5);
  }
  return atoms;
}

std::vector<Place> placesOf(std::span<const Atom> atoms, std::size_t count) {
  return uniformPlaces({Kernel::poly6, {atoms.begin(), atoms.end()}}, count);
}

struct Scene {
  AtomField field;
  Simulation simulation{{}};

  // Some steps at rest. Each is a frame of its own: it finds new places to look for holes.
  void step(std::span<const Atom> atoms, std::span<const Vec3> velocities = {}, int steps = 1,
            double dt = kFrame) {
    for (int i = 0; i < steps; ++i) {
      field.set(Kernel::poly6, atoms, velocities);
      simulation.step(field, dt);
    }
  }
  // On a disc and about as near to a surfel as neighbours are to one another, whichever is less.
  double covered(std::span<const Place> all) const {
    const Coverage c = coverage(simulation.surfels(), all, 0.5 * simulation.report().reach);
    return std::min(c.covered, c.near);
  }
  // Frames until 99 % are covered.
  int frames(std::span<const Atom> atoms) {
    const std::vector<Place> all = placesOf(atoms, 4000);
    int count = 0;
    do {
      step(atoms);
      ++count;
    } while (covered(all) < 0.99 && count < 200);
    return count;
  }
};

// sigma by its definition, over all pairs.
double unevenness(std::span<const Surfel> surfels, double reach) {
  constexpr std::size_t kStride = 16;
  std::vector<double> sigma(surfels.size() / kStride);
  parallelFor(sigma.size(), [&](std::size_t i) {
    for (const Surfel& s : surfels)
      if (const double r = glm::length(s.p - surfels[kStride * i].p); r < reach)
        sigma[i] += std::pow(1 - r / reach, 3);
  });
  double mean = 0, squares = 0;
  for (const double s : sigma) mean += s / static_cast<double>(sigma.size());
  for (const double s : sigma) squares += sqr(s - mean) / static_cast<double>(sigma.size());
  return std::sqrt(squares) / mean;
}

// The greatest |f| at a surfel, by the metaballs' own field in double precision.
double residual(std::span<const Surfel> surfels, std::span<const Atom> atoms) {
  const metaballs::Field field(Kernel::poly6, {atoms.begin(), atoms.end()});
  std::vector<std::uint32_t> all(atoms.size());
  std::iota(all.begin(), all.end(), 0U);
  double most = 0;
  for (const Surfel& s : surfels) most = std::max(most, std::abs(field.sample(s.p, all).value));
  return most;
}

TEST(AtRest, TheCoverIsEvenAndHasNoHole) {
  const std::vector<Atom> atoms = water(12, 11, 11);
  Scene scene;
  scene.step(atoms, {}, 60);
  const std::span<const Surfel> surfels = scene.simulation.surfels();
  ASSERT_EQ(surfels.size(), 16384U);
  const double uneven = unevenness(surfels, scene.simulation.report().reach);
  EXPECT_LT(uneven, 0.15);
  EXPECT_NEAR(scene.simulation.report().evenness, uneven, 0.02);
  EXPECT_EQ(scene.covered(placesOf(atoms, 20000)), 1);
  EXPECT_LT(residual(surfels, atoms), 1e-3);
  RecordProperty("unevenness", std::to_string(uneven));
}

// All surfels cover a drop at one corner; then all of the water is there.
TEST(BadStart, NearlyAllIsCoveredSoon) {
  const std::vector<Atom> atoms = water(12, 11, 11);
  Scene scene;
  scene.step(std::span(atoms).first(1), {}, 20);
  const int count = scene.frames(atoms);
  EXPECT_LE(count, 12);
  RecordProperty("frames", count);
}

// Half of the water is elsewhere, from one frame to the next; no flow leads there.
TEST(Split, NearlyAllIsCoveredSoon) {
  std::vector<Atom> atoms = water(12, 11, 11);
  Scene scene;
  scene.step(atoms, {}, 30);
  for (Atom& atom : atoms)
    if (atom.centre.x > 6) atom.centre.x += 1000;
  const int count = scene.frames(atoms);
  EXPECT_LE(count, 15);
  RecordProperty("frames", count);
}

// Water that is pulled in two: what stays together is covered all the time.
TEST(Split, NothingOpensWhileTheWaterFlows) {
  std::vector<Atom> atoms = water(12, 11, 11);
  std::vector<Vec3> velocities;
  for (const Atom& atom : atoms) velocities.emplace_back(atom.centre.x > 6 ? 15.F : -15.F, 0, 0);
  Scene scene;
  scene.step(atoms, velocities, 30, 0);
  for (int frame = 0; frame < 30; ++frame) {
    for (std::size_t i = 0; i < atoms.size(); ++i)
      atoms[i].centre += static_cast<float>(kFrame) * velocities[i];
    scene.step(atoms, velocities);
    EXPECT_LT(scene.simulation.report().residual, 1e-3) << frame;
    if (frame % 10 != 9) continue;
    EXPECT_GT(scene.covered(placesOf(atoms, 2000)), 0.99) << frame;
    EXPECT_LT(residual(scene.simulation.surfels(), atoms), 1e-3) << frame;
  }
}

}  // namespace
}  // namespace pbrt::surfels::test
