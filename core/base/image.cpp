#include "core/base/image.h"

#include <fmt/format.h>

#include <cctype>

#include "core/base/error.h"
#include "core/base/image_format.h"
#include "core/base/replacement.h"

namespace fs = std::filesystem;

namespace pbrt {

namespace {

[[noreturn]] void cannotWrite(const fs::path& file, std::string_view why) {
  throw Error(fmt::format("cannot write {}: {}", file.string(), why), Failure::io);
}

auto encoderFor(const fs::path& file) {
  std::string suffix = file.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  if (suffix == ".exr") return encodeExr;
  if (suffix == ".png") return encodePng;
  throw std::runtime_error("its name must end in .exr or .png");
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

void writeImage(const fs::path& file, const Image& image) try {
  const auto encode = encoderFor(file);
  Replacement replacement(file);
  encode(replacement.stream(), image);
  replacement.commit();
} catch (const std::exception& error) {
  cannotWrite(file, error.what());
}

void checkWritable(const fs::path& file) try {
  encoderFor(file);
  Replacement replacement(file);
} catch (const std::exception& error) {
  cannotWrite(file, error.what());
}

}  // namespace pbrt
