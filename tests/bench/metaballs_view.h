#pragma once
// Sets of atoms, and the rays of a camera that sees them.

#include <string>

#include "core/scene/accel.h"
#include "tests/bench/cell_shape.h"
#include "tests/shapes/metaballs/clouds.h"

namespace pbrt::metaballs::bench {

// Atoms of one support radius h and the kernel wyvill.
struct Set {
  std::string name;
  Field field;
  double h = 1;
};

// Atoms of radius 1 in a ball, about 12 supports over every interior point; the surface of a lone
// atom is where its field falls to a half.
inline Set ball(int count) {
  Rng rng(7);
  std::vector<Atom> atoms;
  const float extent = std::cbrt(static_cast<float>(count) / 12);
  while (std::ssize(atoms) < count) {
    const Vec3 p = 2.F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 1.F;
    if (lengthSquared(p) <= 1) atoms.push_back(test::atom(Kernel::wyvill, extent * p, 1, 2));
  }
  return {std::to_string(count), {Kernel::wyvill, std::move(atoms)}, 1};
}

// What a fluid simulation leaves: a cube of atoms at the points of a grid of spacing 1, each moved
// by up to 0.3 along every axis; h = 2 and a threshold of half the interior density. That density
// is the integral of the kernel, 4 pi h^3 16 / 315, over a spacing cubed.
inline Set fluid(int count) {
  Rng rng(7);
  std::vector<Atom> atoms;
  const int side = static_cast<int>(std::ceil(std::cbrt(count) - 1e-9));
  const double density = 4 * std::numbers::pi * 8 * 16 / 315;
  for (int i = 0; i < count; ++i) {
    const Vec3 jitter = 0.6F * Vec3(rng.uniform(), rng.uniform(), rng.uniform()) - 0.3F;
    const Point3 p(i % side, i / side % side, i / (side * side));
    atoms.push_back(test::atom(Kernel::wyvill, p + jitter, 2, 2 / density));
  }
  return {std::to_string(count), {Kernel::wyvill, std::move(atoms)}, 2};
}

// Pinhole rays through a square picture of the whole set, in tiles of 4 x 4 pixels: 16 rays in a
// row make a packet.
inline std::vector<Ray> cameraRays(const Field& field, int resolution) {
  Bounds3 box;  // of the centres: its ball holds the surface but for a rim
  for (const Atom& atom : field.atoms()) box.add(atom.centre);
  const float radius = 0.5F * glm::length(box.diagonal());
  const Vec3 forward = glm::normalize(Vec3(-0.8F, 0.6F, -0.45F));
  const Point3 eye = box.centre() - 3 * radius * forward;
  const Vec3 right = glm::normalize(glm::cross(forward, Vec3(0, 1, 0)));
  const Vec3 up = glm::cross(right, forward);
  const float halfWidth = 1 / std::sqrt(8.F);  // the cone about a ball three of its radii away
  std::vector<Ray> rays;
  for (int tile = 0; tile < sqr(resolution / 4); ++tile)
    for (int i = 0; i < 16; ++i) {
      const Point2i pixel =
          4 * Point2i(tile % (resolution / 4), tile / (resolution / 4)) + Point2i(i % 4, i / 4);
      const Point2 p = ((Point2(pixel) + 0.5F) / static_cast<float>(resolution) * 2.F - 1.F);
      const Vec3 d = forward + halfWidth * (p.x * right - p.y * up);
      rays.push_back({eye, 0, glm::normalize(d)});
    }
  return rays;
}

inline ObjectRay inDouble(const Ray& ray) {
  return {DPoint3(ray.o), DVec3(ray.d), ray.tMin, ray.tMax};
}

}  // namespace pbrt::metaballs::bench
