// Pictures: what is written is what is read, by our reader and by the libraries' own; a file is
// whole or absent; broken files are errors.

#include "core/base/image.h"

#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfMatrixAttribute.h>
#include <ImfTiledOutputFile.h>
#include <gtest/gtest.h>
#include <png.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <glm/gtc/matrix_transform.hpp>

#include "core/base/error.h"
#include "core/base/rng.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

// A folder of the test's own, removed with all that is in it.
class ImageTest : public testing::Test {
 protected:
  ImageTest() : folder(fs::temp_directory_path() / ("image_test-" + std::to_string(getpid()))) {
    fs::remove_all(folder);
    fs::create_directory(folder);
  }
  ~ImageTest() override { fs::remove_all(folder); }

  std::vector<std::string> files() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    return names;
  }

  fs::path folder;
};

std::string bytesOf(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void writeBytes(const fs::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

Image noise(const Bounds2i& window, Point2i resolution, std::vector<std::string> names) {
  Image image;
  image.window = window;
  image.resolution = resolution;
  image.names = std::move(names);
  Rng rng(7);
  for (std::size_t i = 0; i < image.names.size(); ++i) {
    auto& channel = image.channels.emplace_back(window.width() * window.height());
    for (float& v : channel) v = rng.uniform();
  }
  return image;
}

Image whole(int width, int height, std::vector<std::string> names) {
  return noise({{0, 0}, {width, height}}, {width, height}, std::move(names));
}

void expectSamePixels(const Image& a, const Image& b) {
  EXPECT_EQ(a.window, b.window);
  EXPECT_EQ(a.resolution, b.resolution);
  ASSERT_EQ(a.names.size(), b.names.size());
  for (const std::string& name : a.names) {
    ASSERT_NE(b.channel(name), nullptr) << name;
    EXPECT_EQ(*a.channel(name), *b.channel(name)) << name;
  }
}

// The message, if `action` throws an Error of kind io; else a test failure.
template <class Action>
std::string ioError(Action action) {
  try {
    action();
  } catch (const Error& error) {
    EXPECT_EQ(error.failure(), Failure::io);
    return error.what();
  }
  ADD_FAILURE() << "no error";
  return {};
}

struct Pixels {
  png_uint_32 width = 0, height = 0, format = 0;
  std::vector<int> bytes;  // RGBA
};

Pixels readPng(const fs::path& file) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_NE(png_image_begin_read_from_file(&png, file.c_str()), 0) << png.message;
  Pixels pixels{png.width, png.height, png.format, {}};
  png.format = PNG_FORMAT_RGBA;
  std::vector<png_byte> bytes(PNG_IMAGE_SIZE(png));
  EXPECT_NE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr), 0) << png.message;
  pixels.bytes.assign(bytes.begin(), bytes.end());
  return pixels;
}

// One row of grey pixels with alpha.
Image greys(const std::vector<float>& values, const std::vector<float>& alpha) {
  const int n = static_cast<int>(values.size());
  Image image = whole(n, 1, {"R", "G", "B"});
  image.channels = {values, values, values};
  if (!alpha.empty()) {
    image.names.emplace_back("A");
    image.channels.push_back(alpha);
  }
  return image;
}

TEST_F(ImageTest, ExrKeepsEveryBitOfChannelsWindowsAndAttributes) {
  Image image = noise({{5, 70}, {45, 211}}, {100, 300}, {"R", "G", "B", "A", "variance.Y"});
  image.channels[0][0] = 1e-42F;  // subnormal
  image.channels[1][3] = -kInfinity;
  image.attributes = {
      {"samples", 16},
      {"seconds", 0.1},
      {"exposure", 0.1F},
      {"software", std::string("pbrt \xe2\x82\xac")},
      {"worldToCamera", glm::dmat4(1, 2, 3, 0, 4, 5, 6, 0, 7, 8, 9, 0, 10, 11, 12, 1)}};
  writeImage(folder / "a.exr", image);
  const Image back = readExr(folder / "a.exr");
  expectSamePixels(image, back);
  for (const auto& [name, value] : image.attributes) {
    ASSERT_TRUE(back.attributes.contains(name)) << name;
    EXPECT_EQ(back.attributes.at(name), value) << name;
  }
  // What was read can be written: the file's own attributes do not get in the way.
  writeImage(folder / "b.exr", back);
  expectSamePixels(image, readExr(folder / "b.exr"));
  EXPECT_EQ(files(), (std::vector<std::string>{"a.exr", "b.exr"}));
}

