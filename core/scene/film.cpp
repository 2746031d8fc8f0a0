#include "core/scene/film.h"

#include <fmt/format.h>

#include <array>
#include <bit>
#include <limits>

#include "core/base/error.h"
#include "core/base/memory_limit.h"
#include "core/plugin/culprit.h"

namespace pbrt {

namespace {

constexpr int kWidest = 256;  // filters, in pixels

// What can be added up: infinities are as good as the largest number; what is none is left out.
double finite(float x) {
  constexpr float kMost = std::numeric_limits<float>::max();
  return std::isnan(x) ? 0 : double{std::clamp(x, -kMost, kMost)};
}

// The greatest integer below x, or x, without a call of the library.
int wholePart(float x) {
  const int i = static_cast<int>(x);
  return i - (x < static_cast<float>(i) ? 1 : 0);
}

int roundDown(int x, int multiple) {
  const int rest = x % multiple;
  return x - (rest < 0 ? rest + multiple : rest);
}

// Pixels of `part` in whole blocks, which begin at whole.lo, as far as they are in `whole`.
Bounds2i wholeBlocks(const Bounds2i& part, const Bounds2i& whole, int block) {
  Bounds2i widened;
  for (int i = 0; i < 2; ++i) {
    widened.lo[i] = whole.lo[i] + roundDown(part.lo[i] - whole.lo[i], block);
    widened.hi[i] = whole.lo[i] - roundDown(whole.lo[i] - part.hi[i], block);
  }
  return intersect(widened, whole);
}

float weight(const Filter& filter, Vec2 p) {
  try {
    return filter.evaluate(p);
  } catch (...) {
    std::rethrow_exception(asError());
  }
}

}  // namespace

Film::Film(Point2i resolution, const Bounds2i& crop, const Filter& filter, const Settings& settings)
    : resolution_(resolution),
      crop_(crop),
      scale_(settings.scale),
      brightest_(settings.brightest),
      aovs_(settings.aovs),
      origin_(settings.origin),
      radius_(filter.radius()) {
  // Beyond this the table below and the borders of the tiles have no sizes.
  constexpr float kLeast = 1e-3F, kMost = 1e3F;
  for (int i = 0; i < 2; ++i)
    if (!(radius_[i] >= kLeast && radius_[i] <= kMost))
      throw Error(fmt::format("the filter reaches over {} pixels; it must be from {} to {}",
                              radius_[i], kLeast, kMost));
  if (!(std::max(radius_.x, radius_.y) <= kWidest))
    throw Error(fmt::format("a filter cannot reach farther than {} pixels", kWidest));
  // Other blocks would be cut by the tiles, elsewhere in a crop than in the whole picture.
  if (settings.block < 1 || settings.block > kTile ||
      !std::has_single_bit(static_cast<unsigned>(settings.block)))
    throw Error(fmt::format("the integrator has blocks of {0} x {0} pixels; their width must be a "
                            "power of two, {1} at most",
                            settings.block, kTile),
                Failure::plugin);
  // The centre of pixel i is at i + 1/2; a sample at x reaches the centres within the radius.
  reach_ = glm::max(Point2i(glm::ceil(radius_ - 0.5F)), 0);
  sampled_ = wholeBlocks({crop.lo - reach_, crop.hi + reach_}, {-reach_, resolution + reach_},
                         settings.block);
  makeSums();
  makeTable(filter);
}

void Film::makeSums() {
  const Point2i size(sampled_.width(), sampled_.height());
  const int apron = std::max(reach_.x, reach_.y);
  const auto each = [&](const auto& visit) {
    visit(picture_, apron);
    if (stores(kVariance)) visit(noise_, apron);
    if (stores(kSampleCount)) visit(samples_, 0);
    if (stores(kOfSurface & ~kOfDetail)) visit(surface_, 0);
    if (stores(kOfDetail)) visit(detail_, 0);
  };
  // With the picture that is made of them in the end: it must not fail then.
  double bytes = 4.0 * sizeof(float) * crop_.width() * crop_.height();
  each([&](const auto& sums, int border) { bytes += sums.bytes(size.x, size.y, kTile, border); });
  const std::string what = fmt::format("a film of {} x {} pixels", crop_.width(), crop_.height());
  checkMemory(bytes, what);
  try {
    each([&](auto& sums, int border) { sums = {size.x, size.y, kTile, border}; });
  } catch (const std::exception&) {
    throw Error("not enough memory for " + what);
  }
}

void Film::makeTable(const Filter& filter) {
  const PluginCode* plugin = pluginOf(filter);
  const std::string name = plugin ? plugin->label() : "the filter";
  // Weights at the centres of the table's cells: positions are rounded to 1/32 of the radius.
  tableScale_ = static_cast<float>(kTable) / radius_;
  table_.resize(std::size_t{kTable} * kTable);
  float greatest = 0;
  for (int y = 0; y < kTable; ++y)
    for (int x = 0; x < kTable; ++x) {
      const Vec2 p = (Vec2(x, y) + 0.5F) / tableScale_;
      const float w = weight(filter, p);
      if (!std::isfinite(w))
        throw Error(fmt::format("{} gives the weight {} at ({}, {}) pixels from a pixel's centre",
                                name, w, p.x, p.y),
                    Failure::plugin);
      table_[y * kTable + x] = w;
      greatest = std::max(greatest, std::abs(w));
    }
  if (greatest == 0)
    throw Error(name + " gives no sample any weight: the picture would be empty", Failure::plugin);
  // Multiples of 2^-24 of the greatest: the sum of the weights of half a billion samples is exact
  // in a double, and products with samples spread over fewer bits.
  const int unit = std::ilogb(greatest) - 23;
  for (float& w : table_) w = std::ldexp(std::rint(std::ldexp(w, -unit)), unit);

  // A pixel is sum(w L) / sum(w) over independent samples of variance s^2, n in each pixel:
  // s^2 sum(w^2) / sum(w)^2 = s^2 / n * integral(w^2) / integral(w)^2, over areas in pixels.
  double sum = 0, squares = 0;
  for (const double w : table_) sum += w, squares += w * w;
  const double cellArea = 4.0 * radius_.x * radius_.y / (kTable * kTable);  // of all quadrants
  filterNoise_ = squares / (cellArea * sum * sum);
}

Bounds2i Film::tilePixels(int tile) const {
  const Point2i lo = sampled_.lo + picture_.corner(tile);
  return intersect(sampled_, {lo, lo + kTile});
}

template <class Add>
void Film::spread(int tile, Point2 film, Add add) const {
  const Point2i pixel(wholePart(film.x), wholePart(film.y));
  // From the centre of the sample's pixel: so weights do not depend on the tile that it is in.
  const Vec2 p = film - Point2(pixel) - 0.5F;
  const int x0 = std::max(-reach_.x, wholePart(p.x - radius_.x) + 1);
  const int y0 = std::max(-reach_.y, wholePart(p.y - radius_.y) + 1);
  const int x1 = std::min(reach_.x, wholePart(p.x + radius_.x));
  const int y1 = std::min(reach_.y, wholePart(p.y + radius_.y));
  const auto inTable = [](int i, float at, float scale) {
    return std::min(kTable - 1, static_cast<int>(std::abs(static_cast<float>(i) - at) * scale));
  };
  int columns[2 * kWidest + 1];
  for (int x = x0; x <= x1; ++x) columns[x - x0] = inTable(x, p.x, tableScale_.x);
  const Point2i cell = pixel - corner(tile);
  for (int y = y0; y <= y1; ++y) {
    const float* weights = &table_[inTable(y, p.y, tableScale_.y) * kTable];
    for (int x = x0; x <= x1; ++x) add(cell.x + x, cell.y + y, double{weights[columns[x - x0]]});
  }
}

void Film::add(int tile, Point2 film, const Spectrum& radiance, bool opaque) {
  Spectrum L = radiance;
  if (const float y = luminance(L); y > brightest_) L *= brightest_ / y;
  constexpr float kMost = std::numeric_limits<float>::max();
  L = glm::clamp(L * scale_, -kMost, kMost);
  spread(tile, film, [&](int x, int y, double w) {
    PictureSums& sums = picture_.row(tile, y)[x];
    sums.rgb.add({w * L.x, w * L.y, w * L.z});
    sums.weight += w;
    sums.alpha += opaque ? w : 0;
  });
  if (stores(kVariance))
    spread(tile, film, [&](int x, int y, double w) {
      if (w == 0) return;
      NoiseSums& noise = noise_.row(tile, y)[x];
      const glm::dvec3 wL = w * glm::dvec3(L);
      noise.sums.add({w * wL.x, w * wL.y, w * wL.z, wL.x * wL.x, wL.y * wL.y, wL.z * wL.z, w * w});
      ++noise.count;
    });
  if (stores(kSampleCount)) {
    const Point2i at = Point2i(glm::floor(film)) - sampled_.lo - samples_.corner(tile);
    ++samples_.row(tile, at.y)[at.x];
  }
}

void Film::add(int tile, Point2i pixel, std::uint32_t index, const FirstSurface& s) {
  const Point2i at = pixel - sampled_.lo - picture_.corner(tile);
  if (surface_.blocks() > 0) {
    SurfaceSums sums;
    sums.sums.add({finite(s.albedo.x), finite(s.albedo.y), finite(s.albedo.z), finite(s.n.x),
                   finite(s.n.y), finite(s.n.z), finite(s.p.x), finite(s.p.y), finite(s.p.z),
                   finite(s.depth)});
    sums.count = 1;
    surface_.row(tile, at.y)[at.x] += sums;
  }
  if (detail_.blocks() > 0) {
    DetailSums sums;
    sums.sums.add({finite(s.uv.x), finite(s.uv.y), finite(s.trueN.x), finite(s.trueN.y),
                   finite(s.trueN.z), finite(s.dpdu.x), finite(s.dpdu.y), finite(s.dpdu.z),
                   finite(s.dpdv.x), finite(s.dpdv.y), finite(s.dpdv.z)});
    sums.count = 1;
    sums.shape = s.shape;
    sums.first = index;
    detail_.row(tile, at.y)[at.x] += sums;
  }
}

FilmPixel Film::pixel(Point2i pixel) const {
  const Point2i at = pixel - sampled_.lo;
  FilmPixel all;
  // The tiles whose sums, with their borders, cover this pixel.
  const int border = picture_.apron();
  const Point2i first = glm::max(at - border, 0) / kTile;
  const Point2i last =
      glm::min((at + border) / kTile, Point2i(picture_.across(), picture_.down()) - 1);
  for (int ty = first.y; ty <= last.y; ++ty)
    for (int tx = first.x; tx <= last.x; ++tx) {
      const int tile = ty * picture_.across() + tx;
      const Point2i in = at - Point2i(tx, ty) * kTile + border;
      all.picture += picture_.row(tile, in.y)[in.x];
      if (noise_.blocks() > 0) all.noise += noise_.row(tile, in.y)[in.x];
    }
  const Point2i own = at / kTile, in = at - own * kTile;
  const int tile = own.y * picture_.across() + own.x;
  if (samples_.blocks() > 0) all.samples = samples_.row(tile, in.y)[in.x];
  if (surface_.blocks() > 0) all.surface = surface_.row(tile, in.y)[in.x];
  if (detail_.blocks() > 0) all.detail = detail_.row(tile, in.y)[in.x];
  return all;
}

void Film::add(Point2i pixel, const FilmPixel& sums) {
  const Point2i at = pixel - sampled_.lo, own = at / kTile, in = at - own * kTile;
  const int tile = own.y * picture_.across() + own.x;
  const Point2i inBorder = in + picture_.apron();
  picture_.row(tile, inBorder.y)[inBorder.x] += sums.picture;
  if (noise_.blocks() > 0) noise_.row(tile, inBorder.y)[inBorder.x] += sums.noise;
  if (samples_.blocks() > 0) samples_.row(tile, in.y)[in.x] += sums.samples;
  if (surface_.blocks() > 0) surface_.row(tile, in.y)[in.x] += sums.surface;
  if (detail_.blocks() > 0) detail_.row(tile, in.y)[in.x] += sums.detail;
}

Image Film::image(AovSet aovs) const {
  return pictureOf({resolution_, crop_, static_cast<AovSet>(aovs & aovs_), origin_},
                   [&](int y, std::span<FilmPixel> pixels) {
                     for (int x = crop_.lo.x; x < crop_.hi.x; ++x)
                       pixels[x - crop_.lo.x] = pixel({x, y});
                   });
}

}  // namespace pbrt
