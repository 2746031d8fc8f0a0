// FLIP against its authors' program and against their paper.

#include <gtest/gtest.h>

#include <array>

#include "tests/tools/flip_pictures.h"
#include "tools/compare/flip.h"

namespace pbrt {
namespace {

using namespace test;

using Real = long double;
using Colour = std::array<Real, 3>;

using Formula = float (*)(int x, int y, int c);

struct Sample {
  int width, height;
  double pixelsPerDegree;
  Formula reference, test;
  // The mean, and the values of the first, the middle (index size / 2) and the last pixel.
  std::array<double, 4> ldr, hdr;
};

// The values come from the authors' FLIP.h (github.com/NVlabs/flip, commit 8144bd5, the part for
// CPUs) with its arithmetic changed to double: in its float, rounding makes weak features where
// there are none, which moves these means by up to 0.0001.
const Sample kSamples[] = {
    {48,
     32,
     kPixelsPerDegree,  // gradients, shifted
     [](int x, int y, int c) {
       return static_cast<float>(c == 0 ? x : c == 1 ? y : 32) / 64;
     },
     [](int x, int y, int c) {
       return static_cast<float>(c == 0 ? x + 2 : c == 1 ? y : 28) / 64;
     },
     {0.15176869, 0.09553611, 0.14496224, 0.17416280},
     {0.12991768, 0.39315432, 0.37480790, 0.08151720}},
    {40,
     40,
     kPixelsPerDegree,  // a checkerboard, shifted
     [](int x, int y, int) { return (x / 4 + y / 4) % 2 == 0 ? 0.F : 0.75F; },
     [](int x, int y, int) { return ((x + 1) / 4 + y / 4) % 2 == 0 ? 0.F : 0.75F; },
     {0.28609203, 0.22100077, 0.02304627, 0.97502093},
     {0.29648796, 0.24273030, 0.02470765, 0.97695226}},
    {33,
     27,
     kPixelsPerDegree,  // noise of two seeds
     [](int x, int y, int c) { return noise(x, y, c, 1); },
     [](int x, int y, int c) { return noise(x, y, c, 2); },
     {0.40873367, 0.67107358, 0.25813936, 0.36592903},
     {0.34078877, 0.37979799, 0.38851782, 0.23029641}},
    {31,
     17,
     30,  // patches of colour, and noise on them
     [](int x, int y, int c) { return noise(x / 5, y / 5, c, 3); },
     [](int x, int y, int c) {
       return 0.75F * noise(x / 5, y / 5, c, 3) + 0.25F * noise(x, y, c, 4);
     },
     {0.37024484, 0.58587266, 0.34285127, 0.42514943},
     {0.33685228, 0.46663526, 0.22211947, 0.22547766}},
    {64,
     9,
     kPixelsPerDegree,  // a line, shifted
     [](int x, int, int) { return x == 32 ? 1.F : 0.25F; },
     [](int x, int, int) { return x == 34 ? 1.F : 0.25F; },
     {0.04206014, 0, 0.56141758, 0},
     {0.02324671, 0, 0.33045887, 0}},
    {1,
     1,
     kPixelsPerDegree,  // one pixel
     [](int, int, int c) { return c == 0 ? 0.5F : 0.125F; },
     [](int, int, int c) { return c == 2 ? 0.5F : 0.25F; },
     {0.66698621, 0.66698621, 0.66698621, 0.66698621},
     {0.36355212, 0.36355212, 0.36355212, 0.36355212}},
    {1,
     23,
     100,  // one column
     [](int, int y, int c) { return noise(0, y, c, 5); },
     [](int, int y, int) { return static_cast<float>(y) / 32; },
     {0.65484974, 0.96822009, 0.54992180, 0.52105245},
     {0.60754732, 0.97749067, 0.50843093, 0.41669477}},
    {36,
     30,
     kPixelsPerDegree,  // a high range: 13 exposures
     [](int x, int y, int c) { return bright(x, y, c, 6); },
     [](int x, int y, int c) { return bright(x, y, c, 6) * (0.75F + noise(x, y, c, 7) / 2); },
     {0.03721250, 0.01022925, 0.01129949, 0.00819681},
     {0.08443681, 0.14431647, 0.08981321, 0.18513831}},
    {24,
     24,
     kPixelsPerDegree,  // fireflies
     [](int x, int y, int c) { return static_cast<float>(1 + x + y + c) / 64; },
     [](int x, int y, int c) {
       return hash(x + 100 * y) % 50 == 0 ? 512.F : static_cast<float>(1 + x + y + c) / 64;
     },
     {0.07409831, 0.97777616, 0.00472710, 0.00109978},
     {0.04307172, 0.92305296, 0.00341045, 0.00046852}}};

TEST(Flip, AgreesWithTheAuthors) {
  for (const Sample& s : kSamples) {
    SCOPED_TRACE(&s - kSamples);
    const Image reference = picture(s.width, s.height, s.reference);
    const Image test = picture(s.width, s.height, s.test);
    const auto check = [](const FlipMap& map, const std::array<double, 4>& expected) {
      EXPECT_NEAR(map.mean, expected[0], 2e-7);
      EXPECT_NEAR(map.values.front(), expected[1], 2e-6);
      EXPECT_NEAR(map.values[map.values.size() / 2], expected[2], 2e-6);
      EXPECT_NEAR(map.values.back(), expected[3], 2e-6);
    };
    check(flip(reference, test, s.pixelsPerDegree), s.ldr);
    check(flipHdr(reference, test, s.pixelsPerDegree), s.hdr);
  }
}

// LDR-FLIP as the paper states it: YCxCz, kernels over the square, no separation; in long double,
// and with the matrix of the authors' program.
class Oracle {
 public:
  Oracle(Image reference, Image test, Real pixelsPerDegree)
      : images_{std::move(reference), std::move(test)}, ppd_(pixelsPerDegree) {}

