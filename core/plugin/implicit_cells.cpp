#include "core/plugin/implicit_cells.h"

#include <array>
#include <optional>

#include "core/base/error.h"
#include "core/base/parallel.h"

namespace pbrt {
namespace {

// The part of the box that may hold zeros, by the mean value form about the middle c:
//   0 = f(x) = f(c) + sum of G_j (x_j - c_j)
// with some G of the range of the gradient over the box. It is solved for each coordinate whose
// G_i excludes zero (interval Newton), and must hold in all.
std::optional<Bounds3> contracted(const ImplicitField& field, const Bounds3& box) {
  DPoint3 lo(box.lo), hi(box.hi);
  const FieldRange f = field.over(lo, hi);
  if (!f.value.contains(0)) return {};
  const DPoint3 c = 0.5 * lo + 0.5 * hi;
  const Range centre = field.over(c, c).value;
  if (centre.empty()) return box;  // no value there: nothing holds from there
  Range term[3];
  for (int i = 0; i < 3; ++i) term[i] = f.gradient[i] * (Range(lo[i], hi[i]) - c[i]);
  if (!(centre + term[0] + term[1] + term[2]).contains(0)) return {};
  for (int i = 0; i < 3; ++i) {
    const Range x = c[i] - (centre + term[(i + 1) % 3] + term[(i + 2) % 3]) / f.gradient[i];
    lo[i] = std::max(lo[i], x.lo), hi[i] = std::min(hi[i], x.hi);
    if (!(lo[i] <= hi[i])) return {};
  }
  return roundOutward(lo, hi);
}

// The halves across the longest edge; the box itself if floats between its ends are lacking.
std::vector<Bounds3> halves(const Bounds3& box) {
  const Vec3 edges = box.diagonal();
  const int axis = edges.x >= edges.y && edges.x >= edges.z ? 0 : edges.y >= edges.z ? 1 : 2;
  const float middle = box.centre()[axis];
  if (!(middle > box.lo[axis] && middle < box.hi[axis])) return {box};
  std::vector<Bounds3> both(2, box);
  both[0].hi[axis] = both[1].lo[axis] = middle;
  return both;
}

using Boxes = std::vector<Bounds3>;

// Those that `rule` makes of each, in their order.
template <class Rule>
Boxes all(const Boxes& boxes, const Rule& rule) {
  constexpr std::size_t kShare = 256;
  std::vector<Boxes> parts((boxes.size() + kShare - 1) / kShare);
  parallelFor(parts.size(), [&](std::size_t k) {
    for (std::size_t i = k * kShare; i < std::min((k + 1) * kShare, boxes.size()); ++i)
      rule(boxes[i], parts[k]);
  });
  Boxes result;
  for (const Boxes& part : parts) result.insert(result.end(), part.begin(), part.end());
  return result;
}

}  // namespace

std::vector<Bounds3> shellOf(const ImplicitField& field, std::size_t most) {
  const Bounds3 whole = field.bounds();
  if (!isFinite(whole.lo) || !isFinite(whole.hi) || whole.empty())
    throw Error("the bounds of an implicit surface are empty or not finite");
  Boxes boxes{whole};
  for (int halvings = 0; halvings < 3 * 24; ++halvings) {  // a float has 24 bits
    Boxes next = all(boxes, [&](const Bounds3& box, Boxes& out) {
      for (const Bounds3& half : halves(box))
        if (field.over(DPoint3(half.lo), DPoint3(half.hi)).value.contains(0)) out.push_back(half);
    });
    if (next.size() > most) break;
    boxes = std::move(next);
  }
  return all(boxes, [&](const Bounds3& box, Boxes& out) {
    std::optional<Bounds3> tight = contracted(field, box);
    if (tight) tight = contracted(field, *tight);
    if (tight) out.push_back(*tight);
  });
}

}  // namespace pbrt
