// The colours that a shape brings along, such as those of the atoms of metaballs. A float is their
// luminance. They belong to the shape: bumps do not move them.

#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class ShapeColor final : public Texture<T> {
 public:
  explicit ShapeColor(Params& p)
      : fallback_(p.texture<T>("fallback", 1, "where the shape has no colour of its own")) {}

  T evaluate(const SurfaceInteraction& at) const override {
    if (!at.color) return fallback_(at);
    const Spectrum color = at.color->at(at.objectP, at.primitive);
    if constexpr (std::is_same_v<T, float>)
      return luminance(color);
    else
      return color;
  }
  bool filters() const override { return fallback_.filters(); }

 private:
  Textured<T> fallback_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::ShapeColor, "shapecolor",
                    "the colours that a shape brings along, such as those of metaballs")
