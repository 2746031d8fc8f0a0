#pragma once
// Pictures as a renderer looks things up in them: linear colours on a grid, and what lies beyond
// the edges.

#include <array>
#include <cstdint>

#include "core/base/image.h"
#include "core/base/spectrum.h"

namespace pbrt {

// Beyond its edges a picture repeats, is black, goes on as at the edge, is folded as the whole
// sphere in a square (SphereMap::equalarea), or repeats to the sides alone (SphereMap::latlong).
enum class Wrap : std::uint8_t { repeat, black, clamp, octahedral, latlong };

// Brings the pixel x, y into a picture of w times h pixels; false: there it is black.
inline bool wrapPixel(Wrap wrap, int w, int h, int& x, int& y) {
  if (x >= 0 && x < w && y >= 0 && y < h) return true;
  const auto modulo = [](int a, int n) { return a % n < 0 ? a % n + n : a % n; };
  switch (wrap) {
    case Wrap::black:
      return false;
    case Wrap::repeat:
      x = modulo(x, w);
      y = modulo(y, h);
      return true;
    case Wrap::octahedral:
      // Each edge is folded in its middle: beyond it lies the picture turned by half a turn about
      // the middle of the edge.
      x = modulo(x, 2 * w);
      if (x >= w) {
        x = 2 * w - 1 - x;
        y = h - 1 - y;
      }
      y = modulo(y, 2 * h);
      if (y >= h) {
        x = w - 1 - x;
        y = 2 * h - 1 - y;
      }
      return true;
    case Wrap::latlong:
      x = modulo(x, w);
      break;
    case Wrap::clamp:
      break;
  }
  x = std::clamp(x, 0, w - 1);
  y = std::clamp(y, 0, h - 1);
  return true;
}

// Interpolates between the four pixels about the point st of a picture of w times h pixels, which
// fills the unit square, its first pixel about (0.5 / w, 0.5 / h). pixel(x, y) is asked for pixels
// within the picture.
template <class T, class Pixel>
T bilinear(int w, int h, Point2 st, Wrap wrap, const Pixel& pixel) {
  // Far away the fraction means nothing, and int must hold the whole.
  const double s = std::clamp(double{st.x}, -1e4, 1e4) * w - 0.5;
  const double t = std::clamp(double{st.y}, -1e4, 1e4) * h - 0.5;
  const auto x = static_cast<int>(std::floor(s)), y = static_cast<int>(std::floor(t));
  const auto dx = static_cast<float>(s - x), dy = static_cast<float>(t - y);
  const auto at = [&](int i, int j) { return wrapPixel(wrap, w, h, i, j) ? pixel(i, j) : T(0); };
  return (1 - dy) * ((1 - dx) * at(x, y) + dx * at(x + 1, y)) +
         dy * ((1 - dx) * at(x, y + 1) + dx * at(x + 1, y + 1));
}

// A picture of light, as lamps project it. Nothing in it is negative.
class Picture {
 public:
  // One pixel.
  explicit Picture(const Spectrum& color) : pixels_{color} {}
  // By readImage; code values are decoded, what is below zero is zero. Throws Error, Failure::io,
  // if it has neither "R" "G" "B" nor "Y", or a pixel is not finite.
  explicit Picture(const std::filesystem::path& file);

  int width() const { return width_; }
  int height() const { return height_; }
  const Spectrum& pixel(int x, int y) const {
    return pixels_[static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) +
                   static_cast<std::size_t>(x)];
  }
  Spectrum at(Point2 st, Wrap wrap) const {
    return bilinear<Spectrum>(width_, height_, st, wrap, [&](int x, int y) { return pixel(x, y); });
  }

 private:
  int width_ = 1, height_ = 1;
  std::vector<Spectrum> pixels_;
};

// The channels that hold a picture's colours: R, G and B, or three times Y or the only one there
// is. Throws Error, Failure::io, in the name of `file` if there are none, or a value is not finite.
std::array<const std::vector<float>*, 3> colorChannels(const Image& image,
                                                       const std::filesystem::path& file);

}  // namespace pbrt
