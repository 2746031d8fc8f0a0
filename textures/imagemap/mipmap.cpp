#include "textures/imagemap/mipmap.h"

#include "core/base/parallel.h"

namespace pbrt {

namespace {

using Byte = std::uint8_t;
using Byte3 = std::array<std::uint8_t, 3>;

// Bytes to values of light, or values as they are.
class Decoder {
 public:
  explicit Decoder(float gamma) : gamma_(gamma) {
    for (int i = 0; i < 256; ++i) table_[i] = decode(static_cast<float>(i) / 255);
  }
  float decode(float code) const {
    if (gamma_ == 1) return code;
    return gamma_ == kSrgbCurve ? decodeSrgb(code) : std::pow(std::max(0.F, code), gamma_);
  }
  float operator()(float v) const { return v; }
  Spectrum operator()(const Spectrum& v) const { return v; }
  float operator()(Byte code) const { return table_[code]; }
  Spectrum operator()(const Byte3& c) const { return {table_[c[0]], table_[c[1]], table_[c[2]]}; }

 private:
  float gamma_;
  std::array<float, 256> table_{};
};

// Which texels of a row of n lie under texel i of the next level, which has n / 2 of them, rounded
// down. For an even n they are two; n = 2 m + 1 gives each n / m = 2 + 1 / m texels: the one in the
// middle whole, of the outer ones the shares 1 - i / m and (i + 1) / m (Guthe and Heckbert 2005,
// "Non-Power-of-Two Mipmap Creation"). The mean of a level is that of the picture.
struct Taps {
  int first = 0, count = 1;
  std::array<float, 3> weights{1, 0, 0};
};
Taps tapsUnder(int i, int n) {
  if (n == 1) return {};
  if (n % 2 == 0) return {2 * i, 2, {0.5F, 0.5F, 0}};
  const auto m = static_cast<float>(n / 2), whole = static_cast<float>(n);
  const auto k = static_cast<float>(i);
  return {2 * i, 3, {(m - k) / whole, m / whole, (k + 1) / whole}};
}

// exp(-2 r^2) - exp(-2) over r^2 in [0, 1): the Gaussian of an ellipse, lowered to end at its edge.
constexpr int kWeights = 128;
const std::array<float, kWeights> kGaussian = [] {
  std::array<float, kWeights> table{};
  for (int i = 0; i < kWeights; ++i)
    table[i] = std::exp(-2 * static_cast<float>(i) / (kWeights - 1)) - std::exp(-2.F);
  return table;
}();

// Stored: how the texels of the picture itself are kept; the other levels are values.
template <class Stored, class Value>
class Pyramid final : public MipMap {
 public:
  Pyramid(Point2i size, std::vector<Stored> texels, const Decoder& decoder)
      : decoder_(decoder), base_(std::move(texels)) {
    levels_.push_back({size.x, size.y, {}});
    while (levels_.back().w > 1 || levels_.back().h > 1) halve();
  }

  int levels() const override { return static_cast<int>(levels_.size()); }

  Spectrum at(const TexturePoint& p, const Lookup& how) const override {
    Point2 st = p.st;
    if (!std::isfinite(st.x) || !std::isfinite(st.y)) return Spectrum(top());
    if (how.wrap == Wrap::repeat) st -= glm::floor(st);
    const Vec2 size(levels_[0].w, levels_[0].h);
    const Vec2 dx = p.dx * size, dy = p.dy * size;  // in texels
    if (how.filter == TexelFilter::ewa) return Spectrum(ellipse(st, dx, dy, how));

    const Vec2 widest = glm::max(glm::abs(dx), glm::abs(dy));
    const float level = levelOf(2 * std::max(widest.x, widest.y));
    const int i = static_cast<int>(level);
    if (how.filter == TexelFilter::point) return Spectrum(nearest(i, st, how.wrap));
    if (how.filter == TexelFilter::bilinear) return Spectrum(between(i, st, how.wrap));
    return Spectrum(blend(level, [&](int l) { return between(l, st, how.wrap); }));
  }

