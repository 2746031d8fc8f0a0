#pragma once
// Variants measured as pbrt-converge does, from scenes of files or text.

#include "tests/command.h"
#include "tests/support.h"
#include "tests/tools/stripes.h"
#include "tools/converge/measure.h"

namespace pbrt::test {

inline constexpr const char* kScenes = PBRT_SOURCE_DIR "/scenes/";

inline Variant variantOf(const std::filesystem::path& scene, const std::string& change = "",
                         int width = 0) {
  BuildOptions options;
  options.aovs = kVariance;
  if (width > 0) options.width = width;
  return buildVariant(scene, readChange(change), loader(), options);
}

inline Variant variantOfText(const std::string& scene, const std::string& change = "") {
  const Folder folder;
  folder.write("scene.pbrt", scene);
  return variantOf(folder.path() / "scene.pbrt", change);
}

// A picture that is right, of one value.
inline Reference exact(int size, float value) {
  Image image{.window = {{0, 0}, {size, size}}, .resolution = {size, size}};
  for (const char* name : {"R", "G", "B"}) {
    image.names.emplace_back(name);
    image.channels.emplace_back(static_cast<std::size_t>(size * size), value);
  }
  const Folder folder;
  writeImage(folder.path() / "right.exr", image);
  return readReference(folder.path() / "right.exr");
}

inline std::vector<Curve> measureAll(const std::vector<Variant>& variants,
                                     const Reference& reference, const Plan& plan) {
  return measure(variants, std::vector<const Reference*>(variants.size(), &reference), plan,
                 [](const std::string&) {});
}

inline Curve measureOne(Variant variant, const Reference& reference, const Plan& plan) {
  std::vector<Variant> one;
  one.push_back(std::move(variant));
  return std::move(measureAll(one, reference, plan)[0]);
}

// The mean over seeds of the slope of log RMSE against log samples, less the reference's error.
inline Estimate slopeAgainstSamples(const Curve& curve, double referenceMse = 0) {
  std::vector<double> slopes;
  for (std::size_t seed = 0; seed < curve.snapshots[0].runs.size(); ++seed) {
    std::vector<double> x, y;
    for (const Snapshot& s : curve.snapshots) {
      x.push_back(std::log(s.runs[seed].samples));
      y.push_back(0.5 * std::log(s.runs[seed].errors.mse - referenceMse));
    }
    slopes.push_back(slopeOf(x, y).value().value);
  }
  return meanOf(slopes);
}

inline double meanMse(const Snapshot& s) {
  return s.mean([](const Run& r) { return r.errors.mse; }).value;
}

}  // namespace pbrt::test
