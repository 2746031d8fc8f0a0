// A mesh from a PLY file.

#include <fmt/format.h>

#include "core/plugin/plugin.h"
#include "shapes/files/ply.h"

namespace pbrt {

class PlyMesh final : public MeshShape {
 public:
  explicit PlyMesh(Params& p) {
    const std::filesystem::path file = p.file("filename", "a PLY file; may be gzipped");
    p.require("filename");
    p.positive("edgelength", 1, "of displaced triangles; not used");
    if (p.optionalFloatTexture("displacement", "moves the surface along its normals; not used"))
      p.warn("displacement", "is not known yet: the mesh stays as it is");
    if (p.describing()) return;
    try {
      read(files::Input(file));
    } catch (const Error& error) {
      throw error.at(p.where());
    }
    if (mesh_.indices.empty()) p.warn("filename", "names a mesh without faces: " + file.string());
  }

 private:
  using Names = std::vector<std::string_view>;  // of one property; the first that is there

  void read(const files::Input& input) {
    files::PlyFile file(input);
    bool hasVertices = false, hasFaces = false;
    for (const files::PlyElement& element : file.elements()) {
      if (element.name == "vertex" && !hasVertices) {
        readVertices(file, element, input);
        hasVertices = true;
      } else if (element.name == "face" && !hasFaces) {
        if (!hasVertices) input.fail("has its faces before the vertices");
        readFaces(file, element, input);
        hasFaces = true;
      } else if (!(hasVertices && hasFaces)) {
        file.skip(element);
      }
    }
    if (!hasVertices) input.fail("has no element \"vertex\"");
    if (!hasFaces) input.fail("has no element \"face\"");
  }

  void readVertices(files::PlyFile& file, const files::PlyElement& vertices,
                    const files::Input& input) {
    if (vertices.count > 0xffffffffU)
      input.fail(fmt::format("has {} vertices; 2^32 - 1 are the most", vertices.count));
    file.checkRoom(vertices);
    std::vector<std::optional<files::Target>> targets(vertices.properties.size());
    // Whether the file has all of these properties, which are the components of `values`.
    const auto take = [&](auto& values, std::initializer_list<Names> components) {
      std::vector<std::size_t> found;
      for (const Names& names : components)
        if (const auto i = vertices.find(names); i && !vertices.properties[*i].lengthType)
          found.push_back(*i);
      if (found.size() != components.size()) return false;
      values.resize(vertices.count);
      for (std::size_t k = 0; k < found.size() && !values.empty(); ++k)
        targets[found[k]] = {&values[0][static_cast<int>(k)], found.size()};
      return true;
    };
    if (!take(mesh_.positions, {{"x"}, {"y"}, {"z"}}))
      input.fail("its vertices lack one of the properties x, y and z");
    take(mesh_.normals, {{"nx"}, {"ny"}, {"nz"}});
    take(mesh_.uv, {{"u", "s", "texture_u", "texture_s"}, {"v", "t", "texture_v", "texture_t"}});
    file.read(vertices, targets);
    checkFinite(mesh_.positions, "position", input);
    checkFinite(mesh_.normals, "normal", input);
    checkFinite(mesh_.uv, "texture coordinates", input);
  }

  template <class V>
  static void checkFinite(const std::vector<V>& values, const char* what,
                          const files::Input& input) {
    for (std::size_t i = 0; i < values.size(); ++i)
      // Zero times a number is zero; times infinity or NaN it is NaN.
      if (!std::isfinite(glm::dot(values[i], V(0))))
        input.fail(fmt::format("vertex {} (the first is 0): its {} is not finite", i, what));
  }

  // A face of more than three corners becomes a fan about the first.
  void readFaces(files::PlyFile& file, const files::PlyElement& faces, const files::Input& input) {
    const auto property = faces.find(Names{"vertex_indices", "vertex_index"});
    if (!property || !faces.properties[*property].lengthType)
      input.fail("its faces lack the list \"vertex_indices\"");
    file.checkRoom(faces);
    mesh_.indices.reserve(3 * faces.count);
    const auto vertices = static_cast<double>(mesh_.positions.size());
    file.readLists(faces, *property, [&](std::size_t face, std::span<const double> corners) {
      const auto fail = [&](const std::string& what) {
        file.fail(fmt::format("face {} (the first is 0) {}", face, what));
      };
      if (corners.size() < 3) fail(fmt::format("has {} corners", corners.size()));
      for (const double corner : corners)
        if (!(corner >= 0 && corner < vertices && corner == std::floor(corner)))
          fail(fmt::format("has vertex {}, but there are {}, from 0", corner, vertices));
      for (std::size_t i = 2; i < corners.size(); ++i)
        for (const double corner : {corners[0], corners[i - 1], corners[i]})
          mesh_.indices.push_back(static_cast<std::uint32_t>(corner));
    });
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::PlyMesh, "plymesh", "a mesh of triangles from a PLY file")
