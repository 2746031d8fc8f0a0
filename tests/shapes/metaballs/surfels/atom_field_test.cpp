// The field of moving atoms against sums in 113 bits over all atoms, with no cells.

#include "shapes/metaballs/surfels/atom_field.h"

#include <gtest/gtest.h>

#include <bit>
#include <cstring>

#include "core/base/parallel.h"
#include "tests/shapes/metaballs/quad.h"
#include "tests/shapes/metaballs/sets.h"

namespace pbrt::surfels::test {
namespace {

using metaballs::Field;
using metaballs::test::Quad;
using metaballs::test::Random;

std::vector<Vec3> someVelocities(std::size_t count, double most = 1) {
  Random random(5);
  std::vector<Vec3> v(count);
  for (Vec3& one : v) one = Vec3(most * random.cube());
  return v;
}

// The kernel and its slope.
std::pair<Quad, Quad> kernelAt(Kernel kernel, Quad q) {
  if (q >= 1) return {0, 0};
  const Quad a = 1 - q;
  switch (kernel) {
    case Kernel::blob:
      return {a * a, -2 * a};
    case Kernel::gaussian: {
      const Quad e = metaballs::test::exp(-4 * q);
      return {e - metaballs::test::exp(Quad(-4)), -4 * e};
    }
    default:
      return {a * a * a, -3 * a * a};
  }
}

struct Sum {
  Quad value = -1;
  DVec3 gradient{}, flow{};
  double slopes = 0, weights = 0;  // sums of |grad W_j| and of |w_j|
};
Sum sumOver(const Field& field, std::span<const Vec3> velocities, const DPoint3& p) {
  Sum sum;
  Quad gradient[3] = {}, flow[3] = {}, slopes = 0;
  for (std::size_t j = 0; j < field.atoms().size(); ++j) {
    const Atom& a = field.atoms()[j];
    const Quad d[3] = {Quad(p.x) - a.centre.x, Quad(p.y) - a.centre.y, Quad(p.z) - a.centre.z};
    const Quad r2 = d[0] * d[0] + d[1] * d[1] + d[2] * d[2], h2 = Quad(a.radius) * a.radius;
    const auto [k, slope] = kernelAt(field.kernel(), r2 / h2);
    if (r2 < h2) sum.weights += std::abs(a.weight);
    sum.value += Quad(a.weight) * k;
    const Quad c = 2 * Quad(a.weight) * slope / h2;
    const Quad size = metaballs::test::abs(c) * std::sqrt(static_cast<double>(r2));
    slopes += size;
    for (int i = 0; i < 3; ++i) {
      gradient[i] += c * d[i];
      if (velocities.empty()) continue;
      flow[i] += size * velocities[j][i];
    }
  }
  for (int i = 0; i < 3; ++i) {
    sum.gradient[i] = static_cast<double>(gradient[i]);
    if (slopes > 0) sum.flow[i] = static_cast<double>(flow[i] / slopes);
  }
  sum.slopes = static_cast<double>(slopes);
  return sum;
}

// Points in and about the supports of some atoms, many of them near the surface.
std::vector<DPoint3> pointsAbout(const Field& field, const AtomField& at, std::size_t count) {
  Random random(11);
  std::vector<DPoint3> points(count);
  if (!at.seeds(0, points)) points.resize(0);
  for (std::size_t i = 0; i < count; ++i) {
    const Atom& a = field.atoms()[random.uniform(static_cast<std::uint32_t>(field.atoms().size()))];
    points.push_back(DPoint3(a.centre) + 1.1 * a.radius * random.cube());
  }
  points.emplace_back(1e30, 0, 0);
  return points;
}

class AtomFieldOf : public testing::TestWithParam<std::tuple<metaballs::test::Set, Kernel>> {};

TEST_P(AtomFieldOf, IsTheSumOfItsAtoms) {
  const auto& [set, kernel] = GetParam();
  const Field atoms = set.field(kernel);
  const std::vector<Vec3> velocities = someVelocities(atoms.atoms().size(), 3);
  AtomField field;
  field.set(kernel, atoms.atoms(), velocities);
  const std::vector<DPoint3> points =
      pointsAbout(atoms, field, std::min<std::size_t>(100, 300000 / atoms.atoms().size()));
  std::vector<FieldAt> at(points.size());
  field.at(points, at);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Sum sum = sumOver(atoms, velocities, points[i]);
    const auto exact = static_cast<double>(sum.value);
    EXPECT_NEAR(at[i].value, exact, 1e-4 * std::max(1.0, std::abs(exact))) << i;
    const double slopes = sum.slopes + 0.1 * sum.weights / field.grain();
    EXPECT_LT(glm::length(at[i].gradient - sum.gradient), 1e-4 * slopes + 1e-300) << i;
    // Where slopes are next to nothing the mean is ill-conditioned.
    if (sum.slopes * field.grain() > 1e-3 * sum.weights) {
      EXPECT_LT(glm::length(at[i].flow - sum.flow), 1e-2) << i;
    }
    EXPECT_TRUE(std::isfinite(lengthSquared(at[i].flow))) << i;
  }
}

TEST_P(AtomFieldOf, BendsAsItsGradientTurns) {
  const auto& [set, kernel] = GetParam();
  const Field atoms = set.field(kernel);
  AtomField field;
  field.set(kernel, atoms.atoms(), {});
  const std::vector<DPoint3> points = pointsAbout(atoms, field, 40);
  std::vector<ShapeAt> shape(points.size());
  field.shape(points, shape);
  double largest = 0;
  for (const Atom& a : atoms.atoms()) largest = std::max<double>(largest, a.radius);
  std::vector<std::uint32_t> all(atoms.atoms().size());
  for (std::uint32_t j = 0; j < all.size(); ++j) all[j] = j;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const metaballs::FieldSample exact = atoms.sample(points[i], all);
    EXPECT_LE(glm::length(shape[i].gradient - exact.gradient),
              1e-4 * glm::length(exact.gradient) + 1e-9 * exact.bend * largest + 1e-300)
        << i;
    double size = 0, error = 0;
    for (int k = 0; k < 3; ++k) {
      size += lengthSquared(exact.hessian[k]);
      error += lengthSquared(shape[i].hessian[k] - exact.hessian[k]);
    }
    double h = field.grain();  // the largest support there
    for (const Atom& a : atoms.atoms())
      if (glm::length(DPoint3(a.centre) - points[i]) < a.radius) h = std::max<double>(h, a.radius);
    const double slope = glm::length(exact.gradient);
    EXPECT_LE(std::sqrt(error),
              1e-3 * std::max(std::sqrt(size), slope / h) + 1e-9 * exact.bend + 1e-300)
        << i;
  }
}

