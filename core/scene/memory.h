#pragma once
// What the parts of a scene hold of the memory.

#include <memory>
#include <string_view>
#include <vector>

namespace pbrt {

class Scene;

struct MemoryPart {
  std::string_view name;
  double bytes = 0;  // not below 0
};

// Frees a scene part by part, and tells how much memory that gave back: measured at the end, it
// costs the scene nothing while it is built and rendered. What others hold as well does not count.
// The last part is what was free already.
// No other thread may allocate meanwhile.
std::vector<MemoryPart> takeApart(std::unique_ptr<Scene> scene);

}  // namespace pbrt
