#pragma once
// Measured reflection, fitted by cosine lobes.

#include <array>

#include "core/api/bsdf.h"

namespace pbrt {

// Lafortune et al. 1997, "Non-Linear Approximation of Reflectance Functions", equation 8 without a
// preferred tangent: f(o, i) = max(0, Cxy (o.x i.x + o.y i.y) + Cz o.z i.z)^n, for each colour. It
// is a power of the cosine between i and q = (Cxy o.x, Cxy o.y, Cz o.z), which need not be where a
// mirror would send the light, and |q|^n is its height. Reciprocal.
struct GeneralizedCosine {
  Spectrum xy{0}, z{0}, exponent{1};
};

// A diffuse part and three lobes.
struct LafortuneFit {
  static constexpr int kLobes = 3;

  Spectrum diffuse{0};
  std::array<GeneralizedCosine, kLobes> lobes;
};

// A fit, with what must be known of it as a whole. Nothing but data bounds the energy of a fit, and
// near the horizon, where nobody can measure, it may make some. With the factor k(o) that would
// undo this for light from o,
//   f'(o, i) = f(o, i) min(k(o), k(i))
// is reciprocal still, and its albedo is at most k(o) times that of f.
class LafortuneModel {
 public:
  explicit LafortuneModel(const LafortuneFit& fit);

  const LafortuneFit& fit() const { return fit_; }
  // At a cosine of the angle to the normal, on either side.
  Spectrum kept(float cosTheta) const;           // k, of the lobes' light
  float albedo(int lobe, float cosTheta) const;  // luminance of what a lobe scatters by f

 private:
  static constexpr int kCosines = 65;  // at j / 64
  struct Cell {
    int j = 0;
    float t = 0;
  };
  static Cell cell(float cosTheta);

  LafortuneFit fit_;
  std::array<Spectrum, kCosines> kept_;
  std::array<std::array<float, kCosines>, LafortuneFit::kLobes> albedo_;
};

class LafortuneLobe final : public Bxdf {
 public:
  // The model must outlive the lobe.
  LafortuneLobe(const LafortuneModel& model, int lobe)
      : Bxdf(kReflection | kGlossy), model_(model), lobe_(lobe) {}
  Spectrum f(const Vec3& wo, const Vec3& wi) const override;
  // A third of the samples goes by each colour: by its power of the cosine about q, or by the
  // cosine about the normal where q is below the surface.
  float pdf(const Vec3& wo, const Vec3& wi) const override;
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const override;
  float weight(const Vec3& wo) const override;

 private:
  const LafortuneModel& model_;
  int lobe_;
};

}  // namespace pbrt
