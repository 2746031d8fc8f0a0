#include <png.h>

#include <cerrno>
#include <csetjmp>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <system_error>

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

// What libpng calls back to, and what its calls may not unwind past.
struct PngReader {
  std::string_view bytes;
  std::string message;
  png_structp png = nullptr;
  png_infop info = nullptr;
  std::vector<std::uint8_t> pixels;
  std::vector<png_bytep> rows;

  ~PngReader() { png_destroy_read_struct(&png, &info, nullptr); }
};

void onError(png_structp png, png_const_charp what) {
  static_cast<PngReader*>(png_get_error_ptr(png))->message = what;
  png_longjmp(png, 1);
}
void onWarning(png_structp /*png*/, png_const_charp /*what*/) {}

void onRead(png_structp png, png_bytep to, png_size_t count) {
  std::string_view& bytes = static_cast<PngReader*>(png_get_io_ptr(png))->bytes;
  if (bytes.size() < count) png_error(png, "the file ends too early");
  std::copy_n(bytes.begin(), count, to);
  bytes.remove_prefix(count);
}

// The two halves of reading. They hold nothing that has a destructor: errors jump out of them.
bool readHeader(PngReader& r) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_set_read_fn(r.png, &r, onRead);
  png_read_info(r.png, r.info);
  png_set_expand(r.png);  // palettes to RGB, few bits to 8, transparent colours to alpha
  png_set_interlace_handling(r.png);
  png_read_update_info(r.png, r.info);
  return true;
}
bool readRows(PngReader& r) {
  if (setjmp(png_jmpbuf(r.png))) return false;
  png_read_image(r.png, r.rows.data());
  png_read_end(r.png, nullptr);
  return true;
}

}  // namespace

// The simplified interface would turn 16-bit pictures into linear light by the file's own idea of
// its gamma. Here the code values are wanted, whatever the file says of them.
Image decodePng(std::string_view bytes) {
  PngReader r;
  r.bytes = bytes;
  r.png = png_create_read_struct(PNG_LIBPNG_VER_STRING, &r, onError, onWarning);
  if (r.png) r.info = png_create_info_struct(r.png);
  if (!r.info) throw std::bad_alloc();
  if (!readHeader(r)) throw std::runtime_error(r.message);

  const Point2i size(png_get_image_width(r.png, r.info), png_get_image_height(r.png, r.info));
  const int channels = png_get_channels(r.png, r.info);
  // Deflate makes 258 bytes of two bits at best, and each may be 8 pixels.
  Image image = blankImage(size, channels, bytes.size(), std::size_t{1} << 14U);
  const std::size_t rowBytes = png_get_rowbytes(r.png, r.info);
  r.pixels.resize(rowBytes * static_cast<std::size_t>(size.y));
  for (int y = 0; y < size.y; ++y)
    r.rows.push_back(&r.pixels[rowBytes * static_cast<std::size_t>(y)]);
  if (!readRows(r)) throw std::runtime_error(r.message);

  image.encoded = true;
  const bool wide = png_get_bit_depth(r.png, r.info) == 16;
  const std::uint8_t* from = r.pixels.data();
  for (std::size_t i = 0; i < image.channels[0].size(); ++i)
    for (auto& channel : image.channels) {
      channel[i] = wide ? static_cast<float>(from[0] << 8 | from[1]) / 65535 : from[0] / 255.F;
      from += wide ? 2 : 1;
    }
  return image;
}

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
    throw std::runtime_error(std::ferror(to) ? std::generic_category().message(errno)
                                             : png.message);
}

}  // namespace pbrt
