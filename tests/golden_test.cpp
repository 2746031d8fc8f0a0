// Every scene of scenes/ renders as it did: the mean picture of several seeds is held to a golden
// mean by a z-test. PBRT_UPDATE_GOLDEN=1 makes the golden pictures anew; look at them then.

#include <cstdlib>

#include "tests/scenes.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

constexpr int kWidth = 64;
constexpr int kSamples = 4;       // per pixel and seed
constexpr int kSeeds = 16;        // of a test
constexpr int kGoldenSeeds = 96;  // others

// A scene at kWidth pixels across.
std::unique_ptr<Scene> smallScene(const fs::path& file, std::uint64_t seed) {
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.file(file);
  for (Directive& d : directives)
    if (d.kind == DirectiveKind::Film) {
      int *x = nullptr, *y = nullptr;
      for (Param& p : d.params) {
        if (p.name == "xresolution") x = std::get<std::vector<int>>(p.values).data();
        if (p.name == "yresolution") y = std::get<std::vector<int>>(p.values).data();
      }
      *y = *y * kWidth / *x;
      *x = kWidth;
    }
  BuildOptions options;
  options.seed = seed;
  options.samplesPerPixel = kSamples;
  return buildScene(std::move(directives), test::loader(), options);
}

// Mean and variance over seeds of every pixel, and of the mean of the whole picture, by channel.
struct Statistics {
  Bounds2i window;
  int seeds = 0;
  std::array<std::vector<double>, 3> mean, variance;
  std::array<double, 3> wholeMean{}, wholeVariance{};
};

Statistics render(const fs::path& file, std::uint64_t firstSeed, int seeds) {
  Statistics s;
  s.seeds = seeds;
  std::array<std::vector<double>, 3> sum, squares;
  std::array<double, 3> wholeSum{}, wholeSquares{};
  for (int i = 0; i < seeds; ++i) {
    const auto scene = smallScene(file, firstSeed + static_cast<std::uint64_t>(i));
    const Image image = test::renderScene(*scene);
    s.window = image.window;
    for (int c = 0; c < 3; ++c) {
      const std::vector<float>& pixels = image.channels[c];
      sum[c].resize(pixels.size());
      squares[c].resize(pixels.size());
      double whole = 0;
      for (std::size_t p = 0; p < pixels.size(); ++p) {
        sum[c][p] += pixels[p];
        squares[c][p] += sqr(double{pixels[p]});
        whole += pixels[p] / static_cast<double>(pixels.size());
      }
      wholeSum[c] += whole;
      wholeSquares[c] += sqr(whole);
    }
  }
  const auto variance = [&](double total, double totalSquares) {
    return std::max(0.0, (totalSquares - total * total / seeds) / (seeds - 1));
  };
  for (int c = 0; c < 3; ++c) {
    for (std::size_t p = 0; p < sum[c].size(); ++p) {
      s.mean[c].push_back(sum[c][p] / seeds);
      s.variance[c].push_back(variance(sum[c][p], squares[c][p]));
    }
    s.wholeMean[c] = wholeSum[c] / seeds;
    s.wholeVariance[c] = variance(wholeSum[c], wholeSquares[c]);
  }
  return s;
}

fs::path goldenFile(const fs::path& scene) {
  return fs::path(PBRT_SOURCE_DIR "/tests/golden") / scene.stem().concat(".exr");
}

constexpr std::array<const char*, 3> kMean = {"R", "G", "B"};
constexpr std::array<const char*, 3> kVariance = {"variance.R", "variance.G", "variance.B"};

void save(const fs::path& file, const Statistics& s) {
  Image image;
  image.window = s.window;
  image.resolution = s.window.hi;
  for (int c = 0; c < 3; ++c) {
    image.names.emplace_back(kMean[c]);
    image.channels.emplace_back(s.mean[c].begin(), s.mean[c].end());
    image.names.emplace_back(kVariance[c]);
    image.channels.emplace_back(s.variance[c].begin(), s.variance[c].end());
    image.attributes[std::string("whole.variance.") + kMean[c]] = s.wholeVariance[c];
  }
  image.attributes["seeds"] = s.seeds;
  writeImage(file, image);
}

