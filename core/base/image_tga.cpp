// Truevision TGA, as its specification 2.0 (1991) has it: true colour, grey and colour-mapped
// pictures, run-length encoded or not.

#include <array>
#include <cstdint>
#include <stdexcept>

#include "core/base/image_format.h"

namespace pbrt {

namespace {

class TgaReader {
 public:
  explicit TgaReader(std::string_view bytes) : bytes_(bytes) {}

  Image read() {
    take(18, header_.data());
    const int kind = header_[2] & 7;  // 1: colour-mapped, 2: true colour, 3: grey
    encoded_ = header_[2] & 8;
    const int depth = header_[16];
    const bool mapped = kind == 1;
    if (kind < 1 || kind > 3 || header_[2] > 11 || mapped != (header_[1] == 1))
      throw std::runtime_error("it is no TGA picture, or of a kind that is not known");
    if ((kind == 2 && depth != 15 && depth != 16 && depth != 24 && depth != 32) ||
        (kind != 2 && depth != 8))
      throw std::runtime_error("its pixels have an unusual number of bits");

    skip(header_[0]);
    if (header_[1] == 1) readMap();
    const int entry = mapped ? mapDepth_ : depth;
    const int channels = kind == 3 ? 1 : (entry == 32 ? 4 : 3);
    const Point2i size(number(12), number(14));
    // A run of two to five bytes stands for 128 pixels.
    Image image = blankImage(size, channels, bytes_.size(), 128);
    image.encoded = true;

    const bool fromRight = header_[17] & 0x10, fromTop = header_[17] & 0x20;
    pixelBytes_ = (depth + 7) / 8;
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) {
        const std::uint8_t* code = nextPixel();
        if (mapped) code = mapEntry(code[0]);
        const std::size_t i = static_cast<std::size_t>(fromTop ? y : size.y - 1 - y) *
                                  static_cast<std::size_t>(size.x) +
                              static_cast<std::size_t>(fromRight ? size.x - 1 - x : x);
        store(image, i, code, entry);
      }
    return image;
  }

 private:
  int number(int at) const { return header_[at] | header_[at + 1] << 8; }

  void take(std::size_t count, std::uint8_t* to) {
    if (bytes_.size() < count) throw std::runtime_error("the file ends too early");
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<std::uint8_t>(bytes_[i]);
    bytes_.remove_prefix(count);
  }
  void skip(std::size_t count) { bytes_.remove_prefix(std::min(count, bytes_.size())); }

  void readMap() {
    mapFirst_ = number(3);
    mapDepth_ = header_[7];
    if (mapDepth_ != 15 && mapDepth_ != 16 && mapDepth_ != 24 && mapDepth_ != 32)
      throw std::runtime_error("the entries of its colour map have an unusual number of bits");
    map_.resize(static_cast<std::size_t>(number(5)) * ((mapDepth_ + 7) / 8));
    take(map_.size(), map_.data());
  }
  const std::uint8_t* mapEntry(int index) const {
    const int at = (index - mapFirst_) * ((mapDepth_ + 7) / 8);
    if (at < 0 || at >= static_cast<int>(map_.size()))
      throw std::runtime_error("a pixel is not in its colour map");
    return &map_[at];
  }

  const std::uint8_t* nextPixel() {
    if (encoded_ && left_ == 0) {
      std::uint8_t packet = 0;
      take(1, &packet);
      left_ = (packet & 0x7F) + 1;
      repeats_ = packet & 0x80;
      if (repeats_) take(pixelBytes_, pixel_.data());
    }
    if (!(encoded_ && repeats_)) take(pixelBytes_, pixel_.data());
    --left_;
    return pixel_.data();
  }

  // Colours are stored blue first; 16 bits are 5 of each colour, the highest one unused.
  static void store(Image& image, std::size_t i, const std::uint8_t* code, int depth) {
    if (depth == 15 || depth == 16) {
      const int bits = code[0] | code[1] << 8;
      for (int c = 0; c < 3; ++c)
        image.channels[c][i] = static_cast<float>(bits >> (10 - 5 * c) & 31) / 31;
      return;
    }
    constexpr std::array<int, 4> from = {2, 1, 0, 3};
    for (std::size_t c = 0; c < image.channels.size(); ++c)
      image.channels[c][i] = code[depth == 8 ? 0 : from[c]] / 255.F;
  }

  std::string_view bytes_;
  std::array<std::uint8_t, 18> header_{};
  bool encoded_ = false, repeats_ = false;
  int left_ = 0;  // of the current packet
  std::size_t pixelBytes_ = 0;
  std::array<std::uint8_t, 4> pixel_{};
  std::vector<std::uint8_t> map_;
  int mapFirst_ = 0, mapDepth_ = 0;
};

}  // namespace

Image decodeTga(std::string_view bytes) {
  return TgaReader(bytes).read();
}

}  // namespace pbrt
