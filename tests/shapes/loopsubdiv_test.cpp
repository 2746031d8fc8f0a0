// Subdivision surfaces: the limit does not depend on how far one subdivides, and input that has
// no surface is refused.

#include <array>
#include <map>

#include "core/base/rng.h"
#include "tests/support.h"

namespace pbrt {
namespace {

struct Coarse {
  std::vector<float> points;
  std::vector<int> indices;
};

std::unique_ptr<Shape> subdivided(const Coarse& coarse, int levels) {
  return test::make<Shape>(
      "loopsubdiv", {test::points("P", coarse.points), test::integers("indices", coarse.indices),
                     test::integers("nlevels", {levels})});
}

const Coarse kOctahedron{{1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1, 0, 0, -1},
                         {0, 2, 4, 2, 1, 4, 1, 3, 4, 3, 0, 4, 2, 0, 5, 1, 2, 5, 3, 1, 5, 0, 3, 5}};

// A closed surface of random shape with vertices of valence 3, 4, 5 and more: an octahedron whose
// faces are split at random by a vertex within.
Coarse bumpy() {
  Coarse c = kOctahedron;
  Rng rng(3);
  for (int i = 0; i < 12; ++i) {
    const std::size_t f = 3 * rng.uniform(static_cast<std::uint32_t>(c.indices.size() / 3));
    const std::array<int, 3> t{c.indices[f], c.indices[f + 1], c.indices[f + 2]};
    const auto v = static_cast<int>(c.points.size() / 3);
    for (int k = 0; k < 3; ++k) {
      float sum = 0;
      for (const int corner : t) sum += c.points[3 * static_cast<std::size_t>(corner) + k];
      c.points.push_back(sum / 3 * (1.2F + 0.3F * rng.uniform()));
    }
    c.indices[f + 2] = v;
    c.indices.insert(c.indices.end(), {t[1], t[2], v, t[2], t[0], v});
  }
  return c;
}

// A sheet over n x n squares with a boundary of all valences; diagonals at random.
Coarse sheet(int n, float bump) {
  Coarse c;
  Rng rng(5);
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      const float z = bump * rng.uniform();
      c.points.insert(c.points.end(), {static_cast<float>(x), static_cast<float>(y), z});
    }
  for (int y = 0; y < n; ++y)
    for (int x = 0; x < n; ++x) {
      const int a = y * (n + 1) + x, b = a + 1, d = a + n + 1, e = d + 1;
      if (rng.uniform() < 0.5F)
        c.indices.insert(c.indices.end(), {a, b, e, a, e, d});
      else
        c.indices.insert(c.indices.end(), {a, b, d, b, e, d});
    }
  return c;
}

// The limit of a vertex of the coarse mesh is the same point with the same normal, however often
// the mesh was subdivided before: the masks are left eigenvectors of the subdivision matrix.
TEST(LoopSubdiv, LimitDoesNotDependOnTheLevel) {
  const Coarse coarse = bumpy();
  const auto first = subdivided(coarse, 0);
  for (int levels = 1; levels <= 4; ++levels) {
    const auto shape = subdivided(coarse, levels);
    for (std::size_t v = 0; v < coarse.points.size() / 3; ++v) {
      EXPECT_LE(glm::distance(shape->triangles()->positions[v], first->triangles()->positions[v]),
                1e-6);
      EXPECT_LE(glm::distance(shape->triangles()->normals[v], first->triangles()->normals[v]),
                1e-4);
    }
  }
}

// On a boundary pbrt's mask is near the limit, so the difference shrinks by four at each level.
TEST(LoopSubdiv, BoundaryConverges) {
  const Coarse coarse = sheet(4, 1);
  double before = 0;
  for (int levels = 0; levels < 5; ++levels) {
    const auto a = subdivided(coarse, levels), b = subdivided(coarse, levels + 1);
    double worst = 0;
    for (std::size_t v = 0; v < coarse.points.size() / 3; ++v)
      worst = std::max<double>(
          worst, glm::distance(a->triangles()->positions[v], b->triangles()->positions[v]));
    EXPECT_TRUE(levels == 0 || worst < before / 3) << "level " << levels;
    before = worst;
  }
}

// Normals are those of the surface: of ever smaller triangles around the vertex.
void normalsMatchFacets(const Coarse& coarse, int levels, float cosine) {
  const auto shape = subdivided(coarse, levels);
  const TriangleMesh& m = *shape->triangles();
  std::vector<Vec3> facets(m.positions.size(), Vec3(0));
  for (std::size_t t = 0; t < m.indices.size(); t += 3) {
    const Point3 a = m.positions[m.indices[t]], b = m.positions[m.indices[t + 1]],
                 c = m.positions[m.indices[t + 2]];
    for (std::size_t k = 0; k < 3; ++k) facets[m.indices[t + k]] += glm::cross(b - a, c - a);
  }
  for (std::size_t v = 0; v < m.positions.size(); ++v)
    EXPECT_GT(glm::dot(glm::normalize(facets[v]), m.normals[v]), cosine) << "vertex " << v;
}
TEST(LoopSubdiv, NormalsAreThoseOfTheSurface) {
  normalsMatchFacets(kOctahedron, 4, 0.9999F);
  normalsMatchFacets(bumpy(), 5, 0.995F);
  normalsMatchFacets(sheet(4, 1), 5, 0.995F);
}

TEST(LoopSubdiv, KeepsTopology) {
  for (int levels = 0; levels <= 4; ++levels) {
    const auto shape = subdivided(kOctahedron, levels);
    const TriangleMesh& m = *shape->triangles();
    EXPECT_EQ(m.triangles(), 8U << (2 * levels));
    EXPECT_EQ(m.positions.size(), m.triangles() / 2 + 2);  // Euler: V - E + F = 2, 2 E = 3 F
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    for (std::size_t i = 0; i < m.indices.size(); ++i)
      ++edges[{m.indices[i], m.indices[i % 3 == 2 ? i - 2 : i + 1]}];
    for (const auto& [edge, count] : edges) {
      EXPECT_EQ(count, 1);
      EXPECT_EQ(edges.count({edge.second, edge.first}), 1U);
    }
  }
}

TEST(LoopSubdiv, FlatStaysFlatAndFacesItsWinding) {
  const auto shape = subdivided(sheet(3, 0), 3);
  for (const Point3& p : shape->triangles()->positions) EXPECT_EQ(p.z, 0);
  for (const Normal3& n : shape->triangles()->normals)
    EXPECT_LE(glm::distance(n, Normal3(0, 0, 1)), 1e-6);
  // A single triangle: three corners of valence two.
  const auto one = subdivided({{0, 0, 0, 1, 0, 0, 0, 1, 0}, {0, 1, 2}}, 2);
  for (const Normal3& n : one->triangles()->normals)
    EXPECT_LE(glm::distance(n, Normal3(0, 0, 1)), 1e-6);
}

TEST(LoopSubdiv, VerticesInNoTriangleAreHarmless) {
  Coarse c = kOctahedron;
  c.points.insert(c.points.begin(), {9, 9, 9});
  for (int& i : c.indices) ++i;
  const auto shape = subdivided(c, 2), plain = subdivided(kOctahedron, 2);
  const TriangleMesh &a = *shape->triangles(), &b = *plain->triangles();
  ASSERT_EQ(a.triangles(), b.triangles());
  for (std::size_t i = 0; i < a.indices.size(); ++i)
    EXPECT_EQ(a.positions[a.indices[i]], b.positions[b.indices[i]]);
}

TEST(LoopSubdiv, WarnsOfSchemesThatThereAreNot) {
  const ParamList list{test::points("P", kOctahedron.points),
                       test::integers("indices", kOctahedron.indices),
                       test::text("scheme", "catmull-clark")};
  std::vector<std::string> warnings;
  Params params("shapes/loopsubdiv", {}, {&list}, nullptr,
                [&](const Diagnostic& d) { warnings.push_back(d.message); });
  EXPECT_TRUE(create<Shape>(test::loader().open(PluginKind::shape, "loopsubdiv"), params, {}));
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("catmull-clark"), std::string::npos);
}

