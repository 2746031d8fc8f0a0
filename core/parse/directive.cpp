#include "core/parse/directive.h"

#include <algorithm>

namespace pbrt {
namespace {

// In the order of DirectiveKind.
constexpr std::array kSyntax{Syntax{"Accelerator", Arguments::plugin},
                             Syntax{"ActiveTransform", Arguments::time},
                             Syntax{"AreaLightSource", Arguments::plugin},
                             Syntax{"Attribute", Arguments::plugin},
                             Syntax{"AttributeBegin", Arguments::none},
                             Syntax{"AttributeEnd", Arguments::none},
                             Syntax{"Camera", Arguments::plugin},
                             Syntax{"ColorSpace", Arguments::name},
                             Syntax{"ConcatTransform", Arguments::numbers, 16},
                             Syntax{"CoordinateSystem", Arguments::name},
                             Syntax{"CoordSysTransform", Arguments::name},
                             Syntax{"Film", Arguments::plugin},
                             Syntax{"Identity", Arguments::none},
                             Syntax{"Integrator", Arguments::plugin},
                             Syntax{"LightSource", Arguments::plugin},
                             Syntax{"LookAt", Arguments::numbers, 9},
                             Syntax{"MakeNamedMaterial", Arguments::plugin},
                             Syntax{"MakeNamedMedium", Arguments::plugin},
                             Syntax{"Material", Arguments::plugin},
                             Syntax{"MediumInterface", Arguments::names},
                             Syntax{"NamedMaterial", Arguments::name},
                             Syntax{"ObjectBegin", Arguments::name},
                             Syntax{"ObjectEnd", Arguments::none},
                             Syntax{"ObjectInstance", Arguments::name},
                             Syntax{"Option", Arguments::option},
                             Syntax{"PixelFilter", Arguments::plugin},
                             Syntax{"Renderer", Arguments::plugin},
                             Syntax{"ReverseOrientation", Arguments::none},
                             Syntax{"Rotate", Arguments::numbers, 4},
                             Syntax{"Sampler", Arguments::plugin},
                             Syntax{"Scale", Arguments::numbers, 3},
                             Syntax{"SearchPath", Arguments::name},
                             Syntax{"Shape", Arguments::plugin},
                             Syntax{"SurfaceIntegrator", Arguments::plugin},
                             Syntax{"Texture", Arguments::texture},
                             Syntax{"Transform", Arguments::numbers, 16},
                             Syntax{"TransformBegin", Arguments::none},
                             Syntax{"TransformEnd", Arguments::none},
                             Syntax{"TransformTimes", Arguments::numbers, 2},
                             Syntax{"Translate", Arguments::numbers, 3},
                             Syntax{"Volume", Arguments::plugin},
                             Syntax{"VolumeIntegrator", Arguments::plugin},
                             Syntax{"WorldBegin", Arguments::none},
                             Syntax{"WorldEnd", Arguments::none}};
static_assert(kSyntax.size() == static_cast<std::size_t>(DirectiveKind::WorldEnd) + 1);

}  // namespace

const Syntax& syntax(DirectiveKind kind) {
  return kSyntax[static_cast<std::size_t>(kind)];
}

std::string_view directiveName(DirectiveKind kind) {
  return syntax(kind).keyword;
}

std::optional<DirectiveKind> findDirective(std::string_view keyword) {
  const auto* found = std::ranges::find(kSyntax, keyword, &Syntax::keyword);
  if (found == kSyntax.end()) return {};
  return static_cast<DirectiveKind>(found - kSyntax.begin());
}

std::vector<std::string> directiveNames() {
  std::vector<std::string> names{"Include", "Import"};
  for (const Syntax& s : kSyntax) names.emplace_back(s.keyword);
  return names;
}

}  // namespace pbrt
