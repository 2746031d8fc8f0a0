#pragma once
// Discs to be drawn, cameras that look at them, and what their rays see in double precision, found
// by looking at every disc.

#include <functional>

#include "core/base/rng.h"
#include "shapes/metaballs/surfels/draw.h"

namespace pbrt::surfels::test {

class Random {
 public:
  explicit Random(std::uint64_t seed) : rng_(seed) {}
  double in(double lo, double hi) { return lo + (hi - lo) * static_cast<double>(rng_.uniform()); }
  std::size_t below(std::size_t n) { return rng_.uniform(static_cast<std::uint32_t>(n)); }
  DVec3 cube() {
    const double x = in(-1, 1), y = in(-1, 1);
    return {x, y, in(-1, 1)};
  }
  DVec3 direction() {
    for (;;)
      if (const DVec3 v = cube(); lengthSquared(v) > 0.01 && lengthSquared(v) < 1)
        return glm::normalize(v);
  }

 private:
  Rng rng_;
};

inline void setBend(Surfel& surfel, const glm::dmat3& b) {
  const double all[] = {b[0][0], b[1][1], b[2][2], b[0][1], b[0][2], b[1][2]};
  for (int i = 0; i < 6; ++i) surfel.bend[i] = static_cast<float>(all[i]);
}

// With which n discs on a Fibonacci lattice cover a unit ball. A hexagonal lattice of cells of area
// A = 4 pi / n covers with r^2 = 2 A / (3 sqrt(3)); the other needs up to half as much again in r.
inline double coveringRadius(std::size_t n) {
  return 1.5 * std::sqrt(8 * std::numbers::pi / (3 * std::sqrt(3) * static_cast<double>(n)));
}

// A ball covered by n discs.
inline std::vector<Surfel> ball(std::size_t n, const DPoint3& centre = {}, double radius = 1,
                                bool bent = true) {
  std::vector<Surfel> surfels(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double phi = static_cast<double>(i) * std::numbers::pi * (3 - std::sqrt(5));
    const double rho = std::sqrt(1 - z * z);
    const DVec3 m{rho * std::cos(phi), rho * std::sin(phi), z};
    Surfel& s = surfels[i];
    s.p = centre + radius * m;
    s.n = Normal3(m);
    s.radius = static_cast<float>(radius * coveringRadius(n));
    if (bent) setBend(s, (glm::dmat3(1) - glm::outerProduct(m, m)) / radius);
  }
  return surfels;
}

// Discs anywhere in a cube, of any direction, radius and bend.
inline std::vector<Surfel> confetti(std::size_t n, std::uint64_t seed) {
  Random random(seed);
  std::vector<Surfel> surfels(n);
  for (Surfel& s : surfels) {
    const DVec3 m = random.direction(), e = glm::normalize(glm::cross(m, random.direction()));
    const DVec3 f = glm::cross(m, e);
    s.p = random.cube();
    s.n = Normal3(m);
    s.radius = static_cast<float>(std::pow(10, random.in(-2, -0.7)));
    const double limit = 0.7 / static_cast<double>(s.radius);
    setBend(s, random.in(-limit, limit) * glm::outerProduct(e, e) +
                   random.in(-limit, limit) * glm::outerProduct(f, f));
  }
  return surfels;
}

// What a ray sees, in double.
struct Sight {
  double t = std::numeric_limits<double>::infinity();
  DVec3 n{};
  std::size_t surfel = 0;
  double lead = 0;      // by how much the surfel's weight exceeds the next, of all weights
  double radius = 0;    // of the surfel
  bool certain = true;  // rounding does not change which discs are met
};

inline Sight see(const Ray& ray, std::span<const Surfel> surfels, const DPoint3& origin) {
  const double length = glm::length(DVec3(ray.d));
  const DVec3 d = DVec3(ray.d) / length;
  const DPoint3 o(ray.o);
  const double tMin = ray.tMin * length, tMax = ray.tMax * length;
  struct Quadric {
    DPoint3 p;
    DVec3 n;
    glm::dmat3 b;
    double value(const DPoint3& x) const {
      return glm::dot(n, x - p) + glm::dot(x - p, b * (x - p)) / 2;
    }
    DVec3 gradient(const DPoint3& x) const { return n + b * (x - p); }
  };
  const auto quadric = [&](const Surfel& s) {
    const auto& [xx, yy, zz, xy, xz, yz] = s.bend;
    return Quadric{s.p - origin, s.n, {xx, xy, xz, xy, yy, yz, xz, yz, zz}};
  };
  Sight sight;
  double nearest = sight.t, nearestDoubt = sight.t;
  for (const Surfel& s : surfels) {
    if (!(s.radius > 0)) continue;
    const Quadric q = quadric(s);
    const double middle = glm::dot(q.p - o, d), r2 = 0.999 * sqr(static_cast<double>(s.radius));
    const DPoint3 x = o + middle * d;
    const double doubt = 0.01;
    if (lengthSquared(x - q.p) > r2 * (1 + doubt)) continue;
    const double a = glm::dot(d, q.b * d) / 2, b = glm::dot(d, q.gradient(x)), c = q.value(x);
    const double discriminant = b * b - 4 * a * c;
    if (discriminant < -doubt) continue;
    const double root = std::sqrt(std::max(discriminant, 0.0));
    // From the front: the slope 2 a s + b is -root.
    const double step = std::abs(a) * static_cast<double>(s.radius) > 1e-9 ? (-b - root) / (2 * a)
                        : b < 0                                            ? -c / b
                                                                           : 1e300;
    const double t = middle + step;
    const double outside = (lengthSquared(x - q.p) + step * step) / r2 - 1;
    const double past = std::max(tMin - t, t - tMax) / static_cast<double>(s.radius);
    const double worst = std::max({outside, past, 1e-5 - discriminant});
    const bool steep = std::abs(outside) < doubt || std::abs(past) < doubt;
    if (std::max(outside, past) < doubt && (steep || discriminant < doubt))
      nearestDoubt = std::min(nearestDoubt, t - static_cast<double>(s.radius));
    if (worst < 0) nearest = std::min(nearest, t);
  }
  sight.certain = nearestDoubt > nearest || (nearestDoubt == nearest && std::isinf(nearest));
  if (!std::isfinite(nearest)) return sight;

  const DPoint3 x = o + nearest * d;
  double weights = 0, values = 0, most = 0, next = 0;
  DVec3 sum(0);
  for (std::size_t i = 0; i < surfels.size(); ++i) {
    const Surfel& s = surfels[i];
    if (!(s.radius > 0)) continue;
    const Quadric q = quadric(s);
    const double f = q.value(x), r2 = sqr(static_cast<double>(s.radius));
    const double inside = 1 - (lengthSquared(x - q.p) + 3 * f * f) / r2;
    const double slope = glm::dot(q.gradient(x), d);
    if (inside > -0.02 && std::abs(slope) < 1e-3) sight.certain = false;
    if (inside <= 0 || slope >= 0) continue;
    const double weight = inside * inside;
    weights += weight, values += weight * f, sum += weight * q.gradient(x);
    next = std::max(next, std::min(weight, most));
    if (weight > most) most = weight, sight.surfel = i, sight.radius = s.radius;
  }
  if (weights < 1e-5) sight.certain = false;
  const double step = values / std::max(-glm::dot(sum, d), 0.1 * weights);
  sight.t = std::clamp(nearest + step, tMin, tMax) / length;
  sight.n = glm::normalize(sum);
  sight.lead = (most - next) / weights;
  return sight;
}

// A picture's rays; a point of it has coordinates from -1 to 1.
using Camera = std::function<Ray(double x, double y, Random&)>;

inline Camera pinhole(const DPoint3& eye, double zoom = 1) {
  return [=](double x, double y, Random& random) {
    const DVec3 w = glm::normalize(-eye), u = glm::normalize(glm::cross(w, DVec3(0.1, 1, 0.2)));
    const DVec3 d = w + (x * u + y * glm::cross(u, w)) / zoom;
    return Ray{Point3(eye), 0, Vec3(random.in(0.1, 10) * d)};
  };
}
inline Camera parallel(double half) {
  return [=](double x, double y, Random&) {
    return Ray{Point3(half * x, half * y, 3), 0, {0, 0, -1}};
  };
}
// All directions.
inline Camera surroundings(const DPoint3& eye) {
  return [=](double x, double y, Random&) {
    const double phi = std::numbers::pi * x, theta = std::numbers::pi * (0.5 + 0.5 * y);
    return Ray{
        Point3(eye), 0,
        Vec3(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi))};
  };
}
// In focus at the distance of 3.
inline Camera lens(double radius) {
  return [=](double x, double y, Random& random) {
    const DPoint3 from = DPoint3(radius * random.in(-1, 1), radius * random.in(-1, 1), 3);
    return Ray{Point3(from), 0, Vec3(DPoint3(1.2 * x, 1.2 * y, 0) - from)};
  };
}
// Rays that have nothing to do with one another.
inline Camera any() {
  return [](double, double, Random& random) {
    const double start = random.in(-0.5, 0.5);
    return Ray{Point3(1.5 * random.cube()), static_cast<float>(start), Vec3(random.direction()),
               static_cast<float>(start + random.in(0, 3))};
  };
}

