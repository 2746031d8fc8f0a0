// What a shape promises that is handed over as triangles.

#include "shape_laws.h"
#include "shape_probe.h"

namespace pbrt::laws {
namespace {

template <void (*body)(const TriangleMesh&, Judge&)>
void ofMesh(const Subject& subject, Judge& judge) {
  const auto shape = subject.make<Shape>();
  if (!shape->triangles()) return judge.skip("it is asked ray by ray");
  body(*shape->triangles(), judge);
}

// Whether the corners of all triangles are there.
bool hasItsCorners(const TriangleMesh& mesh) {
  return mesh.indices.size() % 3 == 0 && std::ranges::all_of(mesh.indices, [&](std::uint32_t i) {
           return i < mesh.positions.size();
         });
}

void indicesNameVertices(const TriangleMesh& mesh, Judge& judge) {
  const std::size_t n = mesh.positions.size();
  judge.expect(!mesh.indices.empty(), "there is no triangle");
  judge.expect(mesh.indices.size() % 3 == 0, "{} indices are not three a triangle",
               mesh.indices.size());
  for (std::size_t k = 0; k < mesh.indices.size(); ++k)
    judge.expect(mesh.indices[k] < n, "index {} names vertex {} of {}", k, mesh.indices[k], n);
  const std::pair<const char*, std::size_t> lists[] = {
      {"normals", mesh.normals.size()}, {"tangents", mesh.tangents.size()}, {"uv", mesh.uv.size()}};
  for (const auto& [what, size] : lists)
    judge.expect(size == 0 || size == n, "there are {} {} for {} vertices", size, what, n);
}

void verticesAreFinite(const TriangleMesh& mesh, Judge& judge) {
  const auto check = [&](const char* what, const auto& values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
      bool finite = true;
      for (int k = 0; k < values[i].length(); ++k) finite &= std::isfinite(values[i][k]);
      judge.expect(finite, "{} of vertex {}: {}", what, i, show(values[i]));
    }
  };
  check("position", mesh.positions);
  check("normal", mesh.normals);
  check("tangent", mesh.tangents);
  check("uv", mesh.uv);
}

// Normals lie on the side from which the triangles run counter-clockwise.
void normalsAgreeWithTriangles(const TriangleMesh& mesh, Judge& judge) {
  if (mesh.normals.empty()) return judge.skip("it has no normals");
  if (!hasItsCorners(mesh) || mesh.normals.size() != mesh.positions.size())
    return judge.fail("its indices are wrong");
  Tally tally;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const std::uint32_t* t = &mesh.indices[i - i % 3];
    const Point3 a = mesh.positions[t[0]], b = mesh.positions[t[1]], c = mesh.positions[t[2]];
    const Vec3 facet = glm::cross(b - a, c - a);
    const Normal3 n = mesh.normals[mesh.indices[i]];
    tally.expect(
        !(lengthSquared(facet) > 0) || glm::dot(facet, n) > 0,
        "the normal {} of vertex {} at {} is on the other side of triangle {}, which looks "
        "to {}",
        show(n), mesh.indices[i], show(mesh.positions[mesh.indices[i]]), i / 3, show(facet));
  }
  tally.judge(judge, static_cast<int>(mesh.indices.size() / 100));
}

void twins(const Subject& subject, Judge& judge) {
  const auto one = subject.make<Shape>(), other = subject.make<Shape>();
  if (!one->triangles()) return judge.skip("it is asked ray by ray");
  const TriangleMesh &a = *one->triangles(), &b = *other->triangles();
  const auto same = [&](const char* what, const auto& x, const auto& y) {
    judge.expect(x == y, "two objects of the same parameters have unlike {}", what);
  };
  same("indices", a.indices, b.indices);
  same("positions", a.positions, b.positions);
  same("normals", a.normals, b.normals);
  same("tangents", a.tangents, b.tangents);
  same("uv", a.uv, b.uv);
}

constexpr Law kLaws[] = {
    {"indices-name-vertices", "Indices are three a triangle, attributes one a vertex, or absent.",
     ofMesh<indicesNameVertices>},
    {"vertices-are-finite", "Positions, normals, tangents and uv are numbers.",
     ofMesh<verticesAreFinite>},
    {"normals-agree-with-triangles",
     "Normals lie on the side from which triangles run counter-clockwise.",
     ofMesh<normalsAgreeWithTriangles>},
    {"mesh-twins", "Two objects of the same parameters are the same triangles.", twins},
};

}  // namespace

std::span<const Law> meshLaws() {
  return kLaws;
}

}  // namespace pbrt::laws
