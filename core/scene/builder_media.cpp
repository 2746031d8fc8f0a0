#include <fmt/format.h>

#include "core/scene/scene_builder.h"

namespace pbrt {

// Statements about media.
bool SceneBuilder::handleMedia(Directive& d) {
  using enum DirectiveKind;
  switch (d.kind) {
    case MakeNamedMedium: {
      const std::string name = d.words.at(0);
      std::string type = takeType(d);
      auto defaults = defaultsFor(AttributeTarget::medium, type);
      media_.emplace(std::pair(name, media_.size()),
                     MediumDefinition{std::move(type), std::move(d.params), defaults, d.where,
                                      startOf(d), inWorld_, nullptr});
      return true;
    }
    case DirectiveKind::MediumInterface:
      if (d.words.size() == 1) {  // both sides
        d.words.push_back(d.words[0]);
        d.wordsWhere.push_back(d.wordsWhere.at(0));
      }
      attributes_.media = std::make_shared<const Directive>(std::move(d));
      if (!firstMedia_ && !(attributes_.media->words[0] + attributes_.media->words[1]).empty())
        firstMedia_ = attributes_.media;
      return true;
    case Volume:
      if (!inWorld_) throw Error(d.where, "Volume belongs after WorldBegin");
      addRegion(d);
      return true;
    default:
      return false;
  }
}

void SceneBuilder::addRegion(const Directive& d) {
  auto region = factory_.make<Medium>(d.words.at(0), d.params, d.where, {startOf(d)});
  if (!region->bounded()) throw Error(d.where, "a Volume needs \"p0\" and \"p1\": where it ends");
  scene_->regions_.push_back(region.get());
  scene_->media_.push_back(std::move(region));
}

// What the shape is the border of; null if there is the same on both sides, or nobody looks.
const MediumInterface* SceneBuilder::mediaOf(const Attributes& attributes) {
  const auto& names = attributes.media;
  if (!names || names->words[0] == names->words[1] || !scene_->integrator_->tracesMedia())
    return nullptr;
  const auto [found, isNew] = interfaces_.try_emplace(
      {names->words[0], names->words[1], attributes.mediaNamed}, nullptr, names);
  if (isNew) found->second.first = &scene_->interfaces_.emplace_back();
  return found->second.first;
}

// The medium that one of the words of a MediumInterface names where `named` media have been named:
// the last of this name before, else the first after. Null for "", clear air.
const Medium* SceneBuilder::medium(const Directive& names, std::size_t word, std::size_t named) {
  const std::string& name = names.words[word];
  if (name.empty()) return nullptr;
  auto found = media_.lower_bound({name, named});
  if (found != media_.begin() && std::prev(found)->first.first == name)
    --found;
  else if (found == media_.end() || found->first.first != name) {
    std::vector<std::string> known;
    for (const auto& entry : media_) known.push_back(entry.first.first);
    throw Error(names.wordsWhere[word], fmt::format("there is no named medium \"{}\"{}",
                                                    shown(name), didYouMean(name, known)));
  }
  MediumDefinition& m = found->second;
  if (m.built || !scene_->integrator_->tracesMedia()) return m.built;
  scene_->media_.push_back(factory_.make<Medium>(
      m.type, m.params, m.where, {m.placed ? m.place : transforms_.base() * m.place}, nullptr,
      m.attributes.get()));
  return m.built = scene_->media_.back().get();
}

// Now that all names are known, and who looks at media.
void SceneBuilder::finishMedia() {
  scene_->bordersMedia_ = !interfaces_.empty();
  for (const auto& entry : interfaces_)
    factory_.attempt([&] {
      const auto& [sides, directive] = entry.second;
      const auto named = std::get<2>(entry.first);
      *sides = {medium(*directive, 0, named), medium(*directive, 1, named)};
    });
  if (cameraMedia_)
    factory_.attempt([&] { scene_->cameraMedium_ = medium(*cameraMedia_, 1, cameraMediaNamed_); });

  const bool traced = scene_->integrator_->tracesMedia();
  const auto note = [&](const Location& where, std::string_view message) {
    factory_.report(Severity::warning, where, std::string(message));
  };
  if (firstMedia_ && !traced)
    note(firstMedia_->where,
         "this integrator sees no participating media: the picture shows clear air (\"volpath\" "
         "sees them)");
  if (scene_->regions_.empty()) return;
  if (traced) {
    if (volumeIntegrator_)
      note(volumeIntegrator_->where, "without effect: the integrator traces light through volumes");
    return;
  }
  const SamplingIntegrator* surface = scene_->integrator_->sampling();
  const auto check = [&](const Integrator& made) {
    if (!made.volume())
      throw Error(volumeIntegrator_->wordsWhere.at(0),
                  fmt::format("\"{}\" is no volume integrator: it is one of emission, single",
                              shown(volumeIntegrator_->words.at(0))));
  };
  scene_->surfaceIntegrator_ = std::move(scene_->integrator_);
  scene_->integrator_ = makeOption<Integrator>(volumeIntegrator_, DirectiveKind::VolumeIntegrator,
                                               "emission", Integrator::Setup{surface}, check);
  scene_->volume_ = scene_->integrator_->volume();
}

}  // namespace pbrt
