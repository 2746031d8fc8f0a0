#include "core/plugin/medium_params.h"
#include "core/plugin/plugin.h"
#include "core/plugin/voxel_grid.h"

namespace pbrt {

class VolumeGrid final : public Medium {
 public:
  VolumeGrid(Params& p, const Setup& setup)
      : VolumeGrid(p, setup, readMedium(p), readMediumBox(p), readVoxels(p)) {}

 private:
  VolumeGrid(Params& p, const Setup& setup, const MediumParams& medium, const MediumBox& box,
             const glm::ivec3& n)
      : Medium(setup, medium.g, box.lo, box.hi), unit_(medium.unit) {
    std::vector<float> density =
        readDensities(p, "density", "of each voxel, in its middle; x goes fastest");
    checkVoxels(p, "density", n, density.size());
    if (p.describing()) return;
    density_ = VoxelGrid<float>(n, std::move(density), false);
    const glm::ivec3 cells = boundingCells(n);
    setCells(cells, boundsOf(density_, cells, unit_.extinction()), !isBlack(unit_.emission));
  }

  MediumPoint properties(const DPoint3& p) const override {
    return unit_ * density_((p - lo()) / (hi() - lo()));
  }

  MediumPoint unit_;
  VoxelGrid<float> density_;
};

}  // namespace pbrt

PBRT_PLUGIN(Medium, pbrt::VolumeGrid, "volumegrid",
            "smoke whose density is told voxel by voxel, with sharp borders")