Statistics load(const fs::path& file) {
  const Image image = readExr(file);
  Statistics s;
  s.window = image.window;
  s.seeds = std::get<int>(image.attributes.at("seeds"));
  for (int c = 0; c < 3; ++c) {
    const auto& mean = *image.channel(kMean[c]);
    const auto& variance = *image.channel(kVariance[c]);
    s.mean[c].assign(mean.begin(), mean.end());
    s.variance[c].assign(variance.begin(), variance.end());
    for (const double m : s.mean[c]) s.wholeMean[c] += m / static_cast<double>(s.mean[c].size());
    s.wholeVariance[c] =
        std::get<double>(image.attributes.at(std::string("whole.variance.") + kMean[c]));
  }
  return s;
}

// Differences in standard deviations. The variances are the golden picture's: it has more seeds.
struct Difference {
  double whole = 0;   // of the mean of the picture, the worst channel
  double pixels = 0;  // the share of pixels (and channels) beyond 5
};

Difference compare(const Statistics& a, const Statistics& golden) {
  Difference d;
  const double scale = 1.0 / a.seeds + 1.0 / golden.seeds;
  std::size_t beyond = 0, count = 0;
  for (int c = 0; c < 3; ++c) {
    const double deviation =
        std::sqrt(golden.wholeVariance[c] * scale) + 1e-7 * golden.wholeMean[c] + 1e-12;
    d.whole = std::max(d.whole, std::abs(a.wholeMean[c] - golden.wholeMean[c]) / deviation);
    for (std::size_t p = 0; p < golden.mean[c].size(); ++p, ++count) {
      const double z = std::abs(a.mean[c][p] - golden.mean[c][p]) /
                       (std::sqrt(golden.variance[c][p] * scale) + 1e-5 * golden.mean[c][p] + 1e-6);
      beyond += z > 5;
    }
  }
  d.pixels = static_cast<double>(beyond) / static_cast<double>(count);
  return d;
}

// Pixels with rare bright samples are not normal, so a few beyond 5 sigma are expected.
bool agrees(const Difference& d) {
  return d.whole < 5 && d.pixels < 0.003;
}

std::vector<fs::path> scenes() {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(PBRT_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".pbrt") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

class Golden : public testing::TestWithParam<fs::path> {};

TEST_P(Golden, SceneRendersAsItDid) {
  if (std::getenv("PBRT_UPDATE_GOLDEN")) {
    save(goldenFile(GetParam()), render(GetParam(), 1000, kGoldenSeeds));
    return;
  }
  const Statistics golden = load(goldenFile(GetParam()));
  const Statistics now = render(GetParam(), 1, kSeeds);
  ASSERT_EQ(now.window, golden.window);
  const Difference d = compare(now, golden);
  EXPECT_TRUE(agrees(d)) << "the whole picture is off by " << d.whole << " sigma, "
                         << 100 * d.pixels << " % of the pixels by more than 5";
}

TEST_P(Golden, ATestThatCannotFailIsNone) {
  if (std::getenv("PBRT_UPDATE_GOLDEN")) GTEST_SKIP() << "makes golden pictures";
  const Statistics golden = load(goldenFile(GetParam()));
  Statistics brighter = golden;
  brighter.seeds = kSeeds;
  for (int c = 0; c < 3; ++c) {
    brighter.wholeMean[c] *= 1.03;
    for (double& m : brighter.mean[c]) m *= 1.03;
  }
  EXPECT_FALSE(agrees(compare(brighter, golden))) << "3 % more light are not seen";
}

INSTANTIATE_TEST_SUITE_P(Scenes, Golden, testing::ValuesIn(scenes()), [](const auto& test) {
  std::string name = test.param.stem().string();
  std::replace(name.begin(), name.end(), '-', '_');
  return name;
});

}  // namespace
}  // namespace pbrt
