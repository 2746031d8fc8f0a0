#pragma once
// The encoders behind writeImage. Both write to an open stream and throw std::exception with the
// reason alone; the caller names the file and closes the stream.

#include <cstdio>

#include "core/base/image.h"

namespace pbrt {

void encodeExr(std::FILE* to, const Image& image);
void encodePng(std::FILE* to, const Image& image);

}  // namespace pbrt
