#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {

inline namespace portable {
extern const Loops kLoops;
}
#ifdef PBRT_X86
namespace avx2 {
extern const Loops kLoops;
}
namespace avx512 {
extern const Loops kLoops;
}
#endif

std::span<const Loops* const> allLoops() {
  static const std::vector<const Loops*> all = [] {
    std::vector<const Loops*> supported{&portable::kLoops};
#ifdef PBRT_X86
    if (__builtin_cpu_supports("avx2")) supported.push_back(&avx2::kLoops);
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
      supported.push_back(&avx512::kLoops);
#endif
    return supported;
  }();
  return all;
}

const Loops& loops() {
  static const Loops& best = *allLoops().back();
  return best;
}

}  // namespace pbrt::metaballs
