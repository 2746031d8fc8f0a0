#include "core/base/colorimetry.h"
#include "core/base/illuminants.h"
#include "core/plugin/medium_params.h"
#include "core/plugin/plugin.h"
#include "core/plugin/voxel_grid.h"

namespace pbrt {

// The colours of black bodies whose spectra have a peak of 1, by their temperature.
class BlackBodies {
 public:
  BlackBodies() = default;
  explicit BlackBodies(float hottest) : hottest_(std::max(hottest, 2 * kColdest)) {
    for (int i = 0; i <= kSteps; ++i) {
      const float t = std::lerp(kColdest, hottest_, static_cast<float>(i) / kSteps);
      colours_.push_back(emittedColour(blackbody(t)));
    }
  }
  Spectrum operator()(float kelvin) const {
    if (!(kelvin > kColdest)) return Spectrum(0);
    const float x =
        std::min((kelvin - kColdest) / (hottest_ - kColdest), kOneMinusEpsilon) * kSteps;
    const auto i = static_cast<std::size_t>(x);
    return glm::mix(colours_[i], colours_[i + 1], x - static_cast<float>(i));
  }

 private:
  static constexpr float kColdest = 100;  // K; what is colder does not glow
  static constexpr int kSteps = 1000;
  float hottest_ = 0;
  std::vector<Spectrum> colours_;
};

class UniformGrid final : public Medium {
 public:
  UniformGrid(Params& p, const Setup& setup)
      : UniformGrid(p, setup, readMedium(p), readMediumBox(p), readVoxels(p)) {}

 private:
  UniformGrid(Params& p, const Setup& setup, const MediumParams& medium, const MediumBox& box,
              const glm::ivec3& n)
      : Medium(setup, medium.g, box.lo, box.hi), unit_(medium.unit) {
    std::vector<float> density =
        readDensities(p, "density", "of each voxel, in its middle; x goes fastest");
    checkVoxels(p, "density", n, density.size());
    density_ = VoxelGrid<float>(n, std::move(density), true);
    std::vector<float> strength = readDensities(p, "Lescale", "multiplies what each voxel emits");
    if (!strength.empty()) {
      checkVoxels(p, "Lescale", n, strength.size());
      strength_ = VoxelGrid<float>(n, std::move(strength), true);
    }
    readTemperature(p, n);
    if (p.describing()) return;
    const glm::ivec3 cells = boundingCells(n);
    setCells(cells, boundsOf(density_, cells, unit_.extinction(), {&strength_, &temperature_}),
             glows());
  }

  void readTemperature(Params& p, const glm::ivec3& n) {
    std::vector<float> kelvins = readDensities(
        p, "temperature", "of each voxel in K, by which it glows as a black body with a peak of 1");
    radianceScale_ = readRadianceScale(p);
    const float cutoff = p.number("temperaturecutoff", 0, "the default of temperatureoffset", "K");
    const float offset =
        p.number("temperatureoffset", cutoff, "taken from the temperatures first", "K");
    const float scale = p.nonNegative("temperaturescale", 1, "multiplies the temperatures then");
    if (kelvins.empty()) return;
    if (p.has("Le")) p.fail("temperature", "cannot be beside \"Le\": a voxel glows by one of them");
    checkVoxels(p, "temperature", n, kelvins.size());
    for (float& t : kelvins) t = std::max(0.F, (t - offset) * scale);
    colours_ = BlackBodies(*std::ranges::max_element(kelvins));
    temperature_ = VoxelGrid<float>(n, std::move(kelvins), true);
  }

  bool glows() const { return !temperature_.empty() || !isBlack(unit_.emission); }

  MediumPoint properties(const DPoint3& p) const override {
    const DVec3 u = (p - lo()) / (hi() - lo());
    MediumPoint m = unit_ * density_(u);
    if (!temperature_.empty())
      m.emission = m.absorption * radianceScale_ * colours_(temperature_(u));
    if (!strength_.empty()) m.emission *= strength_(u);
    return m;
  }

  MediumPoint unit_;
  VoxelGrid<float> density_, strength_, temperature_;  // the latter two may be empty
  BlackBodies colours_;
  float radianceScale_ = 1;  // of them
};

}  // namespace pbrt

PBRT_PLUGIN(Medium, pbrt::UniformGrid, "uniformgrid",
            "smoke or fire whose density is told voxel by voxel, fading out at the borders")