TEST(LoopSubdiv, SaysWhatIsWrong) {
  const std::vector<float> points{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  const auto complaint = [&](const std::vector<int>& indices, int levels = 1) -> std::string {
    try {
      subdivided({points, indices}, levels);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  };
  EXPECT_EQ(complaint({0, 1, 2}), "none");
  EXPECT_NE(complaint({0, 1, 2, 1, 0, 3, 1, 0, 4}).find("more than two"), std::string::npos);
  EXPECT_NE(complaint({0, 1, 2, 0, 1, 3}).find("triangles 0 and 1 face opposite sides"),
            std::string::npos);
  EXPECT_NE(complaint({0, 1, 2, 0, 3, 4}).find("vertex 0 alone"), std::string::npos);
  EXPECT_NE(complaint({0, 1, 1}).find("twice"), std::string::npos);
  EXPECT_NE(complaint({0, 1}).find("three a triangle"), std::string::npos);
  EXPECT_NE(complaint({0, 1, 5}).find("number 2 is 5"), std::string::npos);
  EXPECT_NE(complaint({0, 1, -1}).find("number 2 is -1"), std::string::npos);
  EXPECT_NE(complaint({0, 1, 2, 1, 0, 3, 2, 1, 4, 0, 2, 3, 3, 2, 4}, 12).find("too many"),
            std::string::npos);
  EXPECT_THROW(subdivided(kOctahedron, -1), Error);
  EXPECT_THROW(subdivided(kOctahedron, 13), Error);
  EXPECT_THROW(test::make<Shape>("loopsubdiv"), Error);
}

}  // namespace
}  // namespace pbrt
