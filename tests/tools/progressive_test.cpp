// Renders that end by time or error, and pictures that are written as they improve.

#include <fmt/format.h>

#include "core/base/image.h"
#include "tests/command.h"
#include "tests/tools/stripes.h"
#include "tools/compare/metrics.h"
#include "tools/passes.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

// Soft light with every kind of number in play: lens, two lights, a filter that reaches over
// pixels and tiles.
std::string lit(const std::string& sampler) {
  return R"(LookAt 0 2 -5  0 0.5 0  0 1 0
Camera "perspective" "float fov" 40 "float lensradius" 0.1 "float focaldistance" 5
Film "image" "integer xresolution" 48 "integer yresolution" 36 "string filename" "out.exr"
PixelFilter "gaussian" "float xwidth" 1.5 "float ywidth" 1.5
SurfaceIntegrator "directlighting"
Sampler ")" +
         sampler + R"("
WorldBegin
LightSource "distant" "point from" [3 5 -3] "point to" [0 0 0]
AttributeBegin
AreaLightSource "diffuse" "rgb L" [9 8 7]
Translate -2 3 -1
Shape "sphere" "float radius" 0.5
AttributeEnd
Material "matte" "rgb Kd" [0.6 0.4 0.2]
Shape "sphere" "float radius" 0.8
Shape "trianglemesh" "integer indices" [0 1 2 0 2 3] "point P" [-9 -0.8 -9  -9 -0.8 9  9 -0.8 9  9 -0.8 -9]
WorldEnd
)";
}

class Progressive : public testing::Test {
 protected:
  void SetUp() override { folder.write("scene.pbrt", lit("random")); }
  Outcome pbrt(const std::string& arguments) const {
    const Outcome outcome = folder.pbrt("--quiet " + arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out + outcome.err, "");
    return outcome;
  }
  Image render(const std::string& arguments) const {
    pbrt(arguments + " --outfile picture.exr scene.pbrt");
    Image image = readExr(folder.path() / "picture.exr");
    fs::remove(folder.path() / "picture.exr");
    return image;
  }
  static int samplesOf(const Image& image) {
    return std::get<int>(image.attributes.at("samplesPerPixel"));
  }

  Folder folder;
};

TEST_F(Progressive, PassesMakeTheSamePictureBitForBit) {
  for (const char* sampler : {"random", "stratified", "halton", "lowdiscrepancy"}) {
    folder.write("scene.pbrt", lit(sampler));
    const Image once = render("--spp 8 --aov variance");
    const Image often = render("--spp 8 --aov variance --write-every 1ms --nthreads 1");
    EXPECT_EQ(once.names, often.names);
    EXPECT_EQ(once.channels, often.channels) << sampler;
    EXPECT_EQ(samplesOf(often), 8);
  }
}

TEST_F(Progressive, ARangeHoldsItsSamplesOnly) {
  const Image range = render("--samples 3..8 --aov samples");
  EXPECT_EQ(samplesOf(range), 5);
  EXPECT_EQ(std::get<int>(range.attributes.at("firstSample")), 3);
  for (const float n : *range.channel("samples")) EXPECT_EQ(n, 5);
  EXPECT_NE(range.channels[0], render("--samples 0..5").channels[0]);
}

// A range of its own is the law: the renders by time know the scene's number of samples only.
TEST_F(Progressive, TimeEndsARender) {
  for (const char* sampler : {"random", "stratified"}) {
    folder.write("scene.pbrt", lit(sampler));
    const Image timed = render("--time 300ms");
    const int samples = samplesOf(timed);
    EXPECT_GE(samples, 1);
    EXPECT_GT(std::get<double>(timed.attributes.at("renderTimeSeconds")), 0);
    EXPECT_EQ(timed.channels, render(fmt::format("--samples 0..{}", samples)).channels);
    if (sampler == std::string("random")) {
      EXPECT_EQ(timed.channels, render(fmt::format("--spp {}", samples)).channels);
    }
  }
  EXPECT_EQ(samplesOf(render("--time 1h --spp 3")), 3) << "whichever comes first";
  EXPECT_EQ(samplesOf(render("--time 1ms --width 300")), 1) << "one sample at least";
}

TEST_F(Progressive, TheTargetErrorEndsARender) {
  const Image image = render("--target-error 0.005 --aov variance");
  EXPECT_GE(samplesOf(image), 16);
  EXPECT_LE(estimatedError(image), 0.005);
  EXPECT_GT(estimatedError(image), 0.004) << "far more samples than needed";
  EXPECT_EQ(samplesOf(render("--target-error 1e-9 --spp 20")), 20);
  EXPECT_EQ(render("--target-error 1").names.size(), 4U) << "Variance though nobody asked";
}

