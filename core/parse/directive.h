#pragma once
// The statements of a scene file, without their meaning.

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "core/plugin/param.h"

namespace pbrt {

enum class DirectiveKind : std::uint8_t {
  Accelerator,
  ActiveTransform,
  AreaLightSource,
  Attribute,
  AttributeBegin,
  AttributeEnd,
  Camera,
  ColorSpace,
  ConcatTransform,
  CoordinateSystem,
  CoordSysTransform,
  Film,
  Identity,
  Integrator,
  LightSource,
  LookAt,
  MakeNamedMaterial,
  MakeNamedMedium,
  Material,
  MediumInterface,
  NamedMaterial,
  ObjectBegin,
  ObjectEnd,
  ObjectInstance,
  Option,
  PixelFilter,
  Renderer,
  ReverseOrientation,
  Rotate,
  Sampler,
  Scale,
  SearchPath,
  Shape,
  SurfaceIntegrator,
  Texture,
  Transform,
  TransformBegin,
  TransformEnd,
  TransformTimes,
  Translate,
  Volume,
  VolumeIntegrator,
  WorldBegin,
  WorldEnd
};
// Include and Import are not among them: the parser carries them out.

// What follows a keyword; the values in [] may be left out.
enum class Arguments : std::uint8_t {
  none,
  name,     // "name"
  names,    // "name" ["name"]
  plugin,   // "name" parameters
  texture,  // "name" "type" "class" parameters
  numbers,  // so many numbers, in brackets or not
  time,     // StartTime, EndTime or All
  option    // one parameter, whose type may be left out
};

struct Syntax {
  std::string_view keyword;
  Arguments arguments = Arguments::none;
  std::size_t numbers = 0;
};

const Syntax& syntax(DirectiveKind kind);
std::string_view directiveName(DirectiveKind kind);
std::optional<DirectiveKind> findDirective(std::string_view keyword);
// Every keyword, for "did you mean".
std::vector<std::string> directiveNames();

// A parameter is looked for among all others of its statement. Real ones have a few dozen.
constexpr std::size_t kMostParameters = 1000;

struct Directive {
  DirectiveKind kind = DirectiveKind::Identity;
  Location where;                  // the keyword
  std::vector<std::string> words;  // quoted names in their order, e.g. Texture's name, type, class
  std::vector<Location> wordsWhere;
  std::array<double, 16>
      numbers{};  // of Translate, Rotate, LookAt, Transform (column by column), ...
  ParamList params;
};

// Receives each directive as soon as it is complete; may keep parts by moving them out.
using DirectiveSink = std::function<void(Directive&&)>;

}  // namespace pbrt
