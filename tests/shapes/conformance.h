#pragma once
// Every shape plug-in of the build, made by parameters that show what it can do. A new shape is
// made with its defaults; a row of the table gives it better parameters.

#include <map>

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/support.h"

namespace pbrt::test {

struct Row {
  std::string label;
  ParamList params;
  bool convex = false;  // no ray that leaves outward meets it again
  // Turns towards every ray. It is where the ray that met it saw it, and its points' errors say how
  // far off other rays may see it: half of this width off, and as much for the normal's tilt.
  double facingWidth = 0;
  bool looksRound = false;  // its normals, and what dp/dv is across, are those of a tube about it
};

inline const std::map<std::string, std::vector<Row>> kTable = {
    {"sphere",
     {{"whole", {number("radius", 2)}, true},
      {"tiny", {number("radius", 1e-6F)}, true},
      {"huge", {number("radius", 1e6F)}, true},
      {"part", {number("zmin", -0.5F), number("zmax", 0.8F), number("phimax", 250)}}}},
    {"disk",
     {{"whole", {}, true},
      {"sector",
       {number("height", 3), number("radius", 2), number("innerradius", 0.5F),
        number("phimax", 100)},
       true}}},
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
     {{"square", {points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1, 0})}, true},
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
       true,
       0.4},
      {"tube",
       {points("P", {0, 0, 0, 1, 0, 1, 2, 0, 2, 3, 0, 3}), number("width", 0.4F),
        text("type", "cylinder")},
       true,
       0.4,
       true},
      {"bent",
       {points("P", {0, 0, 0, 1, 0, 2, 2, 1, 1, 3, 0.5F, 3}), number("width0", 0.3F),
        number("width1", 0.2F), integers("splitdepth", {1})},
       false,
       0.3},
      {"round",
       {points("P", {0, 0, 0, 1, 2, 0, 2, 2, 1, 3, 0, 1, 4, -1, 1}), text("basis", "bspline"),
        integers("degree", {2}), number("width", 0.3F), text("type", "cylinder")},
       false,
       0.3,
       true},
      {"ribbon",
       {points("P", {0, 0, 0, 1, 0, 2, 2, 1, 1, 3, 0.5F, 3}), number("width0", 0.3F),
        number("width1", 0.3F), text("type", "ribbon"),
        value(ParamType::normal, "N", {0, 1, 0, 0, 1, 0.5F})}},
      {"twisted",
       {points("P", {0, 0, 0, 0, 0, 1, 0, 0, 2, 0, 0.3F, 3}), number("width", 1),
        text("type", "ribbon"), value(ParamType::normal, "N", {1, 0, 0, -1, 1, 0})}}}},
    {"metaballs",
     {{"ball", {points("P", {1, 2, 3})}},
      {"bridge", {points("P", {0, 0, 0, 0.8F, 0, 0, 0.3F, 0.7F, 0})}}}},
};

struct Case {
  std::string shape;
  Row row;
};

// The shapes for which keep(shape) holds. One that cannot be made is kept: its tests say why.
template <class Keep>
std::vector<Case> casesWhere(Keep keep) {
  std::vector<Case> cases;
  for (const std::string& shape : loader().available(PluginKind::shape)) {
    const auto rows = kTable.find(shape);
    for (const Row& row : rows == kTable.end() ? std::vector<Row>{{"defaults", {}}} : rows->second)
      try {
        if (keep(*make<Shape>(shape, row.params))) cases.push_back({shape, row});
      } catch (const Error&) {
        cases.push_back({shape, row});
      }
  }
  return cases;
}

struct Found {
  ShapeHit hit;
  std::uint32_t primitive = 0;
};

class Shapes : public testing::TestWithParam<Case> {
 protected:
  void SetUp() override {
    try {
      shape_ = make<Shape>(GetParam().shape, GetParam().row.params);
    } catch (const Error& error) {
      FAIL() << "give \"" << GetParam().shape << "\" parameters in the table: " << error.what();
    }
    for (std::uint32_t i = 0; i < shape_->primitives(); ++i)
      if (!shape_->bounds(i).empty()) box_.add(shape_->bounds(i));
    centre_ = DPoint3(box_.lo) * 0.5 + DPoint3(box_.hi) * 0.5;
    size_ = glm::length(DVec3(box_.hi) - DVec3(box_.lo)) / 2;
  }
  DPoint3 around(double radii) {
    return centre_ + radii * size_ * DVec3(uniformSphere({rng_.uniform(), rng_.uniform()}));
  }
  DPoint3 inBox() {
    const DVec3 u(rng_.uniform(), rng_.uniform(), rng_.uniform());
    return DPoint3(box_.lo) + u * (DVec3(box_.hi) - DVec3(box_.lo));
  }
  // A ray that is likely to hit: from outside, sometimes from within.
  ObjectRay ray() {
    const DPoint3 o = rng_.uniform() < 0.8F ? around(1.01 + 4 * rng_.uniform()) : inBox();
    return {o, (inBox() - o) * (0.2 + 2 * rng_.uniform())};
  }

  std::optional<Found> nearest(const ObjectRay& ray) const {
    std::optional<Found> best;
    for (std::uint32_t i = 0; i < shape_->primitives(); ++i)
      if (const auto hit = shape_->intersect(ray, i); hit && (!best || hit->t < best->hit.t))
        best = Found{*hit, i};
    return best;
  }
  // All crossings along a ray, each once.
  template <class Visit>
  void crossings(ObjectRay ray, Visit visit) const {
    while (const auto found = nearest(ray)) {
      visit(shape_->surface(ray, found->hit));
      ray.tMin = std::nextafter(found->hit.t, kInfinity);
    }
  }
  // Calls visit(ray, found, point) for `count` hits.
  template <class Visit>
  void forHits(int count, Visit visit) {
    int hits = 0;
    for (int tries = 0; hits < count && tries < 100 * count; ++tries) {
      const ObjectRay r = ray();
      const auto found = nearest(r);
      if (!found) continue;
      ++hits;
      visit(r, *found, shape_->surface(r, found->hit));
      if (HasFatalFailure()) return;
    }
    EXPECT_EQ(hits, count) << "the shape is hardly ever hit within its bounds";
  }

  std::unique_ptr<Shape> shape_;
  Bounds3 box_;
  DPoint3 centre_{0};
  double size_ = 0;
  Rng rng_{7};
};

inline std::string caseName(const testing::TestParamInfo<Case>& info) {
  return info.param.shape + "_" + info.param.row.label;
}
inline void PrintTo(const Case& c, std::ostream* out) {
  *out << c.shape << " " << c.row.label;
}

}  // namespace pbrt::test
