#include "core/base/hash.h"

#include <array>
#include <bit>
#include <cstring>

namespace pbrt {

// The specification reads little-endian numbers, as this machine has them.
static_assert(std::endian::native == std::endian::little);

namespace {

constexpr std::uint64_t kPrime1 = 0x9e3779b185ebca87ULL, kPrime2 = 0xc2b2ae3d27d4eb4fULL,
                        kPrime3 = 0x165667b19e3779f9ULL, kPrime4 = 0x85ebca77c2b2ae63ULL,
                        kPrime5 = 0x27d4eb2f165667c5ULL;

// Takes a number off the front.
template <class T>
std::uint64_t take(std::string_view& bytes) {
  T value = 0;
  std::memcpy(&value, bytes.data(), sizeof value);
  bytes.remove_prefix(sizeof value);
  return value;
}

std::uint64_t round(std::uint64_t lane, std::uint64_t input) {
  return std::rotl(lane + input * kPrime2, 31) * kPrime1;
}

// Four lanes do not wait for one another.
std::uint64_t hashStripes(std::string_view& bytes, std::uint64_t seed) {
  std::array<std::uint64_t, 4> lanes{seed + kPrime1 + kPrime2, seed + kPrime2, seed,
                                     seed - kPrime1};
  while (bytes.size() >= 32)
    for (std::uint64_t& lane : lanes) lane = round(lane, take<std::uint64_t>(bytes));
  std::uint64_t h = std::rotl(lanes[0], 1) + std::rotl(lanes[1], 7) + std::rotl(lanes[2], 12) +
                    std::rotl(lanes[3], 18);
  for (const std::uint64_t lane : lanes) h = (h ^ round(0, lane)) * kPrime1 + kPrime4;
  return h;
}

}  // namespace

std::uint64_t hashBytes(std::string_view bytes, std::uint64_t seed) {
  const std::uint64_t length = bytes.size();
  std::uint64_t h = (length >= 32 ? hashStripes(bytes, seed) : seed + kPrime5) + length;
  while (bytes.size() >= 8)
    h = std::rotl(h ^ round(0, take<std::uint64_t>(bytes)), 27) * kPrime1 + kPrime4;
  if (bytes.size() >= 4)
    h = std::rotl(h ^ take<std::uint32_t>(bytes) * kPrime1, 23) * kPrime2 + kPrime3;
  while (!bytes.empty()) h = std::rotl(h ^ take<std::uint8_t>(bytes) * kPrime5, 11) * kPrime1;
  h = (h ^ h >> 33U) * kPrime2;
  h = (h ^ h >> 29U) * kPrime3;
  return h ^ h >> 32U;
}

}  // namespace pbrt
