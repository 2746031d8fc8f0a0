#include "shapes/metaballs/surfels/draw.h"

#include "core/base/parallel.h"
#include "shapes/metaballs/loops.h"

namespace pbrt::surfels {

inline namespace portable {
extern const DrawLoops kDrawLoops;
}
#ifdef PBRT_X86
namespace avx2 {
extern const DrawLoops kDrawLoops;
}
namespace avx512 {
extern const DrawLoops kDrawLoops;
}
#endif

std::span<const DrawLoops* const> allDrawLoops() {
  static constexpr const DrawLoops* all[] = {&portable::kDrawLoops,
#ifdef PBRT_X86
                                             &avx2::kDrawLoops, &avx512::kDrawLoops
#endif
  };
  return std::span(all).first(metaballs::allLoops().size());
}

namespace {

constexpr std::size_t kChildren = 4 * kLanes;  // of a ball
constexpr std::size_t kChunk = 1024;           // discs that a thread makes at a time

std::size_t packs(std::size_t count) {
  return (count + kLanes - 1) / kLanes;
}

struct Ball {
  Point3 p{};
  float radius = -kInfinity;
  Normal3 n{};
  float turn = 0;
};
Ball get(std::span<const Balls> balls, std::size_t i) {
  const Balls& b = balls[i / kLanes];
  const std::size_t k = i % kLanes;
  return {{b.x[k], b.y[k], b.z[k]}, b.radius[k], {b.nx[k], b.ny[k], b.nz[k]}, b.turn[k]};
}
void put(std::span<Balls> balls, std::size_t i, const Ball& ball) {
  Balls& b = balls[i / kLanes];
  const std::size_t k = i % kLanes;
  b.x[k] = ball.p.x, b.y[k] = ball.p.y, b.z[k] = ball.p.z, b.radius[k] = ball.radius;
  b.nx[k] = ball.n.x, b.ny[k] = ball.n.y, b.nz[k] = ball.n.z, b.turn[k] = ball.turn;
}

// Bounds are widened by what their own arithmetic may have rounded.
constexpr float kWider = 1 + 16 * std::numeric_limits<float>::epsilon();

// The disc of a surfel, and the ball about it; one without radius if it is not to be drawn.
Ball make(const Surfel& surfel, const DPoint3& origin, Disc& disc) {
  disc = {};
  float turn2 = 0;
  for (int i = 0; i < 6; ++i) turn2 += (i < 3 ? 1.F : 2.F) * sqr(surfel.bend[i]);
  const Point3 p(surfel.p - origin);
  const float radius = surfel.radius, inverse2 = 1 / sqr(radius);
  const float turn = std::sqrt(turn2) * radius;  // the Frobenius norm bounds |B u|
  if (!isFinite(p) || !isFinite(surfel.n) || !(radius > 0) || !std::isnormal(inverse2) ||
      !std::isfinite(turn))
    return {};
  disc.p = p;
  disc.n = surfel.n;
  std::copy_n(surfel.bend, 6, disc.bend);
  // Short of the radius, so that where a ray meets the disc it has weight in spite of rounding.
  disc.rim2 = 0.999F * sqr(radius);
  disc.inverse2 = inverse2;
  return {p, radius, surfel.n, kWider * turn};
}

Ball around(std::span<const Balls> balls, std::size_t first) {
  Bounds3 box;
  Normal3 sum(0);
  const std::size_t end = std::min(first + kChildren, balls.size() * kLanes);
  const auto each = [&](auto&& body) {
    for (std::size_t i = first; i < end; ++i)
      if (const Ball ball = get(balls, i); ball.radius > 0) body(ball);
  };
  each([&](const Ball& ball) { box.add(ball.p), sum += ball.n; });
  if (box.empty()) return {};
  const float length = glm::length(sum);
  Ball all{box.centre(), 0, length > 0 ? sum / length : Normal3(0), 0};
  each([&](const Ball& ball) {
    all.radius = std::max(all.radius, kWider * (glm::distance(all.p, ball.p) + ball.radius));
    all.turn = std::max(all.turn, kWider * (glm::distance(all.n, ball.n) + ball.turn));
  });
  return all;
}

}  // namespace

void Discs::set(std::span<const Surfel> surfels, const DPoint3& origin) {
  discs_.resize(surfels.size());
  std::size_t depth = 1;
  for (std::size_t n = surfels.size(); n > kChildren; n = (n + kChildren - 1) / kChildren) ++depth;
  levels_.resize(depth);
  levels_[0].assign(packs(surfels.size()), {});
  parallelFor((surfels.size() + kChunk - 1) / kChunk, [&](std::size_t chunk) {
    const std::size_t end = std::min(surfels.size(), (chunk + 1) * kChunk);
    for (std::size_t i = chunk * kChunk; i < end; ++i)
      put(levels_[0], i, make(surfels[i], origin, discs_[i]));
  });
  for (std::size_t level = 1; level < depth; ++level) {
    const std::span<const Balls> below = levels_[level - 1];
    const std::size_t count = (below.size() * kLanes + kChildren - 1) / kChildren;
    levels_[level].assign(packs(count), {});
    parallelFor((count + 63) / 64, [&](std::size_t chunk) {
      const std::size_t end = std::min(count, (chunk + 1) * 64);
      for (std::size_t i = chunk * 64; i < end; ++i)
        put(levels_[level], i, around(below, i * kChildren));
    });
  }
}

namespace {

// What a thread draws with; it only ever grows.
struct Workspace {
  std::vector<std::uint32_t> found, met, listed, near;
  std::vector<Balls> balls;  // of those that were met

