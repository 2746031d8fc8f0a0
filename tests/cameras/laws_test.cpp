// Every camera that can be found obeys the laws of cameras: tools/laws/camera_laws.cpp.

#include "tests/cameras/lenses.h"
#include "tests/every_law.h"

namespace pbrt::test {
namespace {

std::vector<laws::Subject> forms(const PluginInfo& camera) {
  ParamList required;
  if (std::string_view(camera.name) == "realistic") required = {text("lensfile", kDoubleGauss)};
  return {{&camera, required, {}}};
}

INSTANTIATE_TEST_SUITE_P(Cameras, EveryLaw, testing::ValuesIn(everyLaw(PluginKind::camera, forms)),
                         EveryLaw::name);

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