struct Picture {
  std::vector<Ray> rays;
  std::vector<Fragment> seen;
};

// The picture drawn in blocks of `block` pixels a side.
inline Picture draw(const Discs& discs, const Camera& camera, int width, int height, int block,
                    std::uint64_t seed = 1) {
  Random random(seed);
  Picture picture;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      picture.rays.push_back(camera((2 * x + 1.0) / width - 1, (2 * y + 1.0) / height - 1, random));
  picture.seen.resize(picture.rays.size());
  for (int top = 0; top < height; top += block)
    for (int left = 0; left < width; left += block) {
      const int w = std::min(block, width - left), h = std::min(block, height - top);
      std::vector<Ray> rays;
      const auto pixel = [&](int i) {
        return static_cast<std::size_t>((top + i / w) * width + left + i % w);
      };
      for (int i = 0; i < w * h; ++i) rays.push_back(picture.rays[pixel(i)]);
      std::vector<Fragment> seen(rays.size());
      discs.draw(Beam(rays, w), seen);
      for (int i = 0; i < w * h; ++i) picture.seen[pixel(i)] = seen[static_cast<std::size_t>(i)];
    }
  return picture;
}

// What one ray sees.
inline Fragment seenBy(const Ray& ray, std::span<const Surfel> surfels) {
  Fragment f;
  Discs(surfels, {}).draw(Beam({&ray, 1}, 1), {&f, 1});
  return f;
}

}  // namespace pbrt::surfels::test
