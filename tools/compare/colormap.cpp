#include "tools/compare/colormap.h"

#include "core/base/error.h"

namespace pbrt {

namespace {

// Every fifteenth of the 256 colours of "magma", as sRGB code values, by Nathaniel Smith and Stefan
// van der Walt (matplotlib 2015, CC0). Its lightness grows evenly with the value, for eyes that see
// few colours too. Straight lines between these stay within 0.012 of the others.
constexpr int kCount = 18;
constexpr float kMagma[kCount][3] = {
    {0.0015F, 0.0005F, 0.0139F}, {0.0355F, 0.0284F, 0.1252F}, {0.1028F, 0.0630F, 0.2579F},
    {0.1915F, 0.0648F, 0.3962F}, {0.2914F, 0.0646F, 0.4755F}, {0.3843F, 0.0979F, 0.5010F},
    {0.4758F, 0.1346F, 0.5079F}, {0.5692F, 0.1675F, 0.5041F}, {0.6649F, 0.1981F, 0.4888F},
    {0.7611F, 0.2312F, 0.4602F}, {0.8521F, 0.2761F, 0.4186F}, {0.9259F, 0.3468F, 0.3750F},
    {0.9697F, 0.4469F, 0.3603F}, {0.9894F, 0.5579F, 0.3917F}, {0.9966F, 0.6683F, 0.4562F},
    {0.9967F, 0.7768F, 0.5410F}, {0.9924F, 0.8843F, 0.6401F}, {0.9871F, 0.9914F, 0.7495F}};

}  // namespace

Image heatMap(const std::vector<float>& values, int width, int height) {
  const Bounds2i window{{0, 0}, {width, height}};
  if (window.empty() ||
      values.size() != static_cast<std::size_t>(width) * static_cast<std::size_t>(height))
    throw Error("a picture of errors needs one error per pixel", Failure::usage);
  Image image{window, window.hi, {"R", "G", "B"}, {{}, {}, {}}, {}};
  for (const float value : values) {
    const float position = (value <= 1 ? std::max(value, 0.F) : 1.F) * (kCount - 1);
    const int i = std::min(static_cast<int>(position), kCount - 2);
    for (int c = 0; c < 3; ++c)
      image.channels[c].push_back(
          decodeSrgb(lerp(position - static_cast<float>(i), kMagma[i][c], kMagma[i + 1][c])));
  }
  return image;
}

}  // namespace pbrt
