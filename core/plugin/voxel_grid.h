#pragma once
// Media whose density is told voxel by voxel.

#include <algorithm>
#include <vector>

#include "core/api/medium.h"

namespace pbrt {

// Samples in the middle of the voxels of the unit cube, trilinearly interpolated; x goes fastest.
// T is float or Spectrum.
template <class T>
class VoxelGrid {
 public:
  VoxelGrid() = default;
  // Beyond the outermost samples the value stays (pbrt-v1), or fades to 0 half a voxel outside the
  // cube (v3, v4).
  VoxelGrid(const glm::ivec3& n, std::vector<T> values, bool fades)
      : n_(n), values_(std::move(values)), fades_(fades) {}

  bool empty() const { return values_.empty(); }

  // u in [0, 1]^3.
  T operator()(const DVec3& u) const {
    const DVec3 at = u * DVec3(n_) - 0.5;
    const glm::ivec3 i(glm::floor(at));
    const Vec3 f(at - DVec3(i));
    const auto alongX = [&](int y, int z) {
      return mix(value({i.x, y, z}), value({i.x + 1, y, z}), f.x);
    };
    const auto alongY = [&](int z) { return mix(alongX(i.y, z), alongX(i.y + 1, z), f.y); };
    return mix(alongY(i.z), alongY(i.z + 1), f.z);
  }

  // The least and the greatest value, in each channel, over cell c of `cells` in each direction.
  std::pair<T, T> range(const glm::ivec3& c, const glm::ivec3& cells) const {
    const auto inVoxels = [&](int axis, int face) {
      return static_cast<double>(face) * n_[axis] / cells[axis] - 0.5;
    };
    glm::ivec3 lo, hi;
    for (int k = 0; k < 3; ++k) {
      lo[k] = static_cast<int>(std::floor(inVoxels(k, c[k])));
      hi[k] = static_cast<int>(std::ceil(inVoxels(k, c[k] + 1)));
    }
    std::pair<T, T> range{value(lo), value(lo)};
    for (int z = lo.z; z <= hi.z; ++z)
      for (int y = lo.y; y <= hi.y; ++y)
        for (int x = lo.x; x <= hi.x; ++x) {
          range.first = glm::min(range.first, value({x, y, z}));
          range.second = glm::max(range.second, value({x, y, z}));
        }
    return range;
  }

 private:
  static T mix(const T& a, const T& b, float t) { return a * (1 - t) + b * t; }

  T value(const glm::ivec3& i) const {
    const glm::ivec3 in = glm::clamp(i, glm::ivec3(0), n_ - 1);
    if (fades_ && in != i) return T(0);
    return values_[(static_cast<std::size_t>(in.z) * n_.y + in.y) * n_.x + in.x];
  }

  glm::ivec3 n_{0};
  std::vector<T> values_;
  bool fades_ = false;
};

// How many cells of bounds a medium of so many voxels has. Half a voxel each, if there are few:
// then samples, where slopes change, are at their corners.
inline glm::ivec3 boundingCells(const glm::ivec3& voxels) {
  return glm::min(2 * voxels, glm::ivec3(16));
}

// Those cells, of a medium that has the extinction sigma where the density is 1. Where it is
// uniform `others` have to be so, too; they may be empty.
inline std::vector<Medium::Cell> boundsOf(
    const VoxelGrid<float>& density, const glm::ivec3& cells, const Spectrum& sigma,
    std::initializer_list<const VoxelGrid<float>*> others = {}) {
  std::vector<Medium::Cell> bounds;
  for (int z = 0; z < cells.z; ++z)
    for (int y = 0; y < cells.y; ++y)
      for (int x = 0; x < cells.x; ++x) {
        const auto [least, greatest] = density.range({x, y, z}, cells);
        const bool uniform = std::ranges::all_of(others, [&](const VoxelGrid<float>* grid) {
          if (grid->empty()) return true;
          const auto [lo, hi] = grid->range({x, y, z}, cells);
          return lo == hi;
        });
        bounds.push_back({greatest * sigma, uniform && least == greatest});
      }
  return bounds;
}

}  // namespace pbrt
