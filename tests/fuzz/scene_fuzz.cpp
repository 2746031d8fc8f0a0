// The target of the fuzzing engines, for libFuzzer's interface, which AFL++ has as well.

#include <cstdint>

#include "tests/fuzz/scene_target.h"

namespace {

pbrt::fuzz::SceneTarget& target() {
  static pbrt::fuzz::SceneTarget t;
  return t;
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int*, char***) {
  target();
  return 0;
}

// An exception that leaves it is a find.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  target().run({data, data + size});
  return 0;
}
