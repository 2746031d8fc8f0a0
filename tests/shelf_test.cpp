// docs/shelf shows every plug-in: a scene to copy and a picture of it.

#include <fmt/format.h>

#include <set>

#include "core/base/image.h"
#include "tests/command.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

const fs::path kDocs = PBRT_SOURCE_DIR "/docs";

struct Plugin {
  PluginKind kind{};
  std::string name;

  // In docs/shelf, with this suffix.
  fs::path file(const char* suffix) const {
    return kDocs / "shelf" / kindFolder(kind) / (name + suffix);
  }
};

void PrintTo(const Plugin& plugin, std::ostream* out) {
  *out << kindName(plugin.kind) << " " << plugin.name;
}

std::vector<Plugin> plugins() {
  std::vector<Plugin> found;
  for (std::uint32_t i = 0; i < kPluginKinds; ++i)
    for (const std::string& name : test::loader().available(static_cast<PluginKind>(i)))
      found.push_back({static_cast<PluginKind>(i), name});
  return found;
}

// Means of 4 x 4 parts of the picture, of light clipped to what a screen shows.
std::vector<double> parts(const Image& image) {
  constexpr int kParts = 4;
  const int width = image.window.width(), height = image.window.height();
  std::vector<double> means;
  for (const char* name : {"R", "G", "B"}) {
    std::vector<double> sums(kParts * kParts);
    const std::vector<float>& pixels = *image.channel(name);
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        const float value = std::clamp(pixels[y * width + x], 0.F, 1.F);
        sums[y * kParts / height * kParts + x * kParts / width] +=
            image.encoded ? decodeSrgb(value) : value;
      }
    for (const double sum : sums) means.push_back(sum * sqr(kParts) / (width * height));
  }
  return means;
}

class Shelf : public testing::TestWithParam<Plugin> {
 protected:
  void SetUp() override {
    ASSERT_TRUE(fs::exists(GetParam().file(".pbrt")))
        << "write " << GetParam().file(".pbrt") << ", a short scene that shows what "
        << testing::PrintToString(GetParam()) << " does; then ./dev docs renders its picture";
    ASSERT_TRUE(fs::exists(GetParam().file(".png")))
        << "./dev docs renders " << GetParam().file(".png");
  }
};

TEST_P(Shelf, SceneUsesThePluginAndIsWhatThePictureShows) {
  PluginLoader loader({PBRT_BUILD_DIR "/lib/pbrt"});
  std::vector<Directive> directives;
  Parser parser([&](Directive&& d) { directives.push_back(std::move(d)); });
  parser.file(GetParam().file(".pbrt"));
  BuildOptions options;
  options.width = 64;
  options.samplesPerPixel = 4;
  options.report = [](const Diagnostic& d) {
    if (d.severity != Severity::note) ADD_FAILURE() << format(d);
  };
  const auto scene = buildScene(std::move(directives), loader, options);
  EXPECT_TRUE(std::ranges::any_of(loader.opened(), [](const LoadedPlugin& plugin) {
    return plugin.info->kind == GetParam().kind && plugin.info->name == GetParam().name;
  })) << "the scene does without it";

  const auto now = parts(test::renderScene(*scene));
  const auto then = parts(readImage(GetParam().file(".png")));
  double squares = 0;
  for (std::size_t i = 0; i < now.size(); ++i) squares += sqr(now[i] - then[i]);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(now.size())), 0.02)  // noise is 0.012 at most
      << "it is of another scene: ./dev docs (--all, if a stage changed) renders it anew";
}

TEST_P(Shelf, PictureIsNeitherDarkNorGlaring) {
  const Image picture = readImage(GetParam().file(".png"));
  EXPECT_EQ(picture.resolution, Point2i(128));
  double sum = 0, glaring = 0;
  const std::vector<float>& pixels = *picture.channel("G");
  for (const float value : pixels) sum += value, glaring += value > 0.99F;
  EXPECT_GT(sum / static_cast<double>(pixels.size()), 0.15);
  EXPECT_LT(sum / static_cast<double>(pixels.size()), 0.85);
  EXPECT_LT(glaring / static_cast<double>(pixels.size()), 0.1);
}

INSTANTIATE_TEST_SUITE_P(All, Shelf, testing::ValuesIn(plugins()), [](const auto& plugin) {
  return fmt::format("{}_{}", kindName(plugin.param.kind), plugin.param.name);
});

TEST(ShelfFolder, HasNothingElse) {
  std::set<fs::path> expected;
  for (const Plugin& plugin : plugins())
    expected.insert({plugin.file(".pbrt"), plugin.file(".png")});
  std::string scenes;
  for (const auto& entry : fs::recursive_directory_iterator(kDocs / "shelf"))
    if (entry.path().extension() == ".pbrt") scenes += test::contents(entry.path());
  for (const auto& entry : fs::recursive_directory_iterator(kDocs / "shelf")) {
    if (entry.is_directory() || expected.contains(entry.path())) continue;
    const fs::path name = fs::path("..") / entry.path().lexically_relative(kDocs / "shelf");
    EXPECT_NE(scenes.find(name.string()), std::string::npos) << entry.path() << " is not used";
  }
}

TEST(ShelfPage, IsWhatThePluginsSay) {
  const test::Folder folder;
  const test::Outcome described = folder.pbrt("--describe all");
  EXPECT_EQ(described.code, 0) << described.err;
  EXPECT_EQ(described.out, test::contents(kDocs / "plugins.md")) << "./dev docs makes it anew";
}

}  // namespace
}  // namespace pbrt
