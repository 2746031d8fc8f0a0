// Renders cut into parts by samples, by windows and by both, and put together: the same picture,
// bit for bit; and all that is refused.

#include "tools/merge/merge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>

#include "core/scene/picture_attributes.h"
#include "tests/command.h"
#include "tests/scenes.h"
#include "tests/tools/foggy_scene.h"

namespace pbrt::test {
namespace {

namespace fs = std::filesystem;
using Files = std::vector<fs::path>;

constexpr AovSet kAll = 2 * kShape - 1;
constexpr std::uint32_t kSamples = 7;

void expectSameBits(const Image& a, const Image& b) {
  EXPECT_EQ(a.window, b.window);
  EXPECT_EQ(a.resolution, b.resolution);
  EXPECT_EQ(a.names, b.names);
  EXPECT_EQ(a.attributes, b.attributes);
  for (std::size_t i = 0; i < a.names.size(); ++i) {
    ASSERT_EQ(a.channels[i].size(), b.channels[i].size());
    EXPECT_EQ(std::memcmp(a.channels[i].data(), b.channels[i].data(),
                          a.channels[i].size() * sizeof(float)),
              0)
        << a.names[i];
  }
}

// One render of which parts are made.
struct Render {
  std::string scene = foggyScene();
  RenderKey key{1, 2, 3, kSamples, "settings"};
  Point2i resolution{70, 50};
};

// A render of these samples; its seconds, whose sums are exact, stand for what adds up.
FilmInfo infoOf(const Render& render, std::uint32_t first, std::uint32_t end, double seconds) {
  FilmInfo info;
  info.key = render.key;
  info.firstSample = first;
  info.endSample = end;
  info.seconds = seconds;
  info.badSamples = 1;
  info.attributes = {{"seed", std::string("3")}, {"filterNoise", 0.5F}};
  return info;
}

class Merge : public testing::Test {
 protected:
  // Renders a part and writes its film.
  fs::path part(const Render& render, const Bounds2i& window, std::uint32_t first,
                std::uint32_t end) {
    BuildOptions options;
    options.aovs = kAll;
    options.pixelBounds = {window.lo.x, window.hi.x, window.lo.y, window.hi.y};
    const auto scene = buildText(render.scene, options);
    renderScene(*scene, 0, first, end);
    const fs::path file = path(fmt::format("{}.film", made_++));
    const int pixels = window.width() * window.height();
    writeFilm(file, scene->film(), infoOf(render, first, end, 1.0 * pixels * (end - first)));
    return file;
  }
  Bounds2i whole() const { return {Point2i(0), render_.resolution}; }
  fs::path part(std::uint32_t first, std::uint32_t end) {
    return part(render_, whole(), first, end);
  }

  // Cut at these columns, rows and samples, all that lie between the first and the last.
  Files parts(const Render& render, const std::vector<int>& x, const std::vector<int>& y,
              const std::vector<std::uint32_t>& samples) {
    Files files;
    for (std::size_t s = 0; s + 1 < samples.size(); ++s)
      for (std::size_t j = 0; j + 1 < y.size(); ++j)
        for (std::size_t i = 0; i + 1 < x.size(); ++i)
          files.push_back(
              part(render, {{x[i], y[j]}, {x[i + 1], y[j + 1]}}, samples[s], samples[s + 1]));
    return files;
  }

  Image merged(const Files& files) {
    const fs::path out = path(fmt::format("{}.exr", made_++));
    MergedFilm film(files);
    writeMerged(film, {out});
    return readExr(out);
  }
  fs::path mergedFilm(const Files& files) {
    fs::path out = path(fmt::format("{}.film", made_++));
    MergedFilm film(files);
    writeMerged(film, {out});
    return out;
  }
  // The picture of one process.
  Image direct(const Render& render) {
    BuildOptions options;
    options.aovs = kAll;
    const auto scene = buildText(render.scene, options);
    Image image = renderScene(*scene, 0, 0, kSamples);
    const Point2i size = render.resolution;
    image.attributes = pictureAttributes(infoOf(render, 0, kSamples, size.x * size.y * kSamples));
    const fs::path out = path("direct.exr");
    writeImage(out, image);
    return readExr(out);
  }

  void expectRefused(const Files& files, const std::string& why, Failure failure = Failure::scene) {
    try {
      MergedFilm film(files);
      writeMerged(film, {path("out.exr"), path("out.film")});
      ADD_FAILURE() << "not refused: " << why;
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), failure);
      EXPECT_NE(std::string(error.what()).find(why), std::string::npos) << error.what();
    }
    EXPECT_FALSE(fs::exists(path("out.exr")) || fs::exists(path("out.film")));
  }

