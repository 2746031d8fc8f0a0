#pragma once
// The film: filtered sums of samples, kept so that the picture has the same bits whatever thread
// adds what when.

#include "core/api/filter.h"
#include "core/base/blocked_array.h"
#include "core/base/spectrum.h"
#include "core/scene/film_pixel.h"

namespace pbrt {

// The picture's samples are taken tile by tile. A sample is spread by the filter over the pixels
// about it, which may lie in the next tile; each tile therefore owns its sums over its own pixels
// and a border as wide as the filter, and one thread at a time works on it. The sums are exact: it
// does not matter what is added when, or to which tile, or to which of several films that are put
// together later.
class Film {
 public:
  static constexpr int kTile = 32;

  struct Settings {
    float scale = 1;              // of all pixel values
    float brightest = kInfinity;  // samples of more luminance are darkened to it, then scaled
    AovSet aovs = 0;              // what to store beside the picture
    DPoint3 origin{0};            // where render space's origin is in the world
    // Blocks of so many by so many pixels are rendered together, 1 to kTile: a power of two.
    int block = 4;
  };

  // `crop`: the pixels that are wanted, within [0, resolution). Throws Error: not enough memory, a
  // filter that reaches too far or gives what is no number, wrong blocks.
  Film(Point2i resolution, const Bounds2i& crop, const Filter& filter, const Settings& settings);

  Point2i resolution() const { return resolution_; }
  const Bounds2i& crop() const { return crop_; }
  // Pixels in which samples are taken: the crop and, about it, the filter's reach; widened to whole
  // blocks (Settings::block) of the whole picture's.
  const Bounds2i& sampledPixels() const { return sampled_; }
  AovSet aovs() const { return aovs_; }
  const DPoint3& origin() const { return origin_; }

  int tiles() const { return picture_.blocks(); }
  Bounds2i tilePixels(int tile) const;

  // Adds a sample taken at `film` (in pixels, within tilePixels(tile)). L is a number; what is
  // infinite when scaled counts as the largest float. Alpha is the share of opaque samples.
  void add(int tile, Point2 film, const Spectrum& L, bool opaque);
  // Whether any of these is stored beside the picture.
  bool stores(AovSet aovs) const { return (aovs_ & aovs) != 0; }
  // Adds what sample `index` of a pixel saw first, if the film stores any of kOfSurface.
  void add(int tile, Point2i pixel, std::uint32_t index, const FirstSurface& surface);

  // All sums of a pixel of the crop, whichever tiles hold them.
  FilmPixel pixel(Point2i pixel) const;
  // Adds sums of other samples.
  void add(Point2i pixel, const FilmPixel& sums);

  // The variance of a pixel over that of the mean of its own samples, where all pixels are alike:
  // the filter averages over neighbours, whose errors it thereby correlates. The mean over a block
  // of P pixels has a variance of about sum(Variance / filterNoise) / P^2.
  double filterNoise() const { return filterNoise_; }

  // The picture so far, of the crop, with those of `aovs` that are stored (pictureOf()).
  Image image(AovSet aovs = kEveryAov) const;

 private:
  static constexpr int kTable = 32;  // filter table, cells per radius

  void makeSums();
  void makeTable(const Filter& filter);
  // Where the tile's cells begin: the pixel of the upper left one of its border.
  Point2i corner(int tile) const { return sampled_.lo + picture_.corner(tile) - picture_.apron(); }
  // Calls add(x, y, weight) for each cell of the tile that a sample at `film` counts in.
  template <class Add>
  void spread(int tile, Point2 film, Add add) const;

  Point2i resolution_;
  Bounds2i crop_, sampled_;
  float scale_, brightest_;
  AovSet aovs_;
  DPoint3 origin_;
  double filterNoise_ = 1;
  Vec2 radius_;
  Point2i reach_{0};  // of the filter, in whole pixels
  Vec2 tableScale_;
  std::vector<float> table_;  // filter weights over one quadrant
  // A block a tile. The aprons of the first two are what the filter reaches beyond it; only the
  // first has cells whatever is stored.
  BlockedArray<PictureSums> picture_;
  BlockedArray<NoiseSums> noise_;
  BlockedArray<double> samples_;
  BlockedArray<SurfaceSums> surface_;
  BlockedArray<DetailSums> detail_;
};

}  // namespace pbrt
