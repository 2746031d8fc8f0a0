// Real scenes against pictures of them by pbrt itself, where those are at hand (../shared).
// Averages over blocks leave little noise; what is left over must be the differences between the
// generations that docs/scene-format.md names.

#include <cstdio>

#include "tests/scenes.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

struct Reference {
  std::string name, scene, picture;
  std::string dialect, integrator;  // empty: as the scene says
  int samples;
  double tolerance;  // of the block means: rms difference, most of it noise
};

void PrintTo(const Reference& r, std::ostream* out) {
  *out << r.name;
}

// Means over blocks of 10 x 10 pixels, of values clipped to what a screen shows: an edge of a lamp
// that is a thousand times brighter would drown everything else.
std::vector<double> blockMeans(const Image& image, const char* channel) {
  constexpr int kBlock = 10;
  const std::vector<float>& pixels = *image.channel(channel);
  const int width = image.window.width(), height = image.window.height();
  std::vector<double> means;
  for (int y = 0; y + kBlock <= height; y += kBlock)
    for (int x = 0; x + kBlock <= width; x += kBlock) {
      double sum = 0;
      for (int j = 0; j < kBlock; ++j)
        for (int i = 0; i < kBlock; ++i)
          sum += std::clamp(pixels[(y + j) * width + x + i], 0.F, 1.F);
      means.push_back(sum / (kBlock * kBlock));
    }
  return means;
}

class ReferencePicture : public testing::TestWithParam<Reference> {};

TEST_P(ReferencePicture, IsMatched) {
  const Reference& r = GetParam();
  const fs::path shared = PBRT_SOURCE_DIR "/../shared";
  const fs::path scene = shared / "scenes" / r.scene, picture = shared / "refs" / r.picture;
  if (!fs::exists(scene) || !fs::exists(picture)) GTEST_SKIP() << "no " << picture;

  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  if (!r.integrator.empty())
    parser.text("integrator", "SurfaceIntegrator \"" + r.integrator + "\"");
  parser.file(scene);
  if (!r.integrator.empty())
    std::erase_if(directives, [&](const Directive& d) {
      return d.kind == DirectiveKind::SurfaceIntegrator && &d != directives.data();
    });
  BuildOptions options;
  options.samplesPerPixel = r.samples;
  options.dialect = dialectByName(r.dialect);
  const auto built = buildScene(std::move(directives), test::loader(), options);
  const Image ours = test::renderScene(*built), theirs = readExr(picture);
  ASSERT_EQ(ours.window, theirs.window);

  for (const char* channel : {"R", "G", "B"}) {
    const auto a = blockMeans(ours, channel), b = blockMeans(theirs, channel);
    double sumA = 0, sumB = 0, squares = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
      sumA += a[i], sumB += b[i];
      squares += sqr(a[i] - b[i]);
    }
    const double rms = std::sqrt(squares / static_cast<double>(a.size()));
    std::printf("%-28s %s  mean %+.2f %%  rms of block means %.4f\n", r.name.c_str(), channel,
                100 * (sumA / sumB - 1), rms);
    EXPECT_NEAR(sumA, sumB, 0.01 * sumB) << channel;
    EXPECT_LT(rms, r.tolerance) << channel;
  }
}

INSTANTIATE_TEST_SUITE_P(
    Renders, ReferencePicture,
    testing::Values(Reference{"v1_simple", "v1/simple.pbrt", "v1-simple.exr", "v1", "", 16, 0.008},
                    Reference{"v1_checkerboard", "v1/checkerboard.pbrt", "v1-checkerboard.exr",
                              "v1", "", 16, 0.01},
                    Reference{"v1_balls", "v1/balls.pbrt", "v1-balls.exr", "", "", 2, 0.01},
                    Reference{"v1_areapot", "v1/areapot.pbrt", "v1-areapot.exr", "v1", "", 16,
                              0.012},
                    Reference{"v2_killeroo_directlighting", "v2/killeroo-simple.pbrt",
                              "v2-killeroo-directlighting-32spp.exr", "", "", 4, 0.006},
                    Reference{"v2_killeroo_whitted", "v2/killeroo-simple.pbrt",
                              "v2-killeroo-whitted-64spp.exr", "", "whitted", 8, 0.006},
                    Reference{"v3_killeroo_directlighting", "v3/killeroos/killeroo-simple.pbrt",
                              "v3-killeroo-directlighting-64spp.exr", "", "", 4, 0.006}),
    [](const auto& test) { return test.param.name; });

}  // namespace
}  // namespace pbrt
