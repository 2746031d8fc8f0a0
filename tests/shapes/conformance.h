#pragma once
// Every shape plug-in of the build, made by parameters that show what it can do. A new shape is
// made with its defaults; a row of the table gives it better parameters.

#include <map>

#include "tests/laws.h"

namespace pbrt::test {

struct Row {
  std::string label;
  ParamList params;
  laws::Traits traits = {};
};

inline constexpr laws::Traits kConvex{.convex = true};

inline const std::map<std::string, std::vector<Row>> kTable = {
    {"sphere",
     {{"whole", {number("radius", 2)}, kConvex},
      {"tiny", {number("radius", 1e-6F)}, kConvex},
      {"huge", {number("radius", 1e6F)}, kConvex},
      {"part", {number("zmin", -0.5F), number("zmax", 0.8F), number("phimax", 250)}}}},
    {"disk",
     {{"whole", {}, kConvex},
      {"sector",
       {number("height", 3), number("radius", 2), number("innerradius", 0.5F),
        number("phimax", 100)},
       kConvex}}},
    {"cylinder",
     {{"whole", {}},
      {"part",
       {number("radius", 0.5F), number("zmin", 3), number("zmax", 1), number("phimax", 200)}},
      {"slender", {number("radius", 0.1F), number("zmin", -2), number("zmax", 2)}}}},
    {"cone",
     {{"whole", {}},
      {"part", {number("radius", 2), number("height", 5), number("phimax", 130)}},
      {"flat", {number("radius", 3), number("height", 1e-3F)}}}},
    {"paraboloid",
     {{"whole", {}},
      {"part", {number("radius", 2), number("zmin", 1), number("zmax", 3), number("phimax", 280)}},
      {"downward", {number("zmin", -3), number("zmax", -1)}}}},
    {"hyperboloid",
     {{"cone", {}},
      {"waisted", {points("p1", {1, 0, -1}), points("p2", {0.3F, 1, 1.5F})}},
      {"crossing",
       {points("p1", {1, 0, -1}), points("p2", {-0.5F, 0, 1}), number("phimax", 300)}}}},
    {"trianglemesh", {{"triangle", {points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0})}}}},
    {"plymesh", {{"tent", {text("filename", PBRT_SOURCE_DIR "/tests/shapes/tent.ply")}}}},
    {"heightfield",
     {{"hills",
       {integers("nu", {3}), integers("nv", {2}),
        value(ParamType::number, "Pz", {0, 1, 0, 0.5F, 0, 1})}}}},
    {"bilinearmesh",
     {{"square", {points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})}, kConvex},
      {"saddle", {points("P", {0, 0, 0, 2, 0, 1, 0, 1, 1, 2, 1, 0})}},
      {"fold",
       {points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0.3F, 1.2F, 1, 0, 0, 2, -1, 1, 2, 1}),
        integers("indices", {0, 1, 2, 3, 2, 3, 4, 5})}}}},
    {"loopsubdiv",
     {{"tetrahedron",
       {points("P", {1, 1, 1, 1, -1, -1, -1, 1, -1, -1, -1, 1}),
        integers("indices", {0, 1, 2, 0, 3, 1, 0, 2, 3, 1, 3, 2})}}}},
    {"nurbs",
     {{"saddle",
       {integers("nu", {2}), integers("nv", {2}), integers("uorder", {2}), integers("vorder", {2}),
        value(ParamType::number, "uknots", {0, 0, 1, 1}),
        value(ParamType::number, "vknots", {0, 0, 1, 1}),
        points("P", {0, 0, 0, 1, 0, 1, 0, 1, 1, 1, 1, 0})}}}},
    {"curve",
     {{"straight",
       {points("P", {0, 0, 0, 1, 0, 1, 2, 0, 2, 3, 0, 3}), number("width", 0.4F)},
       {.convex = true, .facingWidth = 0.4}},
      {"tube",
       {points("P", {0, 0, 0, 1, 0, 1, 2, 0, 2, 3, 0, 3}), number("width", 0.4F),
        text("type", "cylinder")},
       {.convex = true, .facingWidth = 0.4, .looksRound = true}},
      {"bent",
       {points("P", {0, 0, 0, 1, 0, 2, 2, 1, 1, 3, 0.5F, 3}), number("width0", 0.3F),
        number("width1", 0.2F), integers("splitdepth", {1})},
       {.facingWidth = 0.3}},
      {"round",
       {points("P", {0, 0, 0, 1, 2, 0, 2, 2, 1, 3, 0, 1, 4, -1, 1}), text("basis", "bspline"),
        integers("degree", {2}), number("width", 0.3F), text("type", "cylinder")},
       {.facingWidth = 0.3, .looksRound = true}},
      {"ribbon",
       {points("P", {0, 0, 0, 1, 0, 2, 2, 1, 1, 3, 0.5F, 3}), number("width0", 0.3F),
        number("width1", 0.3F), text("type", "ribbon"),
        value(ParamType::normal, "N", {0, 1, 0, 0, 1, 0.5F})}},
      {"twisted",
       {points("P", {0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0.3F, 3}), number("width", 1),
        text("type", "ribbon"), value(ParamType::normal, "N", {1, 0, 0, -1, 1, 0})}}}},
    {"metaballs",
     {{"ball", {points("P", {1, 2, 3})}},
      {"bridge", {points("P", {0, 0, 0, 0.8F, 0, 0, 0.3F, 0.7F, 0})}},
      {"coloured",
       {points("P", {0, 0, 0, 0.9F, 0, 0}),
        value(ParamType::rgb, "color", {1, 0, 0, 0.2F, 0.3F, 1})}}}},
};

struct Case {
  std::string shape;
  Row row;

  laws::Subject subject() const {
    return {&loader().open(PluginKind::shape, shape), row.params, row.traits};
  }
};

// Every shape of the build, once for each of its rows.
inline std::vector<Case> cases() {
  std::vector<Case> all;
  for (const std::string& shape : loader().available(PluginKind::shape)) {
    const auto rows = kTable.find(shape);
    for (const Row& row : rows == kTable.end() ? std::vector<Row>{{"defaults", {}}} : rows->second)
      all.push_back({shape, row});
  }
  return all;
}

}  // namespace pbrt::test
