#include "core/scene/memory.h"

#include <malloc.h>

#include "core/scene/scene.h"

namespace pbrt {

namespace {

// Of all arenas: what is in use, with the blocks that have pages of their own, and what is free and
// not given back to the system.
struct Heap {
  const struct mallinfo2 info = mallinfo2();
  double used = static_cast<double>(info.uordblks) + static_cast<double>(info.hblkhd);
  double free = static_cast<double>(info.fordblks);
};

}  // namespace

std::vector<MemoryPart> takeApart(std::unique_ptr<Scene> scene) {
  // Embree has large blocks from the system itself, and small ones, which count twice, from the
  // heap.
  const auto trees = static_cast<double>(scene->device_.bytes());
  const Heap start;
  std::vector<Group*> groups = {&scene->root_};
  for (const auto& object : scene->objects_) groups.push_back(object.get());

  std::vector<MemoryPart> parts;
  const auto measure = [&](std::string_view name, const auto& free) {
    const Heap before;
    free();
    parts.push_back({name, before.used - Heap().used});
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
  parts.back().bytes += trees;
  parts.push_back({"text of the scene, and what else there is", Heap().used});
  parts.push_back({"freed, for new use", start.free});
  return parts;
}

}  // namespace pbrt
