#pragma once
// The texture imagemap over pictures of the test's own.

#include "core/base/rng.h"
#include "tests/command.h"
#include "tests/support.h"

namespace pbrt::test {

// (u, v) with a footprint.
inline SurfaceInteraction at(float u, float v, Vec2 dx = Vec2(0), Vec2 dy = Vec2(0)) {
  SurfaceInteraction s;
  s.uv = {u, v};
  s.dudx = dx.x;
  s.dvdx = dx.y;
  s.dudy = dy.x;
  s.dvdy = dy.y;
  return s;
}

// Makes imagemap over pictures. They are PFM, whose values are exact, where the format is not the
// point.
class ImageMap : public testing::Test {
 protected:
  // A grey picture, rows from the top.
  std::string grey(const std::string& name, int w, const std::vector<float>& values) const {
    const int h = static_cast<int>(values.size()) / w;
    std::string text = "Pf " + std::to_string(w) + " " + std::to_string(h) + " -1\n";
    for (int y = h - 1; y >= 0; --y)
      text.append(reinterpret_cast<const char*>(&values[static_cast<std::size_t>(y * w)]),
                  static_cast<std::size_t>(w) * 4);
    folder.write(name, text);
    return (folder.path() / name).string();
  }
  template <class T = float>
  static std::unique_ptr<Texture<T>> texture(const std::string& file, ParamList list = {}) {
    list.push_back(text("filename", file));
    return make<Texture<T>>("imagemap", list);
  }
  std::vector<float> noise(int n) const {
    Rng rng(7);
    std::vector<float> values;
    for (int i = 0; i < n; ++i) values.push_back(rng.uniform());
    return values;
  }
  Folder folder;
};

}  // namespace pbrt::test
