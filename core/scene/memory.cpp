#include "core/scene/memory.h"

#include <malloc.h>

#include <algorithm>
#include <fstream>
#include <string>

#include "core/scene/scene.h"

namespace pbrt {

namespace {

// Memory in use that is of no file, as the kernel counts it page by page; 0 if it does not. (Pages
// of files come and go on their own: to free things runs code that was not needed before.)
double anonymousBytes() {
  constexpr std::string_view kName = "Anonymous:";
  std::ifstream status("/proc/self/smaps_rollup");  // counted, where others estimate
  for (std::string line; std::getline(status, line);)
    if (line.starts_with(kName)) return 1024 * std::stod(line.substr(kName.size()));
  return 0;
}

// The heap of all arenas, and what is not on it: Embree has large blocks from the system itself.
struct Reading {
  const struct mallinfo2 info = mallinfo2();
  const double own = static_cast<double>(info.hblkhd);  // blocks with pages of their own
  const double used = static_cast<double>(info.uordblks) + own;
  const double free = static_cast<double>(info.fordblks);  // and not given back to the system
  const double outside = anonymousBytes() - static_cast<double>(info.arena) - own;
};

}  // namespace

std::vector<MemoryPart> takeApart(std::unique_ptr<Scene> scene) {
  const Reading start;
  std::vector<Group*> groups = {&scene->root_};
  for (const auto& object : scene->objects_) groups.push_back(object.get());

  std::vector<MemoryPart> parts;
  const auto measure = [&](std::string_view name, const auto& free) {
    const Reading before;
    free();
    const Reading after;
    const double freed = before.used - after.used + before.outside - after.outside;
    parts.push_back({name, std::max(freed, 0.0)});
  };
  const auto eachGeometry = [&](const auto& free) {
    for (Group* group : groups)
      for (const auto& g : group->geometries) free(*g);
  };
  measure("film", [&] { scene->film_.reset(); });
  measure("integrator, camera, sampler, filter", [&] {
    scene->integrator_.reset();
    scene->surfaceIntegrator_.reset();
    scene->ownCamera_.reset();
    scene->makeSampler_ = nullptr;
    scene->sampler_.reset();
    scene->filter_.reset();
  });
  measure("lights", [&] {
    eachGeometry([](Geometry& g) {
      g.light.reset();
      g.sampler.reset();
    });
    scene->ownLights_.clear();
    scene->lightTree_ = {};
    scene->lightPowers_ = {};
  });
  measure("materials and textures", [&] {
    eachGeometry([](Geometry& g) {
      g.material.reset();
      g.cutout.reset();
    });
  });
  measure("media", [&] {
    scene->media_.clear();
    scene->interfaces_.clear();
  });
  measure("shapes", [&] {
    for (Group* group : groups) group->geometries.clear();
  });
  measure("ray trees and instances", [&] { scene.reset(); });
  parts.push_back({"text of the scene, and what else there is", Reading().used});
  parts.push_back({"freed, for new use", start.free});
  return parts;
}

}  // namespace pbrt
