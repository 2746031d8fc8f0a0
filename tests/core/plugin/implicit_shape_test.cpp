// Implicit shapes against what is known of their surfaces, and before the laws of shapes.

#include "core/plugin/implicit_shape.h"

#include "core/base/rng.h"
#include "core/base/warp.h"
#include "tests/core/plugin/formulas.h"
#include "tests/laws.h"
#include "tools/laws/shape_laws.h"

namespace pbrt {
namespace {

template <class F>
std::unique_ptr<ImplicitShape> shapeOf(const F& f, std::size_t cells = 2000) {
  return std::make_unique<ImplicitShape>(std::make_unique<Formula<F>>(f), cells);
}

std::optional<ShapeHit> nearest(const Shape& shape, const ObjectRay& ray) {
  std::optional<ShapeHit> best;
  for (std::uint32_t i = 0; i < shape.primitives(); ++i)
    if (const auto hit = shape.intersect(ray, i); hit && (!best || hit->t < best->t)) best = hit;
  return best;
}

DVec3 direction(Rng& rng) {
  return glm::normalize(DVec3(uniformSphere({rng.uniform(), rng.uniform()})));
}

TEST(ImplicitShape, OfABallIsTheSphere) {
  Rng rng(1);
  for (const double r : {1.0, 1e-6, 1e6}) {
    const auto shape = shapeOf(test::Ball{r}, 500);
    for (int i = 0; i < 1000; ++i) {
      const DVec3 n = direction(rng), aside = direction(rng);
      const DPoint3 o = r * (4.0 * n + 3.0 * direction(rng));
      const ObjectRay towards{o, glm::normalize(r * (n + 0.1 * aside) - o)};
      const double b = glm::dot(towards.o, towards.d);
      const double gap = lengthSquared(towards.o - b * towards.d);
      const auto hit = nearest(*shape, towards);
      ASSERT_EQ(hit.has_value(), gap < r * r);
      if (!hit || gap > 0.9999 * r * r) continue;
      const double t = -b - std::sqrt(r * r - gap);
      EXPECT_NEAR(double{hit->t} + hit->u, t, 1e-12 * t);
      const SurfacePoint s = shape->surface(towards, *hit);
      EXPECT_NEAR(glm::length(s.p), r, 1e-15 * r);
      EXPECT_LE(s.error, 1e-14 * r);
      EXPECT_LE(glm::length(DVec3(s.n) - s.p / r), 1e-6);
      // Its normal turns as the point moves.
      EXPECT_LE(glm::length(s.dndu - s.dpdu / static_cast<float>(r)), 1e-5 * glm::length(s.dndu));
      EXPECT_LE(glm::length(s.dndv - s.dpdv / static_cast<float>(r)), 1e-5 * glm::length(s.dndv));
    }
  }
}

// The boxes hug the surface: its shell, not its inside, and no more than asked for.
TEST(ImplicitShape, HasAShellOfBoxes) {
  for (const std::size_t most : {1, 10, 1000, 30000}) {
    const auto shape = shapeOf(test::Ball{}, most);
    EXPECT_LE(shape->primitives(), most);
    if (most == 1) continue;
    EXPECT_GE(shape->primitives(), most / 4);
    double volume = 0;
    for (std::uint32_t i = 0; i < shape->primitives(); ++i) {
      const DVec3 d(shape->bounds(i).diagonal());
      volume += d.x * d.y * d.z;
    }
    // Of n boxes of edge e on the area 4 pi, n e^2 is about 1.5 * 4 pi.
    EXPECT_LT(volume, 8.3 * std::min(1.0, 40 / std::sqrt(static_cast<double>(most))));
  }
}

// Rays through known points of a surface meet it there.
template <class F, class Point>
void expectHitsAt(const F& f, const Point& point) {
  const auto shape = shapeOf(f);
  Rng rng(2);
  int missed = 0;
  for (int i = 0; i < 1600; ++i) {
    const DPoint3 p = point(DVec3(rng.uniform(), rng.uniform(), rng.uniform()));
    const DVec3 d = direction(rng);
    missed += !nearest(*shape, {p - 3.0 * d, d, 3 - 1e-4, 3 + 1e-4});
  }
  EXPECT_EQ(missed, 0);
}

TEST(ImplicitShape, HasNoHolesWhereItsFormulaIsAtItsEnd) {
  expectHitsAt(test::Brink{},
               [](const DVec3& u) { return DPoint3(1e-4, 1.8 * u.y - 0.9, 1.8 * u.z - 0.9); });
  expectHitsAt(test::Barrel{}, [](const DVec3& u) {
    const double z = 1.8 * u.z - 0.9, turn = 2 * std::numbers::pi * u.x;
    const double radius = std::sqrt(1 - sqr(0.05 + 0.001 * z * z));
    return DPoint3(radius * std::cos(turn), radius * std::sin(turn), z);
  });
}

struct Negative : test::Ball {
  template <class T>
  T operator()(const T& x, const T& y, const T& z) const {
    return -1 - sqr(x) - sqr(y) - sqr(z);
  }
};

TEST(ImplicitShape, TellsThatThereIsNone) {
  const auto shape = shapeOf(Negative{});
  EXPECT_EQ(shape->primitives(), 1U);
  EXPECT_TRUE(shape->bounds(0).empty());
  EXPECT_FALSE(shape->intersect({{0, 0, 3}, {0, 0, -1}}, 0));
  EXPECT_FALSE(shape->occluded({{0, 0, 3}, {0, 0, -1}}, 0));
}

TEST(ImplicitShape, RefusesBoundsThatAreNone) {
  struct Boundless : test::Ball {
    Bounds3 bounds() const { return {Point3(-kInfinity), Point3(1)}; }
  };
  struct Inverted : test::Ball {
    Bounds3 bounds() const { return {Point3(1), Point3(-1)}; }
  };
  EXPECT_THROW(shapeOf(Boundless{}), Error);
  EXPECT_THROW(shapeOf(Inverted{}), Error);
}

// -- the laws -------------------------------------------------------------------------------------

template <class F>
struct Read : F {
  explicit Read(Params&) {}
};
template <class F>
const PluginInfo* plugin(const char* name) {
  static const PluginInfo info{
      {}, PluginKind::shape, name, "a test", createPlugin<Shape, FormulaShape<Read<F>>>, nullptr};
  return &info;
}

std::vector<test::LawCase> cases() {
  std::vector<test::LawCase> all;
  const ParamList cells{test::integers("cells", {600})};
  for (const PluginInfo* info :
       {plugin<test::Ball>("ball"), plugin<test::Torus>("torus"), plugin<test::Gyroid>("gyroid"),
        plugin<test::BarthSextic>("barth"), plugin<test::Heart>("heart"),
        plugin<test::Solid>("solid"), plugin<test::Steep>("steep")})
    for (const laws::Law& law : laws::shapeLaws()) {
      std::string name = std::string(info->name) + "_" + std::string(law.name);
      std::ranges::replace(name, '-', '_');
      if (std::ranges::none_of(all, [&](const test::LawCase& c) { return c.name == name; }))
        all.push_back({name, {info, cells, {}}, &law});
    }
  return all;
}

class Laws : public testing::TestWithParam<test::LawCase> {};
TEST_P(Laws, AreObeyed) {
  test::obey(GetParam().subject, *GetParam().law);
}
INSTANTIATE_TEST_SUITE_P(Implicit, Laws, testing::ValuesIn(cases()),
                         [](const auto& test) { return test.param.name; });

// -- the laws find what is wrong ------------------------------------------------------------------

// A ball with something wrong.
template <int Wrong>
class BadField final : public ImplicitField {
 public:
  Bounds3 bounds() const override { return good_.bounds(); }
  FieldPoint at(const DPoint3& p) const override {
    FieldPoint f = good_.at(p);
    if (Wrong == 1) f.gradient.y *= 1.01;
    if (Wrong == 2) f.value += 1e-3;
    return f;
  }
  FieldRange over(const DPoint3& lo, const DPoint3& hi) const override {
    FieldRange f = good_.over(lo, hi);
    if (Wrong == 1) f.gradient[1] *= Range(1.01);
    if (Wrong == 3) f.value.hi = std::max(f.value.hi, f.value.lo + 1e-3);
    if (Wrong == 4) f.value = 0.9 * f.value.middle() + 0.1 * f.value;
    return f;
  }

