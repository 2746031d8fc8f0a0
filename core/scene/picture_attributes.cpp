#include "core/scene/picture_attributes.h"

namespace pbrt {

std::map<std::string, ImageAttribute> pictureAttributes(const FilmInfo& info) {
  const auto samplesTo = [&](std::uint32_t end) {
    return static_cast<int>(end - info.firstSample);
  };
  auto attributes = info.attributes;
  attributes["firstSample"] = static_cast<int>(info.firstSample);
  attributes["samplesPerPixel"] = samplesTo(info.endSample);
  if (info.interrupted()) attributes["mostSamplesPerPixel"] = samplesTo(info.mostEndSample());
  attributes["renderTimeSeconds"] = info.seconds;
  return attributes;
}

}  // namespace pbrt
