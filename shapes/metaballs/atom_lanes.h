#pragma once
// Atoms, eight at a time.

#include "shapes/metaballs/field.h"

namespace pbrt::metaballs {
inline namespace PBRT_LANES {

// Numbers of eight atoms of a list, from `first` on; lanes beyond its end have weight zero.
template <class V>
struct AtomLanes {
  V x{}, y{}, z{}, inverse{}, weight{};  // centre - near, 1 / h

  AtomLanes(std::span<const Atom> atoms, AtomList list, std::size_t first,
            const glm::vec<3, Lane<V>>& near) {
    static constexpr Atom nothing;
    V radius;
    for (int k = 0; k < kLanes; ++k) {
      const Atom& a = first + k < list.size() ? atoms[list[first + k]] : nothing;
      x[k] = a.centre.x;
      y[k] = a.centre.y;
      z[k] = a.centre.z;
      radius[k] = a.radius;
      if constexpr (sizeof(Lane<V>) == sizeof(float))
        weight[k] = a.lightWeight;
      else
        weight[k] = a.weight;
    }
    x -= near.x, y -= near.y, z -= near.z;
    inverse = 1 / radius;
  }
};

}  // namespace PBRT_LANES
}  // namespace pbrt::metaballs
