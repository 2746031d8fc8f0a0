#pragma once
// What the fuzzers and the test feed.

#include <stdexcept>
#include <string>

#include "core/plugin/loader.h"

namespace pbrt::fuzz {

// A law that holds for every input does not hold for this one.
class BrokenLaw : public std::logic_error {
  using std::logic_error::logic_error;
};

// Any bytes are a scene, or are refused with an Error: parsed, printed anew, built with the
// plug-ins of this build, and a few pixels of it rendered. What is refused is tried once more as
// --permissive does.
//
// An input may bring a file along that the scene can name: after a line `#file.SUFFIX` (small
// letters) the rest of the bytes are that file's. Its first line may be `# v1` to `# v4`: what
// --dialect says.
class SceneTarget {
 public:
  // Opens all plug-ins, so that the engines know all code before the first input.
  SceneTarget();

  // Writes the file of the input into the working directory, and takes it away again. Returns
  // whether it is a scene, without errors. Throws BrokenLaw; whatever else it throws is a bug, too.
  bool run(const std::string& input);

 private:
  PluginLoader loader_;
};

}  // namespace pbrt::fuzz