TEST_F(ImageTest, MatricesMapPointsAlikeInImath) {
  const glm::dmat4 m = glm::translate(glm::perspective(1.0, 1.5, 0.5, 8.0), {3.0, -2.0, 1.0});
  Image image = whole(1, 1, {"R"});
  image.attributes["worldToNDC"] = m;
  writeImage(folder / "m.exr", image);

  const Imf::InputFile file((folder / "m.exr").c_str());
  const auto& theirs = file.header().typedAttribute<Imf::M44fAttribute>("worldToNDC").value();
  const glm::dvec4 ours = m * glm::dvec4(0.3, 0.7, -4.0, 1);
  Imath::V3f mapped;
  theirs.multVecMatrix(Imath::V3f(0.3F, 0.7F, -4.F), mapped);  // row vector, with division by w
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(mapped[i], ours[i] / ours.w, 1e-5);
}

TEST_F(ImageTest, ReadsTilesOfHalfAndIntegerChannelsAwayFromTheOrigin) {
  const fs::path path = folder / "tiles.exr";
  const Imath::Box2i display({10, 20}, {209, 219});
  const Imath::Box2i window({30, 40}, {129, 189});
  const int width = 100, height = 150;
  std::vector<half> halves(width * height);
  std::vector<unsigned> integers(width * height);
  for (int i = 0; i < width * height; ++i) {
    halves[i] = half(static_cast<float>(i % 1000) / 8);
    integers[i] = static_cast<unsigned>(i);
  }
  {
    Imf::Header header(display, window);
    header.setTileDescription(Imf::TileDescription(32, 17));
    header.channels().insert("h", Imf::Channel(Imf::HALF));
    header.channels().insert("id", Imf::Channel(Imf::UINT));
    Imf::FrameBuffer pixels;
    pixels.insert("h", Imf::Slice::Make(Imf::HALF, halves.data(), window));
    pixels.insert("id", Imf::Slice::Make(Imf::UINT, integers.data(), window));
    Imf::TiledOutputFile file(path.c_str(), header);
    file.setFrameBuffer(pixels);
    file.writeTiles(0, file.numXTiles() - 1, 0, file.numYTiles() - 1);
  }
  const Image image = readExr(path);
  EXPECT_EQ(image.resolution, Point2i(200, 200));
  EXPECT_EQ(image.window, (Bounds2i{{20, 20}, {120, 170}}));  // the display begins at 0
  ASSERT_NE(image.channel("h"), nullptr);
  ASSERT_NE(image.channel("id"), nullptr);
  for (int i = 0; i < width * height; ++i) {
    EXPECT_EQ((*image.channel("h"))[i], static_cast<float>(halves[i]));
    EXPECT_EQ((*image.channel("id"))[i], static_cast<float>(i));
  }
}

TEST_F(ImageTest, BrokenExrIsAnErrorThatNamesTheFile) {
  const fs::path path = folder / "broken.exr";
  EXPECT_NE(ioError([&] { readExr(path); }).find("broken.exr"), std::string::npos);  // not there
  EXPECT_NE(ioError([&] { readExr(folder); }).find(folder.string()), std::string::npos);

  writeImage(path, whole(40, 40, {"R", "G", "B"}));
  const std::string bytes = bytesOf(path);
  for (std::size_t size = 0; size < bytes.size(); size += 1 + size / 8) {
    writeBytes(path, std::string_view(bytes).substr(0, size));
    EXPECT_NE(ioError([&] { readExr(path); }).find("broken.exr"), std::string::npos) << size;
  }
}

