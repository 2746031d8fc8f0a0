#include "core/base/noise.h"
#include "core/plugin/mapping_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Dots final : public Texture<T> {
 public:
  Dots(Params& p, const typename Texture<T>::Setup& setup)
      : mapping_(readMapping(p, setup.placement, setup.world)),
        inside_(p.texture<T>("inside", 1, "in the dots")),
        outside_(p.texture<T>("outside", 0, "between them")) {}

  T evaluate(const SurfaceInteraction& at) const override {
    return inDot(glm::dvec2(mapping_(at).st)) ? inside_(at) : outside_(at);
  }
  bool filters() const override { return inside_.filters() || outside_.filters(); }

 private:
  // A cell of the unit lattice, about a whole number, has a dot if noise there is above zero, and
  // noise elsewhere moves it about in its cell. The places are pbrt's: dots lie where they do
  // there.
  static bool inDot(const glm::dvec2& st) {
    const glm::dvec2 cell = glm::floor(st + 0.5);
    const auto noiseAt = [&](double x, double y) {
      return double{noise({cell.x + x, cell.y + y, 0.5})};
    };
    if (!(noiseAt(0.5, 0.5) > 0)) return false;
    constexpr double radius = 0.35, most = 0.5 - radius;
    const glm::dvec2 centre = cell + most * glm::dvec2(noiseAt(1.5, 2.8), noiseAt(4.5, 9.8));
    return lengthSquared(st - centre) < radius * radius;
  }

  Mapping2D mapping_;
  Textured<T> inside_, outside_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Dots, "dots", "dots of one texture, strewn over another")
