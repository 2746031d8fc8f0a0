#pragma once
// One number for many bytes.

#include <cstdint>
#include <string_view>

namespace pbrt {

// XXH64 (Collet 2012-2023, "xxHash fast digest algorithm", version 0.1.1): about as fast as memory.
// Two texts that differ by accident have the same hash with a chance of 2^-64; nothing is promised
// against those who try. The hash of several texts in their order, lengths included: each with the
// hash so far as its seed.
std::uint64_t hashBytes(std::string_view bytes, std::uint64_t seed = 0);

}  // namespace pbrt
