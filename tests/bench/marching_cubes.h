#pragma once
// Metaballs as triangles, the way meshers make them: marching cubes (Lorensen and Cline 1987) of
// the field on a lattice, vertices where the linear interpolant along a lattice edge is zero,
// normals from the field's gradient there. Sparse: space is halved top-down, and what Field::bound
// clears is not visited.

#include <array>
#include <bit>
#include <numeric>
#include <utility>

#include "core/api/shape.h"
#include "shapes/metaballs/field.h"

namespace pbrt::metaballs::bench {

// The surface within a cube, for each of the 256 sets of corners that may be inside. Corner i lies
// at (i & 1, i >> 1 & 1, i >> 2 & 1); edge 4 a + k runs along axis a from the corner whose bits on
// axes a + 1 and a + 2 are k. On each face a segment joins the two ends of every run of inside
// corners, so that runs stay apart: neighbours agree on a face of two runs, and no hole opens.
// Seen from outside the cube all faces turn the same way. An edge is left by one of its two faces
// and entered by the other, which makes the segments closed loops about the outward normal.
class CubeLoops {
 public:
  constexpr CubeLoops() {
    for (int inside = 0; inside < 256; ++inside) {
      next_[inside].fill(-1);
      for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side < 2; ++side) addFace(inside, axis, side);
    }
  }

  // The crossed edge after `edge` on its loop; -1 if `edge` is not crossed.
  constexpr const std::array<std::int8_t, 12>& next(int inside) const { return next_[inside]; }
  // The corner where an edge starts.
  static constexpr int start(int edge) {
    const int axis = edge / 4;
    return (edge & 1) << (axis + 1) % 3 | (edge >> 1 & 1) << (axis + 2) % 3;
  }

 private:
  static constexpr int edge(int from, int to) {
    const int axis = std::countr_zero(static_cast<unsigned>(from ^ to)), low = from & to;
    return 4 * axis + (low >> (axis + 1) % 3 & 1) + 2 * (low >> (axis + 2) % 3 & 1);
  }
  constexpr void addFace(int inside, int axis, int side) {
    const int b = 1 << (axis + 1) % 3, c = 1 << (axis + 2) % 3, s = side << axis;
    const std::array<int, 4> corner =
        side ? std::array{s, s | b, s | b | c, s | c} : std::array{s, s | c, s | b | c, s | b};
    const auto isInside = [&](int i) { return (inside >> corner[i & 3] & 1) != 0; };
    for (int last = 4; last < 8; ++last) {
      if (!isInside(last) || isInside(last + 1)) continue;
      int before = last - 1;
      while (isInside(before)) --before;
      next_[inside][edge(corner[before & 3], corner[(before + 1) & 3])] =
          static_cast<std::int8_t>(edge(corner[last & 3], corner[(last + 1) & 3]));
    }
  }

  std::array<std::array<std::int8_t, 12>, 256> next_{};
};

inline constexpr CubeLoops kCubeLoops;

// For the kernel wyvill, whose (1 - q)^3 a compiler can vectorise over a row of the lattice.
// Lattice points that blocks share have bitwise equal values in both, hence the mesh has no cracks;
// vertices on a block's faces are stored once for each block.
class Mesher {
 public:
  // voxel: the lattice's spacing.
  Mesher(const Field& field, double voxel) : field_(field), voxel_(voxel) {}

  TriangleMesh mesh();

 private:
  static constexpr int kPoints = 8, kVoxels = kPoints - 1;  // of a block, along an axis
  static constexpr std::array<int, 3> kStride{1, kPoints, kPoints* kPoints};
  static constexpr std::uint32_t kNoVertex = ~0U;

  DPoint3 place(const glm::ivec3& point) const { return origin_ + voxel_ * DVec3(point); }
  void split(const glm::ivec3& block, int side, AtomList parents);
  void sample(const glm::ivec3& first, int step, AtomList list);
  bool keepsOff() const;
  void march(const glm::ivec3& first, AtomList list);
  std::uint32_t vertex(const glm::ivec3& first, int point, int axis, AtomList list);

  const Field& field_;
  double voxel_;
  double smallest_ = 0;  // support radius
  DPoint3 origin_{};
  std::array<float, kPoints * kPoints * kPoints> value_;                          // f + 1
  std::array<std::array<std::uint32_t, 3>, kPoints * kPoints * kPoints> vertex_;  // by edge
  TriangleMesh mesh_;
};

inline TriangleMesh Mesher::mesh() {
  Bounds3 box;
  smallest_ = kInfinity;
  for (const Atom& atom : field_.atoms()) {
    box.add(Bounds3{atom.centre - static_cast<float>(atom.radius),
                    atom.centre + static_cast<float>(atom.radius)});
    smallest_ = std::min<double>(smallest_, atom.radius);
  }
  origin_ = box.lo;
  const Vec3 size = box.diagonal();
  const double blocks = std::max({size.x, size.y, size.z}) / (kVoxels * voxel_);
  std::vector<std::uint32_t> all(field_.atoms().size());
  std::iota(all.begin(), all.end(), 0U);
  split({0, 0, 0}, static_cast<int>(std::bit_ceil(static_cast<unsigned>(blocks) + 1)), all);
  return std::move(mesh_);
}

