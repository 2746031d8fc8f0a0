// Pictures on surfaces: formats, code values, and what is wrong with files.

#include <cstdio>

#include "core/base/image.h"
#include "tests/textures/imagemap.h"

// After cstdio, which it needs.
#include <jpeglib.h>

namespace pbrt::test {
namespace {

TEST_F(ImageMap, CodeValuesAreDecoded) {
  folder.write("a.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\x20\x33\x66\x99", 21));
  const std::string tga = (folder.path() / "a.tga").string();
  const auto red = [&](const ParamList& list) {
    return texture<Spectrum>(tga, list)->evaluate(at(0, 0)).x;
  };
  EXPECT_FLOAT_EQ(red({}), decodeSrgb(0.6F));
  EXPECT_FLOAT_EQ(red({flag("gamma", true)}), decodeSrgb(0.6F));
  EXPECT_FLOAT_EQ(red({flag("gamma", false)}), 0.6F);
  EXPECT_FLOAT_EQ(red({text("encoding", "linear")}), 0.6F);
  EXPECT_FLOAT_EQ(red({text("encoding", "sRGB")}), decodeSrgb(0.6F));
  EXPECT_FLOAT_EQ(red({text("encoding", "gamma 2.2")}), std::pow(0.6F, 2.2F));
  EXPECT_THROW(red({text("encoding", "gamma")}), Error);
  EXPECT_THROW(red({text("encoding", "gamma -1")}), Error);
  EXPECT_THROW(red({text("encoding", "srgb2")}), Error);
  // A float texture is the luminance of the light.
  EXPECT_FLOAT_EQ(texture(tga)->evaluate(at(0, 0)),
                  luminance({decodeSrgb(0.6F), decodeSrgb(0.4F), decodeSrgb(0.2F)}));
  // Values of light are not: 0.25 stays, unless pbrt-v3's parameter asks for it.
  const std::string pfm = grey("b.pfm", 1, {0.25F});
  EXPECT_EQ(texture(pfm)->evaluate(at(0, 0)), 0.25F);
  EXPECT_EQ(texture(pfm, {text("encoding", "sRGB")})->evaluate(at(0, 0)), 0.25F);
  EXPECT_FLOAT_EQ(texture(pfm, {flag("gamma", true)})->evaluate(at(0, 0)), decodeSrgb(0.25F));
}

// pbrt-v1 and v2 take code values as light: what their generation says where the scene does not.
TEST_F(ImageMap, TheGenerationMaySayThatCodeValuesAreLight) {
  folder.write("a.tga", std::string("\0\0\2\0\0\0\0\0\0\0\0\0\1\0\1\0\x18\x20\x33\x66\x99", 21));
  const ParamList list = {text("filename", (folder.path() / "a.tga").string())};
  const ParamList defaults = {flag("gamma", false)};
  Params params("imagemap", {}, {&list}, nullptr, {}, &defaults);
  const auto map =
      create<Texture<Spectrum>>(loader().open(PluginKind::texture, "imagemap"), params, {});
  EXPECT_FLOAT_EQ(map->evaluate(at(0, 0)).x, 0.6F);
}

TEST_F(ImageMap, ReadsPngAndExr) {
  Image image;
  image.window = {{0, 0}, {2, 1}};
  image.resolution = {2, 1};
  image.names = {"R", "G", "B"};
  image.channels = {{0.1F, 1}, {0.2F, 0}, {0.4F, 0.5F}};
  for (const char* name : {"a.png", "a.exr"}) {
    writeImage(folder.path() / name, image);
    const Spectrum c =
        texture<Spectrum>((folder.path() / name).string())->evaluate(at(0.25F, 0.5F));
    EXPECT_LT(glm::length(c - Spectrum(0.1F, 0.2F, 0.4F)), 4e-3F) << name;
  }
  image.channels[1][0] = std::numeric_limits<float>::quiet_NaN();
  writeImage(folder.path() / "nan.exr", image);
  EXPECT_THROW(texture<Spectrum>((folder.path() / "nan.exr").string()), Error);
}

// By libjpeg at quality 100: a few code values off at most.
TEST_F(ImageMap, ReadsJpeg) {
  for (const int channels : {1, 3}) {
    const std::string file = (folder.path() / (channels == 1 ? "grey.jpg" : "color.JPEG")).string();
    jpeg_compress_struct jpeg{};
    jpeg_error_mgr errors{};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    std::FILE* out = std::fopen(file.c_str(), "wb");
    jpeg_stdio_dest(&jpeg, out);
    jpeg.image_width = 16;
    jpeg.image_height = 32;
    jpeg.input_components = channels;
    jpeg.in_color_space = channels == 1 ? JCS_GRAYSCALE : JCS_RGB;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 100, TRUE);
    jpeg_start_compress(&jpeg, TRUE);
    for (int y = 0; y < 32; ++y) {
      std::vector<JSAMPLE> row;
      for (int x = 0; x < 16; ++x)
        for (int c = 0; c < channels; ++c)
          row.push_back(static_cast<JSAMPLE>(y < 16 ? 200 - 50 * c : 30));
      JSAMPROW pointer = row.data();
      jpeg_write_scanlines(&jpeg, &pointer, 1);
    }
    jpeg_finish_compress(&jpeg);
    jpeg_destroy_compress(&jpeg);
    std::fclose(out);

    const auto map = texture<Spectrum>(file, {text("encoding", "linear")});
    const Spectrum top = map->evaluate(at(0.5F, 0.75F)), low = map->evaluate(at(0.5F, 0.25F));
    EXPECT_NEAR(top.x * 255, 200, 2);
    EXPECT_NEAR(top.z * 255, channels == 1 ? 200 : 100, 2);
    EXPECT_NEAR(low.y * 255, 30, 2);
    EXPECT_NEAR(texture<Spectrum>(file)->evaluate(at(0.5F, 0.75F)).x, decodeSrgb(200 / 255.F),
                0.02F);

    const std::string whole = contents(file);
    for (const std::size_t n :
         {std::size_t{0}, std::size_t{1}, whole.size() / 4, whole.size() / 2, whole.size() - 20}) {
      folder.write("cut.jpg", whole.substr(0, n));
      EXPECT_THROW(texture((folder.path() / "cut.jpg").string()), Error) << n;
    }
  }
}

