// Triangles, given by their corners.

#include "core/plugin/mesh_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

class TriangleMeshShape final : public MeshShape {
 public:
  explicit TriangleMeshShape(Params& p) {
    mesh_.positions = p.points("P", "positions of the vertices");
    p.require("P");
    const std::size_t vertices = mesh_.positions.size();
    if (vertices == 0 && !p.describing()) p.fail("P", "has no points");
    mesh_.indices = readIndices(p, 3, vertices);
    mesh_.normals = p.normals("N", "shading normals of the vertices");
    mesh_.tangents = p.vectors("S", "shading tangents of the vertices");
    mesh_.uv = p.points2("uv", "texture coordinates of the vertices");
    auto st = p.points2("st", "another name for uv");
    const bool hasUv = !mesh_.uv.empty();
    if (!hasUv) mesh_.uv = std::move(st);
    p.integers("faceIndices", "each face's number in a Ptex file; not used, as there is no Ptex");

    checkVertices(p, "P", mesh_.positions, vertices);
    checkVertices(p, "N", mesh_.normals, vertices);
    checkVertices(p, "S", mesh_.tangents, vertices);
    checkVertices(p, hasUv ? "uv" : "st", mesh_.uv, vertices);
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::TriangleMeshShape, "trianglemesh", "triangles with shared vertices")
