// Compiled once for each instruction set. Nothing here may call functions that are not inlined: the
// linker would keep but one copy of them, for the best machine.

#include "shapes/metaballs/loops.h"

#include "shapes/metaballs/eight_bounds.h"
#include "shapes/metaballs/sample.h"
#include "shapes/metaballs/search.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

extern const Loops kLoops;
const Loops kLoops{
    [](Kernel kernel, std::span<const Atom> atoms, const DPoint3& p, AtomList list) {
      return withKernel(kernel, [&]<class K>(K) { return sample<K>(atoms, p, list); });
    },
    [](Kernel kernel, std::span<const Atom> atoms, AtomList list, const Eight& octants) {
      return withKernel(kernel, [&]<class K>(K) { return allInside<K>(atoms, list, octants); });
    },
    [](Kernel kernel, std::span<const Atom> atoms, AtomList list, const Eight& octants, bool tight,
       std::uint8_t* masks, EightBounds& result) {
      withKernel(kernel, [&]<class K>(K) {
        if (tight)
          bounds<K, true>(atoms, list, octants, masks, result);
        else
          bounds<K, false>(atoms, list, octants, masks, result);
      });
    },
    [](Kernel kernel, std::span<const Atom> atoms, AtomList list, const RayQuery& query) {
      return withKernel(kernel, [&]<class K>(K) { return find<K>(atoms, list, query); });
    }};

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
