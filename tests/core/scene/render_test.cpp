// The same scene, seed and samples give the same bits, however they are computed.

#include "core/scene/render.h"

#include <thread>

#include "core/base/rng.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

// Something of everything: mesh, quadrics, an instance, metaballs, glass, a texture that filters,
// an area light, a filter that reaches over tiles.
std::string everything(const std::string& sampler, const std::string& integrator) {
  return R"(
    LookAt 0 1 6  0 0 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "image" "integer xresolution" 75 "integer yresolution" 50
    PixelFilter "mitchell"
    Sampler ")" +
         sampler + R"("
    Integrator ")" +
         integrator + R"("
    WorldBegin
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
      Translate 1.2 0 1
      ObjectInstance "ball"
    AttributeEnd
    Material "plastic"
    Shape "metaballs" "point P" [-1 0 0  -0.4 0.2 0.1] "float radius" 1 "string kernel" "wyvill"
      "float threshold" 0.4
    Material "mirror"
    Translate 0.5 0.9 -1
    Shape "disk"
    WorldEnd)";
}

class SameBits : public testing::TestWithParam<std::string> {};

TEST_P(SameBits, ForAnyNumberOfThreads) {
  const std::string scene = everything(GetParam(), "directlighting");
  const Image one = test::renderText(scene, 1);
  EXPECT_EQ(one.channels, test::renderText(scene, 2).channels);
  EXPECT_EQ(one.channels, test::renderText(scene, 7).channels);
}

TEST_P(SameBits, WhenTheSamplesComeInSeveralPasses) {
  const std::string scene = everything(GetParam(), "whitted");
  BuildOptions options;
  options.samplesPerPixel = 4;
  const Image whole = test::renderText(scene, 0, options);
  const auto split = test::buildText(scene, options);
  test::renderScene(*split, 2, 0, 1);
  EXPECT_EQ(whole.channels, test::renderScene(*split, 1, 1, 4).channels);
}

INSTANTIATE_TEST_SUITE_P(Samplers, SameBits,
                         testing::Values("random", "stratified", "lowdiscrepancy", "bestcandidate",
                                         "halton"));

// Of so many atoms that several threads split the space around them.
TEST(Render, IsTheSameForAnyNumberOfThreadsThatBuild) {
  Rng rng(5);
  std::string atoms;
  for (int i = 0; i < 51000; ++i) atoms += std::to_string(4 * rng.uniform() - 2) + ' ';
  const std::string scene = R"(
    LookAt 2 3 7  0 0 0  0 1 0
    Camera "perspective" "float fov" 40
    Film "image" "integer xresolution" 40 "integer yresolution" 40
    Sampler "random" "integer pixelsamples" 1
    Integrator "whitted"
    WorldBegin
    LightSource "point" "rgb I" [99 99 99] "point from" [2 3 4]
    Shape "metaballs" "string kernel" "wyvill" "float radius" 0.3 "float threshold" 1.5
      "point P" [)" + atoms +
                            "] WorldEnd";
  const auto picture = [&](int threads) {
    BuildOptions options;
    options.threads = threads;
    return test::renderText(scene, threads, options);
  };
  const Image one = picture(1);
  EXPECT_GT(test::mean(one, "R"), 0.01);
  EXPECT_EQ(one.channels, picture(3).channels);
}

TEST(Render, AnotherSeedGivesAnotherPicture) {
  const std::string scene = everything("random", "whitted");
  BuildOptions other;
  other.seed = 1;
  EXPECT_NE(test::renderText(scene).channels, test::renderText(scene, 0, other).channels);
}

// As in pbrt-v1; else a picture for the screen, which divides by alpha, is too bright where
// something covers a part of the sky.
TEST(Render, ASkyThatShinesIsNoHole) {
  const auto alpha = [](const std::string& sky) {
    const Image image = test::renderText(
        "Film \"image\" \"integer xresolution\" 2 \"integer yresolution\" 2\n"
        "Sampler \"random\" \"integer pixelsamples\" 1 Integrator \"path\" WorldBegin " +
        sky + "\nWorldEnd");
    return image.channel("A")->at(0);
  };
  EXPECT_EQ(alpha("LightSource \"infinite\""), 1);
  EXPECT_EQ(alpha("LightSource \"point\""), 0);
}

