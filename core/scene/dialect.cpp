#include "core/scene/dialect.h"

#include <fmt/format.h>

#include <array>
#include <set>

namespace pbrt {

namespace {

constexpr std::array kAliases = {
    Alias{PluginKind::light, "area", "diffuse", true},
    Alias{PluginKind::sampler, "02sequence", "lowdiscrepancy", true},
    Alias{PluginKind::sampler, "sobol", "halton", false},
    Alias{PluginKind::sampler, "maxmindist", "lowdiscrepancy", false},
    Alias{PluginKind::sampler, "adaptive", "lowdiscrepancy", false},
};

Param number(std::string name, float value) {
  return {ParamType::number, std::move(name), {}, {}, std::vector<float>{value}};
}
Param grey(std::string name, float value) {
  return {ParamType::rgb, std::move(name), {}, {}, std::vector<float>{value, value, value}};
}
Param count(std::string name, int value) {
  return {ParamType::integer, std::move(name), {}, {}, std::vector<int>{value}};
}
Param text(std::string name, std::string value) {
  return {ParamType::string, std::move(name), {}, {}, std::vector<std::string>{std::move(value)}};
}

struct DefaultsRow {
  std::set<Dialect> dialects;
  PluginKind kind;
  std::string name;
  ParamList defaults;
};

const std::vector<DefaultsRow>& defaultsTable() {
  constexpr auto v1 = Dialect::v1, v2 = Dialect::v2;
  static const std::vector<DefaultsRow> table = {
      {{v1}, PluginKind::material, "matte", {grey("Kd", 1)}},
      {{v1}, PluginKind::material, "mirror", {grey("Kr", 1)}},
      {{v1},
       PluginKind::material,
       "plastic",
       {grey("Kd", 1), grey("Ks", 1), text("distribution", "blinn")}},
      {{v2}, PluginKind::material, "plastic", {text("distribution", "blinn")}},
      {{v1}, PluginKind::camera, "perspective", {number("hither", 1e-3F)}},
      {{v1}, PluginKind::camera, "orthographic", {number("hither", 1e-3F)}},
      {{v1}, PluginKind::integrator, "whitted", {count("maxdepth", 6)}},
      {{v1}, PluginKind::integrator, "directlighting", {count("maxdepth", 6)}},
      {{v1, v2}, PluginKind::sampler, "lowdiscrepancy", {count("pixelsamples", 4)}},
      {{v1, v2}, PluginKind::integrator, "path", {count("maxdepth", 6)}},
      {{v1}, PluginKind::sampler, "stratified", {count("xsamples", 2), count("ysamples", 2)}},
  };
  return table;
}

bool onlyInV1(const std::string& material) {
  static const std::set<std::string> names = {"shinymetal", "bluepaint", "clay",        "felt",
                                              "primer",     "skin",      "brushedmetal"};
  return names.contains(material);
}

}  // namespace

std::optional<Dialect> dialectByName(std::string_view name) {
  for (const Dialect d : {Dialect::v1, Dialect::v2, Dialect::v3})
    if (name == dialectName(d)) return d;
  return {};
}

std::string_view dialectName(Dialect dialect) {
  constexpr std::array<std::string_view, 3> names = {"v1", "v2", "v3"};
  return names.at(static_cast<std::size_t>(dialect) - 1);
}

DetectedDialect detectDialect(const std::vector<Directive>& scene) {
  using enum DirectiveKind;
  for (const Directive& d : scene) {
    const auto found = [&](Dialect dialect) {
      const std::string word = d.words.empty() ? "" : fmt::format(" \"{}\"", d.words[0]);
      return DetectedDialect{
          dialect, d.where,
          fmt::format("only pbrt-{} has {}{}", dialectName(dialect), directiveName(d.kind), word)};
    };
    switch (d.kind) {
      case SearchPath:
        return found(Dialect::v1);
      case Material:
        if (onlyInV1(d.words.at(0))) return found(Dialect::v1);
        break;
      case Renderer:
      case ActiveTransform:
        return found(Dialect::v2);
      case Integrator:
      case MediumInterface:
      case MakeNamedMedium:
        return found(Dialect::v3);
      default:
        break;
    }
  }
  return {Dialect::v2, {}, "nothing in it tells which pbrt it is for"};
}

const DialectDefaults& dialectDefaults(Dialect dialect) {
  static const std::array<DialectDefaults, 3> table = {{
      {"mitchell", "bestcandidate", "directlighting", "perspective", "matte", {640, 480}},
      {"box", "lowdiscrepancy", "directlighting", "perspective", "matte", {640, 480}},
      {"box", "halton", "path", "perspective", "matte", {1280, 720}},
  }};
  return table.at(static_cast<std::size_t>(dialect) - 1);
}

const ParamList& parameterDefaults(Dialect dialect, PluginKind kind, const std::string& name) {
  static const ParamList none;
  for (const DefaultsRow& row : defaultsTable())
    if (row.kind == kind && row.name == name && row.dialects.contains(dialect)) return row.defaults;
  return none;
}

void translateParameters(Dialect dialect, PluginKind kind, const std::string& name,
                         ParamList& params) {
  if (kind != PluginKind::integrator) return;
  if (!(dialect == Dialect::v1 || (dialect == Dialect::v2 && name == "path"))) return;
  for (Param& param : params)
    if (auto* values = std::get_if<std::vector<int>>(&param.values);
        values && param.name == "maxdepth")
      for (int& depth : *values) depth += depth < std::numeric_limits<int>::max() ? 1 : 0;
}

const Alias* findAlias(PluginKind kind, std::string_view name) {
  for (const Alias& alias : kAliases)
    if (alias.kind == kind && alias.name == name) return &alias;
  return nullptr;
}

}  // namespace pbrt
