#include "core/scene/film_pixel.h"

#include <string>
#include <vector>

namespace pbrt {

namespace {

// A pixel is m = sum(w L) / sum(w), a ratio of two sums over independent samples; to first order
// its variance is sum(w^2 (L - m)^2) / sum(w)^2 (Cochran 1977, "Sampling Techniques",
// section 2.11), times n / (n - 1) for the n samples that m was taken from itself. Where samples
// are spread better than at random, the true variance is smaller.
double variance(const FilmPixel& pixel, int c) {
  const double weight = pixel.picture.weight, n = pixel.noise.count;
  if (n < 2 || weight == 0) return 0;
  const ExactSums<7>& noise = pixel.noise.sums;
  const double m = pixel.picture.rgb.value(c) / weight;
  const double squares = noise.value(3 + c) - 2 * m * noise.value(c) + m * m * noise.value(6);
  return std::max(0.0, squares) * (n / ((n - 1) * weight * weight));
}

// A row of a picture, channel by channel: how the values of its pixels become those of channels.
class Row {
 public:
  Row(std::span<const FilmPixel> pixels, std::vector<std::vector<float>>& channels)
      : pixels_(pixels), channels_(channels) {}

  // The next channel: value(pixel) for each.
  template <class Value>
  void append(Value value) {
    std::vector<float>& channel = channels_[next_++];
    for (const FilmPixel& pixel : pixels_) channel.push_back(static_cast<float>(value(pixel)));
  }
  // The next `n` channels: means of the sums from `first` on.
  template <class Sums>
  void appendMeans(Sums FilmPixel::*sums, int first, int n) {
    for (int c = first; c < first + n; ++c)
      append([&](const FilmPixel& pixel) {
        const Sums& s = pixel.*sums;
        return s.count > 0 ? s.sums.value(c) / s.count : 0;
      });
  }

 private:
  std::span<const FilmPixel> pixels_;
  std::vector<std::vector<float>>& channels_;
  std::size_t next_ = 0;
};

// `layer`.R or the like.
void nameThree(Image& image, std::string_view layer, std::string_view components) {
  for (const char c : components) image.names.push_back(std::string(layer) + '.' + c);
}

// In the order in which appendRow() makes them.
void nameChannels(Image& image, AovSet aovs) {
  image.names = {"R", "G", "B", "A"};
  if (aovs & kVariance) nameThree(image, "Variance", "RGB");
  if (aovs & kSampleCount) image.names.emplace_back("samples");
  if (aovs & kAlbedo) nameThree(image, "Albedo", "RGB");
  if (aovs & kNormal) nameThree(image, "N", "XYZ");
  if (aovs & kPosition) nameThree(image, "P", "XYZ");
  if (aovs & kDepth) image.names.emplace_back("Z");
  if (aovs & kUv) image.names.insert(image.names.end(), {"u", "v"});
  if (aovs & kTrueNormal) nameThree(image, "Ng", "XYZ");
  if (aovs & kDerivatives) {
    nameThree(image, "dPdu", "XYZ");
    nameThree(image, "dPdv", "XYZ");
  }
  if (aovs & kShape) image.names.emplace_back("shape");
}

void appendRow(Row row, const PictureFrame& frame) {
  for (int c = 0; c < 4; ++c)
    row.append([&](const FilmPixel& pixel) {
      const PictureSums& sums = pixel.picture;
      if (sums.weight == 0) return 0.0;
      const double sum = c == 3 ? sums.alpha : sums.rgb.value(c), value = sum * (1 / sums.weight);
      return c == 3 ? std::clamp(value, 0.0, 1.0) : std::max(0.0, value);
    });
  if (frame.aovs & kVariance)
    for (int c = 0; c < 3; ++c) row.append([&](const FilmPixel& p) { return variance(p, c); });
  if (frame.aovs & kSampleCount) row.append([](const FilmPixel& p) { return p.samples; });
  if (frame.aovs & kAlbedo) row.appendMeans(&FilmPixel::surface, 0, 3);
  if (frame.aovs & kNormal) row.appendMeans(&FilmPixel::surface, 3, 3);
  if (frame.aovs & kPosition)
    for (int c = 0; c < 3; ++c)
      row.append([&](const FilmPixel& p) {
        const SurfaceSums& s = p.surface;
        return s.count > 0 ? frame.origin[c] + s.sums.value(6 + c) / s.count : 0;
      });
  if (frame.aovs & kDepth) row.appendMeans(&FilmPixel::surface, 9, 1);
  if (frame.aovs & kUv) row.appendMeans(&FilmPixel::detail, 0, 2);
  if (frame.aovs & kTrueNormal) row.appendMeans(&FilmPixel::detail, 2, 3);
  if (frame.aovs & kDerivatives) row.appendMeans(&FilmPixel::detail, 5, 6);
  if (frame.aovs & kShape) row.append([](const FilmPixel& p) { return p.detail.shape; });
}

}  // namespace

Image pictureOf(const PictureFrame& frame,
                const std::function<void(int y, std::span<FilmPixel> pixels)>& row) {
  Image image;
  image.window = frame.window;
  image.resolution = frame.resolution;
  nameChannels(image, frame.aovs);
  const auto width = static_cast<std::size_t>(frame.window.width());
  const auto height = static_cast<std::size_t>(frame.window.height());
  image.channels.resize(image.names.size());
  for (auto& channel : image.channels) channel.reserve(width * height);
  std::vector<FilmPixel> pixels(width);
  for (int y = frame.window.lo.y; y < frame.window.hi.y; ++y) {
    std::fill(pixels.begin(), pixels.end(), FilmPixel());
    row(y, pixels);
    appendRow(Row(pixels, image.channels), frame);
  }
  return image;
}

}  // namespace pbrt
