#pragma once
// What a film holds of a pixel, and how that becomes a picture.

#include <algorithm>
#include <functional>
#include <span>

#include "core/base/exact_sum.h"
#include "core/base/image.h"
#include "core/scene/aov.h"

namespace pbrt {

// Sums over samples of radiance L that the filter weights with w. Films keep arrays of these; zero
// bytes are empty sums.
struct PictureSums {
  ExactSums<3> rgb;  // w L
  // w, which are multiples of one number, and those of samples that alpha is 1 for: exact, too.
  double weight = 0, alpha = 0;

  PictureSums& operator+=(const PictureSums& o) {
    rgb += o.rgb;
    weight += o.weight;
    alpha += o.alpha;
    return *this;
  }
};

// What the variance of a pixel asks for.
struct NoiseSums {
  ExactSums<7> sums;  // w^2 L, w^2 L^2 (three each), w^2
  double count = 0;

  NoiseSums& operator+=(const NoiseSums& o) {
    sums += o.sums;
    count += o.count;
    return *this;
  }
};

// Over those samples of the pixel itself that met a surface.
struct SurfaceSums {
  ExactSums<10> sums;  // albedo, n, p (three each), depth
  double count = 0;

  SurfaceSums& operator+=(const SurfaceSums& o) {
    sums += o.sums;
    count += o.count;
    return *this;
  }
};

// What few ask for of them.
struct DetailSums {
  ExactSums<11> sums;  // uv (two), true n, dpdu, dpdv (three each)
  double count = 0;
  std::uint32_t shape = 0;  // that of the first of the samples
  std::uint32_t first = 0;  // which sample it is

  DetailSums& operator+=(const DetailSums& o) {
    if (o.count > 0 && (count == 0 || o.first < first)) shape = o.shape, first = o.first;
    sums += o.sums;
    count += o.count;
    return *this;
  }
};

// All of them. What is not stored is zero.
struct FilmPixel {
  PictureSums picture;
  NoiseSums noise;
  double samples = 0;  // taken in the pixel itself
  SurfaceSums surface;
  DetailSums detail;

  // Calls visit(sums) for those of a pixel that a film with these AOVs stores, in one order.
  template <class Pixel, class Visit>
  static void visit(AovSet stored, Pixel& pixel, Visit visit) {
    visit(pixel.picture);
    if (stored & kVariance) visit(pixel.noise);
    if (stored & kSampleCount) visit(pixel.samples);
    if (stored & kOfSurface & ~kOfDetail) visit(pixel.surface);
    if (stored & kOfDetail) visit(pixel.detail);
  }

  // Other samples: in whatever order they are put together, the same bits come out.
  FilmPixel& operator+=(const FilmPixel& o) {
    picture += o.picture;
    noise += o.noise;
    samples += o.samples;
    surface += o.surface;
    detail += o.detail;
    return *this;
  }
};

// What a picture shows.
struct PictureFrame {
  Point2i resolution{0};  // of the whole picture
  Bounds2i window;        // the pixels that are here
  AovSet aovs = 0;        // that are shown beside it; those that are not stored come out zero
  DPoint3 origin{0};      // of render space in the world
};

// The picture of sums: channels R, G, B, A, premultiplied by alpha as EXR has it, then those of the
// AOVs. Pixels without samples are zero; negative values, which only filters with negative lobes
// make, are raised to zero. Calls row(y, pixels) for each row of the window from the top, which
// fills in its pixels.
Image pictureOf(const PictureFrame& frame,
                const std::function<void(int y, std::span<FilmPixel> pixels)>& row);

}  // namespace pbrt
