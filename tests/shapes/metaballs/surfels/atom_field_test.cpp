// The field of moving atoms against sums in 113 bits over all atoms.

#include "shapes/metaballs/surfels/atom_field.h"

#include <gtest/gtest.h>

#include "tests/shapes/metaballs/quad.h"
#include "tests/shapes/metaballs/sets.h"

namespace pbrt::surfels::test {
namespace {

using metaballs::Kernel;
using metaballs::test::Quad;
using metaballs::test::Random;

TEST(AtomField, FindsItsOwnSurface) {
  const metaballs::Field fluid = metaballs::test::fluid(Kernel::wyvill, 11, 0.25, 11);
  AtomField field;
  field.set(fluid.kernel(), fluid.atoms(), {});
  std::vector<DPoint3> seeds(500);
  ASSERT_TRUE(field.seeds(0, seeds));
  std::vector<FieldAt> at(seeds.size());
  field.at(seeds, at);
  for (std::size_t i = 0; i < seeds.size(); ++i) {
    Quad f = -1;
    for (const metaballs::Atom& a : fluid.atoms()) {
      const DVec3 d = seeds[i] - DPoint3(a.centre);
      const Quad q = Quad(lengthSquared(d)) / Quad(sqr(double(a.radius)));
      if (q < 1) f += Quad(a.weight) * (1 - q) * (1 - q) * (1 - q);
    }
    EXPECT_NEAR(double(f), at[i].value, 1e-4);
    EXPECT_GT(at[i].value, -0.1);
  }
}

}  // namespace
}  // namespace pbrt::surfels::test
