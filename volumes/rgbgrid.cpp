#include "core/plugin/medium_params.h"
#include "core/plugin/plugin.h"
#include "core/plugin/voxel_grid.h"

namespace pbrt {

class RgbGrid final : public Medium {
 public:
  RgbGrid(Params& p, const Setup& setup)
      : RgbGrid(p, setup,
                p.inRange("g", 0, -0.999F, 0.999F,
                          "mean cosine of scattering: above 0 forward, below 0 backward"),
                readMediumBox(p), readVoxels(p)) {}

 private:
  using Grid = VoxelGrid<Spectrum>;

  RgbGrid(Params& p, const Setup& setup, float g, const MediumBox& box, const glm::ivec3& n)
      : Medium(setup, g, box.lo, box.hi),
        absorption_(read(p, "sigma_a", "absorption of each voxel; all 1 if there is none", n)),
        scattering_(read(p, "sigma_s", "scattering of each voxel; all 1 if there is none", n)),
        emission_(read(p, "Le", "radiance that each voxel emits, as a black body", n)),
        scale_(p.nonNegative("scale", 1, "multiplies sigma_a and sigma_s")),
        emissionScale_(p.nonNegative("Lescale", 1, "multiplies Le") * readRadianceScale(p)) {
    if (p.describing()) return;
    if (!emission_.empty() && absorption_.empty())
      p.fail("Le", "needs \"sigma_a\", by which it goes");
    if (absorption_.empty() && scattering_.empty()) p.fail("sigma_a", "or \"sigma_s\" is needed");
    const glm::ivec3 cells = boundingCells(n);
    std::vector<Cell> bounds;
    for (int z = 0; z < cells.z; ++z)
      for (int y = 0; y < cells.y; ++y)
        for (int x = 0; x < cells.x; ++x) {
          Cell cell;
          for (const Grid* grid : {&absorption_, &scattering_}) {
            const auto [least, greatest] =
                grid->empty() ? std::pair(Spectrum(1), Spectrum(1)) : grid->range({x, y, z}, cells);
            cell.majorant += scale_ * greatest;
            cell.uniform = cell.uniform && least == greatest;
          }
          if (!emission_.empty()) {
            const auto [least, greatest] = emission_.range({x, y, z}, cells);
            cell.uniform = cell.uniform && least == greatest;
          }
          bounds.push_back(cell);
        }
    setCells(cells, std::move(bounds), !emission_.empty());
  }

  static Grid read(Params& p, const std::string& name, std::string_view meaning,
                   const glm::ivec3& n) {
    std::vector<Spectrum> values = p.spectra(name, meaning);
    if (values.empty()) return {};
    checkVoxels(p, name, n, values.size());
    for (const Spectrum& v : values) checkNonNegative(p, name, {&v.x, 3});
    return {n, std::move(values), true};
  }

  MediumPoint properties(const DPoint3& p) const override {
    const DVec3 u = (p - lo()) / (hi() - lo());
    const auto value = [&](const Grid& grid) { return grid.empty() ? Spectrum(1) : grid(u); };
    MediumPoint m{scale_ * value(absorption_), scale_ * value(scattering_), Spectrum(0)};
    if (!emission_.empty()) m.emission = m.absorption * emissionScale_ * emission_(u);
    return m;
  }

  Grid absorption_, scattering_, emission_;  // each may be empty
  float scale_, emissionScale_;
};

}  // namespace pbrt

PBRT_PLUGIN(Medium, pbrt::RgbGrid, "rgbgrid",
            "coloured smoke: absorption, scattering and glow are told voxel by voxel")