  Real at(int x, int y) const {
    const Real largest = distance({0, 1, 0}, {0, 0, 1});
    const Real d = distance(filtered(0, x, y), filtered(1, x, y));
    const Real knee = 0.4L * largest;
    const Real colour = d < knee ? 0.95L / knee * d : 0.95L + (d - knee) / (largest - knee) * 0.05L;
    const Real edge = std::abs(feature(0, x, y, 1) - feature(1, x, y, 1));
    const Real point = std::abs(feature(0, x, y, 2) - feature(1, x, y, 2));
    return std::pow(colour, 1 - std::sqrt(std::max(edge, point) / std::sqrt(2.L)));
  }

  static Real distance(const Colour& a, const Colour& b) {
    const Colour p = lab(a), q = lab(b);
    return std::pow(std::abs(p[0] - q[0]) + std::hypot(p[1] - q[1], p[2] - q[2]), 0.7L);
  }

 private:
  static constexpr Real kWhite[3] = {23359437.L / 24577794, 1, 80288307.L / 73733382};

  static Colour toXyz(const Colour& c) {
    return {(10135552 * c[0] + 8788810 * c[1] + 4435075 * c[2]) / 24577794,
            (2613072 * c[0] + 8788810 * c[1] + 887015 * c[2]) / 12288897,
            (1425312 * c[0] + 8788810 * c[1] + 70074185 * c[2]) / 73733382};
  }

  // By Cramer's rule.
  static Colour toRgb(const Colour& xyz) {
    const Colour r = toXyz({1, 0, 0}), g = toXyz({0, 1, 0}), b = toXyz({0, 0, 1});
    const auto det = [](const Colour& u, const Colour& v, const Colour& w) {
      return u[0] * (v[1] * w[2] - v[2] * w[1]) + u[1] * (v[2] * w[0] - v[0] * w[2]) +
             u[2] * (v[0] * w[1] - v[1] * w[0]);
    };
    const Real d = det(r, g, b);
    return {det(xyz, g, b) / d, det(r, xyz, b) / d, det(r, g, xyz) / d};
  }

  static Colour lab(const Colour& rgb) {
    Colour f = toXyz(rgb);
    for (int i = 0; i < 3; ++i) {
      const Real t = f[i] / kWhite[i], d = 6.L / 29;
      f[i] = t > d * d * d ? std::cbrt(t) : t / (3 * d * d) + 4.L / 29;
    }
    const Real l = 116 * f[1] - 16;
    return {l, l / 100 * 500 * (f[0] - f[1]), l / 100 * 200 * (f[1] - f[2])};
  }

  // YCxCz of the nearest pixel of the picture.
  Colour opponent(int image, int x, int y) const {
    const Image& from = images_[image];
    const int w = from.window.width(), h = from.window.height();
    const int i = std::clamp(y, 0, h - 1) * w + std::clamp(x, 0, w - 1);
    Colour c{};
    for (int k = 0; k < 3; ++k) c[k] = std::clamp(from.channels[k][i], 0.F, 1.F);
    const Colour xyz = toXyz(c);
    const Real u = xyz[0] / kWhite[0], v = xyz[1], w3 = xyz[2] / kWhite[2];
    return {116 * v - 16, 500 * (u - v), 200 * (v - w3)};
  }

