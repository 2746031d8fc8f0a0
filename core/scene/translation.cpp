#include "core/scene/translation.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pbrt {

namespace {

using enum PluginKind;

constexpr std::string_view kBump = "displacement bumpmap";
constexpr std::string_view kRadii = "xradius xwidth, yradius ywidth";
constexpr std::string_view kLens =
    "specfile lensfile, aperture_diameter aperturediameter, film_distance filmdistance, "
    "hither -, yon -";
constexpr std::string_view kLights = "lightsampler lightsamplestrategy, regularize -";
constexpr std::string_view kNoise = "the noise of the picture is not the same";
constexpr std::string_view kPaths = "paths find the same light, at another cost";

constexpr std::array kTable = {
    // name, generations, here, parameters, what differs
    Translation{camera, "spherical", "v4", "environment", "", ""},
    Translation{camera, "realistic", "v2 v3 v4", "realistic", kLens, ""},

    Translation{filter, "box", "v4", "box", kRadii, ""},
    Translation{filter, "gaussian", "v4", "gaussian", kRadii, ""},
    Translation{filter, "mitchell", "v4", "mitchell", kRadii, ""},
    Translation{filter, "sinc", "v4", "sinc", kRadii, ""},
    Translation{filter, "triangle", "v4", "triangle", kRadii, ""},

    Translation{integrator, "path", "v4", "path", kLights, ""},
    Translation{integrator, "volpath", "v4", "volpath", kLights, ""},
    Translation{integrator, "simplepath", "v4", "path", "maxdepth maxdepth, * -", ""},
    Translation{integrator, "simplevolpath", "v4", "volpath", "maxdepth maxdepth, * -", ""},
    Translation{integrator, "randomwalk", "v4", "path", "", ""},
    Translation{integrator, "bdpt", "v3 v4", "volpath", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "lightpath", "v4", "path", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "mlt", "v3 v4", "volpath", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "sppm", "v3 v4", "path", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "bidirectional", "v1", "path", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "photonmap", "v1 v2", "path", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "exphotonmap", "v1 v2", "path", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "irradiancecache", "v1 v2", "path", "* -", kPaths},
    Translation{integrator, "igi", "v1 v2", "path", "maxdepth maxdepth, * -", kPaths},
    Translation{integrator, "ambientocclusion", "v2 v3 v4", "ambientocclusion",
                "maxdist maxdistance", ""},
    Translation{integrator, "dipolesubsurface", "v2", "", "", ""},
    Translation{integrator, "diffuseprt", "v2", "", "", ""},
    Translation{integrator, "glossyprt", "v2", "", "", ""},
    Translation{integrator, "useprobes", "v2", "", "", ""},
    Translation{integrator, "function", "v4", "", "", ""},

    Translation{light, "area", "v1 v2 v3", "diffuse", "", ""},
    Translation{light, "infinitesample", "v1", "infinite", "", ""},
    Translation{light, "exinfinite", "v1 v2 v3", "infinite", "", ""},

    Translation{material, "diffuse", "v4", "matte", "reflectance Kd, displacement bumpmap", ""},
    Translation{material, "dielectric", "v4", "glass", kBump, ""},
    Translation{material, "conductor", "v4", "metal", kBump, ""},
    Translation{material, "thindielectric", "v4", "thindielectric", kBump, ""},
    Translation{material, "coateddiffuse", "v4", "coateddiffuse", kBump, ""},
    Translation{material, "coatedconductor", "v4", "coatedconductor", kBump, ""},
    Translation{material, "diffusetransmission", "v4", "diffusetransmission", kBump, ""},
    Translation{material, "measured", "v2 v4", "", "", ""},
    Translation{material, "subsurface", "v2 v3 v4", "", "", ""},
    Translation{material, "kdsubsurface", "v2 v3", "", "", ""},
    Translation{material, "disney", "v3", "", "", ""},
    Translation{material, "fourier", "v3", "", "", ""},
    Translation{material, "hair", "v3 v4", "", "", ""},

    Translation{sampler, "02sequence", "v3", "lowdiscrepancy", "", ""},
    Translation{sampler, "independent", "v4", "random", "", ""},
    Translation{sampler, "paddedsobol", "v4", "sobol", "", ""},
    Translation{sampler, "pmj02bn", "v4", "zsobol", "", kNoise},
    Translation{sampler, "maxmindist", "v3", "lowdiscrepancy", "", kNoise},
    Translation{sampler, "adaptive", "v2", "lowdiscrepancy", "maxsamples pixelsamples, * -",
                "all pixels get the most samples"},

    Translation{texture, "ptex", "v3 v4", "", "", ""},

    Translation{volume, "heterogeneous", "v3", "uniformgrid", "", ""},
    Translation{volume, "nanovdb", "v4", "", "", ""},
};

// The next piece of a list up to a separator, blanks about it taken away.
std::string_view next(std::string_view& list, char separator) {
  const std::size_t end = std::min(list.find(separator), list.size());
  std::string_view piece = list.substr(0, end);
  list.remove_prefix(std::min(end + 1, list.size()));
  while (piece.starts_with(' ')) piece.remove_prefix(1);
  return piece;
}

// What the table calls a parameter here: its own name if it says nothing, "-" if it has no effect.
std::string_view renamed(const Translation& t, std::string_view name) {
  for (std::string_view list = t.parameters; !list.empty();) {
    std::string_view pair = next(list, ',');
    const std::string_view old = next(pair, ' ');
    if (old == name || old == "*") return pair;
  }
  return name;
}

void deepen(Param& maxdepth) {
  if (auto* values = std::get_if<std::vector<int>>(&maxdepth.values))
    for (int& depth : *values) depth += depth < std::numeric_limits<int>::max() ? 1 : 0;
}

void alphaFromSigma(Param& sigma) {
  auto* values = std::get_if<std::vector<float>>(&sigma.values);
  if (!values || values->size() != 1 || !(values->front() > 0)) return;
  sigma.name = "alpha";
  values->front() = 1 / (2 * values->front() * values->front());
}

// (scale x)^g = scale^g x^g.
void powerOfScaled(ParamList& params) {
  const auto find = [&](std::string_view name) -> std::vector<float>* {
    const auto p = std::ranges::find(params, name, &Param::name);
    auto* values = p == params.end() ? nullptr : std::get_if<std::vector<float>>(&p->values);
    return values && values->size() == 1 ? values : nullptr;
  };
  const std::vector<float>* power = find("gamma");
  if (!power || !(power->front() > 0)) return;
  if (std::vector<float>* scale = find("scale"))
    scale->front() = std::pow(std::max(0.F, scale->front()), power->front());
  Param& gamma = *std::ranges::find(params, "gamma", &Param::name);
  const std::string curve = fmt::format("gamma {}", power->front());
  gamma = {ParamType::string, "encoding", gamma.where, gamma.valueWhere,
           std::vector<std::string>{curve}};
}

void lightStrategy(Param& strategy) {
  if (auto* names = std::get_if<std::vector<std::string>>(&strategy.values))
    for (std::string& name : *names)
      if (name == "bvh" || name == "exhaustive") name = "spatial";
}

}  // namespace