std::vector<metaballs::test::Set> allSets() {
  std::vector<metaballs::test::Set> sets = metaballs::test::ordinarySets(1000);
  for (const metaballs::test::Set& set : metaballs::test::extremeSets()) sets.push_back(set);
  const auto every = metaballs::test::anyRay;
  sets.push_back({"radii 1e-15 and 1e15",
                  [](Kernel k) {
                    std::vector<Atom> atoms;
                    for (const float h : {1e-14F, 1e-3F, 1.F, 3.F, 1e6F, 1e14F})
                      atoms.emplace_back(Point3(0.3F * h, 0, 0), h, 1.5);
                    return Field(k, std::move(atoms));
                  },
                  every});
  sets.push_back({"weights to 1e29",
                  [](Kernel k) {
                    Random random(2);
                    std::vector<Atom> atoms;
                    for (int i = 0; i < 40; ++i)
                      atoms.emplace_back(Point3(1.5 * random.cube()), 1.F,
                                         std::pow(10.0, random.in(-4, 29)));
                    return Field(k, std::move(atoms));
                  },
                  every});
  return sets;
}
INSTANTIATE_TEST_SUITE_P(
    Sets, AtomFieldOf,
    testing::Combine(testing::ValuesIn(allSets()), testing::ValuesIn(metaballs::test::kAllKernels)),
    [](const auto& test) {
      return std::get<0>(test.param).identifier() + "_" +
             std::string(metaballs::kKernels[static_cast<std::size_t>(std::get<1>(test.param))]);
    });

