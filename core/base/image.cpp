#include "core/base/image.h"

#include <fmt/format.h>

#include <cctype>

#include "core/base/error.h"
#include "core/base/file.h"
#include "core/base/image_format.h"
#include "core/base/memory_limit.h"
#include "core/base/replacement.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

std::string suffixOf(const fs::path& file) {
  std::string suffix = file.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix;
}

bool isWritable(const std::string& suffix) {
  return suffix == ".exr" || suffix == ".png";
}

// What a scene calls its picture may be a link that came with it: no other file is overwritten.
auto encoderFor(const fs::path& file) {
  const auto refuse = [&](const std::string& reason) {
    throw Error(fmt::format("cannot write {}: {} must end in .exr or .png", file.string(), reason),
                Failure::io);
  };
  const std::string suffix = suffixOf(file);
  if (!isWritable(suffix)) refuse("its name");
  const fs::path target = throughLinks(file);
  if (!isWritable(suffixOf(target)))
    refuse(fmt::format("it is a link to {}, whose name", target.string()));
  return suffix == ".exr" ? encodeExr : encodePng;
}

auto decoderFor(const fs::path& file) {
  const std::string suffix = suffixOf(file);
  if (suffix == ".png") return decodePng;
  if (suffix == ".tga") return decodeTga;
  if (suffix == ".hdr") return decodeHdr;
  if (suffix == ".pfm") return decodePfm;
  throw Error(fmt::format("cannot read {}: its name must end in .exr, .hdr, .pfm, .png or .tga",
                          file.string()),
              Failure::io);
}

// Clamped to [0, 1]; not a number is 0.
float clamp01(float x) {
  return x > 0 ? std::min(x, 1.F) : 0.F;
}

}  // namespace

float encodeSrgb(float linear) {
  const float x = clamp01(linear);
  return x <= 0.0031308F ? 12.92F * x : 1.055F * std::pow(x, 1 / 2.4F) - 0.055F;
}

float decodeSrgb(float code) {
  return code <= 0.04045F ? code / 12.92F : std::pow((code + 0.055F) / 1.055F, 2.4F);
}

void checkRoom(std::size_t values, std::size_t bytes, std::size_t densest) {
  if (values / densest > bytes)
    throw std::runtime_error("the file is too short for the size of its picture");
  if (values > halfOfMemory() / sizeof(float))
    throw std::runtime_error("the picture is too large for the memory of this machine");
}

Image blankImage(Point2i size, int channels, std::size_t bytes, std::size_t densest) {
  if (size.x <= 0 || size.y <= 0) throw std::runtime_error("the picture has no pixels");
  const std::size_t count = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  checkRoom(count * static_cast<std::size_t>(channels), bytes, densest);
  Image image;
  image.window = {Point2i(0), size};
  image.resolution = size;
  image.names =
      channels >= 3 ? std::vector<std::string>{"R", "G", "B"} : std::vector<std::string>{"Y"};
  if (channels % 2 == 0) image.names.emplace_back("A");
  image.channels.assign(image.names.size(), std::vector<float>(count));
  return image;
}

Image readImage(const fs::path& file) {
  if (suffixOf(file) == ".exr") return readExr(file);
  const auto decode = decoderFor(file);
  const std::string bytes = readFile(file);
  try {
    return decode(bytes);
  } catch (const std::exception& error) {
    throw Error(fmt::format("cannot read {}: {}", file.string(), reasonOf(error)), Failure::io);
  }
}

const std::vector<float>* Image::channel(std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? nullptr : &channels[found - names.begin()];
}

double Image::number(std::string_view name, double otherwise) const {
  const auto found = attributes.find(std::string(name));
  if (found == attributes.end()) return otherwise;
  return std::visit(
      [&](const auto& value) {
        if constexpr (std::is_arithmetic_v<std::decay_t<decltype(value)>>)
          return static_cast<double>(value);
        else
          return otherwise;
      },
      found->second);
}

void writeImage(const fs::path& file, const Image& image) {
  const auto encode = encoderFor(file);
  replaceFile(file, [&](std::FILE* stream) { encode(stream, image); });
}

void checkWritable(const fs::path& file) {
  encoderFor(file);
  checkReplaceable(file);
}

}  // namespace pbrt
