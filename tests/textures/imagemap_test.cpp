// Pictures on surfaces. They are PFM, whose values are exact, where the format is not the point.

#include <gtest/gtest.h>

// libjpeg's header needs it.
#include <jpeglib.h>

#include <cstdio>

#include "core/base/image.h"
#include "core/base/rng.h"
#include "tests/command.h"
#include "tests/support.h"

namespace pbrt::test {
namespace {

using Color = std::array<float, 3>;

// (u, v) with a footprint.
SurfaceInteraction at(float u, float v, Vec2 dx = Vec2(0), Vec2 dy = Vec2(0)) {
  SurfaceInteraction s;
  s.uv = {u, v};
  s.dudx = dx.x;
  s.dvdx = dx.y;
  s.dudy = dy.x;
  s.dvdy = dy.y;
  return s;
}

class ImageMap : public testing::Test {
 protected:
  // A grey picture, rows from the top.
  std::string grey(const std::string& name, int w, const std::vector<float>& values) const {
    const int h = static_cast<int>(values.size()) / w;
    std::string text = "Pf " + std::to_string(w) + " " + std::to_string(h) + " -1\n";
    for (int y = h - 1; y >= 0; --y)
      text.append(reinterpret_cast<const char*>(&values[static_cast<std::size_t>(y * w)]),
                  static_cast<std::size_t>(w) * 4);
    folder.write(name, text);
    return (folder.path() / name).string();
  }
  template <class T = float>
  static std::unique_ptr<Texture<T>> texture(const std::string& file, ParamList list = {}) {
    list.push_back(text("filename", file));
    return make<Texture<T>>("imagemap", list);
  }
  // Eight by eight pseudo-random values.
  std::vector<float> noise(int n) const {
    Rng rng(7);
    std::vector<float> values;
    for (int i = 0; i < n; ++i) values.push_back(rng.uniform());
    return values;
  }
  Folder folder;
};

TEST_F(ImageMap, LowestRowIsAtTheOrigin) {
  const std::string file = grey("a.pfm", 2, {1, 2, 3, 4});
  const auto lower = texture(file), upper = texture(file, {text("origin", "upper")});
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.25F, 0.25F)), 3);
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.75F, 0.25F)), 4);
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.25F, 0.75F)), 1);
  EXPECT_FLOAT_EQ(upper->evaluate(at(0.25F, 0.25F)), 1);
  EXPECT_FLOAT_EQ(lower->evaluate(at(0.5F, 0.5F)), 2.5F);
}

TEST_F(ImageMap, Wraps) {
  const std::string file =
      grey("a.pfm", 4, {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15, 16});
  const auto value = [&](const char* wrap, float u, float v) {
    return texture(file, {text("wrap", wrap), text("origin", "upper")})->evaluate(at(u, v));
  };
  // Texels' centres, one row above and one column beside the picture; and far away.
  const float out = -0.125F, in = 0.375F;
  EXPECT_FLOAT_EQ(value("repeat", in, out), 14);
  EXPECT_FLOAT_EQ(value("repeat", 1.125F, in), 5);
  EXPECT_FLOAT_EQ(value("clamp", in, out), 2);
  EXPECT_FLOAT_EQ(value("clamp", 1.125F, in), 8);
  EXPECT_FLOAT_EQ(value("black", in, out), 0);
  EXPECT_FLOAT_EQ(value("octahedralsphere", in, out), 3);  // mirrored in the middle of the edge
  EXPECT_FLOAT_EQ(value("octahedralsphere", 1.125F, in), 12);
  EXPECT_FLOAT_EQ(value("repeat", 1000.375F, -999.625F), 6);
  EXPECT_FLOAT_EQ(value("clamp", 1e9F, -1e9F), 4);
  EXPECT_FLOAT_EQ(value("black", 1e9F, -1e9F), 0);
  EXPECT_FLOAT_EQ(value("black", 0, in), 2.5F);  // half way to the black beyond
}

// Whatever the size, every level has the mean of the picture; the last one is nothing else.
TEST_F(ImageMap, WideFootprintsSeeTheMean) {
  for (const Point2i size : {Point2i(8, 8), Point2i(7, 5), Point2i(1, 13), Point2i(30, 1)}) {
    const std::vector<float> values = noise(size.x * size.y);
    double mean = 0;
    for (const float v : values) mean += v / static_cast<double>(values.size());
    const std::string file = grey("m.pfm", size.x, values);
    for (const char* filter : {"point", "bilinear", "trilinear", "ewa"}) {
      const auto map = texture(file, {text("filter", filter)});
      EXPECT_NEAR(map->evaluate(at(0.3F, 0.2F, {50, 0}, {0, 50})), mean, 1e-6) << filter;
      EXPECT_NEAR(map->evaluate(at(0.3F, 0.2F, {1e9F, 3}, {-1e20F, 1e30F})), mean, 1e-6);
    }
  }
}

TEST_F(ImageMap, ConstantsStayConstant) {
  const auto map = texture(grey("c.pfm", 13, std::vector<float>(13 * 9, 0.3F)));
  Rng rng(3);
  const auto x = [&] {
    return std::exp(20 * rng.uniform() - 15) * (rng.uniform() < 0.5F ? -1 : 1);
  };
  for (int i = 0; i < 5000; ++i)
    ASSERT_NEAR(map->evaluate(at(x(), x(), {x(), x()}, {x(), x()})), 0.3F, 1e-6);
}

