#pragma once
// Small scenes in which integrators are tried.

#include "core/parse/parse.h"
#include "core/scene/render.h"
#include "core/scene/scene.h"
#include "law.h"

namespace pbrt::laws {

// A scene and the subject's integrator, whatever the scene names; a volume integrator adds to
// directlighting.
class Stage final : public World {
 public:
  static constexpr Point2i kResolution{40, 36};  // four tiles

  struct Options {
    std::uint64_t seed = 0;
    std::uint32_t samples = 2;  // of a whole picture
    std::uint32_t first = 0;    // of those that are taken
    std::uint32_t end = 0;      // one past the last; 0: all
    int threads = 1;
    Bounds2i crop{{0, 0}, kResolution};
  };
  struct Picture {
    Image image;
    std::uint64_t badSamples = 0;
  };

  Hit intersect(const Ray& ray) const override { return scene_->intersect(ray); }
  bool occluded(const Ray& ray) const override { return scene_->occluded(ray); }
  void intersect(std::span<const Ray* const> rays, std::span<Hit> hits) const override {
    scene_->intersect(rays, hits);
  }
  std::uint32_t occluded(std::span<const Ray> rays) const override {
    return scene_->occluded(rays);
  }
  SurfaceInteraction surface(const RayDifferential& ray, const Hit& hit) const override {
    return scene_->surface(ray, hit);
  }
  Bsdf bsdf(SurfaceInteraction& at, Scratch& scratch) const override {
    return scene_->bsdf(at, scratch);
  }
  ImplicitSurfaces implicitSurfaces() const override { return scene_->implicitSurfaces(); }

  const std::string& name() const { return name_; }
  bool isLit() const { return !lights().empty(); }
  const Integrator& integrator() const { return *integrator_; }
  // Another of the same parameters, for this stage.
  std::unique_ptr<Integrator> makeIntegrator() const;
  std::unique_ptr<Sampler> sampler(std::uint64_t seed, std::uint32_t samples) const {
    return scene_->makeSampler(seed, static_cast<int>(samples));
  }

  Film film(const Bounds2i& crop = {{0, 0}, kResolution}) const;
  // Adds samples to the film; returns how many were not finite.
  std::uint64_t render(const Integrator& integrator, const Options& options, Film& film) const;
  Picture render(const Options& options) const {
    Film empty = film(options.crop);
    const std::uint64_t bad = render(integrator(), options, empty);
    return {empty.image(), bad};
  }

 private:
  friend std::vector<std::unique_ptr<Stage>> stages(const Subject& subject);

  Stage(const Subject& subject, std::string name, std::unique_ptr<Parser> text,
        std::unique_ptr<Scene> scene, std::unique_ptr<Integrator> surface);

  Subject subject_;
  std::string name_;
  std::unique_ptr<Parser> text_;  // which the scene may quote
  std::unique_ptr<Scene> scene_;
  std::unique_ptr<Integrator> surface_;  // directlighting
  std::unique_ptr<Integrator> integrator_;
};

// All that suit the subject. Throws Error, also where plug-ins that scenes need are not there.
std::vector<std::unique_ptr<Stage>> stages(const Subject& subject);

}  // namespace pbrt::laws
