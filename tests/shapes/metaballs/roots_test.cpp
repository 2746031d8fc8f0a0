// The first crossing against the 113-bit oracle.

#include "shapes/metaballs/roots.h"

#include <gtest/gtest.h>

#include "tests/shapes/metaballs/clouds.h"
#include "tests/shapes/metaballs/oracle.h"

namespace pbrt::metaballs::test {
namespace {

struct Tally {
  int rays = 0, hits = 0, touches = 0;
  int missed = 0, wrong = 0;
  std::vector<double> errors;  // |t - oracle| |d| over the unit, where the crossing is clean
  Effort effort;

  void print(const std::string& what) {
    std::ranges::sort(errors);
    const auto quantile = [&](double q) {
      return errors.empty() ? 0 : errors[static_cast<std::size_t>(q * (errors.size() - 1))];
    };
    std::printf(
        "%-28s rays %5d hits %5d touches %3d missed %d false %d |dt|/h: median %.1e 99%% %.1e "
        "max %.1e; intervals %.1f points %.1f\n",
        what.c_str(), rays, hits, touches, missed, wrong, quantile(0.5), quantile(0.99),
        quantile(1), static_cast<double>(effort.intervals) / rays,
        static_cast<double>(effort.points) / rays);
  }
};

// `unit`: a typical radius. Position rounds by some epsilon of |o| + |t d|: that bounds what any
// double answer can mean.
void judge(const Field& field, const Cells& cells, const ObjectRay& ray, double unit,
           Tally& tally) {
  ++tally.rays;
  const auto t = nearest(cells, ray, [&](const Cell& c, AtomList list, const ObjectRay& r) {
    return firstCrossing(field, c, list, r, &tally.effort);
  });
  const auto any = nearest(cells, ray, [&](const Cell& c, AtomList list, const ObjectRay& r) {
    return crosses(field, c, list, r) ? std::optional(0.0) : std::nullopt;
  });
  EXPECT_EQ(t.has_value(), any.has_value());

  const Oracle oracle(field, ray);
  const auto truth = oracle.first();
  tally.hits += truth.has_value();
  const double speed = glm::length(ray.d);
  const double rounding =
      1e-13 * unit + 32 * kEpsilon * (glm::length(ray.o) + (truth ? speed * double(*truth) : 0));
  if (!t) {
    tally.missed += truth.has_value();
    return;
  }
  EXPECT_GT(*t, ray.tMin);
  EXPECT_LE(*t, ray.tMax);
  const double f = static_cast<double>(oracle.value(*t));
  const double slope = std::abs(static_cast<double>(oracle.slope(*t))) / speed;
  const double fRounding = 1e-13 * static_cast<double>(oracle.magnitude()) + slope * rounding;
  if (!truth) {
    ++(std::abs(f) <= fRounding ? tally.touches : tally.wrong);
    return;
  }
  const double error = (*t - static_cast<double>(*truth)) * speed;
  // What rounding of the field can move a crossing of this slope by.
  const double expected = rounding + 1e-13 * static_cast<double>(oracle.magnitude()) / slope;
  if (std::abs(error) <= expected)
    tally.errors.push_back(std::abs(error) / unit);
  else if (std::abs(f) <= fRounding)
    ++tally.touches;
  else
    ++(error < 0 ? tally.wrong : tally.missed);
}

enum RayKind { outside, inside, axis, along, far, kRayKinds };

ObjectRay rayOf(RayKind kind, const Field& field, double unit, Random& random) {
  const Atom& a = field.atoms()[random.uniform(static_cast<std::uint32_t>(field.atoms().size()))];
  const DPoint3 target = DPoint3(a.centre) + 0.8 * unit * random.cube();
  const double extent = unit * (3 + std::cbrt(static_cast<double>(field.atoms().size())));
  const DVec3 d = random.direction();
  switch (kind) {
    case inside:
      return {target, random.in(0.1, 10) * d};
    case axis: {
      DVec3 e(0);
      e[static_cast<int>(random.uniform(3U))] = random.uniform() < 0.5 ? -1 : 1;
      return {target - extent * e, e};
    }
    case along: {  // in a plane of constant z that holds the atom's centre, a face of many cells
      const DVec3 e = glm::normalize(DVec3(d.x, d.y, 0));
      return {DPoint3(target.x, target.y, a.centre.z) - extent * e, e};
    }
    case far:
      return {target - 1e4 * unit * d, d * random.in(0.1, 10)};
    default:
      return {target - extent * d, unit * d};
  }
}

class Crossing : public testing::TestWithParam<Kernel> {};

TEST_P(Crossing, IsTheFirst) {
  for (const double unit : {1.0, 1e-6, 1e6})
    for (const int count : {1, 2, 12, 300})
      for (const double carving : {0.0, 0.3}) {
        if (count == 1 && carving > 0) continue;
        const Field field = cloud(count, GetParam(), carving, unit, count);
        const Cells cells(field);
        Random random(count + 17);
        Tally tally;
        const int rays = unit == 1 && count < 300 ? 150 : 30;
        for (int i = 0; i < rays; ++i)
          judge(field, cells, rayOf(static_cast<RayKind>(i % kRayKinds), field, unit, random), unit,
                tally);
        tally.print(std::string(kKernels[static_cast<int>(GetParam())]) + " " +
                    std::to_string(count) + (carving > 0 ? " carved" : "") +
                    (unit < 1   ? " x 1e-6"
                     : unit > 1 ? " x 1e6"
                                : ""));
        EXPECT_EQ(tally.missed, 0);
        EXPECT_EQ(tally.wrong, 0);
        ASSERT_GT(tally.hits, rays / 20);
        EXPECT_EQ(tally.touches, 0);
        EXPECT_LT(tally.errors.back(), 1e-9);
      }
}

TEST_P(Crossing, OfRaysThatGraze) {
  for (const int count : {1, 2, 12}) {
    const Field field = cloud(count, GetParam(), 0, 1, count + 5);
    const Cells cells(field);
    std::vector<std::uint32_t> all(field.atoms().size());
    for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
    Random random(3);
    Tally tally;
    for (int i = 0; i < 300; ++i) {
      // A point of the surface, found from outside, and a ray in its tangent plane moved off by
      // 1e-1 to 1e-17 of the unit, inwards or outwards.
      const ObjectRay to = rayOf(outside, field, 1, random);
      const auto t = Oracle(field, to).first();
      if (!t) continue;
      const DPoint3 p = to.at(static_cast<double>(*t));
      const DVec3 n = -glm::normalize(field.sample(p, all).gradient);
      const DVec3 d = glm::normalize(glm::cross(n, random.direction()));
      const double off = (i % 2 ? 1 : -1) * std::pow(10.0, -random.in(1, 17));
      judge(field, cells, {p + off * n - random.in(0.1, 5) * d, d}, 1, tally);
    }
    tally.print(std::string(kKernels[static_cast<int>(GetParam())]) + " grazing " +
                std::to_string(count));
    EXPECT_EQ(tally.missed, 0);
    EXPECT_EQ(tally.wrong, 0);
    EXPECT_LT(static_cast<double>(tally.effort.intervals) / tally.rays, 200);
  }
}

// Rays through a neck at which the field equals the threshold and its gradient is zero.
TEST_P(Crossing, ThroughABreakingNeck) {
  const Field even(GetParam(), {{{-0.5F, 0, 0}, 1, 1, 1}, {{0.5F, 0, 0}, 1, 1, 1}});
  const std::uint32_t all[] = {0, 1};
  const double peak = even.sample(DPoint3(0), all).value + 1;
  Tally tally;
  Random random(5);
  for (const double above : {0.0, 1e-15, -1e-15, 1e-12, -1e-12, 1e-6, -1e-6}) {
    const double w = (1 + above) / peak;
    const Field field(GetParam(), {{{-0.5F, 0, 0}, 1, 1, w}, {{0.5F, 0, 0}, 1, 1, w}});
    const Cells cells(field);
    for (int i = 0; i < 40; ++i) {
      const DVec3 d = i % 2 ? random.direction() : DVec3(0, std::cos(i), std::sin(i));
      judge(field, cells, {-3.0 * d, d}, 1, tally);
    }
  }
  tally.print("neck");
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.wrong, 0);
}

TEST_P(Crossing, OfStiffSets) {
  const Kernel k = GetParam();
  std::vector<Atom> radii, strengths;
  Random random(9);
  for (int i = 0; i < 6; ++i) {
    radii.push_back(atom(Kernel::wyvill, Point3(1e-6 * random.cube()), 1e-6F, 3));
    strengths.push_back(atom(Kernel::wyvill, Point3(random.cube()), 1, i % 2 ? 2e4 : 2e-4));
  }
  radii.push_back(atom(Kernel::wyvill, {1e6F, 0, 0}, 1e6F, 2));
  strengths.push_back(atom(Kernel::wyvill, {0.3F, 0.2F, 0}, 1, -1e4));
  for (const auto& atoms : {radii, strengths}) {
    const Field field(k, atoms);
    const Cells cells(field);
    Tally tally;
    const double unit = atoms.front().radius;
    for (int i = 0; i < 100; ++i)
      judge(field, cells, rayOf(i % 2 ? outside : axis, field, unit, random), unit, tally);
    tally.print("stiff");
    EXPECT_EQ(tally.missed, 0);
    EXPECT_EQ(tally.wrong, 0);
  }
}

TEST_P(Crossing, OfAThousandAtomsInOnePlace) {
  std::vector<Atom> atoms(1000, Atom{{1, 2, 3}, 1, 1, 2e-3});
  for (std::size_t i = 500; i < atoms.size(); ++i) atoms[i].centre.x += 1e-3F * (i % 7);
  const Field field(GetParam(), atoms);
  const Cells cells(field);
  Tally tally;
  Random random(21);
  for (int i = 0; i < 30; ++i)
    judge(field, cells, rayOf(static_cast<RayKind>(i % kRayKinds), field, 1, random), 1, tally);
  tally.print("1000 in one place");
  EXPECT_EQ(tally.missed, 0);
  EXPECT_EQ(tally.wrong, 0);
}

// A cavity between atoms: rays that start in it see its wall; one that starts past the surface and
// ends before the next sees nothing.
TEST_P(Crossing, KeepsToTheRaysPart) {
  const Field field = cloud(12, GetParam(), 0.3, 1, 12);
  const Cells cells(field);
  Random random(33);
  const auto first = [&](const Cell& c, AtomList list, const ObjectRay& r) {
    return firstCrossing(field, c, list, r);
  };
  int parts = 0;
  for (int i = 0; i < 300; ++i) {
    ObjectRay ray = rayOf(outside, field, 1, random);
    std::vector<double> all;
    while (const auto t = nearest(cells, ray, first)) {
      all.push_back(*t);
      ray.tMin = *t + 1e-9;
    }
    ray.tMin = 0;
    EXPECT_EQ(all.size() % 2, 0U);  // what enters leaves
    for (std::size_t k = 0; k + 1 < all.size(); ++k) {
      const ObjectRay part{ray.o, ray.d, all[k] + 1e-9, all[k + 1] - 1e-9};
      EXPECT_FALSE(nearest(cells, part, first));
      ++parts;
    }
  }
  EXPECT_GT(parts, 100);
}

// From a point that is on the surface but for the rounding of its coordinates.
TEST_P(Crossing, IsNotWhereTheRayStarts) {
  const Field field = cloud(12, GetParam(), 0.3, 1, 12);
  const Cells cells(field);
  Random random(34);
  const auto first = [&](const Cell& c, AtomList list, const ObjectRay& r) {
    return firstCrossing(field, c, list, r);
  };
  int starts = 0;
  for (int i = 0; i < 300; ++i) {
    const ObjectRay ray = rayOf(outside, field, 1, random);
    const auto t = nearest(cells, ray, first);
    if (!t) continue;
    const Oracle oracle(field, ray);
    if (std::abs(static_cast<double>(oracle.slope(*t))) < 0.1) continue;
    for (const double sign : {1.0, -1.0}) {
      const auto next = nearest(cells, {ray.at(*t), sign * ray.d}, first);
      EXPECT_TRUE(!next || *next > 1e-3);
    }
    ++starts;
  }
  EXPECT_GT(starts, 50);
}

INSTANTIATE_TEST_SUITE_P(Kernels, Crossing,
                         testing::Values(Kernel::poly6, Kernel::wyvill, Kernel::blob,
                                         Kernel::gaussian),
                         [](const auto& i) {
                           return std::string(kKernels[static_cast<int>(i.param)]);
                         });

TEST(CrossingOfNothing, IsNone) {
  const Field field(Kernel::wyvill, {{{0, 0, 0}, 1, 1, 2}});
  const Cells cells(field);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  for (const ObjectRay& ray :
       {ObjectRay{{0, 0, 0.6}, {0, 0, 0}}, ObjectRay{{0, 0, -3}, {0, 0, nan}},
        ObjectRay{{0, nan, -3}, {0, 0, 1}}, ObjectRay{{0, 0, -3}, {0, 0, infinity}},
        ObjectRay{{0, 0, -3}, {0, 0, 1}, 2, 1}, ObjectRay{{0, 0, -infinity}, {0, 0, 1}}})
    for (const Cell& cell : cells.cells()) {
      EXPECT_FALSE(firstCrossing(field, cell, cells.atoms(cell), ray));
      EXPECT_FALSE(crosses(field, cell, cells.atoms(cell), ray));
    }
}

}  // namespace
}  // namespace pbrt::metaballs::test
