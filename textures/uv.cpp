#include "core/plugin/mapping_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

template <class T>
class Uv final : public Texture<T> {
 public:
  Uv(Params& p, const typename Texture<T>::Setup& setup)
      : mapping_(readMapping(p, setup.placement, setup.world)) {
    if constexpr (std::is_same_v<T, float>)
      if (!p.describing()) throw Error("\"uv\" is a color texture, not a float one");
  }

  T evaluate(const SurfaceInteraction& at) const override {
    const Point2 st = glm::fract(mapping_(at).st);
    if constexpr (std::is_same_v<T, float>)
      return st.x;
    else
      return {st.x, st.y, 0};
  }

 private:
  Mapping2D mapping_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Uv, "uv", "shows the coordinates (u, v) of the surface as red and green")
