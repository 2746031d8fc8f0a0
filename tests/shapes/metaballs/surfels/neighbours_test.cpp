#include "shapes/metaballs/surfels/neighbours.h"

#include <gtest/gtest.h>

#include <bit>
#include <set>

#include "shapes/metaballs/surfels/repulsion.h"
#include "tests/shapes/metaballs/surfels/fields.h"

namespace pbrt::surfels::test {
namespace {

// Surfels in a thick shell about a place, some turned inward.
std::vector<Surfel> shell(std::size_t count, const DPoint3& centre, double size) {
  std::vector<Surfel> surfels(count);
  Rng rng(count);
  for (Surfel& s : surfels) {
    const float u = rng.uniform(), v = rng.uniform();
    s.n = uniformSphere({u, v});
    s.p = centre + size * (1 + 0.05 * rng.uniform()) * DVec3(s.n);
    if (rng.uniform() < 0.2F) s.n = -s.n;
  }
  return surfels;
}

// Some numbers to be averaged.
std::vector<float> crowdings(std::size_t count) {
  std::vector<float> result;
  for (std::size_t i = 0; i < count; ++i) result.push_back(static_cast<float>(3 + i * i % 31));
  return result;
}

std::vector<Surfel> sorted(Neighbours& neighbours, const std::vector<Surfel>& surfels,
                           double reach) {
  std::vector<Surfel> result;
  for (const std::uint32_t i : neighbours.sort(surfels, reach)) result.push_back(surfels[i]);
  neighbours.store(result, crowdings(result.size()));
  return result;
}

struct Place {
  DPoint3 centre{};
  double size = 1, reach = 0.2;
};
const Place kPlaces[] = {{{0, 0, 0}, 1, 0.2},         {{-3, 50, 1e6}, 1, 0.07},
                         {{1e-7, 0, 0}, 1e-9, 3e-10}, {{0, 0, 0}, 1e12, 1e11},
                         {{0, 0, 0}, 1, 5},           {{0, 0, 0}, 1, 0.004}};

TEST(Neighbours, EverySurfelIsInOneCell) {
  Neighbours neighbours;
  for (const Place& place : kPlaces) {
    const auto surfels = shell(3000, place.centre, place.size);
    const auto span = neighbours.sort(surfels, place.reach);
    EXPECT_EQ(std::set<std::uint32_t>(span.begin(), span.end()).size(), surfels.size());
    std::uint32_t next = 0;
    std::set<std::uint64_t> keys;
    for (const Cell& cell : neighbours.cells()) {
      EXPECT_EQ(cell.first, next);
      next += cell.count;
      EXPECT_TRUE(keys.insert(cell.key).second);
    }
    EXPECT_EQ(next, surfels.size());
  }
}

TEST(Neighbours, AllWithinTheReachAreVisitedOnce) {
  Neighbours neighbours;
  for (const Place& place : kPlaces) {
    const auto surfels = sorted(neighbours, shell(1500, place.centre, place.size), place.reach);
    for (std::size_t i = 0; i < surfels.size(); i += 7) {
      std::multiset<std::size_t> found;
      neighbours.any(surfels[i].p, [&](std::size_t j) {
        found.insert(j);
        return false;
      });
      for (std::size_t j = 0; j < surfels.size(); ++j) {
        EXPECT_LE(found.count(j), 1U);
        if (glm::length(surfels[i].p - surfels[j].p) < place.reach) {
          EXPECT_EQ(found.count(j), 1U);
        }
      }
    }
  }
}

TEST(Repulsion, IsThatOfAllPairs) {
  Neighbours neighbours;
  for (const Place& place : kPlaces) {
    // Few enough that no heap is cut short.
    const auto surfels = sorted(neighbours, shell(1000, place.centre, place.size), place.reach);
    std::vector<Repulsion> all(surfels.size());
    const std::vector<float> numbers = crowdings(surfels.size());
    repel(neighbours.view(), neighbours.cells(), all.data());
    for (std::size_t i = 0; i < surfels.size(); i += 3) {
      const Surfel& s = surfels[i];
      double sigma = 0, near = 0, count = 0, crowding = 0;
      DVec3 force{};
      for (std::size_t j = 0; j < surfels.size(); ++j) {
        const DVec3 d = (s.p - surfels[j].p) / place.reach;
        const double r = glm::length(d);
        if (r >= 1 || glm::dot(DVec3(s.n), DVec3(surfels[j].n)) <= 0) continue;
        sigma += std::pow(1 - r, 3), crowding += (1 - r) * numbers[j];
        if (j == i) continue;
        near += 1 - r, count += r < 0.99999 ? 1 : 0, force += sqr(1 - r) / r * d;
      }
      const DVec3 n(s.n);
      const DVec3 push = near > 1e-3 ? (force - glm::dot(force, n) * n) / (2 * near) : DVec3(0);
      EXPECT_NEAR(all[i].density, sigma, 2e-4 * sigma);
      EXPECT_NEAR(all[i].crowding, crowding / (1 + near), 1e-3 * crowding);
      EXPECT_NEAR(all[i].neighbours, count, 1.01);
      if (near > 1e-3 || near == 0) {
        EXPECT_LT(glm::length(DVec3(all[i].push[0], all[i].push[1], all[i].push[2]) - push), 2e-3);
      }
    }
  }
}

TEST(Repulsion, AllInstructionSetsGiveTheSameBits) {
  Neighbours neighbours;
  for (const Place& place : kPlaces) {
    const auto surfels = sorted(neighbours, shell(2000, place.centre, place.size), place.reach);
    const auto bits = [&](Repel& repel) {
      std::vector<Repulsion> all(surfels.size());
      repel(neighbours.view(), neighbours.cells(), all.data());
      std::vector<std::uint32_t> result;
      for (const Repulsion& r : all)
        for (const float x : {r.push[0], r.push[1], r.push[2], r.density, r.neighbours, r.crowding})
          result.push_back(std::bit_cast<std::uint32_t>(x));
      return result;
    };
    const auto portable = bits(*allRepels().front());
    for (std::size_t i = 1; i < allRepels().size(); ++i)
      EXPECT_EQ(bits(*allRepels()[i]), portable) << "instruction set " << i;
  }
}

// All in one place, more than one looks at: pushes stay bounded, and tell them apart.
TEST(Repulsion, OfAHeapIsBounded) {
  Neighbours neighbours;
  std::vector<Surfel> heap(5000);
  for (Surfel& s : heap) s.p = {1e6, 1, 2};
  heap = sorted(neighbours, heap, 1e-3);
  std::vector<Repulsion> all(heap.size());
  repel(neighbours.view(), neighbours.cells(), all.data());
  std::set<float> pushes;
  for (const Repulsion& r : all) {
    EXPECT_LE(std::hypot(r.push[0], r.push[1], r.push[2]), 0.5F);
    EXPECT_GE(r.density, 500);
    pushes.insert(r.push[0]);
  }
  EXPECT_GT(pushes.size(), 4000U);
}

}  // namespace
}  // namespace pbrt::surfels::test
