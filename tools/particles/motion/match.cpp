#include "tools/particles/motion/match.h"

#include <algorithm>
#include <bit>

#include "core/base/rng.h"

namespace pbrt::motion {
namespace {

// The sum of the squared distances from the mean of `count` vectors.
template <class At>
double spread(std::size_t count, At&& at) {
  DVec3 mean(0);
  for (std::size_t i = 0; i < count; ++i) mean += at(i) / static_cast<double>(count);
  double sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += lengthSquared(at(i) - mean);
  return sum;
}

// Places in no order are, squared, twice as far from each other as from their mean. What moves
// together hardly comes to an eighth of that from one frame to the next.
bool sameOrder(const std::vector<Point3>& from, const std::vector<Point3>& to) {
  const std::size_t n = std::min(from.size(), to.size());
  return spread(n, [&](std::size_t i) { return DVec3(to[i]) - DVec3(from[i]); }) <=
         0.25 * spread(n, [&](std::size_t i) { return DVec3(from[i]); });
}

// Finds what is nearest, within the edge of a cell.
class Nearest {
 public:
  Nearest(const std::vector<Point3>& points, float edge) : points_(points), edge_(edge) {
    for (std::uint32_t i = 0; i < points.size(); ++i) entries_.push_back({key(cell(points[i])), i});
    std::ranges::sort(entries_);
  }

  std::optional<Vec3> from(const Point3& p) const {
    std::optional<Vec3> best;
    float nearest = sqr(edge_);
    for (int k = 0; k < 27; ++k) {
      const std::uint64_t sought = key(cell(p) + glm::dvec3(k % 3 - 1, k / 3 % 3 - 1, k / 9 - 1));
      auto entry = std::ranges::lower_bound(entries_, Entry{sought, 0});
      // Where particles lie on top of each other one of them is as good as another.
      constexpr int most = 64;
      for (int n = 0; n < most && entry != entries_.end() && entry->key == sought; ++n, ++entry) {
        const Vec3 d = points_[entry->number] - p;
        if (lengthSquared(d) >= nearest) continue;
        nearest = lengthSquared(d);
        best = d;
      }
    }
    return best;
  }

 private:
  struct Entry {
    std::uint64_t key = 0;
    std::uint32_t number = 0;
    auto operator<=>(const Entry&) const = default;
  };

  DVec3 cell(const Point3& p) const { return glm::floor(DVec3(p) / double{edge_}); }
  // Cells may share a key: their points are then looked at in vain.
  static std::uint64_t key(const DVec3& cell) {
    const auto bits = [](double x) { return std::bit_cast<std::uint64_t>(x + 0.); };
    return hash(bits(cell.x), bits(cell.y), bits(cell.z));
  }

  const std::vector<Point3>& points_;
  float edge_;
  std::vector<Entry> entries_;
};

}  // namespace

std::vector<std::optional<Vec3>> shifts(const std::vector<Point3>& from,
                                        const std::vector<Point3>& to, bool toIsLater,
                                        float furthest, float near) {
  const bool grows = toIsLater ? to.size() > from.size() : from.size() > to.size();
  const bool ordered = (grows || from.size() == to.size()) && sameOrder(from, to);
  std::vector<std::optional<Vec3>> shifts(from.size());
  std::optional<Nearest> nearest;
  for (std::size_t i = 0; i < from.size(); ++i) {
    if (ordered && i < to.size() && lengthSquared(to[i] - from[i]) <= sqr(furthest)) {
      shifts[i] = to[i] - from[i];
    } else if (near > 0) {
      if (!nearest) nearest.emplace(to, near);
      shifts[i] = nearest->from(from[i]);
    }
  }
  return shifts;
}

}  // namespace pbrt::motion
