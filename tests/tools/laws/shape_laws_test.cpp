// Every law of shapes finds the shape that breaks it, and no other law cries for a good one.

#include "tools/laws/shape_laws.h"

#include <set>

#include "tests/laws.h"
#include "tools/laws/allocations.h"

namespace pbrt {
namespace {

using laws::Judge;
using laws::Law;
using laws::Subject;

const Law& named(std::string_view name) {
  for (const auto& part : {laws::commonLaws(), laws::shapeLaws()})
    for (const Law& law : part)
      if (law.name == name) return law;
  throw Error("no law " + std::string(name));
}

Judge judged(const Subject& subject, std::string_view law) {
  Judge judge;
  named(law).check(subject, judge);
  return judge;
}

// -- shapes that are traced
// -------------------------------------------------------------------------

struct Flaw {
  std::string name, law, says;  // `says`: what the finding has to hold
};
void PrintTo(const Flaw& f, std::ostream* out) {
  *out << f.name;
}

class FlawedShapes : public testing::TestWithParam<Flaw> {};

Subject sphere(const std::string& flaw) {
  static const PluginInfo& plugin =
      openPlugin(PBRT_BUILD_DIR "/tests/bad_plugins/shapes/flawed.so");
  return {&plugin, {test::text("flaw", flaw)}, {}};
}

TEST_P(FlawedShapes, AreFound) {
  if (GetParam().law == "allocates-nothing" && !laws::countsAllocations())
    GTEST_SKIP() << "sanitizers have an operator new of their own";
  const Judge judge = judged(sphere(GetParam().name), GetParam().law);
  ASSERT_GT(judge.failures(), 0U);
  EXPECT_NE(judge.findings()[0].find(GetParam().says), std::string::npos) << judge.findings()[0];
}

INSTANTIATE_TEST_SUITE_P(
    Every, FlawedShapes,
    testing::Values(
        Flaw{"tight-bounds", "bounds-hold-every-hit", "outside of the bounds"},
        Flaw{"infinite-bounds", "bounds-hold-every-hit", "has the bounds (-inf, -inf, -inf) to"},
        Flaw{"nowhere", "bounds-hold-every-hit", "it is nowhere"},
        Flaw{"late-hits", "hits-lie-on-the-ray", "off the ray's own point"},
        Flaw{"other-primitive", "hits-lie-on-the-ray", "names primitive 1"},
        Flaw{"loses-hits", "lines-are-the-same-backwards", "crossings there, but"},
        Flaw{"no-shadow", "shadow-rays-agree", "occluded() says false"},
        Flaw{"behind", "range-of-t-is-kept", "not beyond tMin"},
        Flaw{"beyond", "range-of-t-is-kept", "just beyond tMax"},
        Flaw{"not-a-number", "odd-rays-are-met-as-well", "not finite"},
        Flaw{"off-the-surface", "points-lie-on-the-surface", "off the surface along"},
        Flaw{"no-error", "points-lie-on-the-surface", "off the surface along"},
        Flaw{"huge-error", "points-lie-on-the-surface", "is 1, not from 0"},
        Flaw{"long-normal", "frames-are-consistent", "has length 1.1"},
        Flaw{"wild-uv", "frames-are-consistent", "is not finite"},
        Flaw{"inward-shading", "frames-are-consistent", "shading normal"},
        Flaw{"turned-normal", "normals-do-not-turn-to-the-ray", "from the other side"},
        Flaw{"inside-out", "normals-of-closed-shapes-point-outward", "points into it"},
        Flaw{"half-derivatives", "derivatives-foretell-the-neighbourhood", "(0, 0, 0)"},
        Flaw{"wrong-curvature", "derivatives-foretell-the-neighbourhood", "its normal by"},
        Flaw{"sinks", "rays-leave-the-surface", "again at once"},
        Flaw{"shared", "thread-safe", "while other threads ask"},
        Flaw{"counts", "repeatable", "in another order"},
        Flaw{"differs", "twins", "another object"},
        Flaw{"allocates", "allocates-nothing", "asked for 1 times"},
        Flaw{"dark-colour", "colours-are-sound", "(-1, -1, -1)"},
        Flaw{"wrong-area", "area-is-how-often-lines-cross", "as often as one of 12.5"},
        Flaw{"wrong-pdf", "samples-lie-on-the-surface", "but pdf() of it is"},
        Flaw{"uneven-samples", "samples-follow-their-density", "but by sample()"},
        Flaw{"wrong-density", "density-integrates-to-one", "pdf() integrates to"},
        Flaw{"samples-inside", "samples-lie-on-the-surface", "no surface"},
        Flaw{"narrow-normals", "samples-lie-on-the-surface", "not in the cone"},
        Flaw{"no-way", "what-is-hit-may-be-hit", "mayHit() says no"}),
    [](const auto& test) {
      std::string name = test.param.name;
      std::ranges::replace(name, '-', '_');
      return name;
    });

TEST(ShapeLaws, TellOfWrongBoundsOnce) {
  for (const std::string flaw : {"nowhere", "infinite-bounds"})
    for (const Law& law : laws::shapeLaws()) {
      if (law.name == "bounds-hold-every-hit") continue;
      const Judge judge = judged(sphere(flaw), law.name);
      EXPECT_EQ(judge.failures(), 0U) << flaw << ", " << law.name << ": " << judge.findings()[0];
    }
}

TEST(ShapeLaws, LetTheGoodOnePass) {
  for (const Law& law : laws::shapeLaws()) {
    const Judge judge = judged(sphere("none"), law.name);
    EXPECT_EQ(judge.failures(), 0U) << law.name << ": " << judge.findings()[0];
    EXPECT_GT(judge.trials() + judge.skipped().size(), 0U) << law.name;
  }
}

// uv may lie beyond 1, or be missing with its derivatives.
TEST(ShapeLaws, LetAnyUvPass) {
  for (const char* uv : {"tiled-uv", "no-uv"})
    for (const Law& law : laws::shapeSurfaceLaws()) {
      const Judge judge = judged(sphere(uv), law.name);
      EXPECT_EQ(judge.failures(), 0U) << uv << ", " << law.name << ": " << judge.findings()[0];
    }
}

// A class of this test as a plug-in.
template <class Class>
const PluginInfo* plugin() {
  static const PluginInfo info = [] {
    PluginInfo own{};
    own.kind = PluginKind::shape;
    own.name = "own";
    own.create = createPlugin<Shape, Class>;
    return own;
  }();
  return &info;
}

// Unit balls far apart from one another, along a line.
template <int count, int apart>
class Beads final : public Shape {
 public:
  explicit Beads(Params&) : ball_(test::make<Shape>("sphere")) {}

