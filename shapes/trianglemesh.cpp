// Triangles, given by their corners.

#include <fmt/format.h>

#include "core/plugin/plugin.h"

namespace pbrt {

class TriangleMeshShape final : public MeshShape {
 public:
  explicit TriangleMeshShape(Params& p) {
    mesh_.positions = p.points("P", "positions of the vertices");
    p.require("P");
    if (mesh_.positions.empty() && !p.describing()) p.fail("P", "has no points");
    readIndices(p);
    mesh_.normals = p.normals("N", "shading normals of the vertices");
    mesh_.tangents = p.vectors("S", "shading tangents of the vertices");
    mesh_.uv = p.points2("uv", "texture coordinates of the vertices");
    auto st = p.points2("st", "another name for uv");
    const bool hasUv = !mesh_.uv.empty();
    if (!hasUv) mesh_.uv = std::move(st);
    p.integers("faceIndices", "numbers of the faces for Ptex; not used");

    checkVertices(p, "P", mesh_.positions);
    checkVertices(p, "N", mesh_.normals);
    checkVertices(p, "S", mesh_.tangents);
    checkVertices(p, hasUv ? "uv" : "st", mesh_.uv);
  }

 private:
  void readIndices(Params& p) {
    const std::vector<int> given = p.integers("indices", "three vertices a triangle, from 0");
    const std::size_t n = mesh_.positions.size();
    if (!p.has("indices")) {
      if (n != 3 && !p.describing()) p.fail("indices", "is missing (only 3 points need none)");
      mesh_.indices = {0, 1, 2};
      return;
    }
    if (given.size() % 3 != 0)
      p.fail("indices", fmt::format("has {} numbers, not three a triangle", given.size()));
    mesh_.indices.reserve(given.size());
    for (std::size_t i = 0; i < given.size(); ++i) {
      if (given[i] < 0 || static_cast<std::size_t>(given[i]) >= n)
        p.fail("indices",
               fmt::format("number {} is {}, but there are {} vertices, from 0", i, given[i], n));
      mesh_.indices.push_back(static_cast<std::uint32_t>(given[i]));
    }
  }

  template <class V>
  void checkVertices(const Params& p, const char* name, const std::vector<V>& values) const {
    const std::size_t n = mesh_.positions.size();
    if (!values.empty() && values.size() != n)
      p.fail(name, fmt::format("has {} entries for {} vertices", values.size(), n));
    for (std::size_t i = 0; i < values.size(); ++i)
      // Zero times a number is zero; times infinity or NaN it is NaN.
      if (!std::isfinite(glm::dot(values[i], V(0))))
        p.fail(name, fmt::format("is not finite at vertex {}", i));
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::TriangleMeshShape, "trianglemesh", "triangles with shared vertices")