  fs::path path(const std::string& name) const { return folder_.path() / name; }

  const Folder folder_;
  const Render render_;
  int made_ = 0;
};

TEST_F(Merge, OfSamplesGivesTheSameBits) {
  const Image wanted = direct(render_);
  expectSameBits(merged({part(0, kSamples)}), wanted);
  Rng rng(1);
  for (const std::vector<std::uint32_t>& cuts :
       std::vector<std::vector<std::uint32_t>>{{0, 3, 7}, {0, 1, 4, 7}, {0, 1, 2, 3, 4, 5, 6, 7}}) {
    Files files = parts(render_, {0, 70}, {0, 50}, cuts);
    for (int order = 0; order < 3; ++order) {
      for (std::size_t i = files.size(); i > 1; --i)
        std::swap(files[i - 1], files[rng.uniform(static_cast<std::uint32_t>(i))]);
      expectSameBits(merged(files), wanted);
    }
  }
}

// The filter reaches over the borders; no border is that of a tile or of a block.
TEST_F(Merge, OfWindowsGivesTheSameBits) {
  expectSameBits(merged(parts(render_, {0, 13, 41, 70}, {0, 33, 50}, {0, kSamples})),
                 direct(render_));
}

TEST_F(Merge, OfSamplesAndWindowsGivesTheSameBits) {
  const Files files = parts(render_, {0, 30, 70}, {0, 7, 50}, {0, 2, kSamples});
  const Image wanted = direct(render_);
  expectSameBits(merged(files), wanted);
  // In two stages: by windows, then by samples, the latter first.
  const fs::path early = mergedFilm({files[3], files[0], files[2], files[1]});
  const fs::path late = mergedFilm({files[4], files[5], files[6], files[7]});
  expectSameBits(merged({late, early}), wanted);
  // And the other way round, by columns, one part of them alone in its stage.
  const fs::path left = mergedFilm({files[0], files[2], files[4], files[6]});
  const fs::path top = mergedFilm({files[1], files[5]}), bottom = mergedFilm({files[3], files[7]});
  expectSameBits(merged({bottom, left, top}), wanted);
  // What is merged is written the same, however.
  EXPECT_EQ(contents(mergedFilm({early, late})), contents(mergedFilm({top, left, bottom})));
  EXPECT_EQ(contents(mergedFilm({early, late})), contents(mergedFilm(files)));
}

TEST_F(Merge, HoldsForFiltersAndSamplers) {
  const std::vector<std::pair<std::string, std::string>> kinds = {
      {"random", "box"}, {"stratified", "mitchell"},    {"lowdiscrepancy", "sinc"},
      {"zsobol", "box"}, {"bestcandidate", "triangle"}, {"sobol", "gaussian"}};
  for (const auto& [sampler, filter] : kinds) {
    SCOPED_TRACE(sampler + " " + filter);
    Render render;
    render.scene = foggyScene(sampler, filter);
    Files files = parts(render, {0, 70}, {0, 50}, {0, 3, 4});
    files.push_back(part(render, {{0, 0}, {43, 50}}, 4, kSamples));
    files.push_back(part(render, {{43, 0}, {70, 50}}, 4, kSamples));
    expectSameBits(merged(files), direct(render));
  }
}

TEST_F(Merge, TellsOfAllTogether) {
  const Files files = parts(render_, {2, 30, 70}, {5, 50}, {1, 4, 6});
  const MergedFilm film(files);
  const FilmInfo& info = film.info();
  EXPECT_EQ(info.key, render_.key);
  EXPECT_EQ(info.window, (Bounds2i{{2, 5}, {70, 50}}));
  EXPECT_EQ(info.firstSample, 1U);
  EXPECT_EQ(info.endSample, 6U);
  EXPECT_FALSE(info.interrupted());
  EXPECT_EQ(info.badSamples, 4U);
  EXPECT_EQ(info.seconds, 68 * 45 * 5);
  EXPECT_EQ(incompleteness(info),
            "it holds --samples 1..6 --pixelbounds 2,70,5,50 of --samples 0..7");
  EXPECT_EQ(incompleteness(MergedFilm({part(0, kSamples)}).info()), "");
}

