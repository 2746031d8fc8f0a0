// The atoms that touch a cell, against a look at every atom.

#include "shapes/metaballs/surfels/atom_hash.h"

#include <gtest/gtest.h>

#include <set>

#include "tests/shapes/metaballs/clouds.h"

namespace pbrt::surfels::test {
namespace {

using metaballs::test::Random;

// At `scale` about `from`, radii from a quarter of the scale on.
std::vector<Atom> someAtoms(std::size_t count, double scale, const DPoint3& from) {
  Random random(8);
  std::vector<Atom> atoms;
  for (std::size_t i = 0; i < count; ++i)
    atoms.emplace_back(Point3(from + 6 * scale * random.cube()),
                       static_cast<float>(scale * random.in(0.25, 1)), 1);
  return atoms;
}

void expectAllFound(HashKind kind, std::span<const Atom> atoms, double largest) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t j = 0; j < atoms.size(); j += 1 + j % 2) numbers.push_back(j);
  AtomHash hash;
  hash.build(atoms, numbers, largest, kind);
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Atom& about = atoms[random.uniform(static_cast<std::uint32_t>(atoms.size()))];
    const DPoint3 p = DPoint3(about.centre) + 2.0 * about.radius * random.cube();
    std::multiset<std::uint32_t> found;
    hash.visit(hash.cellAt(p), [&](const CellFrame&, const AtomRun& run) {
      found.insert(run.number, run.number + run.count);
    });
    for (const std::uint32_t j : numbers) {
      const bool reaches = glm::length(p - DPoint3(atoms[j].centre)) < atoms[j].radius;
      EXPECT_LE(found.count(j), 1U);
      EXPECT_GE(found.count(j), reaches ? 1U : 0U) << j;
    }
    for (const std::uint32_t j : found) {
      EXPECT_TRUE(std::ranges::binary_search(numbers, j));
      // In a cell that touches this one.
      EXPECT_LT(glm::length(p - DPoint3(atoms[j].centre)), 2.01 * std::sqrt(3.0) * largest);
    }
  }
}

class AtomHashOf : public testing::TestWithParam<HashKind> {};
INSTANTIATE_TEST_SUITE_P(Kinds, AtomHashOf,
                         testing::Values(HashKind::traditional, HashKind::inverted),
                         [](const auto& test) {
                           return test.param == HashKind::traditional ? "traditional" : "inverted";
                         });

TEST_P(AtomHashOf, FindsWhatReachesAPointOnce) {
  for (const std::size_t count : {1, 7, 300, 3000})
    for (const double scale : {1.0, 1e-6, 1e7})
      expectAllFound(GetParam(), someAtoms(count, scale, {}), scale);
}
TEST_P(AtomHashOf, FindsItFarFromTheOrigin) {
  expectAllFound(GetParam(), someAtoms(300, 1, {1e6, -7e5, 3e5}), 1);
  expectAllFound(GetParam(), someAtoms(50, 1e-15, {1e6, -7e5, 3e5}),
                 1e-15);  // less than floats are apart
}
TEST_P(AtomHashOf, FindsItInSparseSpace) {
  std::vector<Atom> atoms;
  Random random(3);
  for (int i = 0; i < 500; ++i) atoms.emplace_back(Point3(1e9 * random.cube()), 1.F, 1);
  expectAllFound(GetParam(), atoms, 1);
}
TEST_P(AtomHashOf, HandsOutMoreThanARunHolds) {
  expectAllFound(GetParam(), std::vector<Atom>(2000, Atom({1, 2, 3}, 1, 1)), 1);
}

TEST_P(AtomHashOf, ComesInAnOrderThatTheCellAloneDecides) {
  const std::vector<Atom> atoms = someAtoms(500, 1, {});
  std::vector<std::uint32_t> numbers(atoms.size());
  for (std::uint32_t j = 0; j < numbers.size(); ++j) numbers[j] = j;
  const auto order = [&](const AtomHash& hash) {
    std::vector<std::uint32_t> found;
    hash.visit({1, 0, -1}, [&](const CellFrame&, const AtomRun& run) {
      found.insert(found.end(), run.number, run.number + run.count);
    });
    return found;
  };
  AtomHash fresh, used;
  fresh.build(atoms, numbers, 1, GetParam());
  const std::vector<Atom> others = someAtoms(9000, 0.1, {});
  std::vector<std::uint32_t> theirs(others.size());
  for (std::uint32_t j = 0; j < theirs.size(); ++j) theirs[j] = j;
  used.build(others, theirs, 0.1, GetParam());
  used.build(atoms, numbers, 1, GetParam());
  EXPECT_FALSE(order(fresh).empty());
  EXPECT_EQ(order(used), order(fresh));
}

}  // namespace
}  // namespace pbrt::surfels::test
