// The cells hold the whole surface and little else.

#include "shapes/metaballs/cells.h"

#include <gtest/gtest.h>

#include "core/base/parallel.h"
#include "shapes/metaballs/roots.h"
#include "tests/shapes/metaballs/clouds.h"

namespace pbrt::metaballs::test {
namespace {

TEST(MetaballCells, HugALoneBall) {
  for (const float h : {1e-6F, 1.F, 1e6F}) {
    const Field field(Kernel::wyvill, {atom(Kernel::wyvill, {h, 2 * h, -h}, h, 2)});
    const Cells cells(field);
    const double radius = h * std::sqrt(1 - std::cbrt(0.5));
    Bounds3 box;
    double volume = 0;
    for (const Cell& cell : cells.cells()) {
      box.add(cell.box);
      const DVec3 d(cell.box.diagonal());
      volume += d.x * d.y * d.z;
    }
    for (int i = 0; i < 3; ++i) {
      EXPECT_GE(box.hi[i] - box.lo[i], 2 * radius * 0.999999);
      EXPECT_LT(box.hi[i] - box.lo[i], 2 * radius * 1.1);
    }
    std::printf("h %g: %zu cells, extent over the ball's %.3f, volume over its area times h %.3f\n",
                h, cells.cells().size(), (box.hi.x - box.lo.x) / (2 * radius),
                volume / (4 * std::numbers::pi * radius * radius * h));
    EXPECT_LT(volume, 0.4 * 4 * std::numbers::pi * radius * radius * h);
  }
}

// Every crossing that a search of all atoms over the whole box finds is found by the cells.
TEST(MetaballCells, MissNothingThatOneBigCellSees) {
  for (const Kernel kernel : {Kernel::poly6, Kernel::blob, Kernel::gaussian})
    for (const int count : {1, 2, 12, 300})
      for (const double carving : {0.0, 0.3}) {
        if (count == 1 && carving > 0) continue;
        const Field field = cloud(count, kernel, carving, 1, count + 40);
        const Cells cells(field);
        std::vector<std::uint32_t> all(field.atoms().size());
        for (std::uint32_t i = 0; i < all.size(); ++i) all[i] = i;
        const float extent = 3 + std::cbrt(static_cast<float>(count));
        const Cell whole{{Point3(-extent), Point3(extent)}, 0, 0};
        Random random(count);
        int found = 0;
        for (int i = 0; i < 500; ++i) {
          const DPoint3 target = 0.3 * extent * random.cube();
          const DVec3 d = random.direction();
          const ObjectRay ray{target - 3.0 * extent * d, d};
          const auto one = firstCrossing(field, whole, all, ray);
          const auto many =
              nearest(cells, ray, [&](const Cell& c, AtomList list, const ObjectRay& r) {
                const auto t = firstCrossing(field, c, list, r);
                if (t) {
                  const DPoint3 p = r.at(*t);
                  const Bounds3 box = Cells::bounds(c);
                  for (int k = 0; k < 3; ++k) {
                    EXPECT_GE(p[k], box.lo[k] - 1e-13);
                    EXPECT_LE(p[k], box.hi[k] + 1e-13);
                  }
                }
                return t;
              });
          ASSERT_EQ(one.has_value(), many.has_value());
          if (!one) continue;
          EXPECT_NEAR(*one, *many, 1e-11);
          ++found;
        }
        EXPECT_GT(found, count == 1 ? 5 : 20);
      }
}

TEST(MetaballCells, AreNoneWhereThereIsNoSurface) {
  EXPECT_TRUE(Cells(Field(Kernel::blob, {})).cells().empty());
  EXPECT_TRUE(Cells(Field(Kernel::blob, {{{0, 0, 0}, 1, 0.999}})).cells().empty());
  EXPECT_TRUE(Cells(Field(Kernel::blob, {{{0, 0, 0}, 1, -5}})).cells().empty());
  EXPECT_TRUE(
      Cells(Field(Kernel::blob, {{{0, 0, 0}, 1, 0.9}, {{5, 0, 0}, 1, 0.9}})).cells().empty());
}

// Of so many atoms that the threads share the work.
TEST(MetaballCells, AreTheSameForAnyNumberOfThreads) {
  Random random(11);
  std::vector<Atom> atoms(20000);
  for (Atom& a : atoms) a = atom(Kernel::wyvill, Point3(10.0 * random.cube()), 1.2F, 0.3);
  const Field field(Kernel::wyvill, atoms);
  const auto made = [&](int threads) {
    const ThreadLimit limit(threads);
    return Cells(field);
  };
  const Cells one = made(1), three = made(3);
  ASSERT_EQ(one.cells().size(), three.cells().size());
  ASSERT_GT(one.cells().size(), 1000U);
  for (std::size_t i = 0; i < one.cells().size(); ++i) {
    const Cell &a = one.cells()[i], &b = three.cells()[i];
    ASSERT_TRUE(a.box.lo == b.box.lo && a.box.hi == b.box.hi) << i;
    ASSERT_TRUE(std::ranges::equal(one.atoms(a), three.atoms(b))) << i;
  }
}

// Cells do not fill the inside of a dense set.
TEST(MetaballCells, FormAShell) {
  std::vector<Atom> atoms;
  for (int x = 0; x < 12; ++x)
    for (int y = 0; y < 12; ++y)
      for (int z = 0; z < 12; ++z)
        atoms.push_back(atom(Kernel::poly6, {0.5F * x, 0.5F * y, 0.5F * z}, 1, 0.39));
  const Cells cells(Field(Kernel::poly6, atoms));
  std::size_t deep = 0;
  for (const Cell& cell : cells.cells()) {
    const Point3 p = cell.box.centre();
    deep += std::min({p.x, p.y, p.z}) > 1 && std::max({p.x, p.y, p.z}) < 4.5F;
  }
  std::printf("%zu cells, %zu deep inside\n", cells.cells().size(), deep);
  EXPECT_EQ(deep, 0U);
}

}  // namespace
}  // namespace pbrt::metaballs::test
