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
using Attribute = std::variant<int, float, double, std::string, glm::dmat4>;

// Named float channels over a rectangle of pixels; scanline order, the rows from the top.
struct Image {
  Bounds2i window;                 // the pixels that are here (data window)
  Point2i resolution{0};           // of the whole picture (display window is [0, resolution))
  std::vector<std::string> names;  // "R", "G", "B", "A", ...
  std::vector<std::vector<float>> channels;  // one per name, window.width() * window.height()
  std::map<std::string, Attribute> attributes;

  // The channel of this name, or null.
  const std::vector<float>* channel(std::string_view name) const;
  // The attribute of this name, if it is a number of any type.
  double number(std::string_view name, double otherwise) const;
};

// Writes by the suffix: .exr (float or half channels, all of them, with attributes) or .png
// (8-bit sRGB, with alpha if there is "A" that is not 1 everywhere). The file appears whole or
// not at all: it is written beside its place and renamed. Throws Error, Failure::io.
void writeImage(const std::filesystem::path& file, const Image& image);

// Throws Error, Failure::io, if the suffix is not one that writeImage knows, the folder is not
// there or cannot be written to, or the path is a folder: ask before a long render.
void checkWritable(const std::filesystem::path& file);

// Reads an EXR file (scan lines or tiles, any channels, as float). Throws Error, Failure::io.
Image readExr(const std::filesystem::path& file);

}  // namespace pbrt
