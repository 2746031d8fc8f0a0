#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {

namespace portable {
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

const Loops& loops() {
  static const Loops& best = []() -> const Loops& {
#ifdef PBRT_X86
    if (__builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
        __builtin_cpu_supports("avx512dq"))
      return avx512::kLoops;
    if (__builtin_cpu_supports("avx2")) return avx2::kLoops;
#endif
    return portable::kLoops;
  }();
  return best;
}

}  // namespace pbrt::metaballs
