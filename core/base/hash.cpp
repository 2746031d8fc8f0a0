#include "core/base/hash.h"

#define XXH_INLINE_ALL  // its header alone: nothing to link
#include <xxhash.h>

namespace pbrt {

std::uint64_t hashBytes(std::string_view bytes, std::uint64_t seed) {
  return XXH64(bytes.data(), bytes.size(), seed);
}

}  // namespace pbrt
