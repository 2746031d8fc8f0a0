#pragma once
// What meshes given in the scene file have in common: indices and values of vertices, checked.

#include <fmt/format.h>

#include "core/plugin/params.h"

namespace pbrt {

// Parameter indices, `corners` of them a face, each below `vertices`. If it is absent there must be
// one face's worth of vertices, in order.
inline std::vector<std::uint32_t> readIndices(Params& p, std::size_t corners,
                                              std::size_t vertices) {
  const std::vector<int> given =
      p.integers("indices", fmt::format("{} vertices a face, from 0", corners));
  std::vector<std::uint32_t> indices;
  if (!p.has("indices")) {
    if (vertices != corners && !p.describing())
      p.fail("indices", fmt::format("is missing (only {} points need none)", corners));
    for (std::uint32_t i = 0; i < corners; ++i) indices.push_back(i);
    return indices;
  }
  if (given.size() % corners != 0)
    p.fail("indices", fmt::format("has {} numbers, not {} a face", given.size(), corners));
  indices.reserve(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    if (given[i] < 0 || static_cast<std::size_t>(given[i]) >= vertices)
      p.fail("indices", fmt::format("number {} is {}, but there are {} vertices, from 0", i,
                                    given[i], vertices));
    indices.push_back(static_cast<std::uint32_t>(given[i]));
  }
  return indices;
}

// Throws unless the parameter is absent or has a finite value for each vertex.
template <class V>
void checkVertices(const Params& p, const char* name, const std::vector<V>& values,
                   std::size_t vertices) {
  if (!values.empty() && values.size() != vertices)
    p.fail(name, fmt::format("has {} entries for {} vertices", values.size(), vertices));
  for (std::size_t i = 0; i < values.size(); ++i)
    // Zero times a number is zero; times infinity or NaN it is NaN.
    if (!std::isfinite(glm::dot(values[i], V(0))))
      p.fail(name, fmt::format("is not finite at vertex {}", i));
}

}  // namespace pbrt
