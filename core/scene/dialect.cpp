#include "core/scene/dialect.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <numbers>

#include "core/parse/parameter.h"

namespace pbrt {

namespace {

// Sets of generations.
constexpr std::uint8_t kV1 = 1, kV2 = 2, kV3 = 4, kV4 = 8;
constexpr std::uint8_t kAll = kV1 | kV2 | kV3 | kV4;

unsigned bit(Dialect dialect) {
  return 1U << (static_cast<unsigned>(dialect) - 1);
}

struct TellTale {
  std::uint8_t generations;
  std::string_view names;  // separated by blanks
};

constexpr std::array kMaterials = {
    TellTale{kV1, "shinymetal bluepaint clay felt primer skin brushedmetal"},
    TellTale{kV3, "disney fourier"},
    TellTale{kV4,
             "diffuse dielectric conductor thindielectric coateddiffuse coatedconductor "
             "diffusetransmission interface measured"},
    TellTale{kV2 | kV3, "metal kdsubsurface"},
    TellTale{kV1 | kV2 | kV3, "matte plastic glass mirror substrate translucent uber"},
};
constexpr std::array kFilms = {TellTale{kV1 | kV2 | kV3, "image"},
                               TellTale{kV4, "rgb gbuffer spectral"}};
constexpr std::array kSamplers = {
    TellTale{kV4, "zsobol paddedsobol pmj02bn independent"}, TellTale{kV3, "02sequence maxmindist"},
    TellTale{kV3 | kV4, "sobol"}, TellTale{kV2, "adaptive"}, TellTale{kV1 | kV2, "bestcandidate"}};
constexpr std::array kCameras = {TellTale{kV1 | kV2 | kV3, "environment"},
                                 TellTale{kV4, "spherical"}};
constexpr std::array kAreaLights = {TellTale{kV1 | kV2 | kV3, "area"}};
constexpr std::array kFilmParameters = {
    TellTale{kV1, "premultiplyalpha writefrequency"}, TellTale{kV3 | kV4, "diagonal"},
    TellTale{kV4, "iso sensor whitebalance maxcomponentvalue savefp16"}};
constexpr std::array kCameraParameters = {
    TellTale{kV3 | kV4, "lensfile aperturediameter focusdistance simpleweighting"}};
constexpr std::array kLights = {TellTale{kV1, "infinitesample"}};
constexpr std::array kSurfaceIntegrators = {
    TellTale{kV1, "bidirectional debug"},
    TellTale{kV2, "ambientocclusion dipolesubsurface diffuseprt glossyprt useprobes"}};
constexpr std::array kShapes = {
    TellTale{kV4, "bilinearmesh"}, TellTale{kV3 | kV4, "curve plymesh"},
    TellTale{kV1 | kV2 | kV3, "cone heightfield hyperboloid nurbs paraboloid"}};

template <std::size_t N>
std::uint8_t generationsOf(const std::array<TellTale, N>& table, const std::string& name) {
  for (const TellTale& row : table)
    if (!name.empty() && fmt::format(" {} ", row.names).find(' ' + name + ' ') != std::string::npos)
      return row.generations;
  return kAll;
}

bool unquotedBool(const Param& p) {
  return p.type == ParamType::boolean && p.valueWhere.source &&
         textAt(p.valueWhere).find('"') == std::string_view::npos;
}

// By the spelling of its type; names that two generations share tell nothing.
std::uint8_t generationsOf(const Param& p) {
  const std::string_view type = declaredType(p);
  if (type == "color") return kV1 | kV2 | kV3;
  if (type == "rgb") return kV2 | kV3 | kV4;
  if (type == "point2" || type == "vector2" || type == "point3" || type == "vector3")
    return kV3 | kV4;
  return unquotedBool(p) ? kV4 : kAll;
}

std::uint8_t generationsOf(const Directive& d) {
  using enum DirectiveKind;
  const auto word = [&] { return d.words.empty() ? std::string() : d.words[0]; };
  switch (d.kind) {
    case SearchPath:
      return kV1;
    case Renderer:
      return kV2;
    case SurfaceIntegrator:
      return generationsOf(kSurfaceIntegrators, word()) & (kV1 | kV2);
    case VolumeIntegrator:
    case Volume:
      return kV1 | kV2;
    case NamedMaterial:
    case ActiveTransform:
      return kV2 | kV3 | kV4;
    case MakeNamedMaterial:
      return generationsOf(kMaterials, namedType(d)) & (kV2 | kV3 | kV4);
    case Integrator:
    case MediumInterface:
    case MakeNamedMedium:
    case TransformTimes:
      return kV3 | kV4;
    case Material:
      return generationsOf(kMaterials, word());
    case Film:
      return generationsOf(kFilms, word());
    case Sampler:
      return generationsOf(kSamplers, word());
    case Camera:
      return generationsOf(kCameras, word());
    case AreaLightSource:
      return generationsOf(kAreaLights, word());
    case LightSource:
      return generationsOf(kLights, word());
    case Shape:
      return generationsOf(kShapes, word());
    default:
      return kAll;
  }
}

Param number(std::string name, float value) {
  return {ParamType::number, std::move(name), {}, {}, std::vector<float>{value}};
}
Param rgb(std::string name, std::vector<float> value) {
  return {ParamType::rgb, std::move(name), {}, {}, std::move(value)};
}
Param grey(std::string name, float value) {
  return rgb(std::move(name), {value, value, value});
}
Param point(std::string name, float value) {
  return {ParamType::point3, std::move(name), {}, {}, std::vector<float>{value, value, value}};
}
Param count(std::string name, int value) {
  return {ParamType::integer, std::move(name), {}, {}, std::vector<int>{value}};
}
Param text(std::string name, std::string value, ParamType type = ParamType::string) {
  return {type, std::move(name), {}, {}, std::vector<std::string>{std::move(value)}};
}
Param flag(std::string name, bool value) {
  return {ParamType::boolean, std::move(name), {}, {}, std::vector<int>{value ? 1 : 0}};
}

struct DefaultsRow {
  std::uint8_t generations;
  PluginKind kind;
  std::string name;
  ParamList defaults;
};

const std::vector<DefaultsRow>& defaultsTable() {
  using enum PluginKind;
  static const ParamList noMedium = {grey("sigma_a", 0), grey("sigma_s", 0),
                                     flag("thermal", false)};
  // Of the CIE's y over the wavelengths in nm: v4 divides by it what a spectrum of a light tells,
  // but not black bodies of a temperature nor grids of colours.
  constexpr float kIntegralOfY = 106.856895F;
  static const ParamList milk = {rgb("sigma_a", {0.0011F, 0.0024F, 0.014F}),
                                 rgb("sigma_s", {2.55F, 3.21F, 3.77F})};
  static const std::vector<DefaultsRow> table = {
      {kV1, material, "matte", {grey("Kd", 1)}},
      {kV1, material, "mirror", {grey("Kr", 1)}},
      {kV1, material, "plastic", {grey("Kd", 1), grey("Ks", 1), text("distribution", "blinn")}},
      {kV2, material, "plastic", {text("distribution", "blinn")}},
      {kV1 | kV2, material, "substrate", {text("distribution", "blinn")}},
      {kV1, material, "translucent", {grey("Kd", 1), grey("Ks", 1), text("distribution", "blinn")}},
      {kV2, material, "translucent", {text("distribution", "blinn")}},
      {kV1, material, "uber", {grey("Kd", 1), grey("Ks", 1), text("distribution", "blinn")}},
      {kV2, material, "uber", {text("distribution", "blinn")}},
      {kV2, material, "metal", {text("distribution", "blinn")}},
      {kV4, material, "glass", {text("remapping", "v4")}},
      {kV4, material, "metal", {text("remapping", "v4")}},
      {kV4, material, "conductor", {text("remapping", "v4"), number("roughness", 0)}},
      {kV4, material, "coateddiffuse", {text("remapping", "v4")}},
      {kV4, material, "coatedconductor", {text("remapping", "v4")}},
      {kV1 | kV2, texture, "imagemap", {text("origin", "upper"), flag("gamma", false)}},
      {kV4, texture, "imagemap", {text("filter", "bilinear")}},
      {kV4, light, "projection", {number("fov", 90)}},
      {kV4, light, "spot", {text("falloff", "smoothstep")}},
      {kV1, camera, "perspective", {number("hither", 1e-3F)}},
      {kV1, camera, "orthographic", {number("hither", 1e-3F)}},
      {kV1, camera, "environment", {number("hither", 1e-3F)}},
      {kV1, integrator, "whitted", {count("maxdepth", 6)}},
      {kV1, integrator, "directlighting", {count("maxdepth", 6)}},
      {kV1 | kV2, sampler, "lowdiscrepancy", {count("pixelsamples", 4)}},
      {kV1 | kV2, integrator, "path", {count("maxdepth", 6)}},
      {kV1, sampler, "stratified", {count("xsamples", 2), count("ysamples", 2)}},
      {kV4, camera, "spherical", {text("mapping", "equalarea")}},
      {kV2, camera, "realistic", {number("unit", 1), flag("simpleweighting", false)}},
      {kV4, camera, "realistic", {flag("simpleweighting", false), flag("timeweighting", false)}},
      {kV2, integrator, "ambientocclusion", {count("nsamples", 2048), flag("weighted", false)}},
      {kV3, integrator, "ambientocclusion", {number("scale", std::numbers::pi_v<float>)}},
      {kV4, integrator, "ambientocclusion", {count("nsamples", 1)}},
      {kV1 | kV2,
       volume,
       "homogeneous",
       {grey("sigma_a", 0), grey("sigma_s", 0), flag("thermal", false), point("p0", 0),
        point("p1", 1)}},
      {kV1 | kV2, volume, "exponential", noMedium},
      {kV1 | kV2, volume, "volumegrid", noMedium},
      {kV3, volume, "homogeneous", milk},
      {kV3, volume, "heterogeneous", milk},
      {kV4, volume, "homogeneous", {flag("presetfirst", true)}},
      {kV4, volume, "cloud", {flag("presetfirst", true)}},
      {kV4,
       volume,
       "uniformgrid",
       {flag("presetfirst", true), number("radiancescale", kIntegralOfY)}},
      {kV4, volume, "rgbgrid", {number("radiancescale", kIntegralOfY)}},
      {kV4, filter, "gaussian", {number("xwidth", 1.5F), number("ywidth", 1.5F)}},
  };
  return table;
}

}  // namespace

std::string namedType(const Directive& d) {
  for (const Param& p : d.params)
    if (const auto* type = std::get_if<std::vector<std::string>>(&p.values);
        type && p.name == "type" && !type->empty())
      return type->front();
  return "";
}

std::optional<Dialect> dialectByName(std::string_view name) {
  for (const Dialect d : {Dialect::v1, Dialect::v2, Dialect::v3, Dialect::v4})
    if (name == dialectName(d)) return d;
  return {};
}

std::string_view dialectName(Dialect dialect) {
  constexpr std::array<std::string_view, 4> names = {"v1", "v2", "v3", "v4"};
  return names.at(static_cast<std::size_t>(dialect) - 1);
}

void DialectDetector::look(const Directive& d) {
  world_ = world_ || d.kind == DirectiveKind::WorldBegin;
  worldEnd_ = worldEnd_ || d.kind == DirectiveKind::WorldEnd;
  const auto narrow = [&](std::uint8_t to, const Location& where, const std::string& what) {
    if (std::popcount(static_cast<unsigned>(left_ & to)) == std::popcount(left_)) return;
    if ((left_ & to) == 0) return;
    left_ &= to;
    where_ = where;
    told_ = what;
  };
  const std::string word = d.words.empty() ? "" : fmt::format(" \"{}\"", d.words[0]);
  using enum DirectiveKind;
  if (d.kind == Attribute || d.kind == ColorSpace || d.kind == Option)
    narrow(kV4, d.where, std::string(directiveName(d.kind)));
  narrow(generationsOf(d), d.where, fmt::format("{}{}", directiveName(d.kind), word));
  for (const Param& p : d.params) {
    if (decided()) return;
    const bool plain = unquotedBool(p);
    narrow(generationsOf(p), p.where,
           plain ? "true and false without quotes" : fmt::format("\"{}\"", declaredType(p)));
    if (d.kind == Film)
      narrow(generationsOf(kFilmParameters, p.name), p.where, fmt::format("Film's \"{}\"", p.name));
    if (d.kind == Camera)
      narrow(generationsOf(kCameraParameters, p.name), p.where,
             fmt::format("Camera's \"{}\"", p.name));
  }
}

DetectedDialect DialectDetector::result() const {
  if (decided())
    return {static_cast<Dialect>(std::countr_zero(left_) + 1), where_,
            fmt::format("{} tells", told_)};
  if (world_ && !worldEnd_ && (left_ & kV4) != 0) return {Dialect::v4, {}, "it has no WorldEnd"};
  const Dialect dialect = (left_ & kV2) != 0   ? Dialect::v2
                          : (left_ & kV3) != 0 ? Dialect::v3
                                               : Dialect::v1;
  std::string others;
  for (const Dialect d : {Dialect::v1, Dialect::v2, Dialect::v3, Dialect::v4})
    if (d != dialect && (left_ & bit(d)) != 0 && (d != Dialect::v4 || !worldEnd_))
      others += fmt::format("{}{}", others.empty() ? "" : " or ", dialectName(d));
  return {dialect, where_,
          others.empty() ? fmt::format("{} and WorldEnd tell", told_)
                         : fmt::format("nothing tells it from {}; --dialect does", others)};
}

DetectedDialect detectDialect(const std::vector<Directive>& scene) {
  DialectDetector detector;
  for (const Directive& d : scene) detector.look(d);
  return detector.result();
}

const DialectDefaults& dialectDefaults(Dialect dialect) {
  static const std::array<DialectDefaults, 4> table = {{
      {"mitchell", "bestcandidate", "directlighting", "perspective", "matte", {640, 480}},
      {"box", "lowdiscrepancy", "directlighting", "perspective", "matte", {640, 480}},
      {"box", "halton", "path", "perspective", "matte", {1280, 720}},
      {"gaussian", "zsobol", "volpath", "perspective", "matte", {1280, 720}},
  }};
  return table.at(static_cast<std::size_t>(dialect) - 1);
}

const ParamList& parameterDefaults(Dialect dialect, PluginKind kind, const std::string& name) {
  static const ParamList none;
  for (const DefaultsRow& row : defaultsTable())
    if (row.kind == kind && row.name == name && (row.generations & bit(dialect)) != 0)
      return row.defaults;
  return none;
}

}  // namespace pbrt
