// Laws of the simulation: what holds after every step, whatever the field does.

#include "shapes/metaballs/surfels/simulation.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "shapes/metaballs/surfels/atom_field.h"
#include "tests/shapes/metaballs/surfels/fields.h"

namespace pbrt::surfels::test {
namespace {

using metaballs::Atom;
using metaballs::Kernel;

// f by all atoms, in double.
double fieldOf(Kernel kernel, const std::vector<Atom>& atoms, const DPoint3& p) {
  double f = -1;
  for (const Atom& a : atoms) {
    const double q = lengthSquared((p - DPoint3(a.centre)) / static_cast<double>(a.radius));
    metaballs::withKernel(kernel, [&]<class K>(K) { f += a.weight * K::value(q); });
  }
  return f;
}

struct Fluid {
  std::vector<Atom> atoms;
  std::vector<Vec3> velocities;
};

// Atoms at random in a ball, moving at random.
Fluid fluid(std::size_t count, std::uint64_t seed, float speed) {
  Rng rng(seed);
  Fluid f;
  const float extent = std::cbrt(static_cast<float>(count) / 8);
  for (std::size_t i = 0; i < count; ++i) {
    const auto random = [&] { return 2 * rng.uniform() - 1; };
    const Vec3 p{random(), random(), random()}, v{random(), random(), random()};
    f.atoms.push_back({extent * p, 1, 2});
    f.velocities.push_back(speed * v);
  }
  return f;
}
void move(Fluid& f, double dt) {
  for (std::size_t i = 0; i < f.atoms.size(); ++i)
    f.atoms[i].centre += static_cast<float>(dt) * f.velocities[i];
}

template <class Value>
void expectSound(const Simulation& simulation, std::size_t count, const Value& f) {
  ASSERT_EQ(simulation.surfels().size(), count);
  for (const Surfel& s : simulation.surfels()) {
    ASSERT_LT(std::abs(f(s.p)), 1e-3);
    ASSERT_NEAR(glm::length(s.n), 1, 1e-5);
    ASSERT_TRUE(s.radius > 0 && std::isfinite(s.radius));
    ASSERT_TRUE(s.density >= 0.999F && std::isfinite(s.density));
    for (const float b : s.bend) ASSERT_TRUE(std::isfinite(b));
  }
}
double valueOf(const MovingField& field, const DPoint3& p) {
  FieldAt a;
  field.at({&p, 1}, {&a, 1});
  return a.value;
}

TEST(Simulation, SurfelsStayOnAMovingFluidForAnyTimeStep) {
  for (const double dt : {1e-4, 1e-2, 1.0, 30.0}) {
    Simulation simulation({.count = 1500});
    Fluid f = fluid(1500, 3, 1);
    AtomField field;
    for (int i = 0; i < 6; ++i) {
      field.set(Kernel::wyvill, f.atoms, f.velocities);
      simulation.step(field, i > 0 ? dt : 0);
      expectSound(simulation, 1500,
                  [&](const DPoint3& p) { return fieldOf(Kernel::wyvill, f.atoms, p); });
      move(f, dt);
    }
  }
}

TEST(Simulation, SurfelsStayOnAtomsThatJumpAndLieAboutTheirVelocity) {
  Simulation simulation({.count = 1000});
  AtomField field;
  for (std::uint64_t i = 0; i < 6; ++i) {
    const Fluid f = fluid(300, i, 1e30F);
    field.set(Kernel::poly6, f.atoms, f.velocities);
    simulation.step(field, 1e30);
    expectSound(simulation, 1000,
                [&](const DPoint3& p) { return fieldOf(Kernel::poly6, f.atoms, p); });
  }
}

TEST(Simulation, SurfelsStayOnSteepAndShallowFields) {
  for (const double steepness : {1e-2, 1e4, 1e8}) {
    Simulation simulation({.count = 1000});
    for (int i = 0; i < 10; ++i) {
      const Balls balls({{{0.1 * i, 0, 0}, 1}, {{-0.1 * i, 0.3, 0}, 1 - 0.05 * i}}, steepness);
      simulation.step(balls, 0.1);
      expectSound(simulation, 1000, [&](const DPoint3& p) { return valueOf(balls, p); });
    }
  }
}

TEST(Simulation, ASurfaceMayVanishShrinkAndComeBack) {
  Simulation simulation({.count = 500});
  for (const double r : {1.0, 0.0, 2.0, 1e-6, 1e-3, 1e3, 0.0, 1.0}) {
    const Balls balls(r > 0 ? std::vector<Balls::Ball>{{{0, 0, 0}, r}}
                            : std::vector<Balls::Ball>{});
    if (r == 0) {
      AtomField none;
      simulation.step(none, 0.1);
      EXPECT_TRUE(simulation.surfels().empty());
      continue;
    }
    simulation.step(balls, 0.1);
    expectSound(simulation, 500, [&](const DPoint3& p) { return valueOf(balls, p); });
  }
}

// Answers nonsense.
class Nonsense final : public MovingField {
 public:
  explicit Nonsense(double value, double slope, bool seeds)
      : value_(value), slope_(slope), seeds_(seeds) {}
  Bounds3 bounds() const override { return {Point3(-1), Point3(1)}; }
  double grain() const override { return 1; }
  void at(std::span<const DPoint3> points, std::span<FieldAt> out) const override {
    std::fill_n(out.begin(), points.size(), FieldAt{value_, DVec3(slope_), DVec3(slope_)});
  }
  void shape(std::span<const DPoint3> points, std::span<ShapeAt> out) const override {
    std::fill_n(out.begin(), points.size(), ShapeAt{DVec3(slope_), glm::dmat3(value_)});
  }
  bool seeds(std::uint64_t, std::span<DPoint3> out) const override {
    std::fill(out.begin(), out.end(), DPoint3(0));
    return seeds_;
  }

