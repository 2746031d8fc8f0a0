// Films on disk: every bit comes back, and nothing that is damaged is taken for a film.

#include "core/scene/film_file.h"

#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <bit>
#include <fstream>

#include "core/base/file.h"
#include "core/base/rng.h"
#include "core/scene/film_header.h"
#include "tests/scenes.h"

namespace pbrt {
namespace {

class FilmFile : public testing::Test {
 protected:
  FilmFile() { std::filesystem::create_directories(folder_); }
  ~FilmFile() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ =
      std::filesystem::path(testing::TempDir()) /
      fmt::format("film-{}-{}", getpid(),
                  testing::UnitTest::GetInstance()->current_test_info()->name());
  std::filesystem::path file_ = folder_ / "a.film";
};

// Of everything, with values that text easily loses.
FilmInfo oddInfo() {
  FilmInfo info;
  info.key = {~0ULL, 1, (1ULL << 53) + 1, 3, "pbrt-v3, of \xC3\xA9 and \xFF"};
  info.firstSample = 2;
  info.endSample = 7;
  info.hidden = kVariance | kShape;
  info.passEnd = 16;
  info.badSamples = ~0ULL;
  info.seconds = 0.1;
  info.attributes = {{"int", -3},
                     {"float", 0.1F},
                     {"tiny", std::numeric_limits<float>::denorm_min()},
                     {"infinite", -kInfinity},
                     {"double", 1.0 / 3},
                     {"none", std::nan("")},
                     {"zero", -0.0},
                     {"text", std::string("a \"b\"\n\0 \xFF\xC3", 10)},
                     {"matrix", glm::dmat4(1.0 / 3, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15,
                                           double{kInfinity})}};
  return info;
}

bool sameBits(double a, double b) {
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b);
}

// A film of all that can be stored, with random sums that no double holds.
std::unique_ptr<Scene> fullScene() {
  BuildOptions options;
  options.aovs = kEveryAov;
  auto scene = test::buildText(R"(
    Film "image" "integer xresolution" 45 "integer yresolution" 40
    Camera "perspective" Sampler "random" "integer pixelsamples" 3 PixelFilter "mitchell"
    Integrator "whitted" WorldBegin LightSource "point" "point from" [1 2 -3]
    Translate 0.3 0.1 4 Shape "sphere" "float radius" 1.5 WorldEnd)",
                               options);
  test::renderScene(*scene);
  return scene;
}

TEST_F(FilmFile, WhatItSaysOfItselfComesBack) {
  const auto scene = fullScene();
  FilmInfo info = oddInfo();
  info.reached.assign(static_cast<std::size_t>(scene->film().tiles()), 8);
  info.reached[1] = 5;
  writeFilm(file_, scene->film(), info);
  const FilmReader reader(file_);
  const FilmInfo& back = reader.info();
  EXPECT_EQ(back.key, info.key);
  EXPECT_EQ(back.resolution, Point2i(45, 40));
  EXPECT_EQ(back.window, scene->film().crop());
  EXPECT_EQ(back.aovs, scene->film().aovs());
  EXPECT_EQ(back.firstSample, 2U);
  EXPECT_EQ(back.reached, info.reached);
  EXPECT_EQ(back.endSample, 5U) << "the least that a tile has";
  EXPECT_EQ(back.hidden, kVariance | kShape);
  EXPECT_EQ(back.passEnd, 16U);
  EXPECT_EQ(back.origin, scene->film().origin());
  EXPECT_EQ(back.badSamples, info.badSamples);
  EXPECT_EQ(back.seconds, 0.1);
  ASSERT_EQ(back.attributes.size(), info.attributes.size());
  for (const auto& [name, value] : info.attributes) {
    const ImageAttribute& found = back.attributes.at(name);
    ASSERT_EQ(found.index(), value.index()) << name;
    if (const auto* number = std::get_if<double>(&value))
      EXPECT_TRUE(sameBits(std::get<double>(found), *number)) << name;
    else
      EXPECT_EQ(found, value) << name;
  }
}

