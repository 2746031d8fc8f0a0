// --stats, and that pbrt is lean: what a small scene takes, and who takes the memory of a large
// one.

#include <fmt/format.h>

#include <map>
#include <regex>
#include <set>
#include <sstream>

#include "core/base/image.h"
#include "core/base/rng.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool kSanitized = true;  // the memory is the sanitizer's, above all
#else
constexpr bool kSanitized = false;
#endif

struct Stats {
  std::string text;
  double most = 0, all = 0;             // MiB
  std::map<std::string, double> parts;  // MiB
  std::size_t opened = 0, available = 0;
  std::set<std::string> plugins;
};

std::string film(int width, int height) {
  return fmt::format(
      "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
      "Camera \"perspective\" Sampler \"random\" \"integer pixelsamples\" 1\n",
      width, height);
}

const std::string kSphere = "LightSource \"point\" Translate 0 0 4 Shape \"sphere\"\n";

Stats statsOf(const std::string& options, const std::string& world,
              const Image* picture = nullptr) {
  const Folder folder;
  if (picture) writeImage(folder.path() / "picture.png", *picture);
  folder.write("scene.pbrt", options + "WorldBegin\n" + world + "WorldEnd\n");
  const Outcome outcome = folder.pbrt("--stats --outfile out.exr scene.pbrt");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  Stats stats{outcome.out};
  std::istringstream lines(outcome.out);
  std::string section;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word;
    if (line[0] != ' ') {
      words >> section;
      if (section == "Memory") words >> stats.most >> word >> word >> word >> stats.all;
      if (section == "Plug-ins") words >> stats.opened >> word >> word >> stats.available;
    } else if (section == "Memory") {
      double size = 0;
      words >> size >> std::ws;
      std::getline(words, word);
      stats.parts[word] = size;
    } else {
      words >> word;
      stats.plugins.insert(word);
    }
  }
  return stats;
}

// What no part claims: stacks and the like; less where memory was reserved and not used.
void expectToAddUp(const Stats& s) {
  double sum = 0;
  for (const auto& [name, size] : s.parts) sum += size;
  EXPECT_NEAR(sum, s.all, 0.1 * static_cast<double>(s.parts.size())) << s.text;
  EXPECT_LT(std::abs(s.parts.at("all else")), 3 + 0.15 * s.all) << s.text;
  EXPECT_GE(s.most, s.all) << s.text;
}

// A part has the least size that its data can have, and not much more; all others are small.
void expectToDominate(const Stats& s, const std::string& part, double least, double most,
                      const std::set<std::string>& others = {}) {
  if (kSanitized) GTEST_SKIP();
  expectToAddUp(s);
  EXPECT_GE(s.parts.at(part), least) << s.text;
  EXPECT_LE(s.parts.at(part), most) << s.text;
  for (const auto& [name, size] : s.parts)
    if (name != part && !others.contains(name)) {
      EXPECT_LT(size, std::max(0.25 * least, 16.0)) << name << '\n' << s.text;
    }
}

TEST(Stats, TellWhichPluginsWereOpenedOfThoseThatThereAre) {
  const Stats s = statsOf(film(16, 16), kSphere);
  EXPECT_EQ(s.plugins, (std::set<std::string>{
                           "cameras/perspective", "filters/box", "integrators/directlighting",
                           "lights/point", "materials/matte", "samplers/random", "shapes/sphere"}));
  EXPECT_EQ(s.opened, s.plugins.size());
  std::size_t files = 0;
  for (const auto& file : fs::recursive_directory_iterator(PBRT_BUILD_DIR "/lib/pbrt"))
    files += file.path().extension() == ".so";
  EXPECT_EQ(s.available, files);
}

TEST(Stats, ASphereTakesLessThan40MB) {
  if (kSanitized) GTEST_SKIP();
  for (const int threads : {1, 2, 16}) {
    const Folder folder;
    folder.write("scene.pbrt", film(640, 480) + "WorldBegin\n" + kSphere + "WorldEnd\n");
    const Outcome outcome =
        folder.pbrt(fmt::format("--stats --nthreads {} --outfile out.exr scene.pbrt", threads));
    const std::size_t at = outcome.out.find("Memory");
    ASSERT_NE(at, outcome.out.npos) << outcome.err;
    const double most = std::stod(outcome.out.substr(at + 6));
    EXPECT_LT(most, 40e6 / (1 << 20)) << threads << " threads\n" << outcome.out;
    EXPECT_GT(most, 12) << "the film alone has that";
    EXPECT_EQ(outcome.err.find("TBB"), outcome.err.npos) << outcome.err;
  }
}

TEST(Stats, AMeshIsShapesAndRayTree) {
  // Two triangles for each of 707 x 707 squares: three indices of four bytes each, and three
  // coordinates for each vertex.
  constexpr int n = 708;
  std::string mesh = "Shape \"trianglemesh\" \"integer indices\" [";
  for (int i = 0; i + 1 < n; ++i)
    for (int j = 0; j + 1 < n; ++j) {
      const int a = i * n + j;
      mesh += fmt::format("{} {} {} {} {} {}\n", a, a + 1, a + n, a + 1, a + n + 1, a + n);
    }
  mesh += "] \"point P\" [";
  for (int i = 0; i < n * n; ++i) mesh += fmt::format("{} {} {}\n", i / n, i % n, i % 7);
  const Stats s = statsOf(film(16, 16), "LightSource \"point\"\n" + mesh + "]\n");
  const double mib = 1 << 20;
  const double data = (2.0 * (n - 1) * (n - 1) + n * n) * 12 / mib;
  expectToDominate(s, "shapes", data, 1.2 * data,
                   {"ray trees and instances", "text of the scene, and what else there is"});
  if (kSanitized) return;
  EXPECT_GT(s.parts.at("ray trees and instances"), data);
  EXPECT_GT(s.parts.at("text of the scene, and what else there is"),
            static_cast<double>(mesh.size()) / mib);
}

