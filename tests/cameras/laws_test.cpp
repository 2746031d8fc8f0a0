// Every camera that can be found obeys the laws of cameras.

#include "tests/cameras/lenses.h"
#include "tests/law_sets.h"

namespace pbrt::test {
namespace {

class CameraLaws : public testing::TestWithParam<LawCase> {};

TEST_P(CameraLaws, Hold) {
  const LawCase& c = GetParam();
  ParamList required;
  if (c.subject.plugin->name == std::string("realistic"))
    required = {text("lensfile", kDoubleGauss)};
  obeyWithEach(c, {required});
}

INSTANTIATE_TEST_SUITE_P(Every, CameraLaws, testing::ValuesIn(lawCases(PluginKind::camera)),
                         nameOf);

// Thin lenses lose no light.
TEST(FlatCameras, HaveFullWeight) {
  for (const char* name : {"perspective", "orthographic"})
    for (const float radius : {0.F, 0.3F, 1e6F}) {
      const auto camera = make<Camera>(
          name, {number("lensradius", radius), number("focaldistance", 4)}, {{}, {90, 60}});
      Rng rng(2);
      for (int i = 0; i < 1000; ++i)
        EXPECT_EQ(camera->generate(randomSample(rng), false).weight, 1);
    }
}

}  // namespace
}  // namespace pbrt::test
