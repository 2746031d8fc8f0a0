#pragma once
// Laws: what the interfaces of core/api promise, as checks that any plug-in can be put to, by the
// tests of this project and by `pbrt-plugin check` alike.

#include <fmt/format.h>

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "core/plugin/loader.h"

namespace pbrt::laws {

// Hears a law's findings.
class Judge {
 public:
  static constexpr std::size_t kMostKept = 3;

  // One more trial. Where it fails, `what` tells a person why, with the ray or the number that
  // shows it. Returns `ok`.
  template <class... Args>
  bool expect(bool ok, fmt::format_string<Args...> what, Args&&... args) {
    ++trials_;
    if (!ok) fail(what, std::forward<Args>(args)...);
    return ok;
  }
  template <class... Args>
  void fail(fmt::format_string<Args...> what, Args&&... args) {
    if (++failures_ <= kMostKept)
      findings_.push_back(fmt::format(what, std::forward<Args>(args)...));
  }
  // The law has nothing to say of this plug-in.
  void skip(std::string why) { skipped_ = std::move(why); }

  std::size_t trials() const { return trials_; }
  std::size_t failures() const { return failures_; }
  const std::vector<std::string>& findings() const { return findings_; }  // the first few
  const std::string& skipped() const { return skipped_; }                 // empty: it applied

 private:
  std::size_t trials_ = 0, failures_ = 0;
  std::vector<std::string> findings_;
  std::string skipped_;
};

// What a plug-in is known to be, where laws cannot tell by themselves. The defaults are the
// strictest.
struct Traits {
  // Shapes: no ray that leaves outward meets it again. A promise more.
  bool convex = false;
  // Shapes that turn towards every ray. Such a one is where the ray that met it saw it, and its
  // points' errors say how far off other rays may see it: half of this width off, and as much for
  // the normal's tilt.
  double facingWidth = 0;
  // Shapes: its normals, and what dp/dv is across, are those of a tube about it.
  bool looksRound = false;
  // Samplers: points are independent of one another, even those of one pixel.
  bool independentNumbers = false;
  // Filters: the weight jumps, at the edge for one.
  bool hasSteps = false;
  // Textures: finite even where the squares of coordinates overflow. A promise more.
  bool finiteAtAnySize = false;
  float albedo = 1;  // of a material: the largest share of light that its parts may add up to
};

// A plug-in and the parameters that it is made with.
struct Subject {
  const PluginInfo* plugin = nullptr;
  ParamList params;
  Traits traits;

  // As a scene would make it, with `more` parameters behind its own; not null. Throws Error, for
  // parameters that nobody reads as well.
  template <class Interface>
  std::unique_ptr<Interface> make(const typename Interface::Setup& setup = {},
                                  const ParamList& more = {}) const {
    Params reader(plugin->name, {}, {&params, &more});
    auto object = create<Interface>(*plugin, reader, setup);
    if (!object) throw Error("its create() gives no object", Failure::plugin);
    for (const std::size_t list : {0, 1}) reader.refuseUnread(list);
    return object;
  }
};

struct Law {
  std::string_view name;     // in words joined by hyphens: "hits-lie-on-the-ray"
  std::string_view promise;  // one sentence
  void (*check)(const Subject&, Judge&);
};

}  // namespace pbrt::laws