  std::uint32_t primitives() const override { return count; }
  Bounds3 bounds(std::uint32_t i) const override {
    const Bounds3 b = ball_->bounds(0);
    return roundOutward(DPoint3(b.lo) + middle(i), DPoint3(b.hi) + middle(i));
  }
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t i) const override {
    auto hit = ball_->intersect(from(ray, i), 0);
    if (hit) hit->primitive = i;
    return hit;
  }
  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    ShapeHit own = hit;
    own.primitive = 0;
    SurfacePoint s = ball_->surface(from(ray, hit.primitive), own);
    s.p += middle(hit.primitive);
    s.error += 1e-15 * glm::length(s.p);
    return s;
  }

 private:
  static DVec3 middle(std::uint32_t i) { return DVec3(2, 3, 1) * double(i) * double(apart); }
  static ObjectRay from(ObjectRay ray, std::uint32_t i) {
    ray.o -= middle(i);
    return ray;
  }

  std::unique_ptr<Shape> ball_;
};

template <class Class>
void passAll() {
  for (const Law& law : laws::shapeLaws()) {
    const Judge judge = judged({plugin<Class>(), {}, {}}, law.name);
    EXPECT_EQ(judge.failures(), 0U) << law.name << ": " << judge.findings()[0];
  }
}

TEST(ShapeLaws, LetSparseShapesPass) {
  passAll<Beads<2, 20>>();
  passAll<Beads<400, 1>>();
}

TEST(ShapeLaws, HoldWhatIsCalledConvexToIt) {
  const Subject tower{&test::loader().open(PluginKind::shape, "hyperboloid"),
                      {test::points("p1", {1, 0, -1}), test::points("p2", {0.3F, 1, 1.5F})},
                      {.convex = true}};
  EXPECT_GT(judged(tower, "rays-leave-the-surface").failures(), 0U);
  EXPECT_GT(judged(tower, "grazing-rays-are-met-as-well").failures(), 0U);
}

TEST(ShapeLaws, HaveNamesOfTheirOwn) {
  std::set<std::string_view> names;
  for (const auto& part : {laws::commonLaws(), laws::shapeLaws()})
    for (const Law& law : part) EXPECT_TRUE(names.insert(law.name).second) << law.name;
}

// -- meshes
// -----------------------------------------------------------------------------------------

// A square whose vertices are changed by `change`.
template <auto change>
class Square final : public MeshShape {
 public:
  explicit Square(Params&) {
    mesh_.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    mesh_.indices = {0, 1, 2, 0, 2, 3};
    mesh_.normals.assign(4, Normal3(0, 0, 1));
    change(mesh_);
  }
};

template <auto change>
std::size_t failures(std::string_view law) {
  return judged({plugin<Square<change>>(), {}, {}}, law).failures();
}

TEST(MeshLaws, FindWhatIsWrong) {
  constexpr auto good = [](TriangleMesh&) {};
  for (const Law& law : laws::meshLaws()) EXPECT_EQ(failures<good>(law.name), 0U) << law.name;

  constexpr auto none = [](TriangleMesh& m) { m.indices.clear(); };
  constexpr auto half = [](TriangleMesh& m) { m.indices.pop_back(); };
  constexpr auto beyond = [](TriangleMesh& m) { m.indices[4] = 4; };
  constexpr auto few = [](TriangleMesh& m) { m.uv.resize(3); };
  EXPECT_EQ(failures<none>("indices-name-vertices"), 1U);
  EXPECT_EQ(failures<half>("indices-name-vertices"), 1U);
  EXPECT_EQ(failures<beyond>("indices-name-vertices"), 1U);
  EXPECT_EQ(failures<few>("indices-name-vertices"), 1U);

  constexpr auto nan = [](TriangleMesh& m) { m.positions[2].y = std::nanf(""); };
  constexpr auto infinite = [](TriangleMesh& m) { m.uv.assign(4, Point2(kInfinity)); };
  EXPECT_EQ(failures<nan>("vertices-are-finite"), 1U);
  EXPECT_EQ(failures<infinite>("vertices-are-finite"), 4U);

  constexpr auto inward = [](TriangleMesh& m) { m.normals[1].z = -1; };
  EXPECT_EQ(failures<inward>("normals-agree-with-triangles"), 1U);
  EXPECT_EQ(failures<beyond>("normals-agree-with-triangles"), 1U);

  static int made = 0;
  constexpr auto other = [](TriangleMesh& m) { m.positions[0].x = static_cast<float>(made++); };
  EXPECT_EQ(failures<other>("mesh-twins"), 1U);
}

}  // namespace
}  // namespace pbrt
