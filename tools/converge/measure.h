#pragma once
// Renders variants at growing numbers of samples, in turns, and measures each picture against its
// reference.

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "fit.h"
#include "tools/compare/metrics.h"
#include "variant.h"

namespace pbrt {

// Means of the picture's blocks and, last, of the whole of it, over R, G and B; and their variances
// as the picture itself states them, taking the noise of the three channels to be the same.
struct Blocks {
  Blocks() = default;
  explicit Blocks(const Image& image);

  std::vector<double> mean, variance;
};

struct Reference {
  std::string scene;                     // what it is a picture of
  std::string description;               // where it comes from
  std::optional<std::uint32_t> samples;  // per pixel
  std::optional<double> mse;             // expected, of itself
  std::uint64_t badSamples = 0;          // as in RenderControl
  Image image;
  Blocks blocks;
};

// A picture of one seed.
struct Run {
  std::uint32_t samples = 0;  // per pixel
  double seconds = 0, cpuSeconds = 0;
  std::uint64_t rays = 0;
  Errors errors;
  double flip = 0;
};

// Pictures of the same number of samples (or the same time) with different seeds.
struct Snapshot {
  std::vector<Run> runs;
  Image picture;                    // of the first seed
  std::optional<double> biasShare;  // of blocks whose mean over the seeds is 3 sigma off
  std::optional<double> biasZ;      // of the whole picture, in standard errors

  // Over the runs.
  Estimate mean(const std::function<double(const Run&)>& value) const;
};

struct Curve {
  std::vector<Snapshot> snapshots;
  // Of log RMSE, less the reference's own error, against log seconds: the mean over seeds if there
  // are several. Empty if fewer than three points stand out of the reference's noise.
  std::optional<Estimate> slope;
  int slopePoints = 0;
  std::uint64_t badSamples = 0;  // of all renders, as in RenderControl
  double renderSeconds = 0;      // of all of them
  double pictureSeconds = 0;     // for taking pictures from the film, which is no rendering
};

struct Plan {
  std::vector<std::uint32_t> samples;  // of the snapshots; empty if `times` tells
  std::vector<double> times;           // render seconds at the snapshots
  bool progressive = false;  // snapshots of one growing render; else a render for each of them
  std::uint64_t firstSeed = 1;
  int seeds = 1;
  int threads = 0;
  // Textures are filtered for so many samples per pixel in all snapshots, as in the reference:
  // otherwise they would not all converge to the same picture. 0: for the scene's own number.
  std::uint32_t textureSamples = 0;
};

// One curve per variant; references[i] is that of variant i. Seed after seed, and for each number
// of samples every variant in turn: what else the machine does hurts all variants alike, and shows
// in the spread of the seeds. `said` is called with what was done.
std::vector<Curve> measure(const std::vector<Variant>& variants,
                           const std::vector<const Reference*>& references, const Plan& plan,
                           const std::function<void(const std::string&)>& said);

// Renders two halves with seeds of their own; how they differ tells the error of their mean.
Reference renderReference(const Variant& variant, std::uint32_t samples, int threads);
// From an EXR file. Its error is known if it states its variance and was taken from two samples at
// least. Throws Error, Failure::io, if it cannot be read or holds no finite R, G and B.
Reference readReference(const std::filesystem::path& file);

}  // namespace pbrt
