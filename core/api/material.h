#pragma once
// Materials.

#include "core/api/bsdf.h"
#include "core/api/texture.h"

namespace pbrt {

class Material {
 public:
  struct Setup {};

  Material() = default;
  Material(const Material&) = delete;
  Material& operator=(const Material&) = delete;
  virtual ~Material();

  // Adds the lobes of this point to the bsdf; the lobes live in the scratch memory.
  // No lobe added: the surface is black.
  virtual void scatter(const SurfaceInteraction& at, Bsdf& bsdf, Scratch& scratch) const = 0;
  // Whether any texture in use filters by the pixel's footprint.
  virtual bool filters() const { return false; }
  // How deep it mixes other materials: 1 if they are plain ones.
  virtual int mixes() const { return 0; }
  // Displaces the shading normal; null: none.
  virtual const Textured<float>* bumpMap() const { return nullptr; }
};

}  // namespace pbrt
