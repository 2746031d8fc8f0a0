#include "core/base/image.h"

#include <fmt/format.h>

#include <cctype>

#include "core/base/error.h"
#include "core/base/image_format.h"
#include "core/base/replacement.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

auto encoderFor(const fs::path& file) {
  std::string suffix = file.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (suffix == ".exr") return encodeExr;
  if (suffix == ".png") return encodePng;
  throw Error(fmt::format("cannot write {}: its name must end in .exr or .png", file.string()),
              Failure::io);
}

}  // namespace

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
