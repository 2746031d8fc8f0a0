// Every shape of the build obeys the laws of shapes.

#include "tests/shapes/conformance.h"

#include "tools/laws/shape_laws.h"
#include "tools/laws/shape_probe.h"

namespace pbrt {
namespace {

using test::Case;
using test::LawCase;

class ShapeLaws : public testing::TestWithParam<LawCase> {};

TEST_P(ShapeLaws, Obeys) {
  test::obey(GetParam().subject, *GetParam().law);
}

// Those laws that have something to say of the shape. One that cannot be made gets those of every
// plug-in: they say why.
std::vector<LawCase> lawCases() {
  std::vector<LawCase> all;
  for (const Case& c : test::cases()) {
    const auto add = [&](std::span<const laws::Law> some) {
      for (const laws::Law& law : some) {
        std::string name = c.shape + "_" + c.row.label + "_" + std::string(law.name);
        std::ranges::replace(name, '-', '_');
        all.push_back({name, c.subject(), &law});
      }
    };
    add(laws::commonLaws());
    try {
      const auto shape = c.subject().make<Shape>();
      if (shape->triangles()) {
        add(laws::meshLaws());
        continue;
      }
      add(laws::shapeHitLaws());
      add(laws::shapeSurfaceLaws());
      add(laws::shapeObjectLaws());
      if (shape->color()) add(laws::shapeColourLaws());
      if (shape->areaSampler()) add(laws::shapeAreaLaws());
      if (shape->implicit()) add(laws::implicitLaws());
    } catch (const Error& error) {
      ADD_FAILURE() << "give \"" << c.shape << "\" parameters in the table: " << error.what();
    }
  }
  return all;
}

// Those of this project: a law would ask too much of others.
TEST(Shapes, HaveUvFromZeroToOne) {
  for (const Case& c : test::cases()) {
    SCOPED_TRACE(c.shape + " " + c.row.label);
    laws::ShapeProbe probe(c.subject());
    if (probe.shape().triangles()) continue;
    laws::Judge judge;
    probe.forHits(1000, judge, [&](const ObjectRay&, const laws::Found&, const SurfacePoint& s) {
      EXPECT_GE(std::min(s.uv.x, s.uv.y), -1e-6F);
      EXPECT_LE(std::max(s.uv.x, s.uv.y), 1 + 1e-6F);
    });
  }
}

INSTANTIATE_TEST_SUITE_P(Every, ShapeLaws, testing::ValuesIn(lawCases()),
                         [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pbrt
