#pragma once
// Atoms, eight at a time.

#include <cstring>

#include "shapes/metaballs/field.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

// Numbers of eight atoms of a list, from `first` on; lanes beyond its end have weight zero.
template <class V>
struct AtomLanes {
  V x, y, z;  // centre - near
  V inverse;  // 1 / h
  V weight;

  AtomLanes(std::span<const Atom> atoms, AtomList list, std::size_t first,
            const glm::vec<3, Lane<V>>& near) {
    static constexpr Atom nothing;
    const Atom* a[kLanes];
    for (int k = 0; k < kLanes; ++k)
      a[k] = first + k < list.size() ? &atoms[list[first + k]] : &nothing;

    // The transpose of eight rows of four: pairs of rows side by side, then interleaved twice.
    static_assert(offsetof(Atom, radius) == 3 * sizeof(float));
    const Floats r04 = rows(a[0], a[4]), r15 = rows(a[1], a[5]), r26 = rows(a[2], a[6]),
                 r37 = rows(a[3], a[7]);
    const Floats xy01 = __builtin_shufflevector(r04, r15, 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats zh01 = __builtin_shufflevector(r04, r15, 2, 10, 3, 11, 6, 14, 7, 15);
    const Floats xy23 = __builtin_shufflevector(r26, r37, 0, 8, 1, 9, 4, 12, 5, 13);
    const Floats zh23 = __builtin_shufflevector(r26, r37, 2, 10, 3, 11, 6, 14, 7, 15);
    x = converted(__builtin_shufflevector(xy01, xy23, 0, 1, 8, 9, 4, 5, 12, 13)) - near.x;
    y = converted(__builtin_shufflevector(xy01, xy23, 2, 3, 10, 11, 6, 7, 14, 15)) - near.y;
    z = converted(__builtin_shufflevector(zh01, zh23, 0, 1, 8, 9, 4, 5, 12, 13)) - near.z;
    inverse = 1 / converted(__builtin_shufflevector(zh01, zh23, 2, 3, 10, 11, 6, 7, 14, 15));
    if constexpr (sizeof(Lane<V>) == sizeof(float))
      weight = V{a[0]->lightWeight, a[1]->lightWeight, a[2]->lightWeight, a[3]->lightWeight,
                 a[4]->lightWeight, a[5]->lightWeight, a[6]->lightWeight, a[7]->lightWeight};
    else
      weight = V{a[0]->weight, a[1]->weight, a[2]->weight, a[3]->weight,
                 a[4]->weight, a[5]->weight, a[6]->weight, a[7]->weight};
  }

 private:
  // Centre and radius of two atoms.
  static Floats rows(const Atom* a, const Atom* b) {
    using Four __attribute__((vector_size(16))) = float;
    Four low, high;
    std::memcpy(&low, &a->centre, sizeof(Four));
    std::memcpy(&high, &b->centre, sizeof(Four));
    return __builtin_shufflevector(low, high, 0, 1, 2, 3, 4, 5, 6, 7);
  }
  static V converted(Floats v) {
    if constexpr (sizeof(Lane<V>) == sizeof(float))
      return v;
    else
      return __builtin_convertvector(v, V);
  }
};

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
