// The rival OpenVDB: the exact field splatted into a sparse grid, turned into a level set, and
// traced with its LevelSetRayIntersector; one primary and at most one shadow ray a pixel.
// `rival-openvdb CLOUD VOXELS PICTURE.exr`: VOXELS in a support radius.

#include <fmt/format.h>
#include <openvdb/openvdb.h>
#include <openvdb/tools/Prune.h>
#include <openvdb/tools/RayIntersector.h>
#include <sys/resource.h>
#include <tbb/global_control.h>

#include "cloud.h"
#include "core/base/image.h"

namespace pbrt::rivals {
namespace {

using openvdb::Coord;
using openvdb::FloatGrid;
using Leaf = FloatGrid::TreeType::LeafNodeType;

double cpuSeconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

// strength (1 - r^2 / h^2)^N.
template <int N>
float falloff(float strength, float q) {
  const float a = std::max(0.F, 1 - q);
  return strength * (N == 3 ? a * a * a : a * a);
}

// Adds an atom to the voxels of one leaf. `at` is the atom's place in voxels, `inverse` 1 / h^2.
template <int N>
void splat(Leaf& leaf, const openvdb::Vec3d& at, float inverse, float strength) {
  const Coord origin = leaf.origin();
  float* values = leaf.buffer().data();
  std::array<float, Leaf::DIM> zz;
  for (int k = 0; k < 8; ++k) zz[k] = static_cast<float>(sqr(origin[2] + k - at[2]));
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j, values += 8) {
      const auto xy = static_cast<float>(sqr(origin[0] + i - at[0]) + sqr(origin[1] + j - at[1]));
      if (xy * inverse >= 1) continue;
      for (int k = 0; k < 8; ++k) values[k] += falloff<N>(strength, (xy + zz[k]) * inverse);
    }
}

template <int N>
void splat(const Cloud& cloud, double voxel, FloatGrid& grid) {
  auto accessor = grid.getAccessor();
  const double h = cloud.radius / voxel;
  const auto inverse = static_cast<float>(1 / (h * h));
  for (std::size_t n = 0; n < cloud.atoms.size(); ++n) {
    const DVec3 p = (cloud.centre(n) - cloud.eye) / voxel;
    const openvdb::Vec3d at(p.x, p.y, p.z);
    const Coord lo = Coord::floor(at - h) & ~7, hi = Coord::ceil(at + h);
    for (int x = lo.x(); x <= hi.x(); x += 8)
      for (int y = lo.y(); y <= hi.y(); y += 8)
        for (int z = lo.z(); z <= hi.z(); z += 8)
          splat<N>(*accessor.touchLeaf({x, y, z}), at, inverse, cloud.atoms[n][3]);
  }
}

// The steepest change of the field per voxel near the surface.
float steepest(const FloatGrid& grid, float threshold) {
  float most = 0;
  for (auto leaf = grid.tree().cbeginLeaf(); leaf; ++leaf) {
    const float* v = leaf->buffer().data();
    const auto along = [&](int i, int step) {
      if ((v[i] < threshold) != (v[i + step] < threshold))
        most = std::max(most, std::abs(v[i + step] - v[i]));
    };
    for (int i = 0; i < 512; ++i) {
      if (i % 8 < 7) along(i, 1);
      if (i / 8 % 8 < 7) along(i, 8);
      if (i / 64 < 7) along(i, 64);
    }
  }
  return most;
}

// Values grow with T - F. The intersector passes over voxels whose value is two voxels or more; one
// that the surface crosses is at most sqrt(3) off. So values are as distances where the field is
// steepest, less elsewhere, times 2 / sqrt(3): no crossing is passed over, and few voxels are
// active.
FloatGrid::Ptr levelSet(const Cloud& cloud, double voxel) {
  auto grid = FloatGrid::create(0);
  cloud.kernel == "blob" ? splat<2>(cloud, voxel, *grid) : splat<3>(cloud, voxel, *grid);
  const auto threshold = static_cast<float>(cloud.threshold);
  const auto reach = static_cast<float>(2 * voxel);
  const float scale = reach / (std::numbers::sqrt3_v<float> * steepest(*grid, threshold));
  for (auto leaf = grid->tree().beginLeaf(); leaf; ++leaf) {
    float* values = leaf->buffer().data();
    for (unsigned i = 0; i < Leaf::SIZE; ++i) {
      values[i] = scale * (threshold - values[i]);
      leaf->setActiveState(i, std::abs(values[i]) < reach);
    }
  }
  grid->tree().root().setBackground(scale * threshold, /*updateChildNodes=*/true);
  openvdb::tools::pruneInactive(grid->tree());
  grid->setTransform(openvdb::math::Transform::createLinearTransform(voxel));
  grid->setGridClass(openvdb::GRID_LEVEL_SET);
  return grid;
}

// The eye is the origin. Channels R, G, B, and Z: the depth, 0 where there is nothing.
Image trace(const Cloud& cloud, const FloatGrid& grid) {
  using openvdb::Vec3d;
  const auto vec = [](const DVec3& v) { return Vec3d(v.x, v.y, v.z); };
  const openvdb::tools::LevelSetRayIntersector<FloatGrid> level(grid);
  const Vec3d light = vec(cloud.light - cloud.eye);
  const double voxel = grid.voxelSize()[0];
  Image image;
  image.window = {Point2i(0), Point2i(cloud.pixels)};
  image.resolution = Point2i(cloud.pixels);
  image.names = {"R", "Z"};
  image.channels.assign(2, std::vector<float>(static_cast<std::size_t>(sqr(cloud.pixels))));
  for (int y = 0, i = 0; y < cloud.pixels; ++y)
    for (int x = 0; x < cloud.pixels; ++x, ++i) {
      Vec3d d = vec(cloud.direction(x, y)), p, n;
      d.normalize();
      if (!level.intersectsWS({Vec3d(0), d}, p, n)) continue;
      image.channels[1][i] = static_cast<float>(p[2]);
      const Vec3d start = p + 0.5 * voxel * n;
      Vec3d w = light - start;
      const double distance = w.length(), cosine = n.dot(w) / distance;
      w /= distance;
      if (cosine > 0 && !level.intersectsWS({start, w, 0, distance}))
        image.channels[0][i] = static_cast<float>(0.5 * cosine);
    }
  image.names = {"R", "G", "B", "Z"};
  image.channels = {image.channels[0], image.channels[0], image.channels[0], image.channels[1]};
  return image;
}

void run(const std::string& file, double voxels, const std::string& picture) {
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  openvdb::initialize();
  const double begun = cpuSeconds();
  const Cloud cloud = readCloud(file);
  const double read = cpuSeconds();
  const FloatGrid::Ptr grid = levelSet(cloud, cloud.radius / voxels);
  const double built = cpuSeconds();
  const Image image = trace(cloud, *grid);
  const double traced = cpuSeconds();
  writeImage(picture, image);
  fmt::print("seconds read {:.3f} build {:.3f} trace {:.3f}\n", read - begun, built - read,
             traced - built);
}

}  // namespace
}  // namespace pbrt::rivals

int main(int argc, char** argv) {
  try {
    if (argc != 4) throw pbrt::Error("rival-openvdb CLOUD VOXELS PICTURE.exr");
    pbrt::rivals::run(argv[1], std::stod(argv[2]), argv[3]);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