// Stripes: 0.25 / n / 0.26 = 0.05^2 at n = 385, and a little later since noisy values v make the
// mean of 1 / (v^2 + 0.01) larger. A picture of another seed is as far off, root two times.
TEST_F(Progressive, TheTargetErrorIsTheError) {
  folder.write("scene.pbrt", stripes(32));
  const Image image = render("--target-error 0.05"), other = render("--target-error 0.05 --seed 5");
  EXPECT_NEAR(samplesOf(image), 389, 8);
  EXPECT_NEAR(std::sqrt(measureErrors(image, other).relMse / 2) / 0.05, 1, 0.1);
}

// Killed at any moment, what is on the disk is a whole picture of some of the samples.
TEST_F(Progressive, AKilledRenderLeavesAWholePicture) {
  for (const int milliseconds : {300, 430, 570, 710}) {
    const Outcome outcome = folder.command(
        fmt::format("timeout -s KILL {} {} --quiet --width 200 --spp 1000000 --write-every 5ms "
                    "--outfile killed.exr scene.pbrt",
                    milliseconds * 1e-3, Folder::program()));
    EXPECT_EQ(outcome.code, 137) << outcome.err;
    if (!fs::exists(folder.path() / "killed.exr")) continue;  // on a slow machine
    const Image image = readExr(folder.path() / "killed.exr");
    const int samples = samplesOf(image);
    EXPECT_GE(samples, 1);
    fs::remove(folder.path() / "killed.exr");
    if (samples < 200) {
      EXPECT_EQ(image.channels,
                render(fmt::format("--width 200 --samples 0..{}", samples)).channels);
    }
  }
}

TEST_F(Progressive, StoresTheChannelsThatAreAskedFor) {
  using Names = std::vector<std::string>;
  EXPECT_EQ(render("--spp 2").names.size(), 4U);
  const auto added = [&](const std::string& aovs) {
    Names names;
    for (const std::string& name : render("--spp 2 " + aovs).names)
      if (name.size() > 1 || name == "Z") names.push_back(name);
    std::sort(names.begin(), names.end());
    return names;
  };
  EXPECT_EQ(added("--aov variance"), (Names{"Variance.B", "Variance.G", "Variance.R"}));
  EXPECT_EQ(added("--aov albedo"), (Names{"Albedo.B", "Albedo.G", "Albedo.R"}));
  EXPECT_EQ(added("--aov normal"), (Names{"N.X", "N.Y", "N.Z"}));
  EXPECT_EQ(added("--aov position"), (Names{"P.X", "P.Y", "P.Z"}));
  EXPECT_EQ(added("--aov depth --aov samples"), (Names{"Z", "samples"}));
  EXPECT_EQ(added("--aov depth,samples"), (Names{"Z", "samples"}));
}

TEST_F(Progressive, TheWidthKeepsTheAspect) {
  for (const auto& [width, height] : {std::pair(96, 72), {24, 18}, {48, 36}, {1, 1}}) {
    const Image image = render(fmt::format("--spp 1 --width {}", width));
    EXPECT_EQ(image.resolution.x, width);
    EXPECT_EQ(image.resolution.y, height);
  }
}

TEST_F(Progressive, BadValuesAreOneClearLine) {
  const std::vector<std::pair<std::string, std::vector<std::string>>> cases = {
      {"--samples", {"3", "3..3", "5..3", "-1..3", "a..b", "0..4294967296", "0..3x", "..3"}},
      {"--time", {"0", "-1", "soon", "1d", "nan", "inf", "5 parsecs"}},
      {"--target-error", {"0", "-0.1", "nan", "inf", "small", "1%"}},
      {"--write-every", {"0s", "-1s", "x", "nan"}},
      {"--aov", {"variants", "", "depth,deep"}},
      {"--width", {"0", "-5", "65537", "2.5", "wide"}},
      {"--spp", {"0", "-1", "2147483648", "1e3", "many"}}};
  for (const auto& [option, values] : cases)
    for (const std::string& value : values) {
      const Outcome outcome = folder.pbrt(fmt::format("'{}={}' scene.pbrt", option, value));
      EXPECT_EQ(outcome.code, 2) << option << ' ' << value << outcome.err;
      EXPECT_NE(outcome.err.find(option), std::string::npos) << value << outcome.err;
      const std::string line = outcome.err.substr(0, outcome.err.find('\n'));
      EXPECT_LT(line.size(), 160U) << line;
      EXPECT_EQ(outcome.out, "");
      EXPECT_EQ(folder.files(), 1U);
    }
}

}  // namespace
}  // namespace pbrt::test
