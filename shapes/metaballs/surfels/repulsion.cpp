#include "shapes/metaballs/surfels/repulsion.h"

#include <array>

#include "shapes/metaballs/loops.h"

namespace pbrt::metaballs {

inline namespace portable {
void repel(const surfels::GridView&, std::span<const surfels::Cell>, surfels::Repulsion*);
}
#ifdef PBRT_X86
namespace avx2 {
void repel(const surfels::GridView&, std::span<const surfels::Cell>, surfels::Repulsion*);
}
namespace avx512 {
void repel(const surfels::GridView&, std::span<const surfels::Cell>, surfels::Repulsion*);
}
#endif

}  // namespace pbrt::metaballs

namespace pbrt::surfels {

void repel(const GridView& grid, std::span<const Cell> cells, Repulsion* out) {
#ifdef PBRT_X86
  static constexpr std::array kAll{metaballs::portable::repel, metaballs::avx2::repel,
                                   metaballs::avx512::repel};
  static const auto best = kAll[metaballs::allLoops().size() - 1];
  best(grid, cells, out);
#else
  metaballs::portable::repel(grid, cells, out);
#endif
}

}  // namespace pbrt::surfels
