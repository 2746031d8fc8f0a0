#pragma once
// Pictures in memory and on disk; the only user of OpenEXR and libpng.

#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

#include "core/base/bounds.h"

namespace pbrt {

// A metadata entry of a picture (an EXR attribute).
using ImageAttribute = std::variant<int, float, double, std::string, glm::dmat4>;

// Named float channels over a rectangle of pixels; scanline order, the rows from the top.
struct Image {
  Bounds2i window;                 // the pixels that are here (data window)
  Point2i resolution{0};           // of the whole picture (display window is [0, resolution))
  std::vector<std::string> names;  // "R", "G", "B", "A", ...
  std::vector<std::vector<float>> channels;  // one per name, window.width() * window.height()
  std::map<std::string, ImageAttribute> attributes;
  bool encoded = false;  // code values for a display (IEC 61966-2-1) from 0 to 1, not linear light

  // The channel of this name, or null.
  const std::vector<float>* channel(std::string_view name) const;
  // The attribute of this name, if it is a number of any type.
  double number(std::string_view name, double otherwise) const;
};

// Writes by the suffix: .exr (float or half channels, all of them, with attributes) or .png
// (8-bit sRGB, with alpha if there is "A" that is not 1 everywhere). The file appears whole or
// not at all: it is written beside its place and renamed. A link is followed to a file whose name
// ends in one of the two, too. Throws Error, Failure::io.
void writeImage(const std::filesystem::path& file, const Image& image);

// Throws Error, Failure::io, if the suffix is not one that writeImage knows, the folder is not
// there or cannot be written to, or the path is a folder, a device or a pipe: ask before a long
// render.
void checkWritable(const std::filesystem::path& file);

// Reads an EXR file (scan lines or tiles, any channels, as float). Throws Error, Failure::io.
Image readExr(const std::filesystem::path& file);

// Reads by the suffix, in any case: .exr, .hdr (Radiance RGBE), .pfm, .png and .tga. All but EXR
// give "R" "G" "B" or, if grey, "Y", and "A" if there is one. PNG and TGA give what is stored, over
// the largest code value: `encoded`, and not multiplied by alpha. Throws Error, Failure::io.
Image readImage(const std::filesystem::path& file);

// A picture of this size with channels "Y", "YA", "RGB" or "RGBA" (1 to 4 of them), all zero.
// Throws std::runtime_error if a file of `bytes` cannot hold so many values, or memory: a broken
// header may claim any size. `densest` is how many values a byte can stand for in the format.
Image blankImage(Point2i size, int channels, std::size_t bytes, std::size_t densest);

// The code values of IEC 61966-2-1:1999, section 5.2, and the linear light that they stand for.
float encodeSrgb(float linear);  // clamped to [0, 1]
float decodeSrgb(float code);

}  // namespace pbrt
