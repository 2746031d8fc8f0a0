#pragma once
// Samplers: the numbers that a pixel's samples are made of.

#include <cstdint>
#include <memory>
#include <optional>
#include <span>

#include "core/base/math.h"

namespace pbrt {

// Every number depends on (seed, pixel, sample index) and on how many were asked for before in
// this sample; on nothing else. One object per thread, made by clone().
class Sampler {
 public:
  struct Setup {
    std::uint64_t seed = 0;
    std::optional<int> samplesPerPixel;  // from the command line: wins over the scene's
    Point2i resolution{1, 1};            // of the whole picture
  };

  virtual ~Sampler();
  virtual std::unique_ptr<Sampler> clone() const = 0;

  // How many samples of a pixel make a whole; sample indices may go beyond it.
  int samplesPerPixel() const { return samplesPerPixel_; }

  // Begins sample `index` of a pixel.
  virtual void start(Point2i pixel, std::uint32_t index) = 0;
  // Where in the pixel the sample lies, [0, 1)^2. Asked for once, first.
  virtual Point2 pixel2D() { return get2D(); }
  // The next one or two dimensions, uniform in [0, 1).
  virtual float get1D() = 0;
  virtual Point2 get2D() = 0;
  // The next two dimensions for a set of points that are used together (light samples); well
  // spread as a set and over all samples of the pixel.
  virtual void get2D(std::span<Point2> points) {
    for (Point2& p : points) p = get2D();
  }

 protected:
  explicit Sampler(int samplesPerPixel) : samplesPerPixel_(samplesPerPixel) {}
  Sampler(const Sampler&) = default;
  Sampler& operator=(const Sampler&) = default;

 private:
  int samplesPerPixel_;
};

}  // namespace pbrt
