#pragma once
// Work on many surfels, some hundred to a call, on all threads.

#include "core/base/parallel.h"

namespace pbrt::surfels {

inline constexpr std::size_t kChunk = 256;

inline std::size_t chunks(std::size_t n) {
  return (n + kChunk - 1) / kChunk;
}

// body(begin, end) for every chunk of 0 ... n - 1.
template <class Body>
void forChunks(std::size_t n, Body&& body) {
  parallelFor(chunks(n),
              [&](std::size_t chunk) { body(chunk * kChunk, std::min(n, (chunk + 1) * kChunk)); });
}

}  // namespace pbrt::surfels
