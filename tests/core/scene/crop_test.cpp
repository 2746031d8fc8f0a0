// A crop has the bits that the whole picture has there: whatever scene, and whatever is stored.

#include "tests/scenes.h"

namespace pbrt {
namespace {

// Both by two samples per pixel.
void expectCropsOfTheWhole(const std::function<std::unique_ptr<Scene>(const BuildOptions&)>& make,
                           const std::vector<std::array<int, 4>>& windows) {
  BuildOptions options;
  options.samplesPerPixel = 2;
  options.aovs = kEveryAov;
  const auto scene = make(options);
  const auto end = static_cast<std::uint32_t>(scene->sampler().samplesPerPixel());
  const Image whole = test::renderScene(*scene, 0, 0, end);
  for (const std::array<int, 4>& window : windows) {
    options.pixelBounds = window;
    const Image crop = test::renderScene(*make(options), 0, 0, end);
    const auto [x0, x1, y0, y1] = window;
    ASSERT_EQ(crop.window, (Bounds2i{{x0, y0}, {x1, y1}}));
    EXPECT_EQ(crop.resolution, whole.resolution);
    ASSERT_EQ(crop.names, whole.names);
    int different = 0;
    std::size_t i = 0;
    for (int y = y0; y < y1; ++y)
      for (int x = x0; x < x1; ++x, ++i)
        for (std::size_t c = 0; c < crop.channels.size(); ++c) {
          const float expected = whole.channels[c][y * whole.resolution.x + x];
          if (crop.channels[c][i] != expected && different++ < 3)
            ADD_FAILURE() << x << ' ' << y << ' ' << crop.names[c] << ": " << crop.channels[c][i]
                          << ", not " << expected;
        }
    EXPECT_EQ(different, 0);
  }
}

// Something of everything: mesh, quadrics, an instance, metaballs, a texture that filters, motion,
// fog, glass, an area light.
std::string everything(const std::string& options) {
  return R"(
    LookAt 0 1 6  0 0 0  0 1 0
    Film "image" "integer xresolution" 75 "integer yresolution" 50
    )" + options +
         R"( WorldBegin
    LightSource "point" "rgb I" [9 9 9] "point from" [2 3 4]
    AttributeBegin
      AreaLightSource "diffuse" "rgb L" [5 6 7] "integer nsamples" 3
      Translate -2 3 1
      Shape "sphere" "float radius" 0.4
    AttributeEnd
    Texture "checks" "color" "checkerboard" "float uscale" 9 "float vscale" 9
    Material "matte" "texture Kd" "checks"
    Shape "trianglemesh" "integer indices" [0 1 2 0 2 3]
      "point P" [-5 -1 -5  -5 -1 5  5 -1 5  5 -1 -5] "float uv" [0 0 0 1 1 1 1 0]
    ObjectBegin "ball"
      Material "glass"
      Shape "sphere" "float radius" 0.6
    ObjectEnd
    AttributeBegin
      ActiveTransform EndTime
      Translate 0.3 0.1 0
      ActiveTransform All
      Translate 1.2 0 1
      ObjectInstance "ball"
    AttributeEnd
    Material "plastic"
    Shape "metaballs" "point P" [-1 0 0  -0.4 0.2 0.1] "float radius" 1 "string kernel" "wyvill"
      "float threshold" 0.4
    Shape "curve" "point P" [-2 -1 1  -2 0 1  -1 0 2  -1 1 2] "float width" 0.1
    Material "mirror"
    Translate 0.5 0.9 -1
    Shape "disk"
    WorldEnd)";
}

const std::vector<std::array<int, 4>> kWindows = {
    {21, 53, 7, 31}, {40, 41, 25, 26}, {0, 75, 33, 34}, {70, 75, 0, 50}};

class Crop : public testing::TestWithParam<std::string> {};

TEST_P(Crop, HasTheBitsOfTheWhole) {
  expectCropsOfTheWhole(
      [&](const BuildOptions& options) { return test::buildText(everything(GetParam()), options); },
      kWindows);
}

INSTANTIATE_TEST_SUITE_P(Samplers, Crop,
                         testing::Values("Sampler \"random\" Integrator \"whitted\"",
                                         "Sampler \"stratified\"", "Sampler \"lowdiscrepancy\"",
                                         "Sampler \"bestcandidate\"", "Sampler \"halton\"",
                                         "Sampler \"sobol\"", "Sampler \"zsobol\""));
INSTANTIATE_TEST_SUITE_P(
    Integrators, Crop,
    testing::Values("Integrator \"ambientocclusion\"", "Integrator \"directlighting\"",
                    "Integrator \"path\"", "Integrator \"volpath\"", "Integrator \"debug\"",
                    "SurfaceIntegrator \"directlighting\" VolumeIntegrator \"single\"",
                    "Integrator \"surfaceparticles\" \"integer particles\" 2000 "
                    "\"integer steps\" 30"));
INSTANTIATE_TEST_SUITE_P(
    Filters, Crop,
    testing::Values("PixelFilter \"box\" Integrator \"whitted\"",
                    "PixelFilter \"box\" \"float xwidth\" 0.3 \"float ywidth\" 1.5",
                    "PixelFilter \"gaussian\" \"float xwidth\" 7 \"float ywidth\" 3",
                    "PixelFilter \"mitchell\" \"float xwidth\" 1.5 \"float ywidth\" 1.5",
                    "PixelFilter \"sinc\" Integrator \"whitted\"",
                    "PixelFilter \"triangle\" \"float xwidth\" 40 \"float ywidth\" 1"));
INSTANTIATE_TEST_SUITE_P(
    Cameras, Crop,
    testing::Values("Camera \"orthographic\" \"float screenwindow\" [-3 3 -2 2]",
                    "Camera \"environment\"",
                    "Camera \"perspective\" \"float fov\" 40 \"float lensradius\" 0.1 "
                    "\"float focaldistance\" 6"));

class CropOfScene : public testing::TestWithParam<const char*> {};

TEST_P(CropOfScene, HasTheBitsOfTheWhole) {
  expectCropsOfTheWhole(
      [&](BuildOptions options) {
        options.width = 48;
        return test::buildFile(std::string(PBRT_SOURCE_DIR "/scenes/") + GetParam() + ".pbrt",
                               options);
      },
      {{11, 37, 5, 18}});
}

INSTANTIATE_TEST_SUITE_P(Scenes, CropOfScene,
                         testing::Values("cornell", "depth-of-field", "fog", "metaballs-2",
                                         "metaballs-300", "metaballs-carved", "metaballs-colors",
                                         "metaballs-file", "metaballs-glass", "metaballs-light",
                                         "metaballs-nested", "metaballs", "motion", "sphere",
                                         "spheres", "surfaceparticles", "v4"));

}  // namespace
}  // namespace pbrt
