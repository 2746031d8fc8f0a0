#include "core/scene/aov.h"

#include <array>

namespace pbrt {

namespace {

constexpr std::array<std::string_view, 10> kNames = {
    "variance", "albedo", "normal",          "position",    "depth",
    "samples",  "uv",     "geometricnormal", "derivatives", "shape"};

// The cell of a pixel that counts from the first of all.
template <class T>
const T& cell(const BlockedArray<T>& sums, Point2i pixel) {
  const Point2i block = pixel / sums.size(), in = pixel - block * sums.size();
  return sums.row(block.y * sums.across() + block.x, in.y)[in.x];
}

// Appends one channel: value(pixel) for each pixel of the window.
template <class Value>
void append(Image& image, const std::string& name, const Bounds2i& window, Value value) {
  std::vector<float> channel;
  channel.reserve(static_cast<std::size_t>(window.width()) * window.height());
  for (int y = window.lo.y; y < window.hi.y; ++y)
    for (int x = window.lo.x; x < window.hi.x; ++x)
      channel.push_back(static_cast<float>(value(Point2i(x, y))));
  image.names.push_back(name);
  image.channels.push_back(std::move(channel));
}

// Three channels, `layer`.R or the like.
template <class Value>
void append(Image& image, std::string_view layer, std::string_view components,
            const Bounds2i& window, Value value) {
  for (int c = 0; c < 3; ++c)
    append(image, std::string(layer) + '.' + components[c], window,
           [&](Point2i pixel) { return value(pixel, c); });
}

}  // namespace

std::span<const std::string_view> aovNames() {
  return kNames;
}

std::optional<AovSet> aovByName(std::string_view name) {
  const auto found = std::find(kNames.begin(), kNames.end(), name);
  if (found == kNames.end()) return {};
  return static_cast<AovSet>(1U << (found - kNames.begin()));
}

AovSums::AovSums(AovSet stored, Point2i size, int tile, const DPoint3& origin)
    : stored_(stored), origin_(origin) {
  if (stores(kSampleCount)) counts_ = {size.x, size.y, tile};
  if (stores(kOfSurface & ~kOfDetail)) surfaces_ = {size.x, size.y, tile};
  if (stores(kOfDetail)) details_ = {size.x, size.y, tile};
}

double AovSums::bytes(AovSet stored, Point2i size, int tile) {
  double bytes = 0;
  if (stored & kSampleCount) bytes += BlockedArray<double>::bytes(size.x, size.y, tile);
  if (stored & kOfSurface & ~kOfDetail)
    bytes += BlockedArray<Surfaces>::bytes(size.x, size.y, tile);
  if (stored & kOfDetail) bytes += BlockedArray<Details>::bytes(size.x, size.y, tile);
  return bytes;
}

void AovSums::add(int tile, Point2i pixel, const FirstSurface& surface) {
  if (surfaces_.blocks() > 0) {
    Surfaces& s = surfaces_.row(tile, pixel.y)[pixel.x];
    s.albedo += surface.albedo;
    s.n += surface.n;
    s.p += surface.p;
    s.depth += surface.depth;
    ++s.count;
  }
  if (details_.blocks() > 0) {
    Details& d = details_.row(tile, pixel.y)[pixel.x];
    d.uv += surface.uv;
    d.n += surface.trueN;
    d.dpdu += surface.dpdu;
    d.dpdv += surface.dpdv;
    if (d.count == 0) d.shape = surface.shape;
    ++d.count;
  }
}

void AovSums::appendTo(Image& image, AovSet wanted, const Bounds2i& window) const {
  wanted &= stored_;
  const auto mean = [](double sum, double count) { return count > 0 ? sum / count : 0; };
  if (wanted & kSampleCount)
    append(image, "samples", window, [&](Point2i pixel) { return cell(counts_, pixel); });
  if (wanted & kAlbedo)
    append(image, "Albedo", "RGB", window, [&](Point2i pixel, int c) {
      const Surfaces& s = cell(surfaces_, pixel);
      return mean(s.albedo[c], s.count);
    });
  if (wanted & kNormal)
    append(image, "N", "XYZ", window, [&](Point2i pixel, int c) {
      const Surfaces& s = cell(surfaces_, pixel);
      return mean(s.n[c], s.count);
    });
  if (wanted & kPosition)
    append(image, "P", "XYZ", window, [&](Point2i pixel, int c) {
      const Surfaces& s = cell(surfaces_, pixel);
      return s.count > 0 ? origin_[c] + s.p[c] / s.count : 0;
    });
  if (wanted & kDepth)
    append(image, "Z", window, [&](Point2i pixel) {
      const Surfaces& s = cell(surfaces_, pixel);
      return mean(s.depth, s.count);
    });
  // `sum` is the member to take the mean of.
  const auto appendMean = [&](std::string_view layer, auto Details::*sum) {
    append(image, layer, "XYZ", window, [&](Point2i pixel, int c) {
      const Details& d = cell(details_, pixel);
      return mean((d.*sum)[c], d.count);
    });
  };
  if (wanted & kUv)
    for (int c = 0; c < 2; ++c)
      append(image, c == 0 ? "u" : "v", window, [&](Point2i pixel) {
        const Details& d = cell(details_, pixel);
        return mean(d.uv[c], d.count);
      });
  if (wanted & kTrueNormal) appendMean("Ng", &Details::n);
  if (wanted & kDerivatives) {
    appendMean("dPdu", &Details::dpdu);
    appendMean("dPdv", &Details::dpdv);
  }
  if (wanted & kShape)
    append(image, "shape", window, [&](Point2i pixel) { return cell(details_, pixel).shape; });
}

}  // namespace pbrt
