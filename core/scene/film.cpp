#include "core/scene/film.h"

#include <fmt/format.h>

#include "core/base/error.h"
#include "core/base/memory_limit.h"

namespace pbrt {

Film::Film(Point2i resolution, const Bounds2i& crop, const Filter& filter, const Settings& settings)
    : resolution_(resolution),
      crop_(crop),
      scale_(settings.scale),
      brightest_(settings.brightest),
      radius_(filter.radius()) {
  // Beyond this the table below and the borders of the tiles have no sizes.
  constexpr float kLeast = 1e-3F, kMost = 1e3F;
  for (int i = 0; i < 2; ++i)
    if (!(radius_[i] >= kLeast && radius_[i] <= kMost))
      throw Error(fmt::format("the filter reaches over {} pixels; it must be from {} to {}",
                              radius_[i], kLeast, kMost));
  // The centre of pixel i is at i + 1/2; a sample at x reaches the centres within the radius.
  constexpr float kWidest = 256;
  if (!(std::max(radius_.x, radius_.y) <= kWidest))
    throw Error(fmt::format("a filter cannot reach farther than {} pixels", kWidest));
  const Point2i reach(glm::ceil(radius_ - 0.5F));
  sampled_ = {crop.lo - reach, crop.hi + reach};
  const Point2i size(sampled_.width(), sampled_.height());
  const int apron = std::max({reach.x, reach.y, 0});
  const bool noisy = (settings.aovs & kVariance) != 0;
  // With the picture that is made of the sums in the end: channels of floats.
  const double picture = 4.0 * sizeof(float) * crop.width() * crop.height();
  const std::string what = fmt::format("a film of {} x {} pixels", crop.width(), crop.height());
  checkMemory(picture + BlockedArray<Sum>::bytes(size.x, size.y, kTile, apron) +
                  (noisy ? BlockedArray<Noise>::bytes(size.x, size.y, kTile, apron) : 0) +
                  AovSums::bytes(settings.aovs, size, kTile),
              what);
  try {
    sums_ = {size.x, size.y, kTile, apron};
    if (noisy) noise_ = {size.x, size.y, kTile, apron};
    aovs_ = {settings.aovs, size, kTile, settings.origin};
  } catch (const std::exception&) {
    throw Error("not enough memory for " + what);
  }

  // Weights at the centres of the table's cells: positions are rounded to 1/32 of the radius.
  tableScale_ = static_cast<float>(kTable) / radius_;
  table_.resize(std::size_t{kTable} * kTable);
  for (int y = 0; y < kTable; ++y)
    for (int x = 0; x < kTable; ++x)
      table_[y * kTable + x] = filter.evaluate((Vec2(x, y) + 0.5F) / tableScale_);

  // A pixel is sum(w L) / sum(w) over independent samples of variance s^2, n in each pixel:
  // s^2 sum(w^2) / sum(w)^2 = s^2 / n * integral(w^2) / integral(w)^2, over areas in pixels.
  double sum = 0, squares = 0;
  for (const double w : table_) sum += w, squares += w * w;
  const double cellArea = 4.0 * radius_.x * radius_.y / (kTable * kTable);  // of all quadrants
  filterNoise_ = squares / (cellArea * sum * sum);
}

Bounds2i Film::tilePixels(int tile) const {
  const Point2i lo = sampled_.lo + sums_.corner(tile);
  return intersect(sampled_, {lo, lo + kTile});
}

template <class Add>
void Film::spread(int tile, Point2 film, Add add) const {
  const Point2i origin = sampled_.lo + sums_.corner(tile) - sums_.apron();
  // Sample and pixel centres in the tile's own pixels, so that truncation rounds down.
  const Point2 p = film - Point2(origin) - 0.5F;
  const int x0 = std::max(0, static_cast<int>(p.x - radius_.x) + (p.x >= radius_.x));
  const int y0 = std::max(0, static_cast<int>(p.y - radius_.y) + (p.y >= radius_.y));
  const int x1 = std::min(sums_.stride() - 1, static_cast<int>(p.x + radius_.x));
  const int y1 = std::min(sums_.stride() - 1, static_cast<int>(p.y + radius_.y));
  for (int y = y0; y <= y1; ++y) {
    const int ty = std::min(
        kTable - 1, static_cast<int>(std::abs(static_cast<float>(y) - p.y) * tableScale_.y));
    const float* weights = &table_[ty * kTable];
    for (int x = x0; x <= x1; ++x) {
      const int tx = std::min(
          kTable - 1, static_cast<int>(std::abs(static_cast<float>(x) - p.x) * tableScale_.x));
      add(x, y, double{weights[tx]});
    }
  }
}

void Film::add(int tile, Point2 film, const Spectrum& radiance, float alpha) {
  Spectrum L = radiance * scale_;
  if (const float y = luminance(radiance); y > brightest_) L *= brightest_ / y;
  spread(tile, film, [&](int x, int y, double w) {
    Sum& sum = sums_.row(tile, y)[x];
    sum.r += w * L.x;
    sum.g += w * L.y;
    sum.b += w * L.z;
    sum.alpha += w * alpha;
    sum.weight += w;
  });
  if (noise_.blocks() > 0)
    spread(tile, film, [&](int x, int y, double w) {
      if (w == 0) return;
      Noise& noise = noise_.row(tile, y)[x];
      const glm::dvec3 wL = w * glm::dvec3(L);
      noise.wwL += w * wL;
      noise.wwLL += wL * wL;
      noise.ww += w * w;
      ++noise.count;
    });
  if (aovs_.stores(kSampleCount))
    aovs_.addSample(tile, Point2i(glm::floor(film)) - sampled_.lo - sums_.corner(tile));
}

void Film::add(int tile, Point2i pixel, const FirstSurface& surface) {
  aovs_.add(tile, pixel - (sampled_.lo + sums_.corner(tile)), surface);
}

template <class T>
T Film::gather(const BlockedArray<T>& sums, Point2i pixel) const {
  const int border = sums.apron();
  // The tiles whose sums, with their borders, cover this pixel.
  const Point2i first = glm::max(pixel - border, 0) / kTile;
  const Point2i last = glm::min((pixel + border) / kTile, Point2i(sums.across(), sums.down()) - 1);
  T total;
  for (int ty = first.y; ty <= last.y; ++ty)
    for (int tx = first.x; tx <= last.x; ++tx) {
      const Point2i in = pixel - Point2i(tx, ty) * kTile + border;
      total += sums.row(ty * sums.across() + tx, in.y)[in.x];
    }
  return total;
}

// A pixel is m = sum(w L) / sum(w), a ratio of two sums over independent samples; to first order
// its variance is sum(w^2 (L - m)^2) / sum(w)^2 (Cochran 1977, "Sampling Techniques",
// section 2.11), times n / (n - 1) for the n samples that m was taken from itself. Where samples
// are spread better than at random, the true variance is smaller.
void Film::appendVariance(Image& image) const {
  const std::size_t first = image.channels.size();
  for (const char* name : {"Variance.R", "Variance.G", "Variance.B"}) {
    image.names.emplace_back(name);
    image.channels.emplace_back(image.channels[0].size());
  }
  std::size_t i = 0;
  for (int y = crop_.lo.y; y < crop_.hi.y; ++y)
    for (int x = crop_.lo.x; x < crop_.hi.x; ++x, ++i) {
      const Point2i pixel = Point2i(x, y) - sampled_.lo;
      const Noise noise = gather(noise_, pixel);
      const Sum sum = gather(sums_, pixel);
      if (noise.count < 2 || sum.weight == 0) continue;
      const glm::dvec3 m = glm::dvec3(sum.r, sum.g, sum.b) / sum.weight;
      const glm::dvec3 squares = noise.wwLL - 2.0 * m * noise.wwL + m * m * noise.ww;
      const double scale = noise.count / ((noise.count - 1) * sum.weight * sum.weight);
      for (int c = 0; c < 3; ++c)
        image.channels[first + c][i] = static_cast<float>(std::max(0.0, squares[c]) * scale);
    }
}

Image Film::image(AovSet aovs) const {
  Image image;
  image.window = crop_;
  image.resolution = resolution_;
  image.names = {"R", "G", "B", "A"};
  const std::size_t n = std::size_t(crop_.width()) * crop_.height();
  image.channels.assign(4, std::vector<float>(n));

  std::size_t i = 0;
  for (int y = crop_.lo.y; y < crop_.hi.y; ++y)
    for (int x = crop_.lo.x; x < crop_.hi.x; ++x, ++i) {
      const Sum sum = gather(sums_, Point2i(x, y) - sampled_.lo);
      if (sum.weight == 0) continue;
      const double scale = 1 / sum.weight;
      image.channels[0][i] = static_cast<float>(std::max(0.0, sum.r * scale));
      image.channels[1][i] = static_cast<float>(std::max(0.0, sum.g * scale));
      image.channels[2][i] = static_cast<float>(std::max(0.0, sum.b * scale));
      image.channels[3][i] = static_cast<float>(std::clamp(sum.alpha * scale, 0.0, 1.0));
    }
  if (aovs & kVariance && noise_.blocks() > 0) appendVariance(image);
  aovs_.appendTo(image, aovs, {crop_.lo - sampled_.lo, crop_.hi - sampled_.lo});
  return image;
}

}  // namespace pbrt