TEST(AtomField, IsFiniteWhateverTheVelocities) {
  const Field atoms = metaballs::test::cloud(40, Kernel::poly6, 0.2, 1, 3);
  for (const double most : {0.0, 1e-38, 1e30}) {
    const std::vector<Vec3> velocities = someVelocities(40, most);
    AtomField field;
    field.set(Kernel::poly6, atoms.atoms(), velocities);
    std::vector<DPoint3> points = pointsAbout(atoms, field, 100);
    for (const Atom& a : atoms.atoms()) points.emplace_back(a.centre);
    points.emplace_back(std::numeric_limits<double>::quiet_NaN(), 0, 0);
    points.emplace_back(0, std::numeric_limits<double>::infinity(), -1e308);
    std::vector<FieldAt> at(points.size());
    field.at(points, at);
    for (const FieldAt& f : at) {
      EXPECT_TRUE(std::isfinite(f.value + f.gradient.x + f.gradient.y + f.gradient.z));
      EXPECT_TRUE(std::isfinite(f.flow.x + f.flow.y + f.flow.z));
      EXPECT_LE(glm::length(f.flow), 1.8 * most);
    }
  }
}

TEST(AtomField, FlowsAsALoneAtomAtItsMiddle) {
  const std::vector<Atom> atoms{{Point3(1, 2, 3), 2, 3}};
  const std::vector<Vec3> velocities{{1, -2, 0.5F}};
  AtomField field;
  field.set(Kernel::wyvill, atoms, velocities);
  const std::vector<DPoint3> points{{1, 2, 3}, {1.5, 2, 3}, {9, 9, 9}};
  std::vector<FieldAt> at(3);
  field.at(points, at);
  EXPECT_LT(glm::length(at[0].flow - DVec3(velocities[0])), 1e-6);
  EXPECT_LT(glm::length(at[1].flow - DVec3(velocities[0])), 1e-6);
  EXPECT_EQ(at[2].flow, DVec3(0));
  EXPECT_EQ(at[2].value, -1);
}

// All bits of what a field says.
std::vector<std::uint64_t> bitsOf(const Field& atoms, std::span<const Vec3> velocities,
                                  bool together) {
  AtomField field;
  field.set(atoms.kernel(), atoms.atoms(), velocities);
  std::vector<DPoint3> points(600);
  EXPECT_TRUE(field.seeds(7, points));
  std::vector<FieldAt> at(points.size());
  if (together)
    field.at(points, at);
  else
    for (std::size_t i = points.size(); i-- > 0;) field.at({&points[i], 1}, {&at[i], 1});
  std::vector<ShapeAt> shape(points.size());
  if (together)
    field.shape(points, shape);
  else
    for (std::size_t i = points.size(); i-- > 0;) field.shape({&points[i], 1}, {&shape[i], 1});
  std::vector<std::uint64_t> bits;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (const double x :
         {points[i].x, points[i].y, points[i].z, at[i].value, at[i].gradient.x, at[i].gradient.y,
          at[i].gradient.z, at[i].flow.x, at[i].flow.y, at[i].flow.z, shape[i].gradient.x,
          shape[i].gradient.z, shape[i].hessian[0].x, shape[i].hessian[2].y})
      bits.push_back(std::bit_cast<std::uint64_t>(x));
  return bits;
}

TEST(AtomField, GivesTheSameBitsForAnyThreadsAndAnyCompany) {
  const Field atoms = metaballs::test::fluid(Kernel::gaussian, 9, 0.25, 9);
  const std::vector<Vec3> velocities = someVelocities(atoms.atoms().size());
  const auto first = bitsOf(atoms, velocities, true);
  EXPECT_EQ(bitsOf(atoms, velocities, false), first);
  for (const int threads : {1, 2, 7}) {
    const ThreadLimit limit(threads);
    EXPECT_EQ(bitsOf(atoms, velocities, true), first);
  }
}