 private:
  struct Level {
    int w, h;
    std::vector<Value> texels;  // none at level 0: see base_
  };

  Value texel(int level, int x, int y) const {
    const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(levels_[level].w) +
                          static_cast<std::size_t>(x);
    return level == 0 ? Value(decoder_(base_[i])) : levels_[level].texels[i];
  }
  Value top() const { return texel(levels() - 1, 0, 0); }

  void halve() {
    const int from = levels() - 1;
    const Level& fine = levels_[from];
    Level coarse{std::max(1, fine.w / 2), std::max(1, fine.h / 2), {}};
    coarse.texels.resize(static_cast<std::size_t>(coarse.w) * static_cast<std::size_t>(coarse.h));
    parallelFor(static_cast<std::size_t>(coarse.h), [&](std::size_t row) {
      const Taps v = tapsUnder(static_cast<int>(row), fine.h);
      for (int x = 0; x < coarse.w; ++x) {
        const Taps u = tapsUnder(x, fine.w);
        Value sum(0);
        for (int j = 0; j < v.count; ++j)
          for (int i = 0; i < u.count; ++i)
            sum += u.weights[i] * v.weights[j] * texel(from, u.first + i, v.first + j);
        coarse.texels[row * static_cast<std::size_t>(coarse.w) + static_cast<std::size_t>(x)] = sum;
      }
    });
    levels_.push_back(std::move(coarse));
  }

  // The level whose texels are as wide as `texels` of the picture itself.
  float levelOf(float texels) const {
    return texels > 1 ? std::min(std::log2(texels), static_cast<float>(levels() - 1)) : 0;
  }
  template <class Sample>
  Value blend(float level, const Sample& sample) const {
    const int i = static_cast<int>(level);
    const float t = level - static_cast<float>(i);
    return t == 0 ? sample(i) : (1 - t) * sample(i) + t * sample(i + 1);
  }

  Value nearest(int level, Point2 st, Wrap wrap) const {
    const auto [w, h] = std::pair(levels_[level].w, levels_[level].h);
    const Vec2 p = glm::floor(glm::clamp(st, -1e4F, 1e4F) * Vec2(w, h));
    int x = static_cast<int>(p.x), y = static_cast<int>(p.y);
    return wrapPixel(wrap, w, h, x, y) ? texel(level, x, y) : Value(0);
  }
  Value between(int level, Point2 st, Wrap wrap) const {
    return bilinear<Value>(levels_[level].w, levels_[level].h, st, wrap,
                           [&](int x, int y) { return texel(level, x, y); });
  }

  // Elliptical weighted average (Greene and Heckbert 1986; Heckbert 1989, section 3.5.8). The level
  // is that at which the ellipse is one to two texels wide; a longer one is made wider.
  Value ellipse(Point2 st, Vec2 major, Vec2 minor, const Lookup& how) const {
    if (lengthSquared(major) < lengthSquared(minor)) std::swap(major, minor);
    const float length = glm::length(major);
    if (!(length < 1e15F)) return top();
    float width = glm::length(minor);
    if (width * how.maxAnisotropy < length) {
      const float least = length / how.maxAnisotropy;
      // Of no width to speak of, it has no direction either.
      minor = width > 1e-6F * length ? minor * (least / width)
                                     : Vec2(-major.y, major.x) / how.maxAnisotropy;
      width = least;
    }
    if (length == 0) return between(0, st, how.wrap);
    const float level = levelOf(width);
    return blend(level, [&](int i) { return weighted(i, st, major, minor, how.wrap); });
  }

