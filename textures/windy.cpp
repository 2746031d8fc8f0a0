#include "core/api/mapping.h"
#include "core/base/noise.h"
#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Windy final : public Texture<T> {
 public:
  Windy(Params& p, const typename Texture<T>::Setup& setup)
      : toTexture_(setup.placement.inverse()) {
    p.number("scale", 1, "without effect, as in every pbrt, whose own scenes have it");
    if (p.has("scale")) p.warn("scale", "has no effect, as in every pbrt; Scale before it has");
  }

  // Waves, strong where a tenfold coarser noise is.
  T evaluate(const SurfaceInteraction& at) const override {
    const SolidPoint s = solidPoint(toTexture_, at);
    const float wind = fbm(0.1 * s.p, 0.1 * s.dx, 0.1 * s.dy, 0.5F, 3);
    return T(std::abs(wind) * fbm(s.p, s.dx, s.dy, 0.5F, 6));
  }
  bool filters() const override { return true; }

 private:
  Transform toTexture_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Windy, "windy", "waves on water, in gusts")
