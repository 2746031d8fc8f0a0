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

void expectAllFound(std::span<const Atom> atoms, double largest) {
  std::vector<std::uint32_t> numbers;
  for (std::uint32_t j = 0; j < atoms.size(); j += 1 + j % 2) numbers.push_back(j);
  AtomHash hash;
  hash.build(atoms, numbers, largest);
  Random random(4);
  for (int i = 0; i < 200; ++i) {
    const Atom& about = atoms[random.uniform(static_cast<std::uint32_t>(atoms.size()))];
    const DPoint3 p = DPoint3(about.centre) + 2.0 * about.radius * random.cube();
    std::multiset<std::uint32_t> found;
    hash.visit(atoms, hash.frame(hash.cellAt(p)),
               [&](const AtomRun& run) { found.insert(run.number, run.number + run.count); });
    for (const std::uint32_t j : numbers) {
      const bool reaches = glm::length(p - DPoint3(atoms[j].centre)) < atoms[j].radius;
      EXPECT_LE(found.count(j), 1U);
      EXPECT_GE(found.count(j), reaches ? 1U : 0U) << j;
    }
    for (const std::uint32_t j : found) {
      EXPECT_TRUE(std::ranges::binary_search(numbers, j));
      // No farther than the cell's far corner.
      EXPECT_LT(glm::length(p - DPoint3(atoms[j].centre)),
                atoms[j].radius + 1.01 * std::sqrt(3.0) * largest);
    }
  }
}

TEST(AtomHash, FindsWhatReachesAPointOnce) {
  for (const std::size_t count : {1, 7, 300, 3000})
    for (const double scale : {1.0, 1e-6, 1e7}) expectAllFound(someAtoms(count, scale, {}), scale);
}
TEST(AtomHash, FindsItFarFromTheOrigin) {
  expectAllFound(someAtoms(300, 1, {1e6, -7e5, 3e5}), 1);
  expectAllFound(someAtoms(50, 1e-15, {1e6, -7e5, 3e5}), 1e-15);  // less than floats are apart
}
TEST(AtomHash, FindsItInSparseSpace) {
  std::vector<Atom> atoms;
  Random random(3);
  for (int i = 0; i < 500; ++i) atoms.emplace_back(Point3(1e9 * random.cube()), 1.F, 1);
  expectAllFound(atoms, 1);
}
TEST(AtomHash, HandsOutMoreThanARunHolds) {
  expectAllFound(std::vector<Atom>(2000, Atom({1, 2, 3}, 1, 1)), 1);
}

TEST(AtomHash, ComesInAnOrderThatTheCellAloneDecides) {
  const std::vector<Atom> atoms = someAtoms(500, 1, {});
  std::vector<std::uint32_t> numbers(atoms.size());
  for (std::uint32_t j = 0; j < numbers.size(); ++j) numbers[j] = j;
  const auto order = [&](const AtomHash& hash) {
    std::vector<std::uint32_t> found;
    hash.visit(atoms, hash.frame({1, 0, -1}), [&](const AtomRun& run) {
      found.insert(found.end(), run.number, run.number + run.count);
    });
    return found;
  };
  AtomHash fresh, used;
  fresh.build(atoms, numbers, 1);
  const std::vector<Atom> others = someAtoms(9000, 0.1, {});
  std::vector<std::uint32_t> theirs(others.size());
  for (std::uint32_t j = 0; j < theirs.size(); ++j) theirs[j] = j;
  used.build(others, theirs, 0.1);
  used.build(atoms, numbers, 1);
  EXPECT_FALSE(order(fresh).empty());
  EXPECT_EQ(order(used), order(fresh));
}

}  // namespace
}  // namespace pbrt::surfels::test
