#include "pictures.h"

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <new>
#include <string_view>

#include "core/base/image_format.h"

namespace pbrt {

namespace {

// RFC 4648, section 4.
std::string base64(std::string_view bytes) {
  static constexpr std::string_view kDigits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t group = 0;
    for (std::size_t j = 0; j < 3; ++j)
      group = group << 8U | (i + j < bytes.size() ? static_cast<std::uint8_t>(bytes[i + j]) : 0U);
    for (std::size_t j = 0; j < 4; ++j)
      text += i + j <= bytes.size() ? kDigits[group >> (18 - 6 * j) & 63U] : '=';
  }
  return text;
}

}  // namespace

std::string dataUri(const Image& image) {
  char* bytes = nullptr;
  std::size_t size = 0;
  std::FILE* const stream = open_memstream(&bytes, &size);
  if (stream == nullptr) throw std::bad_alloc();
  const auto close = [&](std::FILE* f) { std::fclose(f); };
  {
    const std::unique_ptr<std::FILE, decltype(close)> open(stream, close);
    encodePng(stream, image);
  }
  const std::unique_ptr<char, decltype(&std::free)> owned(bytes, &std::free);
  return "data:image/png;base64," + base64({bytes, size});
}

Image thumbnail(const Image& image, int most) {
  const int factor = (image.window.width() + most - 1) / most;
  const Point2i size((image.window.width() + factor - 1) / factor,
                     (image.window.height() + factor - 1) / factor);
  Image small;
  small.window = {{0, 0}, size};
  small.resolution = size;
  for (const char* name : {"R", "G", "B"}) {
    const std::vector<float>& from = *image.channel(name);
    std::vector<float> sum(static_cast<std::size_t>(size.x) * size.y), count(sum.size());
    for (int y = 0; y < image.window.height(); ++y)
      for (int x = 0; x < image.window.width(); ++x) {
        const std::size_t to = static_cast<std::size_t>(y / factor) * size.x + x / factor;
        sum[to] += from[static_cast<std::size_t>(y) * image.window.width() + x];
        ++count[to];
      }
    for (std::size_t i = 0; i < sum.size(); ++i) sum[i] /= count[i];
    small.names.emplace_back(name);
    small.channels.push_back(std::move(sum));
  }
  return small;
}

}  // namespace pbrt