TEST_F(FilmFile, TilesThatAllHaveTheSameAreNotNamed) {
  const auto scene = fullScene();
  FilmInfo info;
  info.reached.assign(static_cast<std::size_t>(scene->film().tiles()), 3);
  writeFilm(file_, scene->film(), info);
  EXPECT_FALSE(FilmReader(file_).info().interrupted());
  EXPECT_EQ(FilmReader(file_).info().endSample, 3U);
}

TEST_F(FilmFile, EverySumComesBack) {
  for (const AovSet aovs : {AovSet{0}, AovSet{kVariance}, AovSet{kSampleCount}, AovSet{kDepth},
                            AovSet{kShape}, kEveryAov}) {
    BuildOptions options;
    options.aovs = aovs;
    const std::string text = R"(
      Film "image" "integer xresolution" 45 "integer yresolution" 40
        "float cropwindow" [0.1 0.9 0.2 1]
      Camera "perspective" Sampler "random" "integer pixelsamples" 3 PixelFilter "sinc"
      Integrator "whitted" WorldBegin LightSource "point" "point from" [1 2 -3]
      Translate 0.3 0.1 4 Shape "sphere" "float radius" 1.5 WorldEnd)";
    const auto scene = test::buildText(text, options), other = test::buildText(text, options);
    const Image image = test::renderScene(*scene, 0, 0, 2);
    writeFilm(file_, scene->film(), {.endSample = 2});
    const FilmInfo info = readFilm(file_, other->film());
    EXPECT_EQ(info.endSample, 2U);
    EXPECT_EQ(other->film().image().channels, image.channels);
    // And what the roundings have lost: the render goes on from there.
    EXPECT_EQ(test::renderScene(*other, 0, 2, 3).channels,
              test::renderScene(*scene, 0, 2, 3).channels);
  }
}

TEST_F(FilmFile, AFilmOfAnotherKindIsRefused) {
  const auto scene = fullScene();
  writeFilm(file_, scene->film(), {});
  const auto box = test::make<Filter>("box");
  const Bounds2i all{{0, 0}, {45, 40}};
  Film stored(Point2i(45, 40), all, *box, {.aovs = 1});
  EXPECT_THROW(readFilm(file_, stored), Error);
  Film smaller(Point2i(45, 40), {{0, 0}, {45, 39}}, *box, {.aovs = scene->film().aovs()});
  EXPECT_THROW(readFilm(file_, smaller), Error);
  FilmInfo interrupted;
  interrupted.reached = {1, 2};
  writeFilm(file_, scene->film(), interrupted);
  Film same(Point2i(45, 40), all, *box, {.aovs = scene->film().aovs()});
  ASSERT_NE(same.tiles(), 2);
  EXPECT_THROW(readFilm(file_, same), Error);
}

// All that a reader does; true if it was content.
bool readsAll(const std::filesystem::path& file) {
  try {
    FilmReader reader(file);
    std::vector<FilmPixel> row(static_cast<std::size_t>(reader.info().window.width()));
    for (int y = 0; y < reader.info().window.height(); ++y) reader.read(row);
    reader.finish();
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::io);
    EXPECT_NE(std::string_view(error.what()).find(file.filename().string()), std::string::npos);
    return false;
  }
}

// A small one, with all that a file can have.
std::string smallFilm(const std::filesystem::path& file) {
  const auto box = test::make<Filter>("box");
  Film film({3, 2}, {{0, 0}, {3, 2}}, *box, {.aovs = kVariance | kDepth});
  film.add(0, {0.5F, 0.5F}, Spectrum(0.1F, 0.2F, 0.3F), 1);
  FilmInfo info = oddInfo();
  info.reached = {9};
  writeFilm(file, film, info);
  return readFile(file);
}

TEST_F(FilmFile, WhatIsCutOffIsRefused) {
  const std::string whole = smallFilm(file_);
  ASSERT_TRUE(readsAll(file_));
  for (std::size_t n = whole.size(); n-- > 0;) {
    std::filesystem::resize_file(file_, n);
    ASSERT_FALSE(readsAll(file_)) << n << " of " << whole.size() << " bytes";
  }
  std::ofstream(file_, std::ios::binary) << whole << '\0';
  EXPECT_FALSE(readsAll(file_)) << "one byte too many";
}