TEST(Stats, MetaballsAreShapesAndRayTree) {
  std::string atoms =
      "LightSource \"point\" Shape \"metaballs\" \"float radius\" 0.5 \"point P\" [";
  Rng rng(1);
  constexpr int n = 30000;
  for (int i = 0; i < n; ++i)
    atoms += fmt::format("{:.2f} {:.2f} {:.2f}\n", 30 * rng.uniform(), 30 * rng.uniform(),
                         30 * rng.uniform());
  // At least the three coordinates and the radius of each atom.
  const double least = n * 16.0 / (1 << 20);
  expectToDominate(statsOf(film(16, 16), atoms + "]\n"), "shapes", least, 20 * least,
                   {"ray trees and instances"});
}

TEST(Stats, APictureIsATexture) {
  constexpr int n = 2048;
  const std::vector<float> dark(n * n, 0.2F), bright(n * n, 0.8F);
  const Image picture{.window = {{0, 0}, {n, n}},
                      .resolution = {n, n},
                      .names = {"R", "G", "B"},
                      .channels = {dark, dark, bright}};
  const Stats s = statsOf(film(16, 16),
                          "Texture \"t\" \"color\" \"imagemap\" \"string filename\" "
                          "\"picture.png\" Material \"matte\" \"texture Kd\" \"t\"\n" +
                              kSphere,
                          &picture);
  // Three bytes a texel, and the smaller levels, a third as many texels, in floats.
  const double size = (3 + 12 / 3.0) * n * n / (1 << 20);
  expectToDominate(s, "materials and textures", size - 0.1, size + 1, {"freed, for new use"});
}

TEST(Stats, ALargeFilmIsTheFilm) {
  // Three sums and what they lost, weight and alpha for each pixel, in doubles; the picture is
  // written from floats.
  const double sums = 2000.0 * 1000 * 8 * 8 / (1 << 20);
  expectToDominate(statsOf(film(2000, 1000), kSphere), "film", sums, 1.1 * sums);
}

TEST(Stats, ManyLightsAreLights) {
  std::string lights;
  constexpr int n = 20000;
  for (int i = 0; i < n; ++i)
    lights +=
        fmt::format("LightSource \"point\" \"point from\" [{} {} {}]\n", i % 9, i % 11, i % 13);
  const Stats s = statsOf("Integrator \"path\"\n" + film(16, 16), lights + kSphere);
  expectToDominate(s, "lights", n * 64.0 / (1 << 20), 10);
}

// They are asked for: --quiet does not silence them.
TEST(Stats, NeverTellOfLessThanNothing) {
  const std::regex negative(R"(-\d)");
  int scenes = 0;
  for (const auto& file : fs::directory_iterator(PBRT_SOURCE_DIR "/scenes")) {
    if (file.path().extension() != ".pbrt") continue;
    ++scenes;
    const Outcome outcome = Folder().pbrt("--stats --quiet --quick --width 32 --outfile out.exr '" +
                                          file.path().string() + "'");
    EXPECT_EQ(outcome.code, 0) << file.path() << outcome.err;
    EXPECT_TRUE(outcome.out.starts_with("Seconds")) << file.path() << outcome.out;
    EXPECT_FALSE(std::regex_search(outcome.out, negative)) << file.path() << '\n' << outcome.out;
  }
  EXPECT_GT(scenes, 10);
}

TEST(Stats, AreOfARender) {
  const Folder folder;
  folder.write("scene.pbrt", film(16, 16) + "WorldBegin\n" + kSphere + "WorldEnd\n");
  for (const std::string other : {"--check", "--format"}) {
    const Outcome outcome = folder.pbrt("--stats " + other + " scene.pbrt");
    EXPECT_EQ(outcome.code, 2) << other;
    EXPECT_NE(outcome.err.find("--stats"), outcome.err.npos) << outcome.err;
  }
}

// A library that one plug-in needs is not opened without it.
TEST(Lean, LibjpegComesWithPicturesAlone) {
  const Folder folder;
  folder.write("scene.pbrt", film(8, 8) + "WorldBegin\n" + kSphere + "WorldEnd\n");
  const auto libraries = [&](const std::string& scene) {
    return folder
        .command("env LD_DEBUG=files " + Folder::program() + " --quiet --outfile out.exr " + scene)
        .err;
  };
  const std::string without = libraries("scene.pbrt");
  EXPECT_NE(without.find("libembree"), without.npos);
  EXPECT_EQ(without.find("libjpeg"), without.npos);
  writeImage(folder.path() / "picture.png", Image{.window = {{0, 0}, {1, 1}},
                                                  .resolution = {1, 1},
                                                  .names = {"R", "G", "B"},
                                                  .channels = {{1}, {1}, {1}}});
  folder.write("picture.pbrt",
               film(8, 8) +
                   "WorldBegin Texture \"t\" \"color\" \"imagemap\" \"string filename\" "
                   "\"picture.png\" Material \"matte\" \"texture Kd\" \"t\"\n" +
                   kSphere + "WorldEnd\n");
  const std::string with = libraries("picture.pbrt");
  EXPECT_NE(with.find("libjpeg"), with.npos);
}

}  // namespace
}  // namespace pbrt::test
