#include "tests/bench/marching_cubes.h"

#include <gtest/gtest.h>

#include <map>

#include "tests/shapes/metaballs/clouds.h"

namespace pbrt::metaballs {
namespace {

using bench::CubeLoops;
using bench::kCubeLoops;
using bench::Mesher;

using Place = std::array<float, 3>;

Place key(const Point3& p) {
  return {p.x, p.y, p.z};
}

// Times that each directed edge, named by the places of its ends, is run through, minus those of
// its reverse: all zero for a closed surface.
std::map<std::pair<Place, Place>, int> unmatched(const TriangleMesh& mesh) {
  std::map<std::pair<Place, Place>, int> edges;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const Place a = key(mesh.positions[mesh.indices[i]]);
    const Place b = key(mesh.positions[mesh.indices[i % 3 == 2 ? i - 2 : i + 1]]);
    if (a < b) ++edges[{a, b}];
    if (b < a) --edges[{b, a}];
  }
  std::erase_if(edges, [](const auto& edge) { return edge.second == 0; });
  return edges;
}

// By the divergence theorem: positive if the winding is outward.
double volume(const TriangleMesh& mesh) {
  double sum = 0;
  for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
    const auto corner = [&](int k) { return DVec3(mesh.positions[mesh.indices[i + k]]); };
    sum += glm::dot(corner(0), glm::cross(corner(1), corner(2))) / 6;
  }
  return sum;
}

// Every crossed edge lies on one loop, and the loops of the complement are the same edges.
TEST(CubeLoops, OfEveryCaseAreClosed) {
  for (int inside = 0; inside < 256; ++inside) {
    std::array<int, 12> entered{};
    for (int edge = 0; edge < 12; ++edge) {
      const int a = CubeLoops::start(edge), b = a | 1 << edge / 4;
      ASSERT_NE(a, b);
      const int next = kCubeLoops.next(inside)[edge];
      ASSERT_EQ(next >= 0, (inside >> a & 1) != (inside >> b & 1)) << inside << ' ' << edge;
      if (next >= 0) ++entered[next];
    }
    for (int edge = 0; edge < 12; ++edge)
      ASSERT_EQ(entered[edge], kCubeLoops.next(inside)[edge] >= 0) << inside << ' ' << edge;
  }
}

TEST(Mesher, SurfaceIsClosedWhateverItsShape) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Field field = test::cloud(60, Kernel::wyvill, 0.2, 1, seed);
    for (const double voxel : {0.3, 0.11, 0.03}) {
      const TriangleMesh mesh = Mesher(field, voxel).mesh();
      ASSERT_GT(mesh.triangles(), 500U);
      EXPECT_TRUE(unmatched(mesh).empty()) << seed << ' ' << voxel;
    }
  }
}

// A lone atom is a ball whose radius is known; the error falls with the square of the voxel.
TEST(Mesher, BallConverges) {
  const Field field(Kernel::wyvill, {test::atom(Kernel::wyvill, {0.1F, 0.2F, -0.3F}, 2, 2)});
  const double r = 2 * std::sqrt(1 - std::cbrt(0.5)), exact = 4 * std::numbers::pi / 3 * r * r * r;
  double last = 0;
  for (const double voxel : {0.2, 0.1, 0.05}) {
    const TriangleMesh mesh = Mesher(field, voxel).mesh();
    for (std::size_t i = 0; i < mesh.positions.size(); ++i) {
      const DVec3 out = DVec3(mesh.positions[i]) - DVec3(field.atoms()[0].centre);
      EXPECT_NEAR(glm::length(out), r, 0.5 * voxel * voxel);
      EXPECT_GT(glm::dot(out, DVec3(mesh.normals[i])), (1 - 1e-6) * glm::length(out));
    }
    const double error = exact - volume(mesh);
    EXPECT_GT(error, 0);
    if (last > 0) {
      EXPECT_NEAR(last / error, 4, 0.4);
    }
    last = error;
  }
}

// Bounds drop no piece: sampled points of the surface have a vertex nearby.
TEST(Mesher, NothingIsMissing) {
  const Field field = test::cloud(60, Kernel::wyvill, 0.2, 1, 5);
  const double voxel = 0.1;
  const TriangleMesh mesh = Mesher(field, voxel).mesh();
  std::vector<std::uint32_t> all(field.atoms().size());
  std::iota(all.begin(), all.end(), 0U);
  Bounds3 box;
  for (const Atom& atom : field.atoms()) box.add(atom.centre);
  test::Random random(7);
  int found = 0;
  for (int i = 0; i < 3000; ++i) {
    // Bisection between a place inside and one outside.
    DPoint3 in = DPoint3(box.centre()) + DVec3(box.diagonal()) * 0.6 * random.cube(), out = in;
    out += 3.0 * random.direction();
    if (!(field.sample(in, all).value > 0 && field.sample(out, all).value < 0)) continue;
    for (int k = 0; k < 40; ++k) {
      const DPoint3 middle = 0.5 * (in + out);
      (field.sample(middle, all).value > 0 ? in : out) = middle;
    }
    double nearest = kInfinity;
    for (const Point3& p : mesh.positions)
      nearest = std::min(nearest, lengthSquared(DPoint3(p) - in));
    EXPECT_LT(std::sqrt(nearest), 2 * voxel);
    ++found;
  }
  EXPECT_GT(found, 100);
}

}  // namespace
}  // namespace pbrt::metaballs
