#include "core/plugin/params.h"

#include <fmt/format.h>

#include <array>

namespace pbrt {

namespace {

template <class... T>
constexpr std::array<ParamType, sizeof...(T)> types(T... t) {
  return {t...};
}

// An integer is a number; every other type is taken as written.
constexpr auto kNumber = types(ParamType::number, ParamType::integer);
constexpr auto kInteger = types(ParamType::integer);
constexpr auto kBoolean = types(ParamType::boolean);
constexpr auto kString = types(ParamType::string);
constexpr auto kPoint2 = types(ParamType::point2, ParamType::vector2, ParamType::number);
constexpr auto kVector3 = types(ParamType::vector3, ParamType::point3, ParamType::normal);
constexpr auto kColour = types(ParamType::rgb, ParamType::xyz);
constexpr auto kNumberOrTexture = types(ParamType::number, ParamType::integer, ParamType::texture);
constexpr auto kColourOrTexture = types(ParamType::rgb, ParamType::xyz, ParamType::texture);
constexpr auto kAnyOrTexture = types(ParamType::number, ParamType::integer, ParamType::rgb,
                                     ParamType::xyz, ParamType::texture);

// CIE XYZ (D65) to linear Rec. 709 (inverse of the matrix in ITU-R BT.709 / IEC 61966-2-1).
Spectrum rgbFromXyz(const Vec3& c) {
  return {3.2404542F * c.x - 1.5371385F * c.y - 0.4985314F * c.z,
          -0.9692660F * c.x + 1.8760108F * c.y + 0.0415560F * c.z,
          0.0556434F * c.x - 0.2040259F * c.y + 1.0572252F * c.z};
}

std::vector<float> floats(const Param& p) {
  if (const auto* ints = std::get_if<std::vector<int>>(&p.values))
    return {ints->begin(), ints->end()};
  return std::get<std::vector<float>>(p.values);
}

std::string show(const Vec3& v) {
  return fmt::format("{} {} {}", v.x, v.y, v.z);
}

}  // namespace

Params::Params(std::string what, Location where, std::vector<const ParamList*> lists,
               TextureLibrary* textures, Reporter report, const ParamList* defaults)
    : what_(std::move(what)),
      where_(where),
      defaults_(defaults),
      textures_(textures),
      report_(std::move(report)) {
  for (const ParamList* list : lists) uses_.push_back({list, std::vector<bool>(list->size())});
}

Params Params::describing(std::string what, std::vector<Declaration>& declarations) {
  Params p(std::move(what), {}, {});
  p.declarations_ = &declarations;
  return p;
}

void Params::declare(const std::string& name, std::string_view type, std::string fallback,
                     std::string_view meaning, std::string_view unit) {
  known_.push_back(name);
  if (declarations_)
    declarations_->push_back(
        {name, std::string(type), std::move(fallback), std::string(meaning), std::string(unit)});
}

// The value to use for a name, or null. Of the same name twice in one list the last one counts, as
// in every pbrt; one that another list hides counts as read.
const Param* Params::find(const std::string& name, std::span<const ParamType> types,
                          std::string_view wanted) {
  const Param* found = nullptr;
  for (Use& use : uses_) {
    const Param* here = nullptr;
    for (std::size_t i = 0; i < use.list->size(); ++i)
      if ((*use.list)[i].name == name) {
        use.read[i] = true;
        here = &(*use.list)[i];
      }
    if (!found) found = here;
  }
  if (!found && defaults_)
    for (const Param& p : *defaults_)
      if (p.name == name) found = &p;
  if (found && std::find(types.begin(), types.end(), found->type) == types.end()) {
    if (found->type == ParamType::spectrum || found->type == ParamType::blackbody)
      fail(name, fmt::format("is given as \"{}\", which is not read yet; give it as \"rgb\"",
                             typeName(found->type)));
    fail(name, fmt::format("has type \"{}\" but must be \"{}\"", typeName(found->type), wanted));
  }
  return found;
}

template <class V>
std::vector<V> Params::list(const std::string& name, std::span<const ParamType> types,
                            std::string_view type, std::string_view meaning,
                            std::string_view unit) {
  declare(name, type, "-", meaning, unit);
  const Param* p = find(name, types, type);
  if (!p) return {};
  if constexpr (std::is_same_v<V, int>) {
    return std::get<std::vector<int>>(p->values);
  } else {
    const std::vector<float> flat = floats(*p);
    constexpr std::size_t n = sizeof(V) / sizeof(float);
    if (flat.size() % n)
      fail(name, fmt::format("has {} numbers, which is not a multiple of {}", flat.size(), n));
    std::vector<V> values(flat.size() / n);
    for (std::size_t i = 0; i < flat.size(); ++i)
      reinterpret_cast<float*>(values.data())[i] = flat[i];
    if (p->type == ParamType::xyz)
      if constexpr (std::is_same_v<V, Spectrum>)
        for (Spectrum& value : values) value = rgbFromXyz(value);
    return values;
  }
}

namespace {

// The only value of a parameter that stands for one.
template <class V>
V single(const Params& params, const Param& p) {
  const std::vector<float> flat = floats(p);
  constexpr std::size_t n = sizeof(V) / sizeof(float);
  if (flat.size() != n)
    params.fail(p.name,
                fmt::format("needs {} number{}, not {}", n, n == 1 ? "" : "s", flat.size()));
  V value{};
  std::copy(flat.begin(), flat.end(), reinterpret_cast<float*>(&value));
  if (p.type == ParamType::xyz)
    if constexpr (std::is_same_v<V, Spectrum>) value = rgbFromXyz(value);
  return value;
}

}  // namespace

float Params::number(const std::string& name, float fallback, std::string_view meaning,
                     std::string_view unit) {
  declare(name, "float", fmt::format("{}", fallback), meaning, unit);
  const Param* p = find(name, kNumber, "float");
  return p ? single<float>(*this, *p) : fallback;
}

float Params::positive(const std::string& name, float fallback, std::string_view meaning,
                       std::string_view unit) {
  const float v = number(name, fallback, meaning, unit);
  if (!(v > 0)) fail(name, fmt::format("must be above 0, not {}", v));
  return v;
}

float Params::nonNegative(const std::string& name, float fallback, std::string_view meaning,
                          std::string_view unit) {
  const float v = number(name, fallback, meaning, unit);
  if (!(v >= 0)) fail(name, fmt::format("must not be below 0, but is {}", v));
  return v;
}

float Params::inRange(const std::string& name, float fallback, float lo, float hi,
                      std::string_view meaning, std::string_view unit) {
  const float v = number(name, fallback, meaning, unit);
  if (!(v >= lo && v <= hi)) fail(name, fmt::format("must be from {} to {}, not {}", lo, hi, v));
  return v;
}

std::optional<float> Params::optionalNumber(const std::string& name, std::string_view meaning,
                                            std::string_view unit) {
  declare(name, "float", "-", meaning, unit);
  const Param* p = find(name, kNumber, "float");
  if (!p) return {};
  return single<float>(*this, *p);
}

int Params::integer(const std::string& name, int fallback, int lo, int hi,
                    std::string_view meaning) {
  declare(name, "integer", fmt::format("{}", fallback), meaning);
  const Param* p = find(name, kInteger, "integer");
  if (!p) return fallback;
  const auto& values = std::get<std::vector<int>>(p->values);
  if (values.size() != 1) fail(name, fmt::format("needs 1 integer, not {}", values.size()));
  if (values[0] < lo || values[0] > hi)
    fail(name, fmt::format("must be from {} to {}, not {}", lo, hi, values[0]));
  return values[0];
}

bool Params::flag(const std::string& name, bool fallback, std::string_view meaning) {
  declare(name, "bool", fallback ? "true" : "false", meaning);
  const Param* p = find(name, kBoolean, "bool");
  if (!p) return fallback;
  const auto& values = std::get<std::vector<int>>(p->values);
  if (values.size() != 1) fail(name, fmt::format("needs 1 bool, not {}", values.size()));
  return values[0] != 0;
}

std::string Params::text(const std::string& name, const std::string& fallback,
                         std::string_view meaning) {
  declare(name, "string", '"' + fallback + '"', meaning);
  const Param* p = find(name, kString, "string");
  if (!p) return fallback;
  const auto& values = std::get<std::vector<std::string>>(p->values);
  if (values.size() != 1) fail(name, fmt::format("needs 1 string, not {}", values.size()));
  return values[0];
}

std::string Params::choice(const std::string& name, std::span<const std::string_view> allowed,
                           std::string_view fallback, std::string_view meaning) {
  std::string value =
      text(name, std::string(fallback), fmt::format("{} ({})", meaning, fmt::join(allowed, ", ")));
  refuseOthers(name, value, allowed);
  return value;
}

std::vector<std::string> Params::choices(const std::string& name,
                                         std::span<const std::string_view> allowed,
                                         std::string_view meaning) {
  declare(name, "string", "-", fmt::format("{} (any of {})", meaning, fmt::join(allowed, ", ")));
  const Param* p = find(name, kString, "string");
  if (!p) return {};
  auto values = std::get<std::vector<std::string>>(p->values);
  for (const std::string& value : values) refuseOthers(name, value, allowed);
  return values;
}

void Params::refuseOthers(const std::string& name, const std::string& value,
                          std::span<const std::string_view> allowed) const {
  if (std::find(allowed.begin(), allowed.end(), value) != allowed.end()) return;
  const std::vector<std::string> names(allowed.begin(), allowed.end());
  fail(name, fmt::format("cannot be \"{}\" (it is one of {}){}", value, fmt::join(names, ", "),
                         didYouMean(value, names)));
}

std::filesystem::path Params::file(const std::string& name, std::string_view meaning) {
  const std::filesystem::path given = text(name, "", meaning);
  if (given.empty()) return {};
  const Source* scene = place(name).source;
  const auto folder = scene ? std::filesystem::path(scene->name).parent_path() : "";
  std::filesystem::path path = folder / given;
  std::error_code unknown;
  if (!std::filesystem::exists(path, unknown))
    fail(name, fmt::format("names a file that is not there: {}", path.string()));
  return path;
}

Point3 Params::point(const std::string& name, const Point3& fallback, std::string_view meaning) {
  declare(name, "point3", show(fallback), meaning);
  const Param* p = find(name, kVector3, "point3");
  return p ? single<Point3>(*this, *p) : fallback;
}

Vec3 Params::vector(const std::string& name, const Vec3& fallback, std::string_view meaning) {
  declare(name, "vector3", show(fallback), meaning);
  const Param* p = find(name, kVector3, "vector3");
  return p ? single<Vec3>(*this, *p) : fallback;
}

Spectrum Params::spectrum(const std::string& name, const Spectrum& fallback,
                          std::string_view meaning) {
  declare(name, "rgb", show(fallback), meaning);
  const Param* p = find(name, kColour, "rgb");
  return p ? single<Spectrum>(*this, *p) : fallback;
}

std::optional<Spectrum> Params::optionalSpectrum(const std::string& name,
                                                 std::string_view meaning) {
  if (has(name)) return spectrum(name, Spectrum(0), meaning);
  declare(name, "rgb", "-", meaning);
  return {};
}

Spectrum Params::emission(const std::string& name, const Spectrum& fallback,
                          std::string_view meaning) {
  return spectrum(name, fallback, meaning);
}

float Params::refractiveIndex(const std::string& name, float fallback, std::string_view meaning) {
  return positive(name, fallback, meaning);
}

// The texture that a parameter names, by one of the library's two functions.
template <class T>
std::shared_ptr<const Texture<T>> Params::named(
    const Param& p,
    std::shared_ptr<const Texture<T>> (TextureLibrary::*lookUp)(const std::string&)) {
  if (!textures_) fail(p.name, "cannot be a texture here");
  try {
    return (textures_->*lookUp)(std::get<std::vector<std::string>>(p.values).at(0));
  } catch (const Error& error) {
    throw error.at(p.valueWhere);
  }
}

Textured<float> Params::floatTexture(const std::string& name, float fallback,
                                     std::string_view meaning, std::string_view unit) {
  declare(name, "float or texture", fmt::format("{}", fallback), meaning, unit);
  const Param* p = find(name, kNumberOrTexture, "float\" or \"texture");
  if (!p) return Textured<float>(fallback);
  if (p->type != ParamType::texture) return Textured<float>(single<float>(*this, *p));
  return Textured<float>(named(*p, &TextureLibrary::floatTexture));
}

Textured<Spectrum> Params::spectrumTexture(const std::string& name, const Spectrum& fallback,
                                           std::string_view meaning) {
  declare(name, "rgb or texture", show(fallback), meaning);
  const Param* p = find(name, kColourOrTexture, "rgb\" or \"texture");
  if (!p) return Textured<Spectrum>(fallback);
  if (p->type != ParamType::texture) return Textured<Spectrum>(single<Spectrum>(*this, *p));
  return Textured<Spectrum>(named(*p, &TextureLibrary::spectrumTexture));
}

std::optional<Textured<float>> Params::optionalFloatTexture(const std::string& name,
                                                            std::string_view meaning) {
  if (has(name)) return floatTexture(name, 0, meaning);
  declare(name, "float or texture", "-", meaning);
  return {};
}

std::optional<Textured<Spectrum>> Params::optionalSpectrumTexture(const std::string& name,
                                                                  std::string_view meaning) {
  if (has(name)) return spectrumTexture(name, Spectrum(0), meaning);
  declare(name, "rgb or texture", "-", meaning);
  return {};
}

template <>
Textured<float> Params::texture<float>(const std::string& name, float fallback,
                                       std::string_view meaning) {
  return floatTexture(name, fallback, meaning);
}

template <>
Textured<Spectrum> Params::texture<Spectrum>(const std::string& name, float fallback,
                                             std::string_view meaning) {
  // A grey value may stand for a colour: textures of both kinds share their scene files.
  const Param* p = find(name, kAnyOrTexture, "rgb\" or \"texture");
  if (!p || (p->type != ParamType::number && p->type != ParamType::integer))
    return spectrumTexture(name, Spectrum(fallback), meaning);
  declare(name, "rgb or texture", fmt::format("{}", fallback), meaning);
  return Textured<Spectrum>(Spectrum(single<float>(*this, *p)));
}

std::vector<float> Params::numbers(const std::string& name, std::string_view meaning,
                                   std::string_view unit) {
  return list<float>(name, kNumber, "float", meaning, unit);
}
std::vector<int> Params::integers(const std::string& name, std::string_view meaning) {
  return list<int>(name, kInteger, "integer", meaning);
}
std::vector<Point2> Params::points2(const std::string& name, std::string_view meaning) {
  return list<Point2>(name, kPoint2, "point2", meaning);
}
std::vector<Point3> Params::points(const std::string& name, std::string_view meaning) {
  return list<Point3>(name, kVector3, "point3", meaning);
}
std::vector<Vec3> Params::vectors(const std::string& name, std::string_view meaning) {
  return list<Vec3>(name, kVector3, "vector3", meaning);
}
std::vector<Normal3> Params::normals(const std::string& name, std::string_view meaning) {
  return list<Normal3>(name, kVector3, "normal", meaning);
}
std::vector<Spectrum> Params::spectra(const std::string& name, std::string_view meaning) {
  return list<Spectrum>(name, kColour, "rgb", meaning);
}

}  // namespace pbrt
