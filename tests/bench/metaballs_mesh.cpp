// Writes a scene anew with its metaballs as triangles: what a renderer without metaballs is given.
// For pbrt-converge, which then measures what that costs and how far off the picture is.
//
//   metaballs_mesh SCENE DIVISIONS > MESH_SCENE    voxels of the smallest radius / DIVISIONS

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <iterator>

#include "core/parse/parse.h"
#include "shapes/metaballs/input.h"
#include "tests/bench/marching_cubes.h"

namespace pbrt::metaballs::bench {
namespace {

template <class V>
void print(const char* name, const std::vector<V>& values) {
  fmt::print("\n  \"{}\" [", name);
  for (const V& v : values) fmt::print("{:.9g} {:.9g} {:.9g}  ", v.x, v.y, v.z);
  fmt::print("]");
}

void printMesh(const Directive& shape, double divisions) {
  Params params("shapes/metaballs", shape.where, {&shape.params});
  const Field field = readInput(params).field;
  if (field.kernel() != Kernel::wyvill) throw Error("only the kernel wyvill can be meshed here");
  double smallest = kInfinity;
  for (const Atom& atom : field.atoms()) smallest = std::min<double>(smallest, atom.radius);
  const TriangleMesh mesh = Mesher(field, smallest / divisions).mesh();
  fmt::print("Shape \"trianglemesh\"\n  \"integer indices\" [");
  for (const auto index : mesh.indices) fmt::print("{} ", index);
  fmt::print("]");
  print("point P", mesh.positions);
  print("normal N", mesh.normals);
  fmt::print("\n");
  fmt::print(stderr, "{} triangles\n", mesh.triangles());
}

int run(const std::string& file, double divisions) {
  std::ifstream in(file, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(in), {}};
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.text(file, text);
  std::size_t from = 0;
  for (std::size_t i = 0; i + 1 < directives.size(); ++i) {
    const Directive& d = directives[i];
    if (d.kind != DirectiveKind::Shape || d.words[0] != "metaballs") continue;
    fmt::print("{}", std::string_view(text).substr(from, d.where.begin - from));
    printMesh(d, divisions);
    from = directives[i + 1].where.begin;
  }
  fmt::print("{}", std::string_view(text).substr(from));
  return 0;
}

}  // namespace
}  // namespace pbrt::metaballs::bench

int main(int argc, char** argv) {
  const double divisions = argc == 3 ? std::strtod(argv[2], nullptr) : 0;
  if (!(divisions > 0)) {
    fmt::print(stderr, "usage: metaballs_mesh SCENE DIVISIONS > MESH_SCENE\n");
    return 2;
  }
  try {
    return pbrt::metaballs::bench::run(argv[1], divisions);
  } catch (const pbrt::Error& error) {
    for (const pbrt::Diagnostic& d : error.diagnostics())
      fmt::print(stderr, "{}\n", pbrt::format(d));
    return 3;
  }
}
