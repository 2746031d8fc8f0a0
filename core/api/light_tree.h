#pragma once
// Choosing one of many lights by what each may send to a point, in the logarithm of their number:
// Conty Estevez and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree Splitting".

#include <span>

#include "core/api/light.h"
#include "core/base/distribution.h"

namespace pbrt {

// A binary tree with one finite light a leaf. At a node the chances of its two halves go by an
// estimate of the light that they could send if nothing were in between. The lights that are
// infinitely far stand beside the tree.
class LightTree {
 public:
  struct Chosen {
    std::uint32_t light = 0;  // its number
    double rest = 0;          // what is left of u: uniform in [0, 1)
    double chance = 0;
  };

  LightTree() = default;  // of no lights
  explicit LightTree(std::span<const Light* const> lights);

  // Of no lights, or black ones alone.
  bool empty() const { return nodes_.empty() && infinite_.empty(); }

  // For the point p, with light from the side of the unit normal n alone; n = 0: from everywhere.
  // u is in [0, 1). The tree must not be empty.
  Chosen choose(const Point3& p, const Normal3& n, double u) const;
  // The chance with which choose() takes this light.
  double chance(const Point3& p, const Normal3& n, std::uint32_t light) const;

 private:
  static constexpr std::uint32_t kNone = ~0U;

  // Of the lights under it. The left child is the next node.
  struct Node {
    double intensity = 0;  // the sum
    Point3 centre{};       // of a ball about them
    float radius2 = 0;     // its radius squared
    DirectionCone normals;
    float cosEmission = 1;
    bool twoSided = false;
    std::uint32_t right = kNone;  // none: a leaf
    std::uint32_t parent = kNone;
    std::uint32_t light = 0;  // of a leaf
  };
  // Light that could arrive is weight / distance2, at most.
  struct Estimate {
    double weight = 0, distance2 = 0;
  };

  struct Leaf;
  std::uint32_t build(std::span<Leaf> leaves, std::uint32_t parent, int depth);
  static Estimate estimate(const Node& node, const Point3& p, const Normal3& n);
  double shareOfLeft(std::uint32_t node, const Point3& p, const Normal3& n) const;
  double shareOfTree(const Point3& p, const Normal3& n) const;

  std::vector<Node> nodes_;
  std::vector<std::uint32_t> infinite_;  // numbers of those lights
  Distribution2D irradiances_;           // theirs
  std::vector<std::uint32_t> places_;    // of a light: its leaf, or its column of irradiances_
};

}  // namespace pbrt