// A frame leaves nothing behind in the next but the number of its trials.
TEST(AtomField, ForgetsEarlierFrames) {
  const Field many = metaballs::test::fluid(Kernel::wyvill, 12, 0.25, 12);
  const Field few = metaballs::test::unlikeRadii(Kernel::blob);
  AtomField used, fresh;
  used.set(many.kernel(), many.atoms(), {});
  used.set(few.kernel(), few.atoms(), {});
  fresh.set(few.kernel(), few.atoms(), {});
  const std::vector<DPoint3> points = pointsAbout(few, fresh, 200);
  std::vector<FieldAt> a(points.size()), b(points.size());
  used.at(points, a);
  fresh.at(points, b);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_EQ(a[i].value, b[i].value);
    EXPECT_EQ(a[i].gradient, b[i].gradient);
  }
  EXPECT_EQ(used.bounds().lo, fresh.bounds().lo);
  used.set(Kernel::poly6, {}, {});
  EXPECT_TRUE(used.bounds().empty());
  EXPECT_FALSE(used.seeds(0, std::span(std::vector<DPoint3>(3).data(), 3)));
}

TEST(AtomLoops, AreTheSameOnAllInstructionSets) {
  Random random(3);
  for (const Kernel kernel : metaballs::test::kAllKernels) {
    const Field atoms = metaballs::test::cloud(100, kernel, 0.2, 1, 3);
    const std::vector<Vec3> velocities = someVelocities(100);
    for (int i = 0; i < 50; ++i) {
      const CellFrame cell{2.0 * random.cube(), random.in(0.3, 1.3), 1e-6};
      const Vec3 offset(random.cube());
      std::vector<float> columns[5];
      std::vector<std::uint32_t> all;
      for (const Atom& a : atoms.atoms()) {
        const Point3 p = cell.inward(DPoint3(a.centre)) - offset;
        const auto h = static_cast<float>(a.radius / cell.side);
        int c = 0;
        for (const float x : {p.x, p.y, p.z, 1 / (h * h), a.lightWeight}) columns[c++].push_back(x);
        all.push_back(static_cast<std::uint32_t>(all.size()));
      }
      for (auto& column : columns) column.resize(100 + kLanes);
      all.resize(100 + kLanes);
      std::vector<std::uint32_t> numbers;
      std::vector<std::uint64_t> first;
      for (const AtomLoops* loops : allAtomLoops()) {
        AtomRun run;
        for (std::size_t k = 0; k < 100;) {
          const CellAtoms some{&columns[0][k], &columns[1][k], &columns[2][k],
                               &columns[3][k], &columns[4][k], &all[k]};
          k += loops->gather(some, 100 - k, offset, 0.50001F, run);
        }
        PointRun points{};
        points.count = 17;
        Random places(static_cast<std::uint64_t>(i));
        for (std::size_t k = 0; k < 24; ++k)
          for (auto& axis : points.p) axis[k] = static_cast<float>(places.in(-0.5, 0.5));
        loops->add(kernel, run, velocities, 0.7F, points);
        ExactSums exact;
        loops->addExactly(kernel, atoms.atoms(), AtomList(run.number, run.count), velocities,
                          cell.centre, exact);
        std::vector<std::uint64_t> bits(run.number, run.number + run.count);
        for (std::size_t k = 0; k < points.count; ++k)
          for (const float* sum :
               {points.value, points.magnitude, points.gradient[0], points.gradient[2],
                points.slopes, points.flow[0], points.flow[2]})
            bits.push_back(std::bit_cast<std::uint32_t>(sum[k]));
        for (const double x : {exact.value, exact.magnitude, exact.gradient.x, exact.slopes,
                               exact.flow.y, exact.weighed.z})
          bits.push_back(std::bit_cast<std::uint64_t>(x));
        BendRun bends{};
        bends.count = points.count;
        std::memcpy(bends.p, points.p, sizeof(bends.p));
        loops->bend(kernel, run, bends);
        for (std::size_t k = 0; k < bends.count; ++k)
          for (const float* sum :
               {bends.gradient[0], bends.gradient[1], bends.hessian[0], bends.hessian[2],
                bends.hessian[5], bends.size, bends.magnitude, bends.terms})
            bits.push_back(std::bit_cast<std::uint32_t>(sum[k]));
        if (first.empty()) first = bits;
        EXPECT_EQ(bits, first);
      }
    }
  }
}

}  // namespace
}  // namespace pbrt::surfels::test
