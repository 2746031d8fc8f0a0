#include "tests/support.h"

namespace pbrt {
namespace {

using test::integers;
using test::value;

Param heights(std::vector<float> z) {
  return value(ParamType::number, "Pz", std::move(z));
}
const Param kNu = integers("nu", {3}), kNv = integers("nv", {2});

TEST(HeightField, IsAGridOfTrianglesOverTheUnitSquare) {
  const auto shape = test::make<Shape>("heightfield", {kNu, kNv, heights({0, 1, 2, 3, 4, 5})});
  const TriangleMesh& m = *shape->triangles();
  EXPECT_EQ(m.positions,
            (std::vector<Point3>{
                {0, 0, 0}, {0.5F, 0, 1}, {1, 0, 2}, {0, 1, 3}, {0.5F, 1, 4}, {1, 1, 5}}));
  ASSERT_EQ(m.uv.size(), 6U);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(m.uv[i], Point2(m.positions[i]));
  EXPECT_TRUE(m.normals.empty());
  EXPECT_EQ(m.indices, (std::vector<std::uint32_t>{0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4}));
  // All face upward, and cover the square once.
  double area = 0;
  for (std::size_t i = 0; i < m.indices.size(); i += 3) {
    const Point3 a = m.positions[m.indices[i]];
    const float z =
        glm::cross(m.positions[m.indices[i + 1]] - a, m.positions[m.indices[i + 2]] - a).z;
    EXPECT_GT(z, 0);
    area += z / 2;
  }
  EXPECT_EQ(area, 1);
}

TEST(HeightField, SaysWhatIsWrong) {
  const auto blames = [](const ParamList& list, const char* text) {
    try {
      test::make<Shape>("heightfield", list);
      ADD_FAILURE() << "accepts that " << text;
    } catch (const Error& error) {
      EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    }
  };
  blames({kNu, kNv}, "\"Pz\" is missing");
  blames({kNu, heights({1, 2})}, "\"nv\" is missing");
  blames({integers("nu", {1}), kNv, heights({1, 2})}, "\"nu\"");
  blames({kNu, kNv, heights({0, 1, 2, 3, 4})}, "has 5 heights; 6 are nu times nv");
  blames({kNu, kNv, heights({0, 1, 2, 3, kInfinity, 5})}, "height 4 is not finite");
}

}  // namespace
}  // namespace pbrt
