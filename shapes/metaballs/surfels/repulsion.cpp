#include "shapes/metaballs/surfels/repulsion.h"

#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {

inline namespace portable {
surfels::Repel repel;
}
#ifdef PBRT_X86
namespace avx2 {
surfels::Repel repel;
}
namespace avx512 {
surfels::Repel repel;
}
#endif

}  // namespace pbrt::metaballs

namespace pbrt::surfels {

std::span<Repel* const> allRepels() {
  static constexpr Repel* all[] = {
      metaballs::portable::repel,
#ifdef PBRT_X86
      metaballs::avx2::repel,
      metaballs::avx512::repel,
#endif
  };
  return std::span(all).first(metaballs::allLoops().size());
}

void repel(const GridView& grid, std::span<const Cell> cells, Repulsion* out) {
  static Repel* const best = allRepels().back();
  best(grid, cells, out);
}

}  // namespace pbrt::surfels
