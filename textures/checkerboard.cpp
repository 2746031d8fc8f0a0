#include "core/plugin/mapping_params.h"
#include "core/plugin/plugin.h"

namespace pbrt {

namespace {

// The largest whole number that is not above x. Beyond 2^52 in size all numbers are whole; they
// count as this one, which is even.
std::int64_t wholeBelow(double x) {
  x = std::clamp(x, -0x1p52, 0x1p52);
  const auto i = static_cast<std::int64_t>(x);
  return i - (static_cast<double>(i) > x ? 1 : 0);
}

bool odd(double x) {
  return (wholeBelow(x) & 1) != 0;
}

// How much of [0, x] lies in cells [k, k + 1) with odd k.
double oddLength(double x) {
  const auto pairs = static_cast<double>(wholeBelow(x / 2));
  return pairs + std::max(0.0, x - 2 * pairs - 1);
}

// The share of odd cells in [x - r, x + r].
double oddShare(double x, double r) {
  if (wholeBelow(x - r) == wholeBelow(x + r)) return odd(x) ? 1 : 0;
  return std::clamp((oddLength(x + r) - oddLength(x - r)) / (2 * r), 0.0, 1.0);
}

}  // namespace

template <class T>
class Checkerboard final : public Texture<T> {
 public:
  Checkerboard(Params& p, const typename Texture<T>::Setup& setup)
      : dimension_(p.integer("dimension", 2, 2, 3, "2: squares; 3: cubes in texture space")),
        tex1_(p.texture<T>("tex1", 1, "in the cells whose numbers have an even sum")),
        tex2_(p.texture<T>("tex2", 0, "in the other cells")),
        toTexture_(setup.placement.inverse()) {
    if (dimension_ == 3) return;
    mapping_ = readMapping(p, setup.placement, setup.world);
    constexpr std::string_view modes[] = {"none", "closedform", "supersample"};
    filtered_ = p.choice("aamode", modes, "closedform",
                         "how a pixel's footprint is averaged; supersample is taken for "
                         "closedform (squares only)") != "none";
  }

  T evaluate(const SurfaceInteraction& at) const override {
    const float second = shareOfSecond(at);
    if (second == 0) return tex1_(at);
    if (second == 1) return tex2_(at);
    return (1 - second) * tex1_(at) + second * tex2_(at);
  }
  bool filters() const override { return filtered_ || tex1_.filters() || tex2_.filters(); }

 private:
  float shareOfSecond(const SurfaceInteraction& at) const {
    if (dimension_ == 3) {
      const DPoint3 p = toTexture_.point(DPoint3(at.p));
      return (odd(p.x) != odd(p.y)) != odd(p.z) ? 1 : 0;
    }
    const TexturePoint m = mapping_(at);
    if (!filtered_) return odd(m.st.x) != odd(m.st.y) ? 1 : 0;
    // The box of half the size `r` about the point. A point of it is in a second cell if one, and
    // only one, of its coordinates is in an odd cell. Wide boxes are grey.
    const Vec2 r = glm::max(glm::abs(m.dx), glm::abs(m.dy));
    if (r.x > 1 || r.y > 1) return 0.5F;
    const double s = oddShare(m.st.x, r.x), t = oddShare(m.st.y, r.y);
    return static_cast<float>(s + t - 2 * s * t);
  }

  int dimension_;
  bool filtered_ = false;
  Textured<T> tex1_, tex2_;
  Mapping2D mapping_;
  Transform toTexture_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::Checkerboard, "checkerboard", "squares or cubes of two textures")
