#pragma once
// The encoders behind writeImage and the decoders behind readImage. They write to an open stream
// or read the bytes of a file, and throw std::exception with the reason alone; the caller names the
// file.

#include <cstdio>
#include <string_view>

#include "core/base/image.h"

namespace pbrt {

void encodeExr(std::FILE* to, const Image& image);
void encodePng(std::FILE* to, const Image& image);

// Throws unless a picture of so many values may be, in a file of `bytes`: its header, which may be
// broken, can claim any size. `densest` is how many values a byte can stand for in the format.
void checkRoom(std::size_t values, std::size_t bytes, std::size_t densest);

Image decodePng(std::string_view bytes);
Image decodeTga(std::string_view bytes);
Image decodeHdr(std::string_view bytes);
Image decodePfm(std::string_view bytes);

}  // namespace pbrt
