#include "tests/support.h"

namespace pbrt {
namespace {

using test::integers;
using test::points;
using test::value;

const std::vector<float> kSquare{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
const Param kP = points("P", kSquare), kIndices = integers("indices", {0, 1, 2, 0, 2, 3});

std::unique_ptr<Shape> mesh(const ParamList& list) {
  return test::make<Shape>("trianglemesh", list);
}
std::string complaint(const ParamList& list) {
  try {
    mesh(list);
  } catch (const Error& error) {
    return error.what();
  }
  return "none";
}

TEST(TriangleMesh, HandsOverWhatItWasGiven) {
  const auto shape = mesh({kP, kIndices, value(ParamType::normal, "N", kSquare),
                           value(ParamType::vector3, "S", kSquare),
                           value(ParamType::number, "uv", {0, 0, 1, 0, 1, 1, 0, 1}),
                           integers("faceIndices", {0, 1})});
  const TriangleMesh& m = *shape->triangles();
  EXPECT_EQ(m.indices, (std::vector<std::uint32_t>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(m.positions, (std::vector<Point3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(m.normals, m.positions);
  EXPECT_EQ(m.tangents, m.positions);
  EXPECT_EQ(m.uv, (std::vector<Point2>{{0, 0}, {1, 0}, {1, 1}, {0, 1}}));
}

TEST(TriangleMesh, TakesTextureCoordinatesUnderEitherNameAndType) {
  for (const ParamType type : {ParamType::number, ParamType::point2})
    for (const char* name : {"uv", "st"}) {
      const auto shape = mesh({kP, kIndices, value(type, name, {0, 0, 1, 0, 1, 1, 0, 7})});
      ASSERT_EQ(shape->triangles()->uv.size(), 4U);
      EXPECT_EQ(shape->triangles()->uv[3], Point2(0, 7));
    }
}

TEST(TriangleMesh, ThreePointsNeedNoIndices) {
  const auto shape = mesh({points("P", {0, 0, 0, 1, 0, 0, 0, 1, 0})});
  EXPECT_EQ(shape->triangles()->indices, (std::vector<std::uint32_t>{0, 1, 2}));
  EXPECT_NE(complaint({kP}).find("\"indices\" is missing"), std::string::npos);
}

TEST(TriangleMesh, KeepsTrianglesWithoutArea) {
  EXPECT_EQ(mesh({kP, integers("indices", {0, 1, 1, 2, 2, 2})})->triangles()->triangles(), 2U);
}

TEST(TriangleMesh, SaysWhatIsWrong) {
  const auto blames = [](const ParamList& list, const char* text) {
    const std::string said = complaint(list);
    EXPECT_NE(said.find(text), std::string::npos) << said;
  };
  blames({kIndices}, "\"P\" is missing");
  blames({points("P", {}), kIndices}, "\"P\" has no points");
  blames({points("P", {0, 0, 0, 1}), kIndices}, "\"P\"");
  blames({kP, integers("indices", {0, 1, 2, 3})}, "\"indices\" has 4 numbers");
  blames({kP, integers("indices", {0, 1, 4})}, "number 2 is 4");
  blames({kP, integers("indices", {0, -1, 2})}, "number 1 is -1");
  blames({kP, kIndices, value(ParamType::normal, "N", {0, 0, 1})}, "\"N\" has 1 entries");
  blames({kP, kIndices, value(ParamType::vector3, "S", {0, 0, 1})}, "\"S\"");
  blames({kP, kIndices, value(ParamType::number, "uv", {0, 0})}, "\"uv\"");
  blames({kP, kIndices, value(ParamType::number, "st", {0, 0, 1})}, "\"st\"");
  std::vector<float> broken = kSquare;
  broken[7] = std::numeric_limits<float>::quiet_NaN();
  blames({points("P", broken), kIndices}, "\"P\" is not finite at vertex 2");
  broken[7] = kInfinity;
  blames({points("P", broken), kIndices}, "\"P\" is not finite at vertex 2");
  blames({kP, kIndices, test::number("alfa", 1)}, "alfa");
}

}  // namespace
}  // namespace pbrt