 private:
  Formula<test::Ball> good_{test::Ball{}};
};
template <int Wrong>
struct BadShape : ImplicitShape {
  explicit BadShape(Params&) : ImplicitShape(std::make_unique<BadField<Wrong>>(), 100) {}
};
// Half of its boxes are never hit, the others too early.
struct BoxyShape final : Shape {
  explicit BoxyShape(Params&) {}
  std::uint32_t primitives() const override { return own_.primitives(); }
  Bounds3 bounds(std::uint32_t i) const override { return own_.bounds(i); }
  std::optional<ShapeHit> intersect(const ObjectRay& ray, std::uint32_t i) const override {
    if (i % 2) return {};
    auto hit = own_.intersect(ray, i);
    if (hit) hit->t *= 0.999F;
    return hit;
  }
  SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const override {
    SurfacePoint s = own_.surface(ray, hit);
    s.p = ray.at(hit.t);
    return s;
  }
  const ImplicitField* implicit() const override { return own_.implicit(); }
  ImplicitShape own_{std::make_unique<Formula<test::Ball>>(test::Ball{}), 100};
};

template <class Class>
std::size_t failuresOf(std::string_view name) {
  const PluginInfo info{{}, PluginKind::shape, "bad", "", createPlugin<Shape, Class>, nullptr};
  for (const laws::Law& law : laws::implicitLaws())
    if (law.name == name) {
      laws::Judge judge;
      law.check({&info, {}, {}}, judge);
      EXPECT_EQ(judge.findings().empty(), judge.failures() == 0);
      return judge.failures();
    }
  ADD_FAILURE() << name;
  return 0;
}

TEST(ImplicitLaws, FindWhatIsWrong) {
  EXPECT_GT(failuresOf<BadShape<1>>("field-gradient-is-its-slope"), 0U);
  EXPECT_GT(failuresOf<BadShape<2>>("field-ranges-hold"), 0U);
  EXPECT_GT(failuresOf<BadShape<3>>("field-ranges-shrink"), 0U);
  EXPECT_GT(failuresOf<BadShape<4>>("field-ranges-hold"), 0U);
  EXPECT_GT(failuresOf<BoxyShape>("hits-are-zeros-of-the-field"), 0U);
  EXPECT_GT(failuresOf<BoxyShape>("no-zero-of-the-field-is-missed"), 0U);
}

}  // namespace
}  // namespace pbrt
