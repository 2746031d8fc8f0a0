#pragma once
// A scene of which frames are rendered.

#include <fmt/format.h>

#include "core/base/image.h"
#include "tests/command.h"

namespace pbrt::test {

inline std::string scene(const std::string& world, int side = 8) {
  return fmt::format(
      "LookAt 0 -6 2  0 0 0  0 0 1\nCamera \"perspective\" \"float shutterclose\" 0\n"
      "Film \"image\" \"integer xresolution\" {} \"integer yresolution\" {}\n"
      "Sampler \"random\" \"integer pixelsamples\" 2\nIntegrator \"whitted\"\nWorldBegin\n"
      "LightSource \"point\" \"rgb I\" [40 40 40] \"point from\" [3 -5 6]\nMaterial "
      "\"matte\"\n{}\nWorldEnd\n",
      side, side, world);
}

class Frames : public testing::Test {
 protected:
  void SetUp() override { folder.write("scene.pbrt", scene("Shape \"sphere\"")); }

  auto channels(const std::string& name) const { return readExr(folder.path() / name).channels; }
  bool there(const std::string& name) const {
    return std::filesystem::exists(folder.path() / name);
  }

  Folder folder;
};

}  // namespace pbrt::test
