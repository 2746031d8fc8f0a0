#include "core/scene/film.h"

#include <fmt/format.h>

#include "core/base/error.h"

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
  try {
    const Point2i size(sampled_.width(), sampled_.height());
    sums_ = {size.x, size.y, kTile, std::max({reach.x, reach.y, 0})};
    aovs_ = {settings.aovs, size, kTile, settings.origin};
  } catch (const std::exception&) {
    throw Error(
        fmt::format("not enough memory for a film of {} x {} pixels", crop.width(), crop.height()));
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

void Film::add(int tile, Point2 film, const Spectrum& radiance, float alpha) {
  Spectrum L = radiance * scale_;
  if (const float y = luminance(radiance); y > brightest_) L *= brightest_ / y;
  const Point2i corner = sampled_.lo + sums_.corner(tile), origin = corner - sums_.apron();
  if (aovs_.stores(kVariance | kSampleCount))
    aovs_.add(tile, Point2i(glm::floor(film)) - corner, L);
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
    Sum* sums = sums_.row(tile, y);
    for (int x = x0; x <= x1; ++x) {
      const int tx = std::min(
          kTable - 1, static_cast<int>(std::abs(static_cast<float>(x) - p.x) * tableScale_.x));
      const double w = weights[tx];
      Sum& sum = sums[x];
      sum.r += w * L.x;
      sum.g += w * L.y;
      sum.b += w * L.z;
      sum.alpha += w * alpha;
      sum.weight += w;
    }
  }
}

void Film::add(int tile, Point2i pixel, const FirstSurface& surface) {
  aovs_.add(tile, pixel - (sampled_.lo + sums_.corner(tile)), surface);
}

Image Film::image(std::uint8_t aovs) const {
  Image image;
  image.window = crop_;
  image.resolution = resolution_;
  image.names = {"R", "G", "B", "A"};
  const std::size_t n = std::size_t(crop_.width()) * crop_.height();
  image.channels.assign(4, std::vector<float>(n));

  const int border = sums_.apron();
  std::size_t i = 0;
  for (int y = crop_.lo.y; y < crop_.hi.y; ++y)
    for (int x = crop_.lo.x; x < crop_.hi.x; ++x, ++i) {
      // The tiles whose sums, with their borders, cover this pixel.
      const Point2i p = Point2i(x, y) - sampled_.lo;
      const Point2i first = glm::max(p - border, 0) / kTile;
      const Point2i last =
          glm::min((p + border) / kTile, Point2i(sums_.across(), sums_.down()) - 1);
      Sum sum;
      for (int ty = first.y; ty <= last.y; ++ty)
        for (int tx = first.x; tx <= last.x; ++tx) {
          const Point2i in = p - Point2i(tx, ty) * kTile + border;
          const Sum& s = sums_.row(ty * sums_.across() + tx, in.y)[in.x];
          sum.r += s.r, sum.g += s.g, sum.b += s.b;
          sum.alpha += s.alpha, sum.weight += s.weight;
        }
      if (sum.weight == 0) continue;
      const double scale = 1 / sum.weight;
      image.channels[0][i] = static_cast<float>(std::max(0.0, sum.r * scale));
      image.channels[1][i] = static_cast<float>(std::max(0.0, sum.g * scale));
      image.channels[2][i] = static_cast<float>(std::max(0.0, sum.b * scale));
      image.channels[3][i] = static_cast<float>(std::clamp(sum.alpha * scale, 0.0, 1.0));
    }
  aovs_.appendTo(image, aovs, {crop_.lo - sampled_.lo, crop_.hi - sampled_.lo}, filterNoise_);
  return image;
}

}  // namespace pbrt