// Or else these few bytes ask for 1.75 GiB.
TEST_F(ImageTest, AttributeOfAnExrIsNoLongerThanTheFile) {
  const fs::path path = folder / "long.exr";
  Image image = whole(1, 1, {"Y"});
  image.attributes["software"] = std::string("x");
  writeImage(path, image);
  std::string bytes = bytesOf(path);
  const std::string attribute("software\0string\0\1", 17);
  ASSERT_NE(bytes.find(attribute), std::string::npos);
  bytes[bytes.find(attribute) + 19] = 0x70;
  writeBytes(path, bytes);
  EXPECT_NE(ioError([&] { readExr(path); }).find("Invalid size"), std::string::npos);
}

TEST_F(ImageTest, DamagedExrNeverCrashes) {
  const fs::path path = folder / "damaged.exr";
  writeImage(path, whole(16, 16, {"R", "G", "B"}));
  const std::string bytes = bytesOf(path);
  Rng rng(1);
  for (int round = 0; round < 2000; ++round) {
    std::string damaged = bytes;
    // Half of the damage goes to the header, which is short and decides sizes.
    const std::size_t range = round % 2 ? 400 : bytes.size();
    for (std::uint32_t k = rng.uniform(4) + 1; k > 0; --k)
      damaged[rng.uniform(static_cast<std::uint32_t>(range))] = static_cast<char>(rng.bits());
    writeBytes(path, damaged);
    try {
      const Image image = readExr(path);
      for (const auto& channel : image.channels)
        ASSERT_EQ(channel.size(),
                  static_cast<std::size_t>(image.window.width()) * image.window.height());
    } catch (const Error& error) {
      EXPECT_EQ(error.failure(), Failure::io);
    }
  }
}

TEST_F(ImageTest, PngIsSrgb) {
  std::vector<float> values;
  for (int i = 0; i <= 4096; ++i) values.push_back(static_cast<float>(i) / 4096);
  writeImage(folder / "a.png", greys(values, {}));
  const Pixels png = readPng(folder / "a.png");
  EXPECT_EQ(png.width, values.size());
  EXPECT_EQ(png.height, 1U);
  EXPECT_EQ(png.format & PNG_FORMAT_FLAG_ALPHA, 0U);
  for (std::size_t i = 0; i < values.size(); ++i) {
    // The decoder of IEC 61966-2-1, in double, takes the code's rounding interval to one that
    // holds the value.
    const auto decode = [](double code) {
      const double v = code / 255;
      return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
    };
    const int code = png.bytes[4 * i];
    EXPECT_GE(values[i], decode(code - 0.5001)) << values[i];
    EXPECT_LE(values[i], decode(code + 0.5001)) << values[i];
    EXPECT_EQ(png.bytes[4 * i + 3], 255);
  }
}

TEST_F(ImageTest, PngChannelsAndRowsAreInOrder) {
  Image image = whole(2, 2, {"B", "G", "R"});
  image.channels = {{0, 0, 1, 0}, {0, 1, 0, 0}, {1, 0, 0, 0}};  // red, green; blue, black
  writeImage(folder / "a.png", image);
  EXPECT_EQ(readPng(folder / "a.png").bytes,
            (std::vector<int>{255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 0, 0, 0, 255}));
}

TEST_F(ImageTest, PngColoursAreNotMultipliedByAlpha) {
  writeImage(folder / "a.png", greys({0.5F, 0.25F, 0.1F, 1, 0}, {1, 0.5F, 0.2F, 0, 0}));
  const Pixels png = readPng(folder / "a.png");
  const int half = 188;  // sRGB code of linear 0.5
  EXPECT_EQ(png.bytes, (std::vector<int>{half, half, half, 255, half, half, half, 128, half, half,
                                         half, 51,   255,  255, 255,  0,    0,    0,   0,    0}));
}

TEST_F(ImageTest, PngClampsWhatIsNoColour) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  writeImage(folder / "a.png", greys({nan, kInfinity, -kInfinity, -1, 3e38F, 1}, {}));
  const std::vector<int> codes{0, 255, 0, 0, 255, 255};
  const Pixels png = readPng(folder / "a.png");
  for (std::size_t i = 0; i < codes.size(); ++i) EXPECT_EQ(png.bytes[4 * i], codes[i]) << i;
}