  // The ellipse is the image of a pixel's unit circle, st + cos(a) p + sin(a) q, which is
  // A x^2 + B x y + C y^2 = F (Heckbert 1989, eq. 3.4). One is added to A and C, the unit circle of
  // the reconstruction filter of the texels: at least one of them lies in it.
  Value weighted(int level, Point2 st, Vec2 p, Vec2 q, Wrap wrap) const {
    const auto [w, h] = std::pair(levels_[level].w, levels_[level].h);
    if (level == levels() - 1) return top();
    const Vec2 shrink = Vec2(w, h) / Vec2(levels_[0].w, levels_[0].h);
    p *= shrink;
    q *= shrink;
    float a = p.y * p.y + q.y * q.y + 1, b = -2 * (p.x * p.y + q.x * q.y);
    float c = p.x * p.x + q.x * q.x + 1;
    const float inverseF = 1 / (a * c - b * b * 0.25F);
    a *= inverseF;
    b *= inverseF;
    c *= inverseF;
    // Now F = 1, and the box about it has half sides 2 sqrt(C / (4 A C - B^2)), with A for the
    // other.
    const float inverse = 1 / (4 * a * c - b * b);
    const double halfX = 2 * std::sqrt(c * inverse), halfY = 2 * std::sqrt(a * inverse);
    const double s = std::clamp(double{st.x}, -1e4, 1e4) * w - 0.5;
    const double t = std::clamp(double{st.y}, -1e4, 1e4) * h - 0.5;

    Value sum(0);
    float weights = 0;
    const int endX = static_cast<int>(std::floor(s + halfX));
    const int endY = static_cast<int>(std::floor(t + halfY));
    for (int y = static_cast<int>(std::ceil(t - halfY)); y <= endY; ++y) {
      const auto dy = static_cast<float>(y - t);
      for (int x = static_cast<int>(std::ceil(s - halfX)); x <= endX; ++x) {
        const auto dx = static_cast<float>(x - s);
        const float r2 = a * dx * dx + b * dx * dy + c * dy * dy;
        if (!(r2 < 1)) continue;
        const float weight = kGaussian[static_cast<int>(r2 * kWeights)];
        weights += weight;
        int i = x, j = y;
        if (wrapPixel(wrap, w, h, i, j)) sum += weight * texel(level, i, j);
      }
    }
    return weights > 0 ? sum / weights : between(level, st, wrap);
  }

  Decoder decoder_;
  std::vector<Stored> base_;
  std::vector<Level> levels_;
};

}  // namespace

std::unique_ptr<MipMap> makeMipMap(const Image& image, float gamma,
                                   const std::filesystem::path& file) {
  const auto channels = colorChannels(image, file);
  const Decoder decoder(gamma);
  const Point2i size(image.window.width(), image.window.height());
  const auto byteOf = [](float v) {
    return static_cast<Byte>(std::clamp(v, 0.F, 1.F) * 255 + 0.5F);
  };
  const auto isByte = [&](float v) { return byteOf(v) / 255.F == v; };
  const bool bytes = image.encoded && std::ranges::all_of(channels, [&](const auto* channel) {
                       return std::ranges::all_of(*channel, isByte);
                     });
  const bool grey = *channels[1] == *channels[0] && *channels[2] == *channels[0];

  const auto make = [&]<class Stored, class Value>(const auto& texelAt) {
    std::vector<Stored> texels(channels[0]->size());
    for (std::size_t i = 0; i < texels.size(); ++i) texels[i] = texelAt(i);
    return std::unique_ptr<MipMap>(
        std::make_unique<Pyramid<Stored, Value>>(size, std::move(texels), decoder));
  };
  const auto at = [&](int c, std::size_t i) { return (*channels[c])[i]; };
  const auto value = [&](int c, std::size_t i) { return decoder.decode(at(c, i)); };
  if (bytes && grey)
    return make.template operator()<Byte, float>([&](std::size_t i) { return byteOf(at(0, i)); });
  if (bytes)
    return make.template operator()<Byte3, Spectrum>([&](std::size_t i) {
      return Byte3{byteOf(at(0, i)), byteOf(at(1, i)), byteOf(at(2, i))};
    });
  if (grey)
    return make.template operator()<float, float>([&](std::size_t i) { return value(0, i); });
  return make.template operator()<Spectrum, Spectrum>(
      [&](std::size_t i) { return Spectrum(value(0, i), value(1, i), value(2, i)); });
}

}  // namespace pbrt