  Colour filtered(int image, int x, int y) const {
    const Real pi = std::numbers::pi_v<Real>;
    const Real a1[3] = {1, 1, 34.1L}, b1[3] = {0.0047L, 0.0053L, 0.04L};
    const Real a2[3] = {0, 0, 13.5L}, b2[3] = {1e-5L, 1e-5L, 0.025L};
    const int r = static_cast<int>(std::ceil(3 * std::sqrt(0.04L / (2 * pi * pi)) * ppd_));
    Colour sum{}, weights{};
    for (int j = -r; j <= r; ++j)
      for (int i = -r; i <= r; ++i) {
        const Colour c = opponent(image, x + i, y + j);
        const Real d2 = (i * i + j * j) / (ppd_ * ppd_);
        for (int k = 0; k < 3; ++k) {
          const Real w = a1[k] * std::sqrt(pi / b1[k]) * std::exp(-pi * pi * d2 / b1[k]) +
                         a2[k] * std::sqrt(pi / b2[k]) * std::exp(-pi * pi * d2 / b2[k]);
          sum[k] += w * c[k];
          weights[k] += w;
        }
      }
    for (int k = 0; k < 3; ++k) sum[k] /= weights[k];
    const Real y1 = (sum[0] + 16) / 116;
    Colour rgb = toRgb({(y1 + sum[1] / 500) * kWhite[0], y1, (y1 - sum[2] / 200) * kWhite[2]});
    for (Real& c : rgb) c = std::clamp(c, 0.L, 1.L);
    return rgb;
  }

  // The strength of edges (order 1) or points (order 2) at a pixel.
  Real feature(int image, int x, int y, int order) const {
    const Real sigma = 0.5L * 0.082L * ppd_;
    const int r = static_cast<int>(std::ceil(3 * sigma));
    Real up[2] = {}, down[2] = {}, positive = 0, negative = 0;
    for (int j = -r; j <= r; ++j)
      for (int i = -r; i <= r; ++i) {
        const Real g = std::exp(-(i * i + j * j) / (2 * sigma * sigma));
        const Real lightness = (opponent(image, x + i, y + j)[0] + 16) / 116;
        for (int axis = 0; axis < 2; ++axis) {
          const int t = axis == 0 ? i : j;
          const Real w = order == 1 ? -t * g : (t * t / (sigma * sigma) - 1) * g;
          (w > 0 ? up : down)[axis] += w * lightness;
          if (axis == 0) (w > 0 ? positive : negative) += std::abs(w);
        }
      }
    return std::hypot(up[0] / positive + down[0] / negative, up[1] / positive + down[1] / negative);
  }

  Image images_[2];
  Real ppd_;
};

TEST(Flip, IsWhatThePaperSays) {
  for (int seed = 0; seed < 6; ++seed) {
    const Image a = picture(9, 7, [&](int x, int y, int c) { return noise(x / 3, y, c, seed); });
    const Image b = picture(9, 7, [&](int x, int y, int c) {
      return 2 * noise(x, y, c, seed + 10) - 0.5F;  // beyond [0, 1] too
    });
    const double pixelsPerDegree = 8 + 12 * seed;
    const FlipMap map = flip(a, b, pixelsPerDegree);
    const Oracle oracle(a, b, pixelsPerDegree);
    for (int i = 0; i < 9 * 7; i += 5)
      EXPECT_NEAR(map.values[i], oracle.at(i % 9, i / 9), 2e-7) << "pixel " << i << " of " << seed;
  }
}

// No filter changes a picture of one colour, and it has no features: the colour term is all.
TEST(Flip, ConstantPicturesDifferByTheirColour) {
  const Real largest = Oracle::distance({0, 1, 0}, {0, 0, 1});
  for (const auto& [a, b] : {std::pair<Colour, Colour>{{0, 0, 0}, {1, 1, 1}},
                             {{0, 1, 0}, {0, 0, 1}},
                             {{1, 0, 0}, {0, 1, 0}},
                             {{0.5L, 0.5L, 0.5L}, {0.5L, 0.5625L, 0.5L}},
                             {{0.001953125L, 0, 0}, {0, 0.00390625L, 0}}}) {
    const Real d = Oracle::distance(a, b) / largest;
    const Real expected = d < 0.4L ? d * 0.95L / 0.4L : 0.95L + (d - 0.4L) / 0.6L * 0.05L;
    const auto image = [](const Colour& c) {
      return constant(5, 4, static_cast<float>(c[0]), static_cast<float>(c[1]),
                      static_cast<float>(c[2]));
    };
    const FlipMap map = flip(image(a), image(b));
    for (const float v : map.values) EXPECT_NEAR(v, expected, 1e-6);
    EXPECT_NEAR(map.mean, expected, 1e-6);
  }
  // White on black: the lightness differs by 100, the chroma not at all.
  EXPECT_NEAR(Oracle::distance({0, 0, 0}, {1, 1, 1}), std::pow(100.L, 0.7L), 1e-12);
}

}  // namespace
}  // namespace pbrt