TEST_F(ImageTest, PngWithoutColourIsAnError) {
  EXPECT_NE(ioError([&] { writeImage(folder / "a.png", whole(2, 2, {"Y"})); }).find("a.png"),
            std::string::npos);
  EXPECT_TRUE(files().empty());
}

TEST_F(ImageTest, AFailedWriteLeavesTheOldFileAndNothingElse) {
  for (const char* name : {"old.exr", "old.png"}) {
    const fs::path path = folder / name;
    writeImage(path, whole(8, 8, {"R", "G", "B"}));
    const std::string before = bytesOf(path);
    const std::vector<std::string> listed = files();

    // A limit on file size fails as a full disk does; each size fails at another place.
    const Image large = whole(64, 64, {"R", "G", "B"});
    writeImage(folder / fs::path("full").replace_extension(path.extension()), large);
    const auto full = fs::file_size(folder / fs::path("full").replace_extension(path.extension()));
    fs::remove(folder / fs::path("full").replace_extension(path.extension()));
    rlimit old{};
    getrlimit(RLIMIT_FSIZE, &old);
    auto* const handler = std::signal(SIGXFSZ, SIG_IGN);
    for (const rlim_t size :
         {rlim_t{0}, rlim_t{100}, rlim_t{4096}, rlim_t{full / 2}, rlim_t{full - 1}}) {
      const rlimit limit{size, old.rlim_max};
      setrlimit(RLIMIT_FSIZE, &limit);
      std::string message;
      try {
        writeImage(path, large);
      } catch (const Error& error) {
        message = error.what();
      }
      setrlimit(RLIMIT_FSIZE, &old);
      EXPECT_NE(message.find(name), std::string::npos) << size << message;
      EXPECT_EQ(bytesOf(path), before);
      EXPECT_EQ(files(), listed);
    }
    std::signal(SIGXFSZ, handler);
  }
}

TEST_F(ImageTest, WhatCannotBeWrittenIsKnownBeforehand) {
  const Image image = whole(2, 2, {"R", "G", "B"});
  fs::create_directory(folder / "folder.exr");
  for (const fs::path& path :
       {folder / "a.jpg", folder / "a", folder / ".exr", folder / "no/a.exr", folder / "folder.exr",
        folder / (std::string(300, 'n') + ".exr"), fs::path("/proc/a.exr")}) {
    const std::string message = ioError([&] { checkWritable(path); });
    EXPECT_NE(message.find(path.string()), std::string::npos) << message;
    EXPECT_EQ(message, ioError([&] { writeImage(path, image); }));
  }
  for (const fs::path& path :
       {folder / "a.exr", folder / "a.PNG", folder / (std::string(251, 'n') + ".exr")}) {
    checkWritable(path);
    EXPECT_FALSE(fs::exists(path));
    writeImage(path, image);
    checkWritable(path);
    EXPECT_TRUE(fs::is_regular_file(path));
  }
}

TEST_F(ImageTest, AProtectedFolderOrFileIsRefused) {
  if (geteuid() == 0) GTEST_SKIP() << "nothing is protected from root";
  writeImage(folder / "a.exr", whole(2, 2, {"R"}));
  fs::permissions(folder / "a.exr", fs::perms::owner_read);
  ioError([&] { checkWritable(folder / "a.exr"); });
  fs::permissions(folder, fs::perms::owner_read | fs::perms::owner_exec);
  ioError([&] { checkWritable(folder / "b.exr"); });
  fs::permissions(folder, fs::perms::owner_all);
}

TEST_F(ImageTest, ALinkKeepsPointingAtTheFile) {
  fs::create_directory(folder / "there");
  writeImage(folder / "there/a.exr", whole(2, 2, {"R"}));
  fs::create_symlink(folder / "there/a.exr", folder / "link.exr");
  const Image image = whole(3, 3, {"R"});
  writeImage(folder / "link.exr", image);
  EXPECT_TRUE(fs::is_symlink(folder / "link.exr"));
  expectSamePixels(image, readExr(folder / "there/a.exr"));
}

}  // namespace
}  // namespace pbrt