// The weighted mean over the ellipse by its definition, in double: texels of the finest level,
// whose pixel is two by one texels turned by 30 degrees.
TEST_F(ImageMap, EllipseIsTheGaussianMean) {
  constexpr int n = 16;
  const std::vector<float> values = noise(n * n);
  const auto map = texture(grey("e.pfm", n, values), {text("origin", "upper")});
  Rng rng(5);
  for (int k = 0; k < 50; ++k) {
    const double u = rng.uniform(), v = rng.uniform(), turn = 6 * rng.uniform();
    const double major = 0.5 + 3 * rng.uniform(),
                 minor = std::min(0.99, major) * (0.5 + 0.5 * rng.uniform());
    const glm::dvec2 p = major * glm::dvec2(std::cos(turn), std::sin(turn));
    const glm::dvec2 q = minor * glm::dvec2(-std::sin(turn), std::cos(turn));
    // The covariance of the pixel and of the texels' own filter.
    const glm::dmat2 m =
        glm::inverse(glm::outerProduct(p, p) + glm::outerProduct(q, q) + glm::dmat2(1));
    double sum = 0, weights = 0;
    for (int y = -n; y < 2 * n; ++y)
      for (int x = -n; x < 2 * n; ++x) {
        const glm::dvec2 d = glm::dvec2(x + 0.5, y + 0.5) - glm::dvec2(u, v) * double(n);
        const double r2 = glm::dot(d, m * d);
        if (r2 >= 1) continue;
        const double w = std::exp(-2 * r2) - std::exp(-2);
        weights += w;
        sum += w * values[((y + n) % n) * n + (x + n) % n];
      }
    EXPECT_NEAR(map->evaluate(at(u, v, Vec2(p) / float(n), Vec2(q) / float(n))), sum / weights,
                5e-3);
  }
}

// A long ellipse across stripes sees grey, one along them the stripes: isotropic filters cannot.
TEST_F(ImageMap, EllipsesFollowTheFootprint) {
  std::vector<float> stripes(64 * 64);
  for (std::size_t i = 0; i < stripes.size(); ++i) stripes[i] = i % 2;
  const std::string file = grey("s.pfm", 64, stripes);
  const Vec2 along(0, 6 / 64.F), across(6 / 64.F, 0), thin(0.1F / 64, 0), low(0, 0.1F / 64);
  const float u = 33.5F / 64;  // in a bright one
  EXPECT_GT(texture(file)->evaluate(at(u, 0.5F, thin, along)), 0.7F);
  EXPECT_NEAR(texture(file)->evaluate(at(u, 0.5F, across, low)), 0.5F, 0.02F);
  EXPECT_NEAR(texture(file, {flag("trilinear", true)})->evaluate(at(u, 0.5F, thin, along)), 0.5F,
              0.02F);
  EXPECT_NEAR(texture(file, {number("maxanisotropy", 1)})->evaluate(at(u, 0.5F, thin, along)), 0.5F,
              0.02F);
  // A footprint without any width is as wide as maxanisotropy allows.
  EXPECT_GT(texture(file)->evaluate(at(u, 0.5F, Vec2(0), along)), 0.7F);
}

TEST_F(ImageMap, ScaleAndInvert) {
  const std::string file = grey("a.pfm", 1, {0.75F});
  EXPECT_FLOAT_EQ(texture(file, {number("scale", 2)})->evaluate(at(0, 0)), 1.5F);
  EXPECT_FLOAT_EQ(texture(file, {flag("invert", true)})->evaluate(at(0, 0)), 0.25F);
  EXPECT_EQ(texture<Spectrum>(file, {flag("invert", true), number("scale", 2)})->evaluate(at(0, 0)),
            Spectrum(0));
  EXPECT_FALSE(texture(file)->filters());  // one texel is the same under every footprint
  EXPECT_TRUE(texture(grey("b.pfm", 2, {1, 2}))->filters());
}

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
  // Values of light are not: 0.25 stays, unless asked for.
  const std::string pfm = grey("b.pfm", 1, {0.25F});
  EXPECT_EQ(texture(pfm)->evaluate(at(0, 0)), 0.25F);
  EXPECT_FLOAT_EQ(texture(pfm, {flag("gamma", true)})->evaluate(at(0, 0)), decodeSrgb(0.25F));
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

TEST_F(ImageMap, ThirtyThousandWide) {
  std::vector<float> ramp(30000 * 2);
  for (std::size_t i = 0; i < ramp.size(); ++i) ramp[i] = static_cast<float>(i % 30000) / 29999;
  const auto map = texture(grey("w.pfm", 30000, ramp), {text("wrap", "clamp")});
  for (const float u : {0.1F, 0.5F, 0.77F}) {
    EXPECT_NEAR(map->evaluate(at(u, 0.5F)), u, 1e-4);
    EXPECT_NEAR(map->evaluate(at(u, 0.5F, {1e-3F, 0}, {0, 1e-3F})), u, 1e-3);
  }
}

TEST_F(ImageMap, FiniteEverywhere) {
  Rng rng(9);
  const std::string file = grey("f.pfm", 5, noise(35));
  const auto x = [&] {
    return std::exp(160 * rng.uniform() - 80) * (rng.uniform() < 0.5F ? -1 : 1);
  };
  for (const char* wrap : {"repeat", "black", "clamp", "octahedralsphere"})
    for (const char* filter : {"point", "bilinear", "trilinear", "ewa"}) {
      const auto map =
          texture(file, {text("wrap", wrap), text("filter", filter), number("maxanisotropy", 100)});
      for (int i = 0; i < 3000; ++i) {
        const float v = map->evaluate(at(x(), x(), {x(), x()}, {x(), x()}));
        ASSERT_TRUE(v >= 0 && v <= 1) << wrap << " " << filter << " " << v;
      }
      EXPECT_TRUE(
          std::isfinite(map->evaluate(at(kInfinity, -kInfinity, Vec2(kInfinity), Vec2(NAN)))));
    }
}

}  // namespace
}  // namespace pbrt::test
