#include <png.h>

#include <cstdint>
#include <stdexcept>

#include "core/base/image_format.h"

namespace pbrt {

namespace {

// To [0, 1]; not a number is 0.
float clamp01(float x) {
  return x > 0 ? std::min(x, 1.F) : 0.F;
}

std::uint8_t toByte(float x) {
  return static_cast<std::uint8_t>(clamp01(x) * 255 + 0.5F);
}

// Linear light to the code values of IEC 61966-2-1:1999, section 5.2.
float encodeSrgb(float linear) {
  const float x = clamp01(linear);
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
}

}  // namespace

void encodePng(std::FILE* to, const Image& image) {
  const std::vector<float>* const rgb[] = {image.channel("R"), image.channel("G"),
                                           image.channel("B")};
  if (rgb[0] == nullptr || rgb[1] == nullptr || rgb[2] == nullptr)
    throw std::runtime_error("the picture has no channels R, G and B");
  if (image.window.empty()) throw std::runtime_error("the picture has no pixels");

  const std::vector<float>* alpha = image.channel("A");
  if (alpha && std::all_of(alpha->begin(), alpha->end(), [](float a) { return a == 1; }))
    alpha = nullptr;

  std::vector<std::uint8_t> bytes;
  bytes.reserve(rgb[0]->size() * (alpha ? 4 : 3));
  for (std::size_t i = 0; i < rgb[0]->size(); ++i) {
    // Our colours are multiplied by alpha, PNG's are not. Light that no surface covers (A = 0)
    // keeps its colour for viewers that ignore alpha.
    const float a = alpha ? clamp01((*alpha)[i]) : 1;
    for (const auto* channel : rgb)
      bytes.push_back(toByte(encodeSrgb(a > 0 ? (*channel)[i] / a : (*channel)[i])));
    if (alpha) bytes.push_back(toByte(a));
  }

  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  png.width = static_cast<png_uint_32>(image.window.width());
  png.height = static_cast<png_uint_32>(image.window.height());
  png.format = alpha ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
  if (png_image_write_to_stdio(&png, to, 0, bytes.data(), 0, nullptr) == 0)
    throw std::runtime_error(png.message);
}

}  // namespace pbrt