// Atoms keep their order in every list: sums over them round alike in neighbouring blocks.
inline void Mesher::split(const glm::ivec3& block, int side, AtomList parents) {
  const DPoint3 lo = place(kVoxels * block), hi = place(kVoxels * (block + side));
  std::vector<std::uint32_t> list;
  for (const std::uint32_t j : parents) {
    const Atom& atom = field_.atoms()[j];
    const DPoint3 c(atom.centre);
    const DVec3 apart = glm::max(DVec3(0), glm::max(lo - c, c - hi));
    if (lengthSquared(apart) < sqr(static_cast<double>(atom.radius))) list.push_back(j);
  }
  if (list.empty()) return;
  if (side == 1) {
    sample(kVoxels * block, 1, list);
    return march(kVoxels * block, list);
  }
  // In a larger box the samples would be too far apart to tell.
  if (hi.x - lo.x < smallest_) {
    sample(kVoxels * block, side, list);
    if (keepsOff()) return;
  }
  for (int i = 0; i < 8; ++i)
    split(block + side / 2 * glm::ivec3(i & 1, i >> 1 & 1, i >> 2), side / 2, list);
}

// The field at kPoints points along each axis, `step` voxels apart.
inline void Mesher::sample(const glm::ivec3& first, int step, AtomList list) {
  double at[3][kPoints];
  for (int i = 0; i < kPoints; ++i)
    for (int axis = 0; axis < 3; ++axis) at[axis][i] = place(first + step * i)[axis];
  value_.fill(0);
  for (const std::uint32_t j : list) {
    const Atom& atom = field_.atoms()[j];
    const double inverse = 1.0 / atom.radius;
    float q[3][kPoints];
    for (int axis = 0; axis < 3; ++axis)
      for (int i = 0; i < kPoints; ++i)
        q[axis][i] = static_cast<float>(sqr((at[axis][i] - atom.centre[axis]) * inverse));
    const auto weight = static_cast<float>(atom.weight);
    for (int z = 0; z < kPoints; ++z)
      for (int y = 0; y < kPoints; ++y) {
        const float rest = 1 - (q[2][z] + q[1][y]);
        if (rest <= 0) continue;
        float* row = &value_[z * kStride[2] + y * kStride[1]];
#pragma GCC unroll 1  // vectors, not eight branches
        for (int x = 0; x < kPoints; ++x) {
          const float a = std::max(0.F, rest - q[0][x]);
          row[x] += weight * (a * a * a);
        }
      }
  }
}

// Whether no sample is so near the surface that half a step along each axis might lead there, at
// the steepest slope between neighbouring samples.
inline bool Mesher::keepsOff() const {
  float nearest = std::numeric_limits<float>::infinity(), steepest = 0;
  for (int i = 0; i < static_cast<int>(value_.size()); ++i) {
    nearest = std::min(nearest, std::abs(value_[i] - 1));
    for (int axis = 0; axis < 3; ++axis)
      if (i / kStride[axis] % kPoints != 0)
        steepest = std::max(steepest, std::abs(value_[i] - value_[i - kStride[axis]]));
  }
  return nearest > 1.5F * steepest;
}

inline void Mesher::march(const glm::ivec3& first, AtomList list) {
  vertex_.fill({kNoVertex, kNoVertex, kNoVertex});
  for (int z = 0; z < kVoxels; ++z)
    for (int y = 0; y < kVoxels; ++y)
      for (int x = 0; x < kVoxels; ++x) {
        const int corner = x + y * kStride[1] + z * kStride[2];
        const auto offset = [](int i) {
          return (i & 1) + (i >> 1 & 1) * kStride[1] + (i >> 2) * kStride[2];
        };
        int inside = 0;
        for (int i = 0; i < 8; ++i) inside |= int{value_[corner + offset(i)] > 1} << i;
        if (inside == 0 || inside == 255) continue;
        std::array<std::int8_t, 12> next = kCubeLoops.next(inside);
        for (int edge = 0; edge < 12; ++edge) {
          // Walks the loop of this edge, a fan of triangles about it, and takes it away.
          std::array<std::uint32_t, 3> triangle{};
          for (int e = edge, n = 0; next[e] >= 0; ++n) {
            triangle[std::min(n, 2)] =
                vertex(first, corner + offset(CubeLoops::start(e)), e / 4, list);
            if (n >= 2) {
              mesh_.indices.insert(mesh_.indices.end(), triangle.begin(), triangle.end());
              triangle[1] = triangle[2];
            }
            e = std::exchange(next[e], std::int8_t{-1});
          }
        }
      }
}

// The vertex on the lattice edge from a point of the block along an axis.
inline std::uint32_t Mesher::vertex(const glm::ivec3& first, int point, int axis, AtomList list) {
  std::uint32_t& index = vertex_[point][axis];
  if (index != kNoVertex) return index;
  const double a = value_[point] - 1.0, b = value_[point + kStride[axis]] - 1.0;
  DPoint3 p = place(first + glm::ivec3(point, point / kStride[1], point / kStride[2]) % kPoints);
  p[axis] += voxel_ * a / (a - b);
  // -grad f is along the sum of w / h^2 (1 - q)^2 (p - centre).
  DVec3 n(0);
  for (const std::uint32_t j : list) {
    const Atom& atom = field_.atoms()[j];
    const DVec3 r = p - DPoint3(atom.centre);
    const double h2 = sqr(static_cast<double>(atom.radius)), rest = h2 - lengthSquared(r);
    if (rest > 0) n += atom.weight / (h2 * h2 * h2) * sqr(rest) * r;
  }
  index = static_cast<std::uint32_t>(mesh_.positions.size());
  mesh_.positions.emplace_back(p);
  mesh_.normals.emplace_back(glm::normalize(n));
  return index;
}

}  // namespace pbrt::metaballs::bench
