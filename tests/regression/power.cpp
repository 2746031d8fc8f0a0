// What the regression renders of scenes/ are worth: `regression-power [SEEDS [SPP]]` renders each
// scene with SEEDS other seeds (default 24) and SPP samples per pixel (default 64), holds the
// pictures to the golden ones, and prints a table:
//   alarms    pictures that do not pass, though nothing changed
//   1 %       pictures that do not pass with 1 % more light, and with 1 % less
//   seen      the least change of all light that does not pass, in percent; median and largest

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>

#include "core/base/error.h"
#include "tools/compare/ztest.h"

namespace pbrt {
namespace {

namespace fs = std::filesystem;

Image render(const fs::path& scene, int seed, int samples, const fs::path& picture) {
  const std::string command =
      fmt::format("'{}' '{}' --quiet --width 64 --spp {} --seed {} --aov variance --outfile '{}'",
                  PBRT_BUILD_DIR "/bin/pbrt", scene.string(), samples, seed, picture.string());
  if (std::system(command.c_str()) != 0) throw Error("failed: " + command);
  return readExr(picture);
}

// The picture if there were `factor` times as much light: radiance is linear in it.
Image brightened(Image image, double factor) {
  for (std::size_t c = 0; c < image.names.size(); ++c) {
    if (image.names[c] == "A") continue;
    const bool variance = image.names[c].starts_with("Variance.");
    for (float& v : image.channels[c])
      v = static_cast<float>(v * (variance ? factor * factor : factor));
  }
  return image;
}

bool passes(const Image& golden, const Image& image, double factor) {
  return zTest(golden, brightened(image, factor)).value().agree();
}

// The least relative change that does not pass, by bisection to a hundredth of it; the larger one
// of more and less light.
double leastSeen(const Image& golden, const Image& image) {
  double worst = 0;
  for (const double sign : {1.0, -1.0}) {
    double below = 0, above = 0.5;
    while (above - below > 0.01 * above) {
      const double middle = (below + above) / 2;
      (passes(golden, image, 1 + sign * middle) ? below : above) = middle;
    }
    worst = std::max(worst, above);
  }
  return worst;
}

void measure(const fs::path& scene, int seeds, int samples) {
  const fs::path golden = fs::path(PBRT_SOURCE_DIR "/tests/golden") / scene.stem().concat(".exr");
  const Image reference = readExr(golden);
  const fs::path picture = fs::temp_directory_path() / fmt::format("pbrt-power-{}.exr", getpid());
  int alarms = 0, more = 0, less = 0;
  std::vector<double> seen;
  for (int i = 0; i < seeds; ++i) {
    const Image image = render(scene, 1000 + i, samples, picture);
    alarms += !passes(reference, image, 1);
    more += !passes(reference, image, 1.01);
    less += !passes(reference, image, 0.99);
    seen.push_back(100 * leastSeen(reference, image));
  }
  fs::remove(picture);
  std::sort(seen.begin(), seen.end());
  fmt::print("| {} | {} | {} | {} | {:.2f} | {:.2f} |\n", scene.stem().string(), alarms, more, less,
             seen[seen.size() / 2], seen.back());
  std::fflush(stdout);
}

void run(int seeds, int samples) {
  std::vector<fs::path> scenes;
  for (const auto& entry : fs::directory_iterator(PBRT_SOURCE_DIR "/scenes"))
    if (entry.path().extension() == ".pbrt") scenes.push_back(entry.path());
  std::sort(scenes.begin(), scenes.end());
  fmt::print("{} seeds, {} samples per pixel\n\n", seeds, samples);
  fmt::print("| scene | alarms | 1 % more | 1 % less | seen, % | largest |\n");
  fmt::print("| --- | --- | --- | --- | --- | --- |\n");
  for (const fs::path& scene : scenes) measure(scene, seeds, samples);
}

}  // namespace
}  // namespace pbrt

int main(int argc, char** argv) {
  try {
    pbrt::run(argc > 1 ? std::atoi(argv[1]) : 24, argc > 2 ? std::atoi(argv[2]) : 64);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
