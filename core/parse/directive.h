#pragma once
// The statements of a scene file, without their meaning.

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "core/plugin/param.h"

namespace pbrt {

enum class DirectiveKind : std::uint8_t {
  Accelerator,
  ActiveTransform,
  AreaLightSource,
  AttributeBegin,
  AttributeEnd,
  Camera,
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
// Include is not among them: the parser carries it out.

std::string_view directiveName(DirectiveKind kind);

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