TEST_F(Merge, RefusesForeignFilms) {
  const fs::path a = part(0, 3);
  const auto refuse = [&](auto change, const std::string& why) {
    Render other = render_;
    change(other);
    const fs::path b = part(other, {Point2i(0), other.resolution}, 3, kSamples);
    expectRefused({a, b}, fmt::format("{} is no part of the same render as {}: {}", b.string(),
                                      a.string(), why));
  };
  refuse([](Render& r) { r.key.scene = 0; }, "it is of another scene, or a file that");
  refuse([](Render& r) { r.key.programs = 0; }, "it was made by another build");
  refuse([](Render& r) { r.key.seed = 4; }, "it has another seed: 4, not 3");
  refuse([](Render& r) { r.key.samplesPerPixel = 8; },
         "its sampler spreads 8 samples over a pixel, not 7");
  refuse([](Render& r) { r.key.settings = "640 x 480"; }, "it is 640 x 480, not settings");
  // The key tells all, but files may lie.
  refuse(
      [](Render& r) {
        r.scene.replace(r.scene.find("70"), 2, "60");
        r.resolution = {60, 50};
      },
      "its film is of another kind");
}

TEST_F(Merge, RefusesWhatIsThereTwice) {
  const fs::path a = part(0, 3), b = part(2, kSamples);
  expectRefused({b, a}, fmt::format("{} and {} hold the same samples: --samples 2..3", a.string(),
                                    b.string()));
  expectRefused({a, a}, "hold the same samples: --samples 0..3");
  const fs::path c = part(render_, {{30, 10}, {70, 50}}, 1, 2);
  expectRefused({a, c}, "hold the same samples: --samples 1..2 --pixelbounds 30,70,10,50");
}

TEST_F(Merge, TellsWhatIsMissing) {
  expectRefused({part(0, 1), part(6, 7), part(2, 4)},
                "the films leave gaps; not there is\n  --samples 1..2\n  --samples 4..6");
  Files files = parts(render_, {0, 13, 41, 70}, {0, 33, 50}, {0, 1});
  files.erase(files.begin() + 4);
  expectRefused(files, "not there is\n  --samples 0..1 --pixelbounds 13,41,33,50");
}

TEST_F(Merge, TakesAnInterruptedFilmAlone) {
  const auto scene = buildText(render_.scene);
  renderScene(*scene, 0, 0, 2);
  FilmInfo info = infoOf(render_, 0, 2, 1);
  info.reached.assign(static_cast<std::size_t>(scene->film().tiles()), 2);
  info.reached.back() = 5;
  writeFilm(path("so-far.film"), scene->film(), info);
  MergedFilm film({path("so-far.film")});
  EXPECT_EQ(incompleteness(film.info()), "it was interrupted: pixels have 2 to 5 samples");
  writeMerged(film, {path("so-far.exr"), path("copy.film")});
  const Image image = readExr(path("so-far.exr"));
  EXPECT_EQ(image.number("samplesPerPixel", 0), 2);
  EXPECT_EQ(image.number("mostSamplesPerPixel", 0), 5);
  EXPECT_EQ(contents(path("copy.film")), contents(path("so-far.film"))) << "it can be resumed";
  expectRefused({path("so-far.film"), path("copy.film")},
                "so-far.film was interrupted: pixels have 2 to 5 samples; go on with it first");
}

TEST_F(Merge, RefusesWhatIsNoFilm) {
  const fs::path a = part(0, 3), b = part(3, kSamples);
  expectRefused({a, path("nowhere.film")}, "nowhere.film: No such file", Failure::io);
  expectRefused({a, folder_.path()}, folder_.path().string(), Failure::io);
  folder_.write("empty.film", "");
  expectRefused({a, path("empty.film")}, "empty.film: it is no film", Failure::io);
  const std::string bytes = contents(b);
  folder_.write("cut.film", bytes.substr(0, bytes.size() - 1));
  expectRefused({a, path("cut.film")}, "cut.film: it is cut off", Failure::io);
  // Only the last byte tells that one in the middle is wrong.
  for (const std::size_t at : {bytes.size() / 2, bytes.size() - 1}) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 1);
    folder_.write("damaged.film", damaged);
    expectRefused({a, path("damaged.film")}, "damaged.film: it is damaged", Failure::io);
  }
  std::string future = bytes;
  future[10] = '9';
  folder_.write("future.film", future);
  expectRefused({a, path("future.film")}, "it is a film of another version of pbrt", Failure::io);
}

}  // namespace
}  // namespace pbrt::test
