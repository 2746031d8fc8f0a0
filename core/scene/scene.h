#pragma once
// A scene that is ready to be rendered: owns everything, and answers integrators.

#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "core/api/integrator.h"
#include "core/api/material.h"
#include "core/api/texture.h"
#include "core/scene/accel.h"
#include "core/scene/film.h"
#include "core/scene/memory.h"

namespace pbrt {

// Where a surface is not there.
struct Cutout {
  Textured<float> alpha{1}, shadowAlpha{1};  // 1: there; 0: a hole; shadow rays ask for both
  bool partial = false;  // whether it is there with the chance alpha in between, or always
};

// One shape in its place.
struct Geometry {
  std::unique_ptr<Shape> shape;
  TriangleMesh* mesh = nullptr;  // the shape's, moved into the space of its group; else null
  Transform toGroup;             // from object space; identity for meshes
  bool reverse = false;          // ReverseOrientation
  bool flip = false;             // whether the winding's normal points inward
  std::optional<Cutout> cutout;  // if it has holes
  std::shared_ptr<const Material> material;  // null: only the border of media
  const MediumInterface* media = nullptr;    // null: the same on both sides
  std::unique_ptr<AreaSampler> sampler;      // of an area light
  std::unique_ptr<Light> light;              // the area light that it is; else null
};

// Geometries that share a space and a tree: the scene itself, or an object for instancing.
struct Group {
  explicit Group(const AccelDevice& device) : accel(device) {}
  std::vector<std::unique_ptr<Geometry>> geometries;  // by Hit::geometry
  Accel accel;
};

struct Instance {
  const Group* group;
  Transform toRender;            // where it rests
  std::optional<Motion> motion;  // if it moves: goes before toRender
};

class Scene final : public World, private HitFilter {
 public:
  explicit Scene(int threads) : device_(threads), root_(device_) {}

  Hit intersect(const Ray& ray) const override { return root_.accel.intersect(ray); }
  bool occluded(const Ray& ray) const override { return root_.accel.occluded(ray); }
  void intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const override {
    root_.accel.intersect(rays, hits);
  }
  std::uint32_t occluded(std::span<const Ray> rays) const override {
    return root_.accel.occluded(rays);
  }
  SurfaceInteraction surface(const RayDifferential& ray, const Hit& hit) const override;
  Bsdf bsdf(SurfaceInteraction& at, Scratch& scratch) const override;
  ImplicitSurfaces implicitSurfaces() const override;

  // The shape that was hit.
  const Shape& shape(const Hit& hit) const { return *geometry(hit).shape; }

  const Integrator& integrator() const { return *integrator_; }
  const Sampler& sampler() const { return *sampler_; }
  // The same sampler with another seed and number of samples per pixel.
  std::unique_ptr<Sampler> makeSampler(std::uint64_t seed, int samplesPerPixel) const {
    return makeSampler_(seed, samplesPerPixel);
  }
  std::uint64_t seed() const { return seed_; }
  Film& film() { return *film_; }
  const Film& film() const { return *film_; }
  const std::string& outputFile() const { return outputFile_; }
  // What the picture should say about itself: worldToCamera, worldToNDC.
  const std::map<std::string, ImageAttribute>& attributes() const { return attributes_; }
  std::size_t shapes() const { return shapes_; }
  std::size_t instances() const { return instances_.size(); }
  // Of all ray trees together.
  double treeSeconds() const;

 private:
  friend class SceneBuilder;
  friend std::vector<MemoryPart> takeApart(std::unique_ptr<Scene> scene);

  bool keeps(const Ray& ray, const Hit& hit, bool shadow) const override;
  const Instance* instance(const Hit& hit) const {
    return hit.instance == Hit::kNone ? nullptr
                                      : &instances_[hit.instance - root_.geometries.size()];
  }
  const Geometry& geometry(const Hit& hit) const {
    const Instance* i = instance(hit);
    return *(i ? *i->group : root_).geometries[hit.geometry];
  }

  AccelDevice device_;  // before the trees, which it must outlive
  std::vector<std::unique_ptr<Group>> objects_;
  Group root_;
  std::vector<Instance> instances_;  // geometries of the root tree after its own
  std::vector<std::unique_ptr<Light>> ownLights_;
  std::unique_ptr<Camera> ownCamera_;
  std::unique_ptr<Filter> filter_;
  std::unique_ptr<Sampler> sampler_;
  std::function<std::unique_ptr<Sampler>(std::uint64_t, std::optional<int>)> makeSampler_;
  std::uint64_t seed_ = 0;
  std::unique_ptr<Integrator> surfaceIntegrator_;  // to which a volume integrator adds
  std::unique_ptr<Integrator> integrator_;
  std::vector<std::unique_ptr<Medium>> media_;
  std::deque<MediumInterface> interfaces_;  // addresses stay valid
  std::unique_ptr<Film> film_;
  std::string outputFile_;
  std::map<std::string, ImageAttribute> attributes_;
  std::size_t shapes_ = 0;
};

}  // namespace pbrt
