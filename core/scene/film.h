#pragma once
// The film: filtered sums of samples, kept so that the picture has the same bits whatever thread
// adds what when.

#include <memory>
#include <span>

#include "core/api/filter.h"
#include "core/base/blocked_array.h"
#include "core/base/image.h"
#include "core/base/spectrum.h"
#include "core/scene/aov.h"

namespace pbrt {

// All that a film holds of one pixel: sums over samples, which add up in any order to the same
// bits (ExactSum). Made and taken row by row, for files and merging; the film's own cells hold only
// what it stores.
struct FilmPixel;

// The picture's samples are taken tile by tile. A sample is spread by the filter over the pixels
// about it, which may lie in the next tile; each tile therefore owns its sums over its own pixels
// and a border as wide as the filter, and one thread at a time works on it. image() adds the
// overlapping sums in the order of the tiles. The sums are doubles: with floats, the ten millionth
// sample of a pixel would change nothing.
class Film {
 public:
  static constexpr int kTile = 32;

  struct Settings {
    float scale = 1;              // of all pixel values
    float brightest = kInfinity;  // samples of more luminance are darkened to it, then scaled
    AovSet aovs = 0;              // what to store beside the picture
    DPoint3 origin{0};            // where render space's origin is in the world
  };

  // `crop`: the pixels that are wanted, within [0, resolution).
  Film(Point2i resolution, const Bounds2i& crop, const Filter& filter, const Settings& settings);

  Point2i resolution() const { return resolution_; }
  const Bounds2i& crop() const { return crop_; }
  // Pixels in which samples are taken: the crop and, about it, the filter's reach.
  const Bounds2i& sampledPixels() const { return sampled_; }

  int tiles() const { return sums_.blocks(); }
  Bounds2i tilePixels(int tile) const;

  // Adds a sample taken at `film` (in pixels, within tilePixels(tile)).
  void add(int tile, Point2 film, const Spectrum& L, float alpha);
  // Whether any of these is stored beside the picture.
  bool stores(AovSet aovs) const { return aovs_.stores(aovs); }
  // Adds what a sample saw first, if the film stores any of kOfSurface.
  void add(int tile, Point2i pixel, const FirstSurface& surface);

  // The variance of a pixel over that of the mean of its own samples, where all pixels are alike:
  // the filter averages over neighbours, whose errors it thereby correlates. The mean over a block
  // of P pixels has a variance of about sum(Variance / filterNoise) / P^2.
  double filterNoise() const { return filterNoise_; }

  // The picture so far: channels R, G, B, A over the crop, premultiplied by alpha as EXR has it,
  // then those of `aovs` that are stored. Pixels without samples are zero; negative values, which
  // only filters with negative lobes make, are raised to zero.
  Image image(AovSet aovs = kEveryAov) const;

 private:
  // Of weighted samples.
  struct Sum {
    double r = 0, g = 0, b = 0, alpha = 0, weight = 0;

    Sum& operator+=(const Sum& o) {
      r += o.r, g += o.g, b += o.b, alpha += o.alpha, weight += o.weight;
      return *this;
    }
  };
  // What the variance of a Sum over its weight asks for.
  struct Noise {
    glm::dvec3 wwL{0}, wwLL{0};
    double ww = 0, count = 0;

    Noise& operator+=(const Noise& o) {
      wwL += o.wwL, wwLL += o.wwLL, ww += o.ww, count += o.count;
      return *this;
    }
  };

  static constexpr int kTable = 32;  // filter table, cells per radius

  // Calls add(x, y, weight) for each cell of the tile that a sample at `film` counts in.
  template <class Add>
  void spread(int tile, Point2 film, Add add) const;
  // Adds up what all tiles hold of a pixel, which counts from the first sampled one.
  template <class T>
  T gather(const BlockedArray<T>& sums, Point2i pixel) const;
  void appendVariance(Image& image) const;

  Point2i resolution_;
  Bounds2i crop_, sampled_;
  float scale_, brightest_;
  double filterNoise_ = 1;
  Vec2 radius_;
  Vec2 tableScale_;
  std::vector<float> table_;   // filter weights over one quadrant
  BlockedArray<Sum> sums_;     // a block a tile; the apron is what the filter reaches beyond it
  BlockedArray<Noise> noise_;  // the same; empty unless the variance is stored
  AovSums aovs_;
};

}  // namespace pbrt
