#include "core/scene/render_key.h"

#include <fmt/format.h>

#include <vector>

#include "core/plugin/loader.h"
#include "core/scene/dialect.h"
#include "core/scene/scene.h"

namespace pbrt {

RenderKey renderKey(const Scene& scene, Dialect dialect, bool permissive,
                    const PluginLoader& plugins, std::uint64_t files) {
  const Film& film = scene.film();
  std::string settings = fmt::format("pbrt-{}, {} x {} pixels", dialectName(dialect),
                                     film.resolution().x, film.resolution().y);
  std::vector<std::string_view> stored;
  for (const std::string_view name : aovNames())
    if (film.stores(*aovByName(name))) stored.push_back(name);
  if (!stored.empty()) settings += fmt::format(", stored: {}", fmt::join(stored, " "));
  const auto& attributes = scene.attributes();
  if (const auto time = attributes.find("sceneTime"); time != attributes.end())
    settings += fmt::format(", at {} s", std::get<double>(time->second));
  if (permissive) settings += ", permissive";
  return {files, plugins.programs(), scene.seed(), scene.sampler().samplesPerPixel(), settings};
}

std::string difference(const RenderKey& wanted, const RenderKey& found) {
  std::vector<std::string> all;
  if (found.scene != wanted.scene)
    all.emplace_back("it is of another scene, or a file that the scene names has changed");
  if (found.programs != wanted.programs)
    all.emplace_back("it was made by another build of pbrt or of its plug-ins");
  if (found.seed != wanted.seed)
    all.push_back(fmt::format("it has another seed: {}, not {}", found.seed, wanted.seed));
  if (found.samplesPerPixel != wanted.samplesPerPixel)
    all.push_back(fmt::format("its sampler spreads {} samples over a pixel, not {}",
                              found.samplesPerPixel, wanted.samplesPerPixel));
  if (found.settings != wanted.settings)
    all.push_back(fmt::format("it is {}, not {}", found.settings, wanted.settings));
  return fmt::format("{}", fmt::join(all, "; "));
}

std::string instructionSet() {
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512f")) return "avx512";
  if (__builtin_cpu_supports("avx2")) return "avx2";
  if (__builtin_cpu_supports("avx")) return "avx";
#endif
  return "sse";
}

}  // namespace pbrt
