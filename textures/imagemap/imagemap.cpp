#include <fast_float/fast_float.h>
#include <fmt/format.h>

#include <compare>
#include <map>
#include <mutex>

#include "core/plugin/mapping_params.h"
#include "core/plugin/plugin.h"
#include "textures/imagemap/jpeg.h"
#include "textures/imagemap/mipmap.h"

namespace pbrt {

namespace {

bool isJpeg(const std::filesystem::path& file) {
  std::string suffix = file.extension().string();
  for (char& c : suffix) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return suffix == ".jpg" || suffix == ".jpeg";
}

// What pbrt-v3's "gamma" and pbrt-v4's "encoding" say of the curve that is undone.
struct Decoding {
  std::optional<float> gamma;  // as in makeMipMap; none: the sRGB curve, of code values
  bool ofCodes = true;         // what is light already stays as it is
  auto operator<=>(const Decoding&) const = default;
};

// The map of a file, which all textures that name it share as long as one of them lives.
std::shared_ptr<const MipMap> sharedMipMap(const std::filesystem::path& file,
                                           const Decoding& decoding) {
  static std::mutex mutex;
  static std::map<std::pair<std::string, Decoding>, std::weak_ptr<const MipMap>> maps;
  const std::lock_guard lock(mutex);
  std::weak_ptr<const MipMap>& known = maps[{std::filesystem::canonical(file).string(), decoding}];
  std::shared_ptr<const MipMap> map = known.lock();
  if (!map) {
    const Image image = isJpeg(file) ? readJpeg(file) : readImage(file);
    const bool decodes = image.encoded || !decoding.ofCodes;
    map = makeMipMap(image, decodes ? decoding.gamma.value_or(kSrgbCurve) : 1, file);
    known = map;
  }
  return map;
}

Decoding readDecoding(Params& p) {
  Decoding decoding;
  if (p.available("gamma") || p.describing())
    decoding = {p.flag("gamma", true,
                       "whether the sRGB curve is undone; if nothing is said it is for files of "
                       "code values: .png, .tga and .jpg")
                    ? kSrgbCurve
                    : 1,
                false};
  const std::string encoding =
      p.text("encoding", "", "of files of code values: \"sRGB\", \"linear\" or \"gamma 2.2\"");
  if (encoding.empty()) return decoding;
  if (encoding == "sRGB") return {kSrgbCurve, true};
  if (encoding == "linear") return {1, true};
  float power = 0;
  const char* end = encoding.data() + encoding.size();
  if (!encoding.starts_with("gamma ") ||
      fast_float::from_chars(encoding.data() + 6, end, power).ptr != end ||
      !(power > 0 && power < 100))
    p.fail("encoding", fmt::format("must be \"sRGB\", \"linear\" or \"gamma\" and an exponent, as "
                                   "\"gamma 2.2\", not \"{}\"",
                                   encoding));
  return {power, true};
}

Lookup readLookup(Params& p) {
  Lookup how;
  constexpr std::string_view wraps[] = {"repeat", "black", "clamp", "octahedralsphere"};
  const std::string wrap =
      p.choice("wrap", wraps, "repeat", "what lies beyond the picture's edges");
  how.wrap = wrap == "repeat"  ? Wrap::repeat
             : wrap == "black" ? Wrap::black
             : wrap == "clamp" ? Wrap::clamp
                               : Wrap::octahedral;
  const bool trilinear = p.flag("trilinear", false, "takes \"trilinear\" for \"filter\"");
  constexpr std::string_view filters[] = {"point", "bilinear", "trilinear", "ewa"};
  const std::string filter =
      p.choice("filter", filters, trilinear ? "trilinear" : "ewa",
               "how a pixel's footprint is averaged, from the fastest to the sharpest");
  how.filter = filter == "point"       ? TexelFilter::point
               : filter == "bilinear"  ? TexelFilter::bilinear
               : filter == "trilinear" ? TexelFilter::trilinear
                                       : TexelFilter::ewa;
  how.maxAnisotropy = p.inRange("maxanisotropy", 8, 1, 1000,
                                "most by which the ellipse of \"ewa\" is longer than wide");
  return how;
}

}  // namespace

template <class T>
class ImageMap final : public Texture<T> {
 public:
  ImageMap(Params& p, const typename Texture<T>::Setup& setup)
      : mapping_(readMapping(p, setup.placement, setup.world)), how_(readLookup(p)) {
    scale_ = p.number("scale", 1, "multiplies the picture");
    invert_ = p.flag("invert", false, "takes 1 - x, not below 0, for the scaled value x");
    constexpr std::string_view origins[] = {"lower", "upper"};
    upper_ = p.choice("origin", origins, "lower",
                      "which row of the picture is v = 0: the lowest, or the top one as in "
                      "pbrt-v1 and v2") == "upper";
    const Decoding decoding = readDecoding(p);
    const std::filesystem::path file =
        p.file("filename", "the picture: .png, .jpg, .tga, .exr, .hdr or .pfm");
    if (p.describing()) return;
    p.require("filename");
    if (file.empty()) p.fail("filename", "names no file");
    try {
      map_ = sharedMipMap(file, decoding);
    } catch (const Error& error) {
      p.fail("filename", "gives no picture: " + error.diagnostics().front().message);
    }
  }

  T evaluate(const SurfaceInteraction& at) const override {
    TexturePoint m = mapping_(at);
    if (!upper_) {
      m.st.y = 1 - m.st.y;
      m.dx.y = -m.dx.y;
      m.dy.y = -m.dy.y;
    }
    const Spectrum color = scale_ * map_->at(m, how_);
    if constexpr (std::is_same_v<T, float>) {
      const float v = luminance(color);
      return invert_ ? std::max(0.F, 1 - v) : v;
    } else {
      return invert_ ? glm::max(Spectrum(0), 1.F - color) : color;
    }
  }
  bool filters() const override { return map_->levels() > 1; }

 private:
  Mapping2D mapping_;
  Lookup how_;
  float scale_ = 1;
  bool invert_ = false, upper_ = false;
  std::shared_ptr<const MipMap> map_;
};

}  // namespace pbrt

PBRT_TEXTURE_PLUGIN(pbrt::ImageMap, "imagemap", "a picture laid over the surface")
