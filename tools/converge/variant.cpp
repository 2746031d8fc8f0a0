#include "variant.h"

#include <fmt/format.h>

#include "clock.h"

namespace pbrt {

Change readChange(const std::string& text) {
  // A label comes before any statement, so before any quotation mark.
  const std::size_t equals = text.find('=');
  if (equals < text.find('"')) return {text.substr(0, equals), text.substr(equals + 1)};
  Change change{"", text};
  bool gap = false;
  for (const char c : text) {
    if (std::string_view("\"[] \t\n").find(c) != std::string_view::npos) {
      gap = !change.label.empty();
    } else {
      if (gap) change.label += ' ';
      change.label += c;
      gap = false;
    }
  }
  return change;
}

namespace {

// The statements take effect just before the world begins: of several of one kind the last counts.
void apply(std::vector<Directive>& change, std::vector<Directive>& scene) {
  for (const Directive& d : change) {
    using enum DirectiveKind;
    if (d.kind != Integrator && d.kind != SurfaceIntegrator && d.kind != Sampler &&
        d.kind != PixelFilter)
      throw Error(d.where, fmt::format("{} cannot be changed here, only Integrator, Sampler and "
                                       "PixelFilter",
                                       directiveName(d.kind)));
  }
  const auto world = std::find_if(scene.begin(), scene.end(), [](const Directive& d) {
    return d.kind == DirectiveKind::WorldBegin;
  });
  scene.insert(world, std::make_move_iterator(change.begin()),
               std::make_move_iterator(change.end()));
}

}  // namespace

Variant buildVariant(const std::filesystem::path& file, const Change& change, PluginLoader& loader,
                     BuildOptions options) {
  Variant variant{"", file.stem().string(), change.statements, 0, 0, nullptr, nullptr};
  std::vector<Directive> scene, statements, *into = &scene;
  variant.parser = std::make_unique<Parser>([&](Directive&& d) { into->push_back(std::move(d)); });
  const Clock parsing;
  variant.parser->file(file);
  variant.parseSeconds = parsing.seconds();
  into = &statements;
  variant.parser->text("--with", change.statements);

  options.folder = file.parent_path();
  if (!options.dialect) options.dialect = detectDialect(scene).dialect;
  apply(statements, scene);
  const Clock building;
  variant.scene = buildScene(std::move(scene), loader, options);
  variant.buildSeconds = building.seconds();
  return variant;
}

}  // namespace pbrt
