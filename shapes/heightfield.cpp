// A height over each place of a grid on the unit square.

#include <fmt/format.h>

#include "core/plugin/plugin.h"

namespace pbrt {

class HeightField final : public MeshShape {
 public:
  explicit HeightField(Params& p) {
    const int nu = p.integer("nu", 2, 2, 1 << 15, "places along x");
    const int nv = p.integer("nv", 2, 2, 1 << 15, "places along y");
    const std::vector<float> heights = p.numbers("Pz", "heights, x running fastest");
    for (const char* name : {"nu", "nv", "Pz"}) p.require(name);
    if (p.describing()) return;
    const auto columns = static_cast<std::uint32_t>(nu), rows = static_cast<std::uint32_t>(nv);
    if (heights.size() != std::size_t{columns} * rows)
      p.fail("Pz", fmt::format("has {} heights; {} are nu times nv", heights.size(),
                               std::size_t{columns} * rows));

    for (std::uint32_t j = 0; j < rows; ++j)
      for (std::uint32_t i = 0; i < columns; ++i) {
        const float z = heights[mesh_.positions.size()];
        if (!std::isfinite(z))
          p.fail("Pz", fmt::format("height {} is not finite", mesh_.positions.size()));
        mesh_.uv.emplace_back(float(i) / float(columns - 1), float(j) / float(rows - 1));
        mesh_.positions.emplace_back(mesh_.uv.back(), z);
      }
    for (std::uint32_t j = 0; j + 1 < rows; ++j)
      for (std::uint32_t i = 0; i + 1 < columns; ++i) {
        const std::uint32_t a = j * columns + i, b = a + 1, c = b + columns, d = a + columns;
        mesh_.indices.insert(mesh_.indices.end(), {a, b, c, a, c, d});
      }
  }
};

}  // namespace pbrt

PBRT_PLUGIN(Shape, pbrt::HeightField, "heightfield", "a landscape of heights over a square")
