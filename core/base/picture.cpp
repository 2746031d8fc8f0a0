#include "core/base/picture.h"

#include <fmt/format.h>

#include "core/base/error.h"

namespace pbrt {

std::array<const std::vector<float>*, 3> colorChannels(const Image& image,
                                                       const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& what) {
    throw Error(fmt::format("cannot use {}: {}", file.string(), what), Failure::io);
  };
  std::array<const std::vector<float>*, 3> channels = {image.channel("R"), image.channel("G"),
                                                       image.channel("B")};
  if (!channels[0] || !channels[1] || !channels[2]) {
    const std::vector<float>* grey = image.channel("Y");
    if (!grey && image.channels.size() == 1) grey = &image.channels[0];
    if (!grey) refuse("the picture has no channels R, G and B");
    channels = {grey, grey, grey};
  }
  for (const auto* channel : channels) {
    const auto bad = std::ranges::find_if(*channel, [](float v) { return !std::isfinite(v); });
    if (bad == channel->end()) continue;
    const auto i = bad - channel->begin();
    refuse(fmt::format("pixel {} {} (the first is 0 0) is not finite", i % image.window.width(),
                       i / image.window.width()));
  }
  return channels;
}

Picture::Picture(const std::filesystem::path& file) {
  const Image image = readImage(file);
  const auto channels = colorChannels(image, file);
  width_ = image.window.width();
  height_ = image.window.height();
  pixels_.resize(channels[0]->size());
  for (std::size_t i = 0; i < pixels_.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      const float v = std::max(0.F, (*channels[c])[i]);
      pixels_[i][c] = image.encoded ? decodeSrgb(v) : v;
    }
}

}  // namespace pbrt
