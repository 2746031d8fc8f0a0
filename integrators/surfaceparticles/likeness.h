#pragma once
// Surfaces that look alike: one is the other turned, mirrored, scaled and shifted. Surfels of one
// cover all.

#include <array>
#include <compare>
#include <map>
#include <vector>

#include "core/api/world.h"
#include "shapes/metaballs/surfels/simulation.h"

namespace pbrt::surfels {

// The same for surfaces that are alike. The columns of a linear map L have the same lengths and
// angles, that is L^T L is the same, for all that differ by a rotation or a reflection after it.
struct Likeness {
  explicit Likeness(const ImplicitSurface& surface);
  auto operator<=>(const Likeness&) const = default;

  const ImplicitField* field;
  std::array<std::int64_t, 6> form{};  // L^T L over its trace, in steps of 2^-20
};

// Things whose keys are equal.
struct Groups {
  template <class Key>
  explicit Groups(const std::vector<Key>& keys) {
    std::map<Key, std::size_t> known;
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const auto [group, isNew] = known.try_emplace(keys[i], firsts.size());
      if (isNew) firsts.push_back(i);
      of.push_back(group->second);
    }
  }

  std::vector<std::size_t> firsts;  // of each group, by which groups are numbered
  std::vector<std::size_t> of;      // the group of each thing
};

// How much larger `to` is than `from`, which is alike, to 2^-20: one number for all copies of one
// size.
double scaleBetween(const Transform& from, const Transform& to);

// A surfel on the surface that `map` leads to; `map` turns, mirrors, scales and shifts.
Surfel placed(const Surfel& surfel, const Transform& map, double scale);

}  // namespace pbrt::surfels
