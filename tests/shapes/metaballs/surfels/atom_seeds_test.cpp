// Where seeds are: on or in the surface, on every piece, by its area.

#include <gtest/gtest.h>

#include "shapes/metaballs/surfels/atom_field.h"
#include "tests/shapes/metaballs/sets.h"

namespace pbrt::surfels::test {
namespace {

using metaballs::Field;

TEST(AtomSeeds, LieOnOrInTheSurface) {
  for (const Kernel kernel : metaballs::test::kAllKernels)
    for (const Field& atoms :
         {metaballs::test::fluid(kernel, 11, 0.25, 11),
          metaballs::test::cloud(300, kernel, 0.3, 1, 3), metaballs::test::cavity(kernel),
          metaballs::test::unlikeStrengths(kernel), metaballs::test::inOnePlace(kernel)}) {
      AtomField field;
      field.set(kernel, atoms.atoms(), {});
      std::vector<DPoint3> seeds(500);
      ASSERT_TRUE(field.seeds(0, seeds));
      std::vector<FieldAt> at(seeds.size());
      field.at(seeds, at);
      for (const FieldAt& f : at)
        EXPECT_TRUE(f.value > 0 || -f.value < 0.1 * field.grain() * glm::length(f.gradient))
            << f.value;
    }
}

TEST(AtomSeeds, AreSharedByArea) {
  // Lone atoms whose surfaces are balls of areas 1 : 4 : 16, in one set of many frames.
  const std::vector<Atom> atoms{
      {Point3(0, 0, 0), 1, 2}, {Point3(10, 0, 0), 2, 2}, {Point3(30, 0, 0), 4, 2}};
  AtomField field;
  double counts[3] = {}, total = 0;
  std::vector<DPoint3> seeds(256);
  for (std::uint64_t frame = 0; frame < 60; ++frame) {
    field.set(Kernel::wyvill, atoms, {});
    ASSERT_TRUE(field.seeds(frame * seeds.size(), seeds));
    for (const DPoint3& p : seeds) ++counts[p.x < 5 ? 0 : p.x < 20 ? 1 : 2], ++total;
  }
  // The atoms in turn, a quarter of the trials, favour the small: by a third of a quarter.
  EXPECT_NEAR(counts[0] / total, 1 / 21.0, 0.12);
  EXPECT_NEAR(counts[1] / total, 4 / 21.0, 0.12);
  EXPECT_NEAR(counts[2] / total, 16 / 21.0, 0.2);
  EXPECT_GT(counts[0] / total, 0.02);
}

TEST(AtomSeeds, SpreadOverTheSidesOfAFluid) {
  const Field atoms = metaballs::test::fluid(Kernel::wyvill, 12, 0.1, 12);
  AtomField field;
  double counts[6] = {}, total = 0;
  std::vector<DPoint3> seeds(512);
  for (std::uint64_t frame = 0; frame < 40; ++frame) {
    if (frame == 0 || frame == 20) field.set(Kernel::wyvill, atoms.atoms(), {});
    ASSERT_TRUE(field.seeds(frame * seeds.size(), seeds));
    for (const DPoint3& p : seeds) {
      const DVec3 d = p - DPoint3(5.5);
      const DVec3 a = glm::abs(d);
      const int axis = a.x > a.y && a.x > a.z ? 0 : a.y > a.z ? 1 : 2;
      ++counts[2 * axis + (d[axis] > 0)], ++total;
    }
  }
  for (const double count : counts) EXPECT_NEAR(count / total, 1 / 6.0, 0.03);
}

TEST(AtomSeeds, FindALoneDropSoon) {
  Field fluid = metaballs::test::fluid(Kernel::wyvill, 11, 0.25, 14);
  std::vector<Atom> atoms = fluid.atoms();
  atoms.emplace_back(Point3(-20, 0, 0), 2.F, 2);
  std::vector<DPoint3> seeds(256);
  for (const bool moves : {true, false}) {
    AtomField field;
    int longest = 0, wait = 0;
    for (std::uint64_t frame = 0; frame < 100; ++frame) {
      if (moves || frame == 0) field.set(Kernel::wyvill, atoms, {});
      ASSERT_TRUE(field.seeds(frame * seeds.size(), seeds));
      ++wait;
      if (std::ranges::any_of(seeds, [](const DPoint3& p) { return p.x < -10; })) wait = 0;
      longest = std::max(longest, wait);
    }
    EXPECT_LE(longest, 25);
  }
}

TEST(AtomSeeds, EndWhereThereIsNone) {
  AtomField field;
  std::vector<DPoint3> seeds(4);
  EXPECT_FALSE(field.seeds(0, seeds));
  for (const double weight : {0.9, -3.0}) {
    const std::vector<Atom> atoms{{Point3(0), 1, weight}, {Point3(9), 1, weight}};
    field.set(Kernel::wyvill, atoms, {});
    EXPECT_FALSE(field.seeds(0, seeds));
  }
}

TEST(AtomSeeds, AreThoseOfTheirNumbers) {
  const Field atoms = metaballs::test::fluid(Kernel::blob, 8, 0.25, 8);
  AtomField field;
  field.set(Kernel::blob, atoms.atoms(), {});
  std::vector<DPoint3> all(700), one(1);
  ASSERT_TRUE(field.seeds(50, all));
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_TRUE(field.seeds(50 + i, one));
    EXPECT_EQ(one[0], all[i]);
  }
}

}  // namespace
}  // namespace pbrt::surfels::test