 private:
  double value_, slope_;
  bool seeds_;
};

TEST(Simulation, NonsenseDoesNoHarm) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double value : {0.0, -1.0, 1.0, 1e308, -1e308, nan, 1e-300})
    for (const double slope : {0.0, 1.0, -1e300, 1e-300, 1e150, nan})
      for (const bool seeds : {true, false}) {
        Simulation simulation({.count = 300});
        simulation.step(Balls({{{0, 0, 0}, 1}}), 0);
        for (int i = 0; i < 3; ++i) simulation.step(Nonsense(value, slope, seeds), 0.1);
        for (const Surfel& s : simulation.surfels()) {
          ASSERT_TRUE(std::isfinite(s.p.x + s.p.y + s.p.z) && isFinite(s.n));
          ASSERT_TRUE(std::isfinite(s.radius + s.density));
          for (const float b : s.bend) ASSERT_TRUE(std::isfinite(b));
        }
        const Balls ball({{{0, 0, 0}, 1}});
        simulation.step(ball, 0.1);
        expectSound(simulation, 300, [&](const DPoint3& p) { return valueOf(ball, p); });
      }
}

TEST(Simulation, RefusesTimesThatAreNone) {
  Simulation simulation({.count = 10});
  for (const double dt : {-1.0, double{kInfinity}, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(simulation.step(Balls({{{0, 0, 0}, 1}}), dt), std::invalid_argument);
  EXPECT_THROW(Simulation({.count = std::size_t{1} << 31U}), std::invalid_argument);
}

TEST(Simulation, AnyCountWillDo) {
  const Balls balls({{{0, 0, 0}, 1}, {{5, 0, 0}, 0.1}});
  for (const std::size_t count : {0, 1, 2, 3, 7, 257, 5000}) {
    Simulation simulation({.count = count});
    for (int i = 0; i < 8; ++i) simulation.step(balls, 0.1);
    expectSound(simulation, count, [&](const DPoint3& p) { return valueOf(balls, p); });
  }
}

TEST(Simulation, NormalAndBendAreThoseOfTheBall) {
  const Balls ball({{{1, 0, 0}, 0.25}});
  Simulation simulation({.count = 300});
  simulation.step(ball, 0);
  for (const Surfel& s : simulation.surfels()) {
    const DVec3 n = glm::normalize(s.p - DPoint3(1, 0, 0));
    EXPECT_LT(glm::length(DVec3(s.n) - n), 1e-6);
    for (int i = 0; i < 6; ++i) {
      const int row = i < 3 ? i : i < 5 ? 0 : 1, column = i < 3 ? i : i < 4 ? 1 : 2;
      EXPECT_NEAR(s.bend[i], 4 * ((row == column ? 1 : 0) - n[row] * n[column]), 1e-3);
    }
  }
}

std::vector<Surfel> run(int threads, double scale, std::uint64_t seed = 0) {
  const ThreadLimit limit(threads);
  Simulation simulation({.count = 3000, .seed = seed});
  for (int i = 0; i < 12; ++i)
    simulation.step(Balls({{{0, 0, 0}, scale},
                           {DPoint3(0.2 * i * scale, 0, 0), 0.5 * scale, DVec3(2 * scale, 0, 0)}}),
                    0.1);
  return {simulation.surfels().begin(), simulation.surfels().end()};
}
bool same(const Surfel& a, const Surfel& b, double scale) {
  const auto s = static_cast<float>(scale);
  return a.p * scale == b.p && a.n == b.n && a.radius * s == b.radius && a.density == b.density;
}

TEST(Simulation, TheBitsDoNotDependOnTheThreads) {
  const auto one = run(1, 1);
  for (const int threads : {1, 2, 7}) {
    const auto other = run(threads, 1);
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_TRUE(same(one[i], other[i], 1)) << i;
  }
  const auto other = run(1, 1, 5);
  EXPECT_FALSE(same(one[0], other[0], 1) && same(one[1], other[1], 1));
}

// Powers of two do not round: what is a million times smaller is the same to the last bit.
TEST(Simulation, KnowsNoScale) {
  const auto one = run(2, 1);
  for (const double scale : {0x1p-20, 0x1p20}) {
    const auto other = run(2, scale);
    for (std::size_t i = 0; i < one.size(); ++i) ASSERT_TRUE(same(one[i], other[i], scale)) << i;
  }
}

}  // namespace
}  // namespace pbrt::surfels::test
