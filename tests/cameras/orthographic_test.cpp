#include "tests/support.h"

namespace pbrt {
namespace {

TEST(OrthographicCamera, RaysAreParallelFromTheirPlaceOnTheScreen) {
  const auto camera = test::make<Camera>("orthographic", {}, {{}, {400, 100}});
  for (float x = 0; x <= 400; x += 50)
    for (float y = 0; y <= 100; y += 25) {
      const Ray ray = camera->generate({{x, y}, {}, 0}, false).ray;
      EXPECT_EQ(ray.d, Vec3(0, 0, 1));
      EXPECT_LT(glm::distance(ray.o, Point3(-4 + x / 50, 1 - y / 50, 0)), 1e-6F);
    }
}

TEST(OrthographicCamera, ScreenWindowIsInSceneUnits) {
  const auto window = test::value(ParamType::number, "screenwindow", {10, 30, -5, 5});
  const auto camera = test::make<Camera>("orthographic", {window}, {{}, {200, 100}});
  EXPECT_LT(glm::distance(camera->generate({{0, 0}, {}, 0}, false).ray.o, Point3(10, 5, 0)), 1e-5F);
  EXPECT_LT(glm::distance(camera->generate({{200, 100}, {}, 0}, false).ray.o, Point3(30, -5, 0)),
            1e-5F);
}

}  // namespace
}  // namespace pbrt
