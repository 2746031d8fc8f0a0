#pragma once
// Pictures for lights to shine through.

#include "core/base/image.h"
#include "tests/command.h"

namespace pbrt::test {

// Writes an EXR of grey values, rows from the top.
inline std::string greyPicture(const Folder& folder, const std::string& name, int width,
                               const std::vector<float>& values) {
  Image image;
  image.resolution = {width, static_cast<int>(values.size()) / width};
  image.window = {{0, 0}, image.resolution};
  image.names = {"R", "G", "B"};
  image.channels = {values, values, values};
  const auto file = folder.path() / name;
  writeImage(file, image);
  return file.string();
}

}  // namespace pbrt::test
