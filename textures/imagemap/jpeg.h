#pragma once
// JPEG pictures; the only user of libjpeg.

#include "core/base/image.h"

namespace pbrt {

// Reads a JPEG file, grey or colour, as readImage does PNG. One that ends too early or is damaged
// is an error. Throws Error, Failure::io.
Image readJpeg(const std::filesystem::path& file);

}  // namespace pbrt
