#pragma once
// The implicit surfaces of a scene, covered with surfels.

#include "core/api/world.h"
#include "shapes/metaballs/surfels/draw.h"
#include "shapes/metaballs/surfels/still_field.h"

namespace pbrt::surfels {

class Cover {
 public:
  struct Settings {
    int particles = 16384;  // on all surfaces together
    float quality = 0;      // above 0: as many as the picture asks for, instead of `particles`
    int steps = 60;         // of the simulation
  };

  // Covers them where they are at the start of their motions, with which the surfels then go.
  // `world` must outlive it. `resolution` is the picture's. On all threads; the result does not
  // depend on their number.
  Cover(const World& world, Point2i resolution, const Settings& settings);

  // What each ray sees first of the surfels and of the scene's other shapes, `width` rays to a row.
  // Hits of surfels mean something to surface() alone, but for t, geometry and instance.
  void look(std::span<const Ray* const> rays, int width, std::span<Hit> hits) const;
  // Of a hit of look().
  SurfaceInteraction surface(const RayDifferential& ray, const Hit& hit) const;
  // How far the point of that hit is below the true surface, which is in the way of its light.
  float depth(const Hit& hit, const SurfaceInteraction& at) const;

 private:
  // What a surfel knows of the surface below.
  struct Base {
    Point3 p{};
    Vec3 dpdu{}, dpdv{};
    Normal3 dndu{}, dndv{};
    Point2 uv{};
    std::uint32_t primitive = 0;
    std::uint32_t skin = Hit::kNone;
  };

  // One surface.
  struct Skin {
    ImplicitSurface surface;
    Transform toField;  // at the start, as the discs are
    Discs discs;
    std::uint32_t firstBase = 0;
    SurfaceInteraction anywhere;  // on it: for all that is the same everywhere
    bool reversed = false;        // whether its normals point inward

    bool moves() const { return static_cast<bool>(surface.toRenderAt); }
    Transform toRender(float time) const {
      return moves() ? surface.toRenderAt(time) : surface.toRender;
    }
    // How it has moved since the start.
    Transform moved(float time) const { return moves() ? toRender(time) * toField : Transform(); }
  };

  std::size_t count(double area, Point2i resolution, const Settings& settings) const;
  double pixelsPerArea(Point2i resolution) const;
  void cover(std::uint32_t number, std::span<const Surfel> surfels);
  static void draw(const Skin& skin, std::span<const Ray> rays, int width, const Beam& beam,
                   std::span<Fragment> out);
  std::optional<SurfaceInteraction> below(const Surfel& surfel, const Skin& skin) const;
  // A hit of which the world says that it is of an implicit surface.
  bool isImplicit(const Hit& hit) const;
  // What the ray meets of other shapes.
  Hit passImplicit(Ray ray, Hit hit) const;

  const World& world_;
  bool alone_ = true;        // whether there are no other shapes
  std::vector<Skin> skins_;  // by instance, then geometry
  std::vector<Base> bases_;  // of all surfels of all skins
};

}  // namespace pbrt::surfels