TEST_F(ImageMap, ErrorsNameTheFile) {
  folder.write("broken.png", "not a picture");
  try {
    texture((folder.path() / "broken.png").string());
    FAIL();
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find("broken.png"), std::string::npos);
  }
  EXPECT_THROW(texture((folder.path() / "absent.png").string()), Error);
  EXPECT_THROW(texture(folder.path().string()), Error);
  EXPECT_THROW(make<Texture<float>>("imagemap"), Error);
  const std::string file = grey("a.pfm", 1, {1});
  EXPECT_THROW(texture(file, {text("wrap", "mirror")}), Error);
  EXPECT_THROW(texture(file, {text("filter", "lanczos")}), Error);
  EXPECT_THROW(texture(file, {number("maxanisotropy", 0)}), Error);
}

// As long as a texture holds a file, others get the same texels, of either kind.
TEST_F(ImageMap, AFileIsDecodedOnce) {
  const std::string file = grey("a.pfm", 1, {1});
  const auto first = texture(file);
  grey("a.pfm", 1, {2});
  EXPECT_EQ(texture(file, {text("wrap", "black")})->evaluate(at(0.5F, 0.5F)), 1);
  EXPECT_EQ(texture<Spectrum>((folder.path() / "." / "a.pfm").string())->evaluate(at(0.5F, 0.5F)),
            Spectrum(1));
  EXPECT_EQ(texture(grey("b.pfm", 1, {3}))->evaluate(at(0, 0)), 3);
}

}  // namespace
}  // namespace pbrt::test
