#pragma once
// Pictures inside a page.

#include <string>

#include "core/base/image.h"

namespace pbrt {

// The picture as a screen shows it: "data:image/png;base64,...".
std::string dataUri(const Image& image);

// R, G and B of the picture, made smaller by a whole factor until it is no wider than `most`
// pixels.
Image thumbnail(const Image& image, int most);

}  // namespace pbrt