std::span<const Translation> translations() {
  return kTable;
}

const Translation* findTranslation(PluginKind kind, std::string_view name) {
  for (const Translation& t : kTable)
    if (t.kind == kind && t.name == name) return &t;
  return nullptr;
}

std::vector<std::string> renamedParameters(PluginKind kind, std::string_view name) {
  std::vector<std::string> names;
  if (const Translation* t = findTranslation(kind, name))
    for (std::string_view list = t->parameters; !list.empty();) {
      std::string_view pair = next(list, ',');
      names.emplace_back(next(pair, ' '));
    }
  return names;
}

void translateParameters(Dialect dialect, PluginKind kind, const std::string& name,
                         ParamList& params) {
  const Translation* t = findTranslation(kind, name);
  if (t && !t->parameters.empty()) {
    std::erase_if(params, [&](const Param& p) { return renamed(*t, p.name) == "-"; });
    for (Param& p : params) p.name = renamed(*t, p.name);
  }
  if (kind == texture && name == "imagemap") powerOfScaled(params);
  const std::string_view target = t ? t->target : name;
  const bool path = kind == integrator && (target == "path" || target == "volpath");
  const bool shallow = dialect == Dialect::v1 || (dialect == Dialect::v2 && path);
  for (Param& p : params) {
    if (kind == integrator && shallow && p.name == "maxdepth") deepen(p);
    if (path && p.name == "lightsamplestrategy") lightStrategy(p);
    if (kind == filter && name == "gaussian" && p.name == "sigma") alphaFromSigma(p);
  }
}

}  // namespace pbrt
