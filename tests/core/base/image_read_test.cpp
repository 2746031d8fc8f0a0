// Pictures that others wrote: each format holds what its specification says, and a broken file is
// an error that names it.

#include "core/base/error.h"
#include "core/base/image.h"
#include "core/base/rng.h"
#include "tests/command.h"

namespace pbrt::test {
namespace {

std::string bytes(std::initializer_list<int> values) {
  std::string s;
  for (const int v : values) s += static_cast<char>(v);
  return s;
}
std::string floats(std::initializer_list<float> values, bool bigEndian) {
  std::string s;
  for (const float v : values) {
    std::string four(reinterpret_cast<const char*>(&v), 4);
    if (bigEndian) std::reverse(four.begin(), four.end());
    s += four;
  }
  return s;
}

// A PNG chunk, with its checksum (the CRC-32 of ISO 3309).
std::string chunk(const std::string& type, const std::string& data) {
  const auto big = [](std::uint32_t v) {
    return bytes({int(v >> 24U), int(v >> 16U & 255U), int(v >> 8U & 255U), int(v & 255U)});
  };
  std::uint32_t crc = ~0U;
  for (const char c : type + data) {
    crc ^= static_cast<std::uint8_t>(c);
    for (int i = 0; i < 8; ++i) crc = crc >> 1U ^ (crc & 1U ? 0xEDB88320U : 0U);
  }
  return big(static_cast<std::uint32_t>(data.size())) + type + data + big(~crc);
}
// One row of 16-bit grey, which deflate stores as it is.
std::string widePng(std::initializer_list<int> row) {
  std::string raw(1, '\0');
  for (const int v : row) raw += bytes({v >> 8, v & 255});
  std::uint32_t a = 1, b = 0;  // Adler-32
  for (const char c : raw) {
    a = (a + static_cast<std::uint8_t>(c)) % 65521;
    b = (b + a) % 65521;
  }
  const int n = static_cast<int>(raw.size());
  const std::string stored = bytes({0x78, 1, 1, n, 0, ~n & 255, 255}) + raw +
                             bytes({int(b >> 8U), int(b & 255U), int(a >> 8U), int(a & 255U)});
  return "\x89PNG\r\n\x1a\n" +
         chunk("IHDR", bytes({0, 0, 0, int(row.size()), 0, 0, 0, 1, 16, 0, 0, 0, 0})) +
         chunk("IDAT", stored) + chunk("IEND", "");
}

// Two by two: red green over blue and a grey of 51.
std::string tga(int descriptor, const std::string& pixels, int kind = 2, int depth = 24) {
  return bytes({0, 0, kind, 0, 0, 0, 0, 0, 0, 0, 0, 0, 2, 0, 2, 0, depth, descriptor}) + pixels;
}
const std::string kRed = bytes({0, 0, 255}), kGreen = bytes({0, 255, 0}),
                  kBlue = bytes({255, 0, 0}), kGrey = bytes({51, 51, 51});

const std::string kHdr = "#?RADIANCE\n# made\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=1\n\n";

class ImageRead : public testing::Test {
 protected:
  Image read(const std::string& name, const std::string& content) const {
    folder.write(name, content);
    return readImage(folder.path() / name);
  }
  static void expectColors(const Image& image, std::initializer_list<std::array<float, 3>> colors) {
    std::size_t i = 0;
    ASSERT_EQ(image.channels.at(0).size(), colors.size());
    for (const auto& color : colors) {
      for (int c = 0; c < 3; ++c) EXPECT_FLOAT_EQ(image.channels.at(c)[i], color[c]) << i << c;
      ++i;
    }
  }
  Folder folder;
};

TEST_F(ImageRead, PfmOfBothByteOrders) {
  for (const bool big : {false, true}) {
    const std::string scale = big ? "2.0" : "-2.0";
    const Image color =
        read("a.pfm", "PF\n1 2\n" + scale + "\n" + floats({1, 2, 3, 4, 5, 6e9F}, big));
    EXPECT_EQ(color.resolution, Point2i(1, 2));
    EXPECT_FALSE(color.encoded);
    expectColors(color, {{8, 10, 12e9F}, {2, 4, 6}});  // rows from the bottom, times the scale
    const Image grey = read("b.PFM", "Pf 2 1 " + scale + "\n" + floats({0.5F, -1}, big));
    EXPECT_EQ(*grey.channel("Y"), (std::vector<float>{1, -2}));
  }
}

TEST_F(ImageRead, TgaOfAllKinds) {
  const std::array<float, 3> red{1, 0, 0}, green{0, 1, 0}, blue{0, 0, 1}, grey{.2F, .2F, .2F};
  const auto expected = {red, green, blue, grey};
  expectColors(read("a.tga", tga(0x20, kRed + kGreen + kBlue + kGrey)), expected);
  expectColors(read("a.tga", tga(0, kBlue + kGrey + kRed + kGreen)), expected);
  expectColors(read("a.tga", tga(0x30, kGreen + kRed + kGrey + kBlue)), expected);
  // One run of one, three as they are; then a run over the end of a row.
  expectColors(
      read("a.tga", tga(0x20, bytes({0x80}) + kRed + bytes({2}) + kGreen + kBlue + kGrey, 10)),
      expected);
  expectColors(read("a.tga", tga(0x20, bytes({0x82}) + kRed + bytes({0}) + kGrey, 10)),
               {red, red, red, grey});
  expectColors(read("a.tga", tga(0x20, bytes({0, 0x7C, 0xE0, 3, 0x1F, 0, 0, 0}), 2, 16)),
               {red, green, blue, {0, 0, 0}});
  const Image one = read("a.tga", tga(0x20, bytes({0, 51, 102, 255}), 3, 8));
  EXPECT_TRUE(one.encoded);
  EXPECT_EQ(*one.channel("Y"), (std::vector<float>{0, 51 / 255.F, 102 / 255.F, 1}));
  // A map of two entries, the first of which has number 5, behind a name of three letters.
  const Image mapped =
      read("a.tga", bytes({3, 1, 1, 5, 0, 2, 0, 24, 0, 0, 0, 0, 2, 0, 1, 0, 8, 32}) + "abc" +
                        kBlue + kGrey + bytes({6, 5}));
  expectColors(mapped, {grey, blue});
  const Image alpha =
      read("a.tga", tga(0x28, bytes({0, 0, 255, 51, 0, 0, 0, 0}) + kRed + kRed + kRed, 2, 32));
  EXPECT_EQ((*alpha.channel("A"))[0], 51 / 255.F);
  EXPECT_EQ((*alpha.channel("R"))[0], 1);
}

TEST_F(ImageRead, RadianceFlatAndRunLength) {
  // 2^(e - 136) times the mantissa: 128 at exponent 129 is 1.
  const Image flat =
      read("a.hdr", kHdr + "-Y 2 +X 2\n" +
                        bytes({128, 64, 0, 129, 1, 1, 1, 1, 0, 0, 0, 0, 128, 128, 255, 140}));
  EXPECT_FALSE(flat.encoded);
  expectColors(flat, {{1, .5F, 0}, {1, .5F, 0}, {0, 0, 0}, {2048, 2048, 4080}});
  expectColors(read("a.hdr", kHdr + "+Y 2 +X 1\n" + bytes({128, 0, 0, 129, 0, 128, 0, 129})),
               {{0, 1, 0}, {1, 0, 0}});
  // Eight pixels: red a run of eight; green four as they are and a run of four; blue 0; exponents.
  const Image runs = read(
      "a.hdr", kHdr + "-Y 1 +X 8\n" +
                   bytes({2, 2, 0, 8, 136, 128, 4, 0, 32, 64, 128, 132, 16, 136, 0, 136, 129}));
  EXPECT_EQ(*runs.channel("R"), std::vector<float>(8, 1));
  EXPECT_EQ(*runs.channel("G"), (std::vector<float>{0, .25F, .5F, 1, .125F, .125F, .125F, .125F}));
}

TEST_F(ImageRead, PngAsItIsStored) {
  Image image;
  image.window = {{0, 0}, {2, 1}};
  image.resolution = {2, 1};
  image.names = {"R", "G", "B"};
  image.channels = {{0, 1}, {0.25F, 0.5F}, {0.001F, 2}};
  writeImage(folder.path() / "a.png", image);
  const Image back = readImage(folder.path() / "a.png");
  EXPECT_TRUE(back.encoded);
  for (int c = 0; c < 3; ++c)
    for (int i = 0; i < 2; ++i)
      EXPECT_EQ(back.channels[c][i], std::round(encodeSrgb(image.channels[c][i]) * 255) / 255.F);

  const Image wide = read("b.png", widePng({0, 1, 258, 65535}));
  EXPECT_EQ(*wide.channel("Y"), (std::vector<float>{0, 1 / 65535.F, 258 / 65535.F, 1}));
}

TEST_F(ImageRead, SrgbCurve) {
  for (int i = 0; i <= 255; ++i) {
    const double code = i / 255.0;
    const double linear = code <= 0.04045 ? code / 12.92 : std::pow((code + 0.055) / 1.055, 2.4);
    EXPECT_NEAR(decodeSrgb(static_cast<float>(code)), linear, 1e-6);
    EXPECT_NEAR(encodeSrgb(static_cast<float>(linear)), code, 1e-5);
  }
}

// No prefix of a file is a file, and no other damage crashes.
TEST_F(ImageRead, BrokenFiles) {
  const std::pair<std::string, std::string> files[] = {
      {"a.pfm", "PF\n1 2\n-1\n" + floats({1, 2, 3, 4, 5, 6}, false)},
      {"a.tga", tga(0x20, bytes({0x81}) + kRed + bytes({1}) + kGreen + kBlue, 10)},
      {"a.hdr", kHdr + "-Y 1 +X 8\n" +
                    bytes({2, 2, 0, 8, 136, 128, 4, 0, 32, 64, 128, 132, 16, 136, 0, 136, 129})},
      {"a.png", widePng({0, 1, 258, 65535})}};
  Rng rng(1);
  for (const auto& [name, content] : files) {
    ASSERT_NO_THROW(read(name, content)) << name;
    for (std::size_t n = 0; n < content.size(); ++n) {
      try {
        read(name, content.substr(0, n));
        ADD_FAILURE() << name << " of " << n << " bytes";
      } catch (const Error& error) {
        EXPECT_NE(std::string(error.what()).find(name), std::string::npos);
        EXPECT_EQ(error.failure(), Failure::io);
      }
    }
    for (int i = 0; i < 250; ++i) {
      std::string damaged = content;
      for (std::uint32_t k = rng.uniform(3U) + 1; k > 0; --k)
        damaged[rng.uniform(static_cast<std::uint32_t>(content.size()))] =
            static_cast<char>(rng.bits());
      try {
        read(name, damaged);
      } catch (const Error&) {
        continue;
      }
    }
  }
}

// Radiance's run lengths could hold so many pixels in so few bytes; no memory could.
TEST_F(ImageRead, LargerThanMemoryIsRefusedBeforeItIsTaken) {
  const std::string head = kHdr + "-Y 262144 +X 262144\n";
  try {
    read("a.hdr", head + std::string(std::size_t{16} << 20U, '\1'));
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("too large for the memory"), std::string::npos)
        << error.what();
  }
}

TEST_F(ImageRead, RefusesWhatIsNoPicture) {
  EXPECT_THROW(read("a.jpg", "x"), Error);
  EXPECT_THROW(read("a", "x"), Error);
  EXPECT_THROW(readImage(folder.path() / "absent.png"), Error);
  std::filesystem::create_directory(folder.path() / "folder.png");
  EXPECT_THROW(readImage(folder.path() / "folder.png"), Error);
  // Claims of sizes that the file cannot hold.
  EXPECT_THROW(read("a.pfm", "PF 1000000 1000000 -1\n1234"), Error);
  EXPECT_THROW(read("a.hdr", kHdr + "-Y 1000000 +X 1000000\n1234"), Error);
}

}  // namespace
}  // namespace pbrt::test
