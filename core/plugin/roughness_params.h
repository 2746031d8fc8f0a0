#pragma once
// The roughness parameters that materials with microfacets share.

#include "core/base/microfacet.h"
#include "core/plugin/params.h"

namespace pbrt {

// The widths of a Trowbridge-Reitz or Beckmann distribution.
struct FacetWidths {
  float x = 0, y = 0;
  bool smooth = true;  // a perfect mirror, without facets

  TrowbridgeReitz facets() const { return {x, y}; }
};

// From a scene's roughness to the widths, as its generation of pbrt has it.
class RoughnessMap {
 public:
  explicit RoughnessMap(Params& p) {
    const bool remap = p.flag("remaproughness", true,
                              "roughness is from 0 to 1, not the distribution's own alpha "
                              "(not of blinn)");
    constexpr std::string_view kinds[] = {"v3", "v4"};
    const std::string kind =
        p.choice("remapping", kinds, "v3",
                 "how alpha grows with roughness: pbrt-v3's polynomial, or pbrt-v4's square root");
    if (remap) kind_ = kind == "v3" ? Kind::polynomial : Kind::root;
  }

  float alpha(float roughness) const {
    if (kind_ == Kind::polynomial) return TrowbridgeReitz::alpha(roughness);
    return kind_ == Kind::root ? safeSqrt(roughness) : roughness;
  }
  // pbrt-v3's polynomial stays above 0, but no roughness at all means a mirror.
  FacetWidths operator()(Vec2 roughness) const {
    const float x = alpha(roughness.x), y = alpha(roughness.y);
    const bool none = std::max(roughness.x, roughness.y) <= 0;
    return {x, y, none || std::max(x, y) < TrowbridgeReitz::kMin};
  }

 private:
  enum class Kind { none, polynomial, root };
  Kind kind_ = Kind::none;
};

// Which distribution the facets' normals follow.
class Facets {
 public:
  // `blinn`: whether Blinn's, with the exponent 1 / roughness, is one of them: pbrt-v1's and v2's.
  explicit Facets(Params& p, bool blinn = true) {
    constexpr std::string_view kinds[] = {"trowbridgereitz", "beckmann", "blinn"};
    const std::string kind =
        p.choice("distribution", std::span(kinds).first(blinn ? 3 : 2), kinds[0],
                 blinn ? "of the facets' normals; blinn has the exponent 1 / roughness"
                       : "of the facets' normals");
    kind_ = kind == kinds[0]   ? Kind::trowbridgeReitz
            : kind == kinds[1] ? Kind::beckmann
                               : Kind::blinn;
  }

  bool blinn() const { return kind_ == Kind::blinn; }
  // use(distribution), of that roughness.
  template <class Use>
  void with(Vec2 roughness, const RoughnessMap& map, Use&& use) const {
    if (blinn()) return use(Blinn(roughness.x, roughness.y));
    const FacetWidths widths = map(roughness);
    if (kind_ == Kind::beckmann) return use(Beckmann(widths.x, widths.y));
    use(widths.facets());
  }

 private:
  enum class Kind { trowbridgeReitz, beckmann, blinn };
  Kind kind_ = Kind::trowbridgeReitz;
};

// Roughness along the tangent (u) and across it (v).
class Roughness {
 public:
  // One for both, unless an axis has its own. The names begin with `prefix`.
  Roughness(Params& p, float fallback, const std::string& prefix = "")
      : u_(p.floatTexture(prefix + "roughness", fallback, "0 is the sharpest highlight")), v_(u_) {
    const auto u = p.optionalFloatTexture(prefix + "uroughness", "roughness along the tangent"),
               v = p.optionalFloatTexture(prefix + "vroughness", "roughness across the tangent");
    if (u) u_ = *u;
    if (v) v_ = *v;
    same_ = !u && !v;
  }
  // Of materials that have no common parameter.
  static Roughness perAxis(Params& p, float fallback) {
    return {p.floatTexture("uroughness", fallback, "roughness along the tangent"),
            p.floatTexture("vroughness", fallback, "roughness across the tangent")};
  }

  Vec2 operator()(const SurfaceInteraction& at) const {
    const float u = u_(at);
    return {u, same_ ? u : v_(at)};
  }
  // Whether it is 0 everywhere.
  bool none() const { return !u_.texture() && !v_.texture() && (*this)({}) == Vec2(0); }
  bool filters() const { return u_.filters() || v_.filters(); }

 private:
  Roughness(Textured<float> u, Textured<float> v) : u_(std::move(u)), v_(std::move(v)) {}

  Textured<float> u_, v_;
  bool same_ = false;  // one texture for both is looked up once
};

}  // namespace pbrt
