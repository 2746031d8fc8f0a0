#pragma once
// Textures: values that vary over a surface.

#include <memory>

#include "core/api/interaction.h"

namespace pbrt {

template <class T>
class Texture {
 public:
  // `placement` maps the texture's own space to render space (the transform in force at its
  // Texture directive), `world` world space.
  struct Setup {
    Transform placement;
    Transform world;
  };

  virtual ~Texture() = default;
  Texture() = default;
  Texture(const Texture&) = delete;
  Texture& operator=(const Texture&) = delete;

  virtual T evaluate(const SurfaceInteraction& at) const = 0;
  // Whether evaluate() reads the footprint (dudx, ..., dpdy). If no texture of a scene does,
  // no ray carries differentials.
  virtual bool filters() const { return false; }
};

// A parameter that is a constant or a texture. The constant costs no call.
template <class T>
class Textured {
 public:
  explicit Textured(T value = T(0)) : value_(value) {}
  explicit Textured(std::shared_ptr<const Texture<T>> texture) : texture_(std::move(texture)) {}

  T operator()(const SurfaceInteraction& at) const {
    return texture_ ? texture_->evaluate(at) : value_;
  }
  const Texture<T>* texture() const { return texture_.get(); }
  bool filters() const { return texture_ && texture_->filters(); }

 private:
  T value_{};
  std::shared_ptr<const Texture<T>> texture_;
};

}  // namespace pbrt
