#include "look.h"

#include "shapes/metaballs/lanes.h"

namespace pbrt {

namespace {

using metaballs::Floats;
using metaballs::kLanes;

// Three numbers in each lane.
struct Lanes3 {
  Floats x{}, y{}, z{};

  friend Lanes3 operator+(const Lanes3& a, const Lanes3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend Lanes3 operator-(const Lanes3& a, const Lanes3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend Lanes3 operator*(const Floats& s, const Lanes3& a) { return {s * a.x, s * a.y, s * a.z}; }
};

Lanes3 all(const Vec3& v) {
  return {Floats{} + v.x, Floats{} + v.y, Floats{} + v.z};
}

Floats dot(const Lanes3& a, const Lanes3& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

Lanes3 normalize(const Lanes3& v) {
  const Floats square = dot(v, v);
  Floats length;
  for (int i = 0; i < kLanes; ++i) length[i] = std::sqrt(square[i]);
  return (1 / length) * v;
}

// What comes from a direction.
Lanes3 environment(const Look& look, const Floats& upward) {
  const Floats s = 0.5F + 0.5F * upward;
  return all(look.ground) + s * all(look.sky - look.ground);
}

}  // namespace

void shade(const Look& look, const PinholeCamera& camera, int x, int y,
           std::span<const surfels::Fragment> seen, float* const out[3]) {
  constexpr float kKey = 2.2F, kShine = 2;
  // Over the beholder's left shoulder, whichever way they look.
  const Lanes3 toKey =
      all(glm::normalize(-0.5F * camera.right() + camera.up() - 0.6F * camera.forward()));
  const Lanes3 up = all(camera.up()), color = all(look.color);
  const Vec3 first = camera.direction(x, y), step = camera.direction(x + 1, y) - first;
  for (std::size_t begin = 0; begin < seen.size(); begin += kLanes) {
    const auto count = static_cast<int>(std::min<std::size_t>(kLanes, seen.size() - begin));
    Lanes3 n, d;
    Floats met{};
    for (int i = 0; i < kLanes; ++i) {
      const surfels::Fragment& f = seen[begin + std::min(i, count - 1)];
      n.x[i] = f.n.x, n.y[i] = f.n.y, n.z[i] = f.n.z;
      met[i] = f.t < kInfinity ? 1 : 0;
      const Vec3 direction = first + static_cast<float>(begin + i) * step;
      d.x[i] = direction.x, d.y[i] = direction.y, d.z[i] = direction.z;
    }
    d = normalize(d);
    const Floats cosine = metaballs::positivePart(-dot(n, d));
    // Lambert under the key light and under the sky, which the half of it above n lights evenly.
    const Floats key = kKey * metaballs::positivePart(dot(n, toKey));
    const Lanes3 fill = environment(look, dot(n, up));
    // Blinn's highlight: (n . h)^64. Schlick's mirror: 0.02 as of water, more at the rim.
    const Floats half = metaballs::positivePart(dot(n, normalize(toKey - d)));
    Floats shine = half * half;
    for (int i = 0; i < 5; ++i) shine *= shine;
    const Floats rest = 1 - cosine, rest2 = rest * rest;
    const Floats mirror = 0.02F + 0.98F * rest2 * rest2 * rest;
    const Lanes3 reflected = environment(look, dot(d, up) + 2 * cosine * dot(n, up));
    const Lanes3 background =
        look.background ? all(*look.background) : environment(look, dot(d, up));

    const auto mix = [&](const Floats& body, const Floats& sky, const Floats& image,
                         const Floats& behind) {
      const Floats skin = (1 - mirror) * body * (key + sky) + mirror * image + kShine * shine;
      return met > 0 ? skin : behind;
    };
    const Floats rgb[3] = {mix(color.x, fill.x, reflected.x, background.x),
                           mix(color.y, fill.y, reflected.y, background.y),
                           mix(color.z, fill.z, reflected.z, background.z)};
    for (int c = 0; c < 3; ++c)
      for (int i = 0; i < count; ++i) out[c][begin + i] = rgb[c][i];
  }
}

}  // namespace pbrt
