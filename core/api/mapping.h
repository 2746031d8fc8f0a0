#pragma once
// How a texture is laid over a surface, or a surface through a texture.

#include <variant>

#include "core/api/interaction.h"

namespace pbrt {

// Texture coordinates, and how they change to the next pixel in x and in y.
struct TexturePoint {
  Point2 st{};
  Vec2 dx{}, dy{};
};

// A point of a texture that fills space, and how it moves to the next pixel in x and in y. Double,
// because textures go into ever finer detail.
struct SolidPoint {
  DPoint3 p{};
  DVec3 dx{}, dy{};
};
inline SolidPoint solidPoint(const Transform& toTexture, const SurfaceInteraction& at) {
  return {toTexture.point(DPoint3(at.p)), toTexture.vector(DVec3(at.dpdx)),
          toTexture.vector(DVec3(at.dpdy))};
}

// The surface's own (u, v), scaled and shifted.
struct UvMapping {
  Vec2 scale{1}, offset{0};

  TexturePoint operator()(const SurfaceInteraction& at) const {
    return {scale * at.uv + offset, scale * Vec2(at.dudx, at.dvdx), scale * Vec2(at.dudy, at.dvdy)};
  }
};

// s from 0 to 1 is the angle to the z axis of texture space, t the angle about it.
struct SphericalMapping {
  Transform toTexture;  // from render space

  TexturePoint operator()(const SurfaceInteraction& at) const {
    const DPoint3 p = toTexture.point(DPoint3(at.p));
    const double r2 = glm::dot(p, p), rho2 = p.x * p.x + p.y * p.y, rho = std::sqrt(rho2);
    // tan(theta) = rho / z and tan(phi) = y / x, differentiated. At the poles phi has no
    // derivative; no footprint is wider than one turn.
    const auto change = [&](const Vec3& v) {
      const DVec3 d = toTexture.vector(DVec3(v));
      if (!(rho > 0)) return Vec2(0);
      const double theta = (p.z * (p.x * d.x + p.y * d.y) / rho - rho * d.z) / r2;
      const double phi = (p.x * d.y - p.y * d.x) / rho2;
      return glm::clamp(Vec2(theta, 0.5 * phi) * kInvPi, -1.F, 1.F);
    };
    const double phi = std::atan2(p.y, p.x);
    return {Vec2(std::atan2(rho, p.z) * kInvPi, phi * (0.5 * kInvPi) + (phi < 0 ? 1 : 0)),
            change(at.dpdx), change(at.dpdy)};
  }
};

// s from 0 to 1 is the angle about the z axis of texture space, from -x; t the height on the unit
// sphere, z / |p|.
struct CylindricalMapping {
  Transform toTexture;  // from render space

  TexturePoint operator()(const SurfaceInteraction& at) const {
    const DPoint3 p = toTexture.point(DPoint3(at.p));
    const double r2 = glm::dot(p, p), rho2 = p.x * p.x + p.y * p.y;
    const double t = r2 > 0 ? p.z / std::sqrt(r2) : 0;
    const auto change = [&](const Vec3& v) {
      const DVec3 d = toTexture.vector(DVec3(v));
      if (!(rho2 > 0)) return Vec2(0);
      const double phi = (p.x * d.y - p.y * d.x) / rho2;
      const double dt = (d.z - p.z * glm::dot(p, d) / r2) / std::sqrt(r2);
      return glm::clamp(Vec2(phi * (0.5 * kInvPi), dt), -1.F, 1.F);
    };
    return {Vec2(0.5 + std::atan2(p.y, p.x) * (0.5 * kInvPi), t), change(at.dpdx), change(at.dpdy)};
  }
};

// Coordinates along two vectors of world space (not of texture space: so it is in every pbrt).
struct PlanarMapping {
  Transform toWorld;  // from render space
  DVec3 v1{1, 0, 0}, v2{0, 1, 0};
  Vec2 offset{0};

  TexturePoint operator()(const SurfaceInteraction& at) const {
    const auto along = [&](const DVec3& v) { return Vec2(glm::dot(v, v1), glm::dot(v, v2)); };
    return {along(toWorld.point(DPoint3(at.p))) + offset, along(toWorld.vector(DVec3(at.dpdx))),
            along(toWorld.vector(DVec3(at.dpdy)))};
  }
};

class Mapping2D {
 public:
  using Kind = std::variant<UvMapping, SphericalMapping, CylindricalMapping, PlanarMapping>;

  Mapping2D() = default;
  template <class Map>
  Mapping2D(const Map& map) : kind_(map) {}  // NOLINT: each of them is a mapping
  TexturePoint operator()(const SurfaceInteraction& at) const {
    return std::visit([&](const auto& map) { return map(at); }, kind_);
  }

 private:
  Kind kind_;
};

}  // namespace pbrt