  template <class T>
  static T* room(std::vector<T>& v, std::size_t count) {
    if (v.size() < count) v.resize(count);
    return v.data();
  }
};

}  // namespace

void Discs::draw(const Beam& beam, std::span<Fragment> out) const {
  std::fill(out.begin(), out.end(), Fragment{});
  if (discs_.empty()) return;
  const DrawLoops& loops = *allDrawLoops().back();
  thread_local Workspace w;

  // Discs that the beam may meet: down from the coarsest level.
  std::size_t met = loops.narrow(beam.bound_, levels_.back(),
                                 Workspace::room(w.met, levels_.back().size() * kLanes));
  for (std::size_t level = levels_.size() - 1; level-- > 0;) {
    const std::span<const Balls> balls = levels_[level];
    std::size_t count = 0;
    Workspace::room(w.found, met * kChildren);
    for (std::size_t i = 0; i < met; ++i) {
      const std::size_t first = w.met[i] * (kChildren / kLanes);
      const std::size_t n = std::min(kChildren / kLanes, balls.size() - first);
      const std::size_t more =
          loops.narrow(beam.bound_, balls.subspan(first, n), w.found.data() + count);
      for (std::size_t k = 0; k < more; ++k)
        w.found[count + k] += static_cast<std::uint32_t>(first * kLanes);
      count += more;
    }
    std::swap(w.found, w.met);
    met = count;
  }
  if (met == 0) return;
  const std::size_t full = packs(met);
  Workspace::room(w.balls, full);
  for (std::size_t i = 0; i < full * kLanes; ++i)
    put(w.balls, i, i < met ? get(levels_[0], w.met[i]) : Ball{});
  Workspace::room(w.listed, met);
  Workspace::room(w.near, met);

  for (const Beam::Patch& patch : beam.patches_) {
    const std::size_t listed =
        loops.narrow(patch.bound, std::span(w.balls).first(full), w.listed.data());
    if (listed == 0) continue;
    for (std::size_t i = 0; i < listed; ++i) w.listed[i] = w.met[w.listed[i]];
    for (int packet = 0; packet < 4; ++packet) {
      Seen seen;
      loops.look(patch.rays[packet], discs_.data(), {w.listed.data(), listed}, w.near.data(), seen);
      for (int lane = 0; lane < kLanes; ++lane) {
        if (!(seen.t[lane] < kInfinity)) continue;
        out[patch.pixels[packet][lane]] = {
            seen.t[lane] * patch.scale[packet][lane],
            glm::normalize(Normal3(seen.nx[lane], seen.ny[lane], seen.nz[lane])),
            seen.surfel[lane]};
      }
    }
  }
}

}  // namespace pbrt::surfels
