#pragma once
// Shapes: geometry in its own object space. Const and thread-safe after construction.

#include <cstdint>
#include <optional>
#include <vector>

#include "core/api/implicit.h"
#include "core/api/interaction.h"
#include "core/base/bounds.h"

namespace pbrt {

// What ranks hits: 16 bytes. Everything else is worked out for the winner alone.
struct ShapeHit {
  float t = kInfinity;
  float u = 0, v = 0;  // the shape's own, handed back to surface()
  std::uint32_t primitive = 0;
};

// A point chosen on a surface as seen from a reference point.
struct AreaSample {
  DPoint3 p{};
  double error = 0;  // as SurfacePoint::error
  Normal3 n{};       // unit, outward
  float pdf = 0;     // per solid angle at the reference point; 0: no sample
};

// Directions whose angle to the unit `axis` has at least this cosine; -1: all there are.
struct DirectionCone {
  Vec3 axis{0, 0, 1};
  float cosine = -1;
};

// Samples a surface for those who gather its light. All in the space of the shape, or in render
// space where the scene hands it to a light.
class AreaSampler {
 public:
  virtual ~AreaSampler() = default;
  virtual double area() const = 0;
  virtual AreaSample sample(const DPoint3& from, Point2 u) const = 0;
  // The density with which sample() chooses the surface point p with normal n, per solid angle.
  virtual float pdf(const DPoint3& from, const DPoint3& p, const Normal3& n) const = 0;
  // False only if no ray from `from` along `w` meets the surface; may be true in vain.
  virtual bool mayHit(const DPoint3& from, const DVec3& w) const = 0;
  // Holds the normals of all its points.
  virtual DirectionCone normals() const { return {}; }
};

// Triangles with optional per-vertex attributes. Empty arrays are absent attributes.
struct TriangleMesh {
  std::vector<std::uint32_t> indices;  // three a triangle, each below positions.size()
  std::vector<Point3> positions;
  std::vector<Normal3> normals;  // shading normals, any length; empty or one per vertex
  std::vector<Vec3> tangents;    // shading tangents; empty or one per vertex
  std::vector<Point2> uv;        // empty or one per vertex

  std::size_t triangles() const { return indices.size() / 3; }
};

class Shape {
 public:
  struct Setup {};

  Shape() = default;
  Shape(const Shape&) = delete;
  Shape& operator=(const Shape&) = delete;
  virtual ~Shape();

  // A shape stands for one or more primitives, each with its own box in the ray tree.
  virtual std::uint32_t primitives() const { return 1; }
  // Holds every point of the surface within the primitive. Empty: the primitive is not there.
  virtual Bounds3 bounds(std::uint32_t primitive) const = 0;
  // The nearest crossing with tMin < t <= tMax within the primitive, if any. Two primitives may
  // report the same crossing; none may miss its own.
  virtual std::optional<ShapeHit> intersect(const ObjectRay& ray,
                                            std::uint32_t primitive) const = 0;
  // Whether there is any crossing.
  virtual bool occluded(const ObjectRay& ray, std::uint32_t primitive) const {
    return intersect(ray, primitive).has_value();
  }
  // The point that a hit of this same ray names. t is a float there: the shape moves the point
  // back onto its surface and states what error is left.
  virtual SurfacePoint surface(const ObjectRay& ray, const ShapeHit& hit) const = 0;

  // Abilities; null is "cannot".
  virtual const AreaSampler* areaSampler() const { return nullptr; }  // may be an area light
  virtual TriangleMesh* triangles() { return nullptr; }          // traced natively; see MeshShape
  virtual const SurfaceColor* color() const { return nullptr; }  // has colours of its own
  virtual const ImplicitField* implicit() const { return nullptr; }  // is where a field is zero
};

// A shape that is nothing but triangles: the scene takes the mesh, and never calls the rest.
class MeshShape : public Shape {
 public:
  ~MeshShape() override;
  TriangleMesh* triangles() final { return &mesh_; }
  Bounds3 bounds(std::uint32_t) const final { return {}; }
  std::optional<ShapeHit> intersect(const ObjectRay&, std::uint32_t) const final { return {}; }
  SurfacePoint surface(const ObjectRay&, const ShapeHit&) const final { return {}; }

 protected:
  TriangleMesh mesh_;
};

}  // namespace pbrt
