#include "core/scene/builder.h"
#include "core/scene/scene_builder.h"

namespace pbrt {

SceneReader::SceneReader(PluginLoader& loader, BuildOptions options)
    : loader_(loader), options_(std::move(options)) {
  if (!options_.dialect) return;
  dialect_ = {*options_.dialect, {}, "--dialect says so"};
  begin();
}

SceneReader::~SceneReader() = default;

void SceneReader::begin() {
  builder_ = std::make_unique<SceneBuilder>(loader_, options_, dialect_);
  for (Directive& d : waiting_) {
    builder_->handle(std::move(d));
    d = Directive();  // frees the parameters that nobody kept
  }
  waiting_ = std::vector<Directive>();  // {} would keep the room
}

void SceneReader::read(Directive&& d) {
  if (builder_) return builder_->handle(std::move(d));
  detector_.look(d);
  waiting_.push_back(std::move(d));
  if (!detector_.decided()) return;
  dialect_ = detector_.result();
  begin();
}

std::unique_ptr<Scene> SceneReader::finish() {
  if (!builder_) {
    dialect_ = detector_.result();
    begin();
  }
  auto scene = builder_->finish();
  builder_.reset();  // and with it all that was named and is not used
  return scene;
}

std::unique_ptr<Scene> buildScene(std::vector<Directive> directives, PluginLoader& loader,
                                  const BuildOptions& options) {
  SceneReader reader(loader, options);
  for (Directive& d : directives) {
    reader.read(std::move(d));
    d = Directive();
  }
  return reader.finish();
}

}  // namespace pbrt
