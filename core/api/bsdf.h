#pragma once
// How a surface point scatters light: a sum of lobes in the shading frame.

#include <array>
#include <cstdint>
#include <memory_resource>
#include <optional>

#include "core/api/interaction.h"

namespace pbrt {

// Per-thread memory for what lives as long as one camera ray. Nothing in it is destroyed, so
// only trivially destructible objects may be placed there.
using Scratch = std::pmr::monotonic_buffer_resource;

template <class T, class... Args>
const T* place(Scratch& scratch, Args&&... args) {
  static_assert(std::is_trivially_destructible_v<T>);
  return new (scratch.allocate(sizeof(T), alignof(T))) T(std::forward<Args>(args)...);
}

// What a lobe does; a set of lobes is asked for by or-ing.
enum LobeFlags : std::uint8_t {
  kReflection = 1,
  kTransmission = 2,
  kDiffuse = 4,
  kGlossy = 8,
  kSpecular = 16,  // a delta distribution: f() and pdf() are zero
  kAllLobes = 31,
};

struct BsdfSample {
  Spectrum f{0};  // for a specular lobe the reflectance over |cos theta_i|
  Vec3 wi{};
  float pdf = 0;  // per solid angle; for a specular lobe the probability of its choice
  std::uint8_t flags = 0;
  float eta = 1;  // transmitted over incident index of refraction, if transmitted
};

// One lobe. Directions are unit, local (z is the shading normal) and point away from the
// surface.
class Bxdf {
 public:
  constexpr explicit Bxdf(std::uint8_t flags) : flags_(flags) {}
  std::uint8_t flags() const { return flags_; }
  bool matches(std::uint8_t wanted) const { return (flags_ & wanted) == flags_; }

  virtual Spectrum f(const Vec3& wo, const Vec3& wi) const = 0;
  // Default: cosine-weighted on wo's side.
  virtual float pdf(const Vec3& wo, const Vec3& wi) const;
  virtual std::optional<BsdfSample> sample(const Vec3& wo, Point2 u) const;
  // A cheap guess of the share of the light from wo's side that is scattered, by which a Bsdf
  // shares out its samples. Zero only where sample() would give nothing. Default: one.
  virtual float weight(const Vec3& wo) const;

 protected:
  ~Bxdf() = default;  // never destroyed through the base; see Scratch

 private:
  std::uint8_t flags_;
};

// Directions here are in render space.
class Bsdf {
 public:
  // No plain material adds more than kMaxLobes / 4: a mix may mix two mixes.
  static constexpr int kMaxLobes = 24;

  explicit Bsdf(const SurfaceInteraction& at) : frame_(at.frame()), n_(at.n) {}
  void add(const Bxdf* lobe) { lobes_[count_++] = lobe; }
  int count() const { return count_; }
  const Bxdf& lobe(int i) const { return *lobes_[i]; }
  // Scales what the lobes from the `first` on scatter; what has no colour left goes.
  void scale(int first, const Spectrum& by, Scratch& scratch);

  // Whether any lobe has one of these kinds (e.g. kDiffuse | kGlossy: worth asking f()).
  bool has(std::uint8_t kinds) const;
  int lobes(std::uint8_t wanted) const;

  // Reflection or transmission is told by the geometric normal, so that interpolated normals
  // leak no light (Veach 1997, section 5.3).
  Spectrum f(const Vec3& wo, const Vec3& wi, std::uint8_t wanted = kAllLobes) const;
  float pdf(const Vec3& wo, const Vec3& wi, std::uint8_t wanted = kAllLobes) const;
  // Chooses a lobe by u.x, with chances by their weights, then a direction; f and pdf are those of
  // the whole (unless the lobe is specular). Empty: no sample.
  std::optional<BsdfSample> sample(const Vec3& wo, Point2 u, std::uint8_t wanted = kAllLobes) const;

  // How much of the light from wo's side is scattered, integral of f(wo, wi) |cos wi| dwi,
  // estimated from the same few directions every time. Refraction counts as power: without the
  // factor by which radiance changes with the index.
  Spectrum rho(const Vec3& wo) const;

  const Frame& frame() const { return frame_; }

 private:
  using Chances = std::array<float, kMaxLobes>;
  // Of each lobe to be chosen for wo (local), up to a common factor: their sum, which is returned.
  float chances(const Vec3& wo, std::uint8_t wanted, Chances& chances) const;

  Frame frame_;
  Normal3 n_;
  int count_ = 0;
  std::array<const Bxdf*, kMaxLobes> lobes_;  // the first count_
};

}  // namespace pbrt
