// Pictures of plain floating-point light: Radiance RGBE (Ward 1991, "Real Pixels", Graphics Gems
// II; its run lengths are those of Radiance's color.c) and PFM (Debevec).

#include <fast_float/fast_float.h>

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <span>
#include <stdexcept>

#include "core/base/image_format.h"

namespace pbrt {

namespace {

using Rgbe = std::array<std::uint8_t, 4>;

class Cursor {
 public:
  explicit Cursor(std::string_view bytes) : bytes_(bytes) {}

  std::size_t left() const { return bytes_.size(); }
  std::string_view take(std::size_t count) {
    if (bytes_.size() < count) throw std::runtime_error("the file ends too early");
    const std::string_view taken = bytes_.substr(0, count);
    bytes_.remove_prefix(count);
    return taken;
  }
  std::uint8_t byte() { return static_cast<std::uint8_t>(take(1)[0]); }
  std::string_view line() {
    const std::size_t end = bytes_.find('\n');
    if (end == bytes_.npos) throw std::runtime_error("its header does not end");
    const std::string_view text = take(end);
    take(1);
    return text.ends_with('\r') ? text.substr(0, end - 1) : text;
  }
  // A word of the header and the one blank after it.
  std::string_view word() {
    const std::size_t end = bytes_.find_first_of(" \t\r\n");
    const std::string_view text = take(end == bytes_.npos ? bytes_.size() : end);
    take(1);
    return text;
  }

 private:
  std::string_view bytes_;
};

template <class T>
T numberOf(std::string_view word) {
  T value{};
  const auto result = fast_float::from_chars(word.data(), word.data() + word.size(), value);
  if (result.ec != std::errc() || result.ptr != word.data() + word.size())
    throw std::runtime_error("its header is broken");
  return value;
}
int sizeOf(std::string_view word) {
  const double value = numberOf<double>(word);
  if (!(value >= 1 && value <= 1 << 24) || value != std::floor(value))
    throw std::runtime_error("its header gives a size that cannot be");
  return static_cast<int>(value);
}

// A scan line whose four components are run-length encoded one after the other.
void readPlanes(Cursor& in, std::span<Rgbe> row) {
  for (int c = 0; c < 4; ++c)
    for (std::size_t x = 0; x < row.size();) {
      const std::uint8_t code = in.byte();
      const std::size_t count = code > 128 ? code - 128U : code;
      if (count == 0 || count > row.size() - x) throw std::runtime_error("a scan line is broken");
      const std::string_view values = in.take(code > 128 ? 1 : count);
      for (std::size_t i = 0; i < count; ++i)
        row[x++][c] = static_cast<std::uint8_t>(values[code > 128 ? 0 : i]);
    }
}

// Pixels one after the other; 1 1 1 n repeats the last one n times, and if it follows another such,
// 256 n times, and so on.
void readPixels(Cursor& in, std::span<Rgbe> row) {
  std::size_t scale = 1;
  for (std::size_t x = 0; x < row.size();) {
    Rgbe pixel;
    std::memcpy(pixel.data(), in.take(4).data(), 4);
    if (pixel[0] != 1 || pixel[1] != 1 || pixel[2] != 1) {
      row[x++] = pixel;
      scale = 1;
      continue;
    }
    const std::size_t count = pixel[3] * scale;
    if (x == 0 || count > row.size() - x) throw std::runtime_error("a scan line is broken");
    std::fill_n(row.begin() + static_cast<std::ptrdiff_t>(x), count, row[x - 1]);
    x += count;
    scale <<= 8U;
  }
}

}  // namespace

Image decodeHdr(std::string_view bytes) {
  Cursor in(bytes);
  if (!in.line().starts_with("#?")) throw std::runtime_error("it is no Radiance picture");
  for (std::string_view line = in.line(); !line.empty(); line = in.line())
    if (line.starts_with("FORMAT=") && line != "FORMAT=32-bit_rle_rgbe")
      throw std::runtime_error("its format is not 32-bit_rle_rgbe");
  const std::string_view vertical = in.word();
  const int height = sizeOf(in.word());
  const std::string_view horizontal = in.word();
  const int width = sizeOf(in.word());
  if ((vertical != "-Y" && vertical != "+Y") || horizontal != "+X")
    throw std::runtime_error("its scan lines do not run from left to right");

  // One pixel that repeats 255 times, and 255 * 256 times, takes twelve bytes.
  Image image = blankImage({width, height}, 3, in.left(), 1U << 14U);
  std::vector<Rgbe> row(static_cast<std::size_t>(width));
  for (int y = 0; y < height; ++y) {
    Cursor start = in;
    const std::uint8_t first = start.byte(), second = start.byte(), third = start.byte();
    if (first == 2 && second == 2 && (third << 8 | start.byte()) == width) {
      in = start;
      readPlanes(in, row);
    } else {
      readPixels(in, row);
    }
    const std::size_t at =
        static_cast<std::size_t>(vertical == "-Y" ? y : height - 1 - y) * row.size();
    for (std::size_t x = 0; x < row.size(); ++x)
      for (int c = 0; c < 3; ++c)
        image.channels[c][at + x] = row[x][3] == 0 ? 0 : std::ldexp(row[x][c], row[x][3] - 136);
  }
  return image;
}

Image decodePfm(std::string_view bytes) {
  Cursor in(bytes);
  const std::string_view kind = in.word();
  if (kind != "PF" && kind != "Pf") throw std::runtime_error("it is no PFM picture");
  const int width = sizeOf(in.word()), height = sizeOf(in.word());
  const float scale = numberOf<float>(in.word());
  if (!(scale != 0 && std::isfinite(scale))) throw std::runtime_error("its header is broken");
  static_assert(std::endian::native == std::endian::little);
  const bool swaps = scale > 0;  // big-endian

  Image image = blankImage({width, height}, kind == "PF" ? 3 : 1, in.left(), 1);
  for (int y = height - 1; y >= 0; --y)
    for (int x = 0; x < width; ++x)
      for (auto& channel : image.channels) {
        std::uint32_t bits = 0;
        std::memcpy(&bits, in.take(4).data(), 4);
        if (swaps) bits = __builtin_bswap32(bits);
        channel[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                static_cast<std::size_t>(x)] = std::bit_cast<float>(bits) * std::abs(scale);
      }
  return image;
}

}  // namespace pbrt