// A camera may give no ray at all where it sees nothing (weight 0): nobody traces what it gives.
TEST(Render, TracesNoRayOfWeightZero) {
  class Blind final : public Camera {
    CameraRay generate(const CameraSample&, bool) const override {
      const Vec3 nan(std::nanf(""));
      return {RayDifferential({.o = nan, .d = nan}), 0};
    }
  };
  class Watched final : public World {
   public:
    Watched() { camera_ = &blind_; }
    Hit intersect(const Ray&) const override { return {}; }
    bool occluded(const Ray&) const override { return false; }
    void intersect(std::span<const Ray* const> rays, std::span<Hit>) const override {
      for (const Ray* ray : rays) {
        EXPECT_TRUE(isFinite(ray->o) && isFinite(ray->d) && ray->d != Vec3(0));
        EXPECT_FALSE(ray->tMax > ray->tMin);
      }
    }
    std::uint32_t occluded(std::span<const Ray>) const override { return 0; }
    SurfaceInteraction surface(const RayDifferential&, const Hit&) const override { return {}; }
    Bsdf bsdf(SurfaceInteraction&, Scratch&) const override { throw Error("nothing was hit"); }
    ImplicitSurfaces implicitSurfaces() const override { return {}; }

   private:
    Blind blind_;
  };
  const auto scene = test::buildText(
      "Film \"image\" \"integer xresolution\" 10 \"integer yresolution\" 10\n"
      "Integrator \"whitted\" WorldBegin WorldEnd");
  RenderControl control;
  control.threads = 1;
  scene->integrator().render(Watched(), scene->sampler(), scene->film(), control);
}

TEST(Render, StopsWhenToldTo) {
  const auto scene = test::buildText(everything("random", "whitted"));
  RenderControl control;
  control.stop = true;
  scene->integrator().render(*scene, scene->sampler(), scene->film(), control);
  EXPECT_EQ(control.samplesDone, 0U);
}

// Stopped wherever it may be, again and again, with other numbers of threads: the same bits.
TEST(Render, GoesOnFromWhereItWasStopped) {
  const std::string text = everything("halton", "directlighting");
  BuildOptions options;
  options.samplesPerPixel = 8;
  options.aovs = kEveryAov;
  const Image whole = test::renderText(text, 2, options);
  const auto scene = test::buildText(text, options);
  const std::uint64_t samples = std::uint64_t{8} * scene->film().sampledPixels().width() *
                                scene->film().sampledPixels().height();
  std::vector<std::uint32_t> reached;
  std::uint64_t done = 0;
  int stops = 0;
  Rng rng(9);
  while (done < samples) {
    RenderControl control;
    control.threads = 1 + static_cast<int>(3 * rng.uniform());
    control.endSample = 8;
    control.reached = reached;
    // Another thread stops it once it has a random number of samples.
    const std::uint64_t until = static_cast<std::uint64_t>(6000 * rng.uniform());
    std::atomic<bool> ended = false;
    std::thread stopper([&] {
      while (!ended && control.samplesDone < until) std::this_thread::yield();
      control.stop = true;
    });
    scene->integrator().render(*scene, scene->sampler(), scene->film(), control);
    ended = true;
    stopper.join();
    reached = control.reached;
    done += control.samplesDone;
    ++stops;
  }
  EXPECT_EQ(done, samples);
  EXPECT_GT(stops, 2);
  EXPECT_EQ(reached, std::vector<std::uint32_t>(reached.size(), 8));
  EXPECT_EQ(scene->film().image().channels, whole.channels);
}

TEST(Render, DoesNotGoOnWithAnotherFilm) {
  const auto scene = test::buildText(everything("halton", "whitted"));
  RenderControl control;
  control.reached = {1};
  EXPECT_THROW(scene->integrator().render(*scene, scene->sampler(), scene->film(), control), Error);
}

// One thread cannot begin; the others would go on for years.
TEST(Render, EndsAtOnceIfAThreadCannotBegin) {
  constexpr int kRays = SamplingIntegrator::kBlock * SamplingIntegrator::kBlock;
  class OfOneThread final : public Sampler {
   public:
    explicit OfOneThread(std::atomic<int>& clones) : Sampler(1), clones_(clones) {}
    std::unique_ptr<Sampler> clone() const override {
      if (++clones_ > kRays) throw Error("there is none for a second thread");
      return std::make_unique<OfOneThread>(clones_);
    }
    void start(Point2i, std::uint32_t) override {
      while (clones_ <= kRays) std::this_thread::yield();
    }
    float get1D() override { return 0.5F; }
    Point2 get2D() override { return {0.5F, 0.5F}; }

   private:
    std::atomic<int>& clones_;
  };
  const auto scene = test::buildText(everything("random", "whitted"));
  std::atomic<int> clones = 0;
  RenderControl control;
  control.threads = 2;
  control.endSample = 1U << 31U;
  EXPECT_THROW(scene->integrator().render(*scene, OfOneThread(clones), scene->film(), control),
               Error);
  EXPECT_TRUE(control.stop);
}

TEST(Render, CountsItsRays) {
  const auto scene = test::buildText(
      "Film \"image\" \"integer xresolution\" 10 \"integer yresolution\" 10\n"
      "Sampler \"random\" \"integer pixelsamples\" 3\nIntegrator \"whitted\"\nWorldBegin WorldEnd");
  RenderControl control;
  control.endSample = 3;
  scene->integrator().render(*scene, scene->sampler(), scene->film(), control);
  EXPECT_EQ(control.rays, 300U);
}

}  // namespace
}  // namespace pbrt