TEST_F(FilmFile, ADamagedOneIsRefused) {
  const std::string whole = smallFilm(file_);
  std::fstream file(file_, std::ios::binary | std::ios::in | std::ios::out);
  const auto put = [&](std::size_t at, int byte) {
    file.seekp(static_cast<std::streamoff>(at)).put(static_cast<char>(byte)).flush();
  };
  Rng rng(1);
  for (int i = 0; i < 2000; ++i) {
    const auto at = static_cast<std::size_t>(rng.uniform() * static_cast<float>(whole.size()));
    put(at, whole[at] ^ (1 + static_cast<int>(rng.uniform() * 255)));
    ASSERT_FALSE(readsAll(file_)) << "byte " << at;
    put(at, whole[at]);
  }
  EXPECT_TRUE(readsAll(file_));
}

TEST_F(FilmFile, WhatIsNoFileIsRefused) {
  EXPECT_FALSE(readsAll(folder_ / "nothing.film"));
  std::filesystem::create_directory(file_);
  EXPECT_FALSE(readsAll(file_));
  EXPECT_FALSE(readsAll("/dev/zero"));
  ASSERT_EQ(mkfifo((folder_ / "pipe.film").c_str(), 0600), 0);
  EXPECT_FALSE(readsAll(folder_ / "pipe.film")) << "and nobody waits for who writes into it";
}

// Is refused, in words that are ours.
void expectNonsense(const std::string& header) {
  try {
    readFilmHeader(header);
    ADD_FAILURE() << header;
  } catch (const std::runtime_error& error) {
    EXPECT_TRUE(std::string_view(error.what()).starts_with("its header ")) << error.what();
  }
}

// Headers that are text, but no film's: what a hash does not tell.
TEST(FilmHeader, NonsenseIsRefused) {
  FilmInfo info = oddInfo();
  info.resolution = {30, 20};
  info.window = {{10, 5}, {30, 20}};
  info.reached = {7, 9};
  const std::string good = filmHeader(info);
  ASSERT_EQ(readFilmHeader(good).window, info.window);
  const std::pair<std::string, std::string> changes[] = {
      {"[30,20]]", "[31,20]]"},                            // beyond the picture
      {"[30,20]]", "[10,20]]"},                            // empty
      {"[30,20]]", "[30,-1]]"},                            // negative
      {"[30,20]]", "[30,20.5]]"},                          // no whole number
      {"[30,20]]", "[30]]"},                               // no point
      {"[30,20]]", "[4294967326,20]]"},                    // 30 if cut to 32 bits
      {"\"endSample\":7", "\"endSample\":8"},              // more than a tile has
      {"\"endSample\":7", "\"endSample\":6"},              // less than each has
      {"\"endSample\":7", "\"endSample\":4294967303"},     // 7 if cut
      {"\"endSample\":7", "\"endSample\":null"},           //
      {"\"firstSample\":2", "\"firstSample\":8"},          // after the end
      {"\"stored\":[]", "\"stored\":[\"colour\"]"},        // no such thing
      {"\"stored\":[]", "\"stored\":[7]"},                 //
      {"\"samplesPerPixel\":3", "\"samplesPerPixel\":0"},  //
      {"{\"int\":-3}", "{\"integer\":-3}"},                // an attribute of no type
      {"{\"int\":-3}", "{\"int\":\"a\"}"},                 //
      {"\"origin\":[0.0,", "\"origin\":[\"much\","},       //
      {"\"origin\":[0.0,", "\"origin\":["},                //
      {"\"seconds\":0.1", "\"seconds\":-1e300"},           // no time
      {"\"seconds\":0.1", "\"seconds\":\"inf\""},          //
      {"\"seconds\":0.1", "\"seconds\":\"nan\""},          //
      {"\"key\"", "\"keys\""},                             //
      {"}", ""},                                           // no JSON
  };
  for (const auto& [from, to] : changes) {
    std::string bad = good;
    ASSERT_NE(bad.find(from), std::string::npos) << from;
    bad.replace(bad.find(from), from.size(), to);
    expectNonsense(bad);
  }
  expectNonsense(std::string(100000, '['));
  expectNonsense("");
}

}  // namespace
}  // namespace pbrt
