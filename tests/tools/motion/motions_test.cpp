// Laws of the motions that are built in: velocities are derivatives, atoms stay in view, numbers
// say all; and what the water of the dam must keep.

#include <gmock/gmock.h>

#include <numbers>
#include <set>

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "tools/particles/motion/dam.h"

namespace pbrt::motion {
namespace {

using testing::HasSubstr;

Fluid at(Motion& motion, int number) {
  Fluid fluid;
  motion.frame(number, fluid);
  return fluid;
}

double greatestChange(const Fluid& a, const Fluid& b) {
  double most = a.atoms.size() == b.atoms.size() ? 0 : 1e9;
  for (std::size_t i = 0; most < 1e9 && i < a.atoms.size(); ++i)
    most = std::max<double>(most, glm::length(a.atoms[i].centre - b.atoms[i].centre));
  return most;
}

struct Energy {
  double kinetic = 0, potential = 0;
  double total() const { return kinetic + potential; }
};

// Of a particle, on the mean; from the bottom of the tank.
Energy energy(const Fluid& fluid) {
  Energy e;
  const auto n = static_cast<double>(fluid.atoms.size());
  for (std::size_t i = 0; i < fluid.atoms.size(); ++i) {
    e.kinetic += 0.5 * lengthSquared(fluid.velocities[i]) / n;
    e.potential += kGravity * fluid.atoms[i].centre.y / n;
  }
  return e;
}

TEST(Motions, AreKnownByName) {
  for (const std::string& name : motionNames()) {
    const auto motion = makeMotion(name, 300);
    const Fluid start = at(*motion, motion->first());
    EXPECT_EQ(start.atoms.size(), 300U) << name;
    EXPECT_EQ(start.velocities.size(), 300U) << name;
  }
}

TEST(Motions, RefuseWhatTheyCannotDo) {
  const auto refusal = [](const std::string& name, int atoms, double fps) -> std::string {
    try {
      makeMotion(name, atoms, fps);
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::usage);
      return error.what();
    }
    return "";
  };
  EXPECT_THAT(refusal("damm", 1500, 60), HasSubstr("did you mean \"dam\"?"));
  EXPECT_THAT(refusal("dam", 99, 60), HasSubstr("99 atoms"));
  EXPECT_THAT(refusal("dam", 1'000'001, 60), HasSubstr("to a million"));
  EXPECT_THAT(refusal("ring", 1500, 0), HasSubstr("0 frames a second"));
  EXPECT_THAT(refusal("ring", 1500, std::nan("")), HasSubstr("frames a second"));
  EXPECT_THROW(at(*makeMotion("ring"), 0), Error);
}

// An error of the derivative would be of first order in the time between frames, that of the
// difference is of third.
TEST(Motions, VelocitiesOfTheClosedFormsAreTheirDerivatives) {
  for (const char* name : {"split", "ring"}) {
    const auto motion = makeMotion(name, 400, 1000);
    for (const int number : {2, 700, 1333, 2000, 3100, 4001}) {
      const Fluid before = at(*motion, number - 1), now = at(*motion, number),
                  after = at(*motion, number + 1);
      for (std::size_t i = 0; i < now.atoms.size(); ++i) {
        const Vec3 difference = (after.atoms[i].centre - before.atoms[i].centre) / 0.002F;
        EXPECT_LT(glm::length(difference - now.velocities[i]), 2e-4) << name << " " << number;
      }
    }
  }
}

TEST(Motions, StayInTheirBounds) {
  for (const std::string& name : motionNames()) {
    const auto motion = makeMotion(name, 500, 10);
    Bounds3 bounds = motion->bounds();
    double outside = 0, all = 0;
    for (int number = 1; number <= 240; ++number)
      for (const metaballs::Atom& atom : at(*motion, number).atoms) {
        outside += !bounds.contains(atom.centre);
        ++all;
      }
    // Spray may fly higher.
    EXPECT_LE(outside, name == "dam" ? 0.01 * all : 0) << name;
  }
}

TEST(Motions, ANumberSaysAllWhateverCameBefore) {
  for (const std::string& name : motionNames()) {
    const auto one = makeMotion(name, 300), other = makeMotion(name, 300);
    at(*one, 30);
    EXPECT_EQ(greatestChange(at(*one, 12), at(*other, 12)), 0) << name;
  }
}

TEST(Motions, ClosedFormsComeBack) {
  EXPECT_LT(greatestChange(at(*makeMotion("split", 300), 1), at(*makeMotion("split", 300), 241)),
            1e-6);
  EXPECT_LT(greatestChange(at(*makeMotion("ring", 300), 1), at(*makeMotion("ring", 300), 1441)),
            1e-6);
}

// The pieces of an atom and those that overlap it, and so on.
int pieces(const Fluid& fluid) {
  std::vector<bool> seen(fluid.atoms.size());
  int count = 0;
  for (std::size_t start = 0; start < seen.size(); ++start) {
    if (seen[start]) continue;
    ++count;
    std::vector<std::size_t> open{start};
    seen[start] = true;
    while (!open.empty()) {
      const metaballs::Atom atom = fluid.atoms[open.back()];
      open.pop_back();
      for (std::size_t i = 0; i < seen.size(); ++i)
        if (!seen[i] && glm::length(fluid.atoms[i].centre - atom.centre) < atom.radius) {
          seen[i] = true;
          open.push_back(i);
        }
    }
  }
  return count;
}

TEST(Motions, SplitIsOneAndThenFive) {
  const auto split = makeMotion("split");
  EXPECT_EQ(pieces(at(*split, 1)), 1);
  EXPECT_EQ(pieces(at(*split, 121)), 5);
}

TEST(Motions, DropsOfTheRingTouchAndPart) {
  const auto ring = makeMotion("ring");
  std::set<int> counts;
  for (int number = 1; number <= 180; number += 9) counts.insert(pieces(at(*ring, number)));
  EXPECT_THAT(counts, testing::Contains(12));
  EXPECT_THAT(counts, testing::Contains(6));
}

TEST(FluidAtom, AloneIsABallOfItsShareOfTheVolume) {
  const metaballs::Atom atom = fluidAtom(Point3(1, 2, 3), 0.1F);
  const double r = 0.1 * std::cbrt(3 / (4 * std::numbers::pi)), q = sqr(r / atom.radius);
  EXPECT_NEAR(atom.weight * std::pow(1 - q, 3), 1, 1e-6);
}

// In the interior by definition; a wall stands for about what the lattice would go on with, and
// what is beyond two of them counts twice.
TEST(Water, ALatticeBetweenWallsHasTheDensityOfRest) {
  constexpr int side = 10;
  std::vector<Point3> lattice;
  for (int i = 0; i < side * side * side; ++i)
    lattice.push_back(Point3(i % side, i / side % side, i / side / side) + 0.5F);
  Water water(lattice, {Point3(0), Point3(side)}, 1, side);
  const std::vector<float> densities = water.densities();
  for (std::size_t i = 0; i < lattice.size(); ++i) {
    const Vec3 edge = glm::min(lattice[i], static_cast<float>(side) - lattice[i]);
    const int walls = (edge.x < 2) + (edge.y < 2) + (edge.z < 2);
    EXPECT_NEAR(densities[i], 1, walls == 0 ? 1e-5 : 0.05 * walls) << i;
  }
}

TEST(Water, BreaksAndComesToRestWithoutGainingEnergy) {
  Dam dam(600, 60);
  const double start = energy(at(dam, 1)).total();
  double last = start;
  for (int number = 6; number <= 1001; number += 5) {
    const double now = energy(at(dam, number)).total();
    EXPECT_LT(now, last + 0.002 * start) << number;
    last = now;
  }
  const Fluid rest = at(dam, 1001);
  const Energy e = energy(rest);
  EXPECT_LT(e.kinetic, 1e-3 * start);
  // Half of how high the column stands once it has all of the tank's bottom.
  EXPECT_NEAR(e.potential / kGravity, 0.12, 0.03 * 0.12);
  double mean = 0;
  for (const float density : dam.water().densities()) mean += density / 600;
  EXPECT_NEAR(mean, 1, 0.02);
}

TEST(Water, FallsAsAllThingsDo) {
  Water drop({Point3(0.5F, 0.9F, 0.25F)}, {Point3(0), Point3(1)}, 0.05F, 1);
  drop.advance(0.2);
  EXPECT_NEAR(drop.velocities()[0].y, -kGravity * 0.2, 1e-3);
  EXPECT_NEAR(drop.positions()[0].y, 0.9 - kGravity * 0.02, 0.01);
  drop.advance(1);
  EXPECT_NEAR(drop.positions()[0].y, 0, 0.01);
}

TEST(Water, OfAnyCountStaysInTheTank) {
  for (const int count : {100, 101, 1500, 10'000}) {
    Dam dam(count, 60);
    for (int number = 1; number <= (count > 5000 ? 12 : 60); number += 3) {
      const Fluid fluid = at(dam, number);
      ASSERT_EQ(std::ssize(fluid.atoms), count);
      for (std::size_t i = 0; i < fluid.atoms.size(); ++i) {
        const Point3 p = fluid.atoms[i].centre;
        ASSERT_TRUE(Bounds3({Point3(0), Point3(1, 1, 0.5F)}).contains(p)) << count;
        ASSERT_LT(glm::length(fluid.velocities[i]), 20) << count;
      }
    }
  }
}

TEST(Water, HeapedUpStaysInTheTank) {
  std::vector<Point3> heap(200, Point3(0));
  for (std::size_t i = 0; i < 20; ++i) heap[i] = Point3(1);
  for (std::size_t i = 20; i < 100; ++i) heap[i].x += 1e-5F * static_cast<float>(i);
  Water water(heap, {Point3(0), Point3(1)}, 0.05F, 1);
  for (int i = 0; i < 20; ++i) water.advance(1. / 60);
  for (std::size_t i = 0; i < heap.size(); ++i) {
    EXPECT_TRUE(Bounds3({Point3(0), Point3(1)}).contains(water.positions()[i]));
    EXPECT_LT(glm::length(water.velocities()[i]), 20);
  }
}

TEST(Water, IsTheSameForAnyNumberOfThreads) {
  Fluid one;
  {
    const ThreadLimit limit(1);
    one = at(*makeMotion("dam", 1000), 20);
  }
  const Fluid many = at(*makeMotion("dam", 1000), 20);
  EXPECT_EQ(greatestChange(one, many), 0);
}

// Any time between frames is cut into steps that are short enough.
TEST(Water, IsSteadyAtAnyFrameRate) {
  for (const double fps : {1., 24., 1000.}) {
    Dam dam(300, fps);
    const double start = energy(at(dam, 1)).total();
    const double later = energy(at(dam, 1 + static_cast<int>(2 * fps))).total();
    EXPECT_LT(later, start) << fps;
    EXPECT_GT(later, 0.3 * start) << fps;
  }
}

}  // namespace
}  // namespace pbrt::motion
