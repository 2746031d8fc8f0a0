// The field that metaballs lend: against the sum over all atoms, everywhere, and against the rays.

#include <cmath>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "core/plugin/implicit_shape.h"
#include "shapes/metaballs/roots.h"
#include "shapes/metaballs/whole_field.h"
#include "tests/laws.h"

namespace pbrt::metaballs {
namespace {

// Of many sizes, some of them carving.
Field cloud(Kernel kernel, int count) {
  Rng rng(static_cast<std::uint64_t>(count));
  std::vector<Atom> atoms;
  const float extent = 0.5F * std::cbrt(static_cast<float>(count));
  for (int i = 0; i < count; ++i) {
    const Vec3 u(rng.uniform(), rng.uniform(), rng.uniform());
    const float h = 0.5F * std::exp2(2 * rng.uniform());
    atoms.push_back({extent * u, h, i % 7 == 3 ? -0.5 : 2});
  }
  return {kernel, atoms};
}

struct Exact {
  long double value = -1, gradient[3] = {};
};

Exact sumOverAll(const Field& field, const DPoint3& p) {
  Exact sum;
  withKernel(field.kernel(), [&]<class K>(K) {
    for (const Atom& atom : field.atoms()) {
      const DVec3 r = p - DPoint3(atom.centre);
      const double h2 = static_cast<double>(atom.radius) * atom.radius;
      const double q = lengthSquared(r) / h2;
      sum.value += atom.weight * K::value(q);
      for (int i = 0; i < 3; ++i) sum.gradient[i] += atom.weight * K::slope(q) * 2 / h2 * r[i];
    }
  });
  return sum;
}

class Lent : public testing::TestWithParam<std::tuple<Kernel, int>> {
 protected:
  DPoint3 place(double beyond) {
    const DPoint3 lo(whole_.bounds().lo), hi(whole_.bounds().hi);
    const DVec3 u(rng_.uniform(), rng_.uniform(), rng_.uniform());
    return lo + (hi - lo) * (u + beyond * (2.0 * u - 1.0));
  }
  Field field_ = cloud(std::get<0>(GetParam()), std::get<1>(GetParam()));
  Cells cells_{field_};
  WholeField whole_{field_, cells_};
  Rng rng_{5};
};

TEST_P(Lent, IsTheSumOverAllAtoms) {
  for (int i = 0; i < 1000; ++i) {
    const DPoint3 p = place(i % 2);  // within the bounds, and as far outside
    const FieldPoint at = whole_.at(p);
    const Exact exact = sumOverAll(field_, p);
    EXPECT_NEAR(at.value, static_cast<double>(exact.value), 1e-12);
    for (int k = 0; k < 3; ++k)
      EXPECT_NEAR(at.gradient[k], static_cast<double>(exact.gradient[k]), 1e-11);
  }
}

TEST_P(Lent, HasRangesThatHoldIt) {
  for (int i = 0; i < 1000; ++i) {
    const DPoint3 lo = place(0.2);
    const DPoint3 hi = lo + std::exp2(2 - 20.0 * rng_.uniform()) *
                                DVec3(rng_.uniform(), rng_.uniform(), rng_.uniform());
    const FieldRange range = whole_.over(lo, hi);
    for (int k = 0; k < 8; ++k) {
      const DPoint3 p = glm::clamp(lo + (hi - lo) * double{rng_.uniform()}, lo, hi);
      const FieldPoint at = whole_.at(p);
      EXPECT_TRUE(range.value.contains(at.value));
      for (int axis = 0; axis < 3; ++axis)
        EXPECT_TRUE(range.gradient[axis].contains(at.gradient[axis]));
    }
  }
}

// But for places where a support ends: some kernels bend, or jump in their slope, there.
TEST_P(Lent, HasTheHessianOfDifferences) {
  int off = 0;
  for (int i = 0; i < 200; ++i) {
    const DPoint3 p = place(0);
    const glm::dmat3 exact = whole_.hessian(p);
    const glm::dmat3 near = whole_.ImplicitField::hessian(p);
    for (int k = 0; k < 3; ++k) off += glm::length(exact[k] - near[k]) > 0.16;  // of 32 an atom
  }
  EXPECT_LE(off, 20);
}

// The general search finds what the special one does.
TEST_P(Lent, IsWhereRaysMeetTheMetaballs) {
  if (std::get<1>(GetParam()) > 100) return;
  struct Borrowed final : ImplicitField {
    explicit Borrowed(const WholeField& f) : field(f) {}
    Bounds3 bounds() const override { return field.bounds(); }
    FieldPoint at(const DPoint3& p) const override { return field.at(p); }
    FieldRange over(const DPoint3& lo, const DPoint3& hi) const override {
      return field.over(lo, hi);
    }
    const WholeField& field;
  };
  const ImplicitShape shape(std::make_unique<Borrowed>(whole_), 500);
  const DPoint3 centre(whole_.bounds().centre());
  const double size = glm::length(DVec3(whole_.bounds().diagonal()));
  int hits = 0;
  for (int i = 0; i < 200; ++i) {
    const DPoint3 o = centre + size * DVec3(uniformSphere({rng_.uniform(), rng_.uniform()}));
    const ObjectRay ray{o, glm::normalize(place(0) - o)};
    double own = kInfinity, general = kInfinity;
    for (const Cell& cell : cells_.cells())
      if (const auto t = firstCrossing(field_, cell, cells_.atoms(cell), ray))
        own = std::min(own, *t);
    for (std::uint32_t k = 0; k < shape.primitives(); ++k)
      if (const auto hit = shape.intersect(ray, k))
        general = std::min(general, double{hit->t} + hit->u);
    if (own == general) continue;
    ++hits;
    EXPECT_NEAR(own, general, 1e-10 * size);
  }
  EXPECT_GT(hits, 50);
}

INSTANTIATE_TEST_SUITE_P(
    Metaballs, Lent,
    testing::Combine(testing::Values(Kernel::poly6, Kernel::wyvill, Kernel::blob, Kernel::gaussian),
                     testing::Values(1, 9, 60, 3000)),
    [](const auto& test) {
      return std::string(kKernels[static_cast<std::size_t>(std::get<0>(test.param))]) + "_" +
             std::to_string(std::get<1>(test.param));
    });

TEST(MetaballsPlugin, LendsNoFieldWithoutASurface) {
  const auto shape = pbrt::test::make<Shape>(
      "metaballs", {pbrt::test::points("P", {0, 0, 0}), pbrt::test::number("threshold", 1e9F)});
  EXPECT_EQ(shape->implicit(), nullptr);
}

}  // namespace
}  // namespace pbrt::metaballs
