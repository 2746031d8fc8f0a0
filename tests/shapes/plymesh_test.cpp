#include <algorithm>
#include <bit>
#include <cstring>

#include "core/base/rng.h"
#include "tests/command.h"
#include "tests/support.h"

namespace pbrt {
namespace {

using namespace std::string_literals;

// A file of the format, written number by number.
class Writer {
 public:
  explicit Writer(const std::string& format) : ascii_(format == "ascii") {
    if (format == "binary_big_endian") order_ = std::endian::big;
    text = "ply\nformat " + format + " 1.0\ncomment by hand\n";
  }
  template <class T>
  Writer& put(T value) {
    if (ascii_) {
      text += std::to_string(value) + " ";
      return *this;
    }
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (order_ != std::endian::native) std::reverse(raw, raw + sizeof value);
    text.append(raw, sizeof value);
    return *this;
  }
  Writer& row() {
    if (ascii_) text += "\n";
    return *this;
  }

  std::string text;

 private:
  bool ascii_;
  std::endian order_ = std::endian::little;
};

class PlyMesh : public testing::TestWithParam<std::string> {
 protected:
  std::unique_ptr<Shape> load(const std::string& bytes, const std::string& name = "a.ply") const {
    folder_.write(name, bytes);
    return test::make<Shape>("plymesh", {test::text("filename", folder_.path() / name)});
  }
  std::string complaint(const std::string& bytes) const {
    try {
      load(bytes);
    } catch (const Error& error) {
      return error.what();
    }
    return "none";
  }
  void expectComplaint(const std::string& bytes, const std::string& text) const {
    const std::string said = complaint(bytes);
    EXPECT_NE(said.find(text), std::string::npos) << said;
    EXPECT_NE(said.find("a.ply"), std::string::npos) << said;
  }

  test::Folder folder_;
};
INSTANTIATE_TEST_SUITE_P(Format, PlyMesh,
                         testing::Values("ascii", "binary_little_endian", "binary_big_endian"),
                         [](const auto& test) { return test.param; });

// A unit square as a triangle, a quadrilateral and a pentagon, with all that a vertex can have and
// much that nobody asked for.
std::string everything(const std::string& format) {
  Writer w(format);
  w.text +=
      "element comment_like 1\nproperty list uchar short junk\nproperty int x\n"
      "element vertex 5\nproperty double x\nproperty uchar red\nproperty float y\n"
      "property float z\nproperty float nx\nproperty float ny\nproperty float nz\n"
      "property float s\nproperty list uchar int extra\nproperty float t\n"
      "element face 3\nproperty int flags\nproperty list uchar uint vertex_indices\n"
      "property list int float texcoord\nelement edge 1\nproperty int a\nend_header\n";
  w.put(std::uint8_t{2}).put(std::int16_t{-3}).put(std::int16_t{4}).put(std::int32_t{5}).row();
  const float at[5][2] = {{0, 0}, {1, 0}, {1, 1}, {0.5F, 1}, {0, 1}};
  for (const auto& p : at) {
    w.put(double{p[0]}).put(std::uint8_t{200}).put(p[1]).put(0.25F);
    w.put(0.F).put(0.5F).put(1.F).put(p[0] / 2).put(std::uint8_t{1}).put(std::int32_t{7});
    w.put(p[1] / 2).row();
  }
  const std::vector<std::vector<std::uint32_t>> faces{{2, 0, 1}, {0, 2, 3, 4}, {0, 1, 2, 3, 4}};
  for (const auto& face : faces) {
    w.put(std::int32_t{-1}).put(static_cast<std::uint8_t>(face.size()));
    for (const std::uint32_t i : face) w.put(i);
    w.put(std::int32_t{1}).put(0.5F).row();
  }
  w.put(std::int32_t{1}).row();
  return w.text;
}

void expectEverything(const Shape& shape) {
  const TriangleMesh& m = *const_cast<Shape&>(shape).triangles();
  EXPECT_EQ(m.positions,
            (std::vector<Point3>{
                {0, 0, 0.25F}, {1, 0, 0.25F}, {1, 1, 0.25F}, {0.5F, 1, 0.25F}, {0, 1, 0.25F}}));
  EXPECT_EQ(m.normals, std::vector<Normal3>(5, {0, 0.5F, 1}));
  EXPECT_EQ(m.uv, (std::vector<Point2>{{0, 0}, {0.5F, 0}, {0.5F, 0.5F}, {0.25F, 0.5F}, {0, 0.5F}}));
  EXPECT_EQ(m.indices, (std::vector<std::uint32_t>{2, 0, 1, 0, 2, 3, 0, 3, 4,  //
                                                   0, 1, 2, 0, 2, 3, 0, 3, 4}));
}

TEST_P(PlyMesh, ReadsWhatWasWritten) {
  expectEverything(*load(everything(GetParam())));
}

TEST_P(PlyMesh, ReadsGzippedFiles) {
  folder_.write("b.ply", everything(GetParam()));
  ASSERT_EQ(folder_.command("gzip b.ply").code, 0);
  expectEverything(
      *test::make<Shape>("plymesh", {test::text("filename", folder_.path() / "b.ply.gz")}));
}

TEST_P(PlyMesh, EveryBeginningOfAFileIsRefused) {
  const std::string whole = everything(GetParam());
  const std::size_t faces = whole.size() - 40;  // what follows them is not missed
  for (std::size_t length = 0; length < faces; length += 5)
    EXPECT_THROW(load(whole.substr(0, length)), Error) << length;
}

TEST_P(PlyMesh, DamageIsRefusedOrHarmless) {
  const std::string whole = everything(GetParam());
  Rng rng(3);
  for (int i = 0; i < 200; ++i) {
    std::string bytes = whole;
    for (int k = 0; k < 3; ++k)
      bytes[static_cast<std::size_t>(rng.uniform() * bytes.size())] =
          static_cast<char>(256 * rng.uniform());
    try {
      const auto shape = load(bytes);
      const TriangleMesh& m = *shape->triangles();
      for (const std::uint32_t index : m.indices) ASSERT_LT(index, m.positions.size());
      for (const Point3& p : m.positions) ASSERT_TRUE(isFinite(p));
    } catch (const Error&) {
    }
  }
}

struct Square {
  std::string vertices = "3 4 0\n1 0 0\n1 1 0\n0 1 0\n";
  std::string properties = "property float x\nproperty float y\nproperty float z\n";
  std::string list = "property list uchar int vertex_index\n";
  std::string faces = "4 0 1 2 3\n";
  std::string file(int vertexCount = 4, const char* faceCount = "1") const {
    return "ply\nformat ascii 1.0\nelement vertex " + std::to_string(vertexCount) + "\n" +
           properties + "element face " + faceCount + "\n" + list + "end_header\n" + vertices +
           faces;
  }
};

using Plain = PlyMesh;
INSTANTIATE_TEST_SUITE_P(Ascii, Plain, testing::Values("ascii"));

TEST_P(Plain, TakesEitherNameOfTheListAndOfTextureCoordinates) {
  EXPECT_EQ(load(Square().file())->triangles()->triangles(), 2U);
  for (const auto& [u, v] : {std::pair("u", "v"), {"s", "t"}, {"texture_u", "texture_v"}}) {
    Square square;
    square.properties += "property float "s + u + "\nproperty float " + v + "\n";
    square.vertices = "0 0 0 5 6\n1 0 0 5 6\n1 1 0 5 6\n0 1 0 5 6\n";
    EXPECT_EQ(load(square.file())->triangles()->uv, std::vector<Point2>(4, {5, 6}));
  }
}

TEST_P(Plain, SaysWhatIsWrongAndWhere) {
  EXPECT_THROW(test::make<Shape>("plymesh"), Error);
  EXPECT_THROW(test::make<Shape>("plymesh", {test::text("filename", "no/such.ply")}), Error);
  expectComplaint("solid cube\n", "does not begin with \"ply\"");
  expectComplaint("ply\nelement vertex 1\nend_header\n", "says no format");
  expectComplaint("ply\nformat ascii 1.0\nend_header\n", "no element \"vertex\"");
  expectComplaint("ply\nformat ascii 1.0\nelement vertex 3\nproperty half x\n", "a.ply:4:");
  expectComplaint(Square().file(1'000'000'000), "should follow");
  expectComplaint(Square().file(4, "1000000000"), "should follow");
  Square s;
  s.faces = "4 0 1 2 4\n";
  expectComplaint(s.file(), "face 0 (the first is 0) has vertex 4, but there are 4");
  expectComplaint(s.file(), "a.ply:14:");
  s.faces = "3 0 -1 2\n";
  expectComplaint(s.file(), "has vertex -1");
  s.faces = "2 0 1 \n";
  expectComplaint(s.file(), "has 2 corners");
  s.faces = "3 0 1 \n";
  expectComplaint(s.file(), "too early");
  s.faces = "3 0 1 x\n";
  expectComplaint(s.file(), "\"x\" is not a number");
  s.faces = "3 0 1 2 3\n";
  expectComplaint(s.file(), "should have ended before");
  s.faces = "-3 0 1 2\n";
  expectComplaint(s.file(), "a list cannot have -3 entries");
  s = {};
  s.list = "property list uchar int corners\n";
  expectComplaint(s.file(), "\"vertex_indices\"");
  s = {};
  s.properties = "property float x\nproperty float y\nproperty float w\n";
  expectComplaint(s.file(), "lack one of the properties x, y and z");
  s = {};
  s.vertices = "0 0 0\n1 0 nan\n1 1 0\n0 1 0\n";
  expectComplaint(s.file(), "vertex 1 (the first is 0): its position is not finite");
  s.vertices = "0 0 0\n1 0 1e39\n1 1 0\n0 1 0\n";
  expectComplaint(s.file(), "its position is not finite");
}

TEST_P(Plain, AMeshWithoutFacesIsEmpty) {
  Square s;
  s.faces = "";
  EXPECT_EQ(load(s.file(4, "0"))->triangles()->triangles(), 0U);
}

}  // namespace
}  // namespace pbrt
