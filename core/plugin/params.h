#pragma once
// Checked reading of parameters. The reader is the declaration: one call reads, checks, defaults
// and documents a parameter, so that `pbrt --describe` needs nothing else.

#include <filesystem>
#include <optional>
#include <span>

#include "core/api/material.h"
#include "core/base/sampled_spectrum.h"
#include "core/plugin/param.h"

namespace pbrt {

// One line of `pbrt --describe`.
struct Declaration {
  std::string name;
  std::string type;          // as a scene file writes it
  std::string defaultValue;  // empty: required; "-": may be left out
  std::string meaning;
  std::string unit;  // empty: a pure number or no number
};

// Where named textures and materials come from.
class TextureLibrary {
 public:
  virtual ~TextureLibrary() = default;
  // Never null: throws Error (with "did you mean") if there is none of this name and type.
  virtual std::shared_ptr<const Texture<float>> floatTexture(const std::string& name) = 0;
  virtual std::shared_ptr<const Texture<Spectrum>> spectrumTexture(const std::string& name) = 0;
  virtual std::shared_ptr<const Material> material(const std::string& name) = 0;
};

// The parameters of one plug-in object. Every reading function throws Error with the place of the
// offending parameter; a wrong type, count or range never gives a silent default.
class Params {
 public:
  // What is read: one or more lists, the first that has a name wins (a shape's parameters go
  // before its material's), then `defaults`, which a dialect of the format may supply.
  // Locations and lists must outlive this object. `what` is "shapes/sphere".
  Params(std::string what, Location where, std::vector<const ParamList*> lists,
         TextureLibrary* textures = nullptr, Reporter report = {},
         const ParamList* defaults = nullptr);
  // For `--describe`: has no values, gives every default (zeros for what is required), and
  // records the declarations.
  static Params describing(std::string what, std::vector<Declaration>& declarations);

  // -- one value ------------------------------------------------------------------------------
  float number(const std::string& name, float fallback, std::string_view meaning,
               std::string_view unit = "");
  float positive(const std::string& name, float fallback, std::string_view meaning,
                 std::string_view unit = "");  // > 0
  float nonNegative(const std::string& name, float fallback, std::string_view meaning,
                    std::string_view unit = "");  // >= 0
  float inRange(const std::string& name, float fallback, float lo, float hi,
                std::string_view meaning, std::string_view unit = "");  // lo <= x <= hi
  std::optional<float> optionalNumber(const std::string& name, std::string_view meaning,
                                      std::string_view unit = "");
  int integer(const std::string& name, int fallback, int lo, int hi, std::string_view meaning);
  bool flag(const std::string& name, bool fallback, std::string_view meaning);
  std::string text(const std::string& name, const std::string& fallback, std::string_view meaning);
  std::string choice(const std::string& name, std::span<const std::string_view> allowed,
                     std::string_view fallback, std::string_view meaning);
  // Any number of the allowed names; empty if absent.
  std::vector<std::string> choices(const std::string& name,
                                   std::span<const std::string_view> allowed,
                                   std::string_view meaning);
  // Materials by their names, none of them null; empty if absent.
  std::vector<std::shared_ptr<const Material>> materials(const std::string& name,
                                                         std::string_view meaning);
  // A file to read: looked for in the folder of the scene file that names it, in the folder given
  // to alsoSearch(), and in the working directory; with / for \ where that is not there. Empty if
  // absent; an error if it is in none of them, or is there but is a folder, a device or a pipe.
  std::filesystem::path file(const std::string& name, std::string_view meaning);
  Point3 point(const std::string& name, const Point3& fallback, std::string_view meaning);
  Vec3 vector(const std::string& name, const Vec3& fallback, std::string_view meaning);

  // -- colours, in linear Rec. 709 ----------------------------------------------------------------
  // Given as "rgb"; "xyz"; "spectrum": pairs of a wavelength in nm and a value, a file of them, or
  // a name (core/base/named_spectra.h); "blackbody": temperatures in K, each with a scale of its
  // peak, the sum of which counts, or one alone: luminance 1. Lamps among the names have luminance
  // 1 too.
  //
  // Of a surface: a reflectance, an index of refraction, a scale (surfaceColour()).
  Spectrum spectrum(const std::string& name, const Spectrum& fallback, std::string_view meaning);
  std::optional<Spectrum> optionalSpectrum(const std::string& name, std::string_view meaning);
  // Of a light (emittedColour()).
  Spectrum emission(const std::string& name, const Spectrum& fallback, std::string_view meaning);
  // A number above 0, or what a spectrum has at the sodium D line, 589.3 nm.
  float refractiveIndex(const std::string& name, float fallback, std::string_view meaning);

  // -- values or textures ----------------------------------------------------------------------
  Textured<float> floatTexture(const std::string& name, float fallback, std::string_view meaning,
                               std::string_view unit = "");
  Textured<Spectrum> spectrumTexture(const std::string& name, const Spectrum& fallback,
                                     std::string_view meaning);
  // As above with no default: empty if the parameter is absent.
  std::optional<Textured<float>> optionalFloatTexture(const std::string& name,
                                                      std::string_view meaning);
  std::optional<Textured<Spectrum>> optionalSpectrumTexture(const std::string& name,
                                                            std::string_view meaning);
  // refractiveIndex() or a texture of it, whose values may be anything.
  std::optional<Textured<float>> optionalRefractiveIndex(const std::string& name,
                                                         std::string_view meaning);
  template <class T>  // float or Spectrum, for textures of either kind
  Textured<T> texture(const std::string& name, float fallback, std::string_view meaning);

  // -- lists; empty if absent --------------------------------------------------------------------
  std::vector<float> numbers(const std::string& name, std::string_view meaning,
                             std::string_view unit = "");
  std::vector<int> integers(const std::string& name, std::string_view meaning);
  std::vector<Point2> points2(const std::string& name, std::string_view meaning);
  std::vector<Point3> points(const std::string& name, std::string_view meaning);
  std::vector<Vec3> vectors(const std::string& name, std::string_view meaning);
  std::vector<Normal3> normals(const std::string& name, std::string_view meaning);
  std::vector<Spectrum> spectra(const std::string& name, std::string_view meaning);

  // -- errors -------------------------------------------------------------------------------------
  bool has(const std::string& name) const;
  // Whether reading it gives something else than the fallback: it is given, or among the defaults.
  bool available(const std::string& name) const;
  // The plug-in's own complaint, at the parameter's value (or the statement, if it is absent).
  [[noreturn]] void fail(const std::string& name, const std::string& message) const;
  // Throws if the parameter is absent: call after the reading that declared it.
  void require(const std::string& name) const;
  void warn(const std::string& name, const std::string& message) const;

  // True while a --describe reads: values are defaults, so relations between them need not hold.
  bool describing() const { return declarations_ != nullptr; }
  // Where file() looks after the folder of the scene file that names the file: for a scene in
  // parts, the folder of the first.
  void alsoSearch(std::filesystem::path folder) { alsoSearch_ = std::move(folder); }
  // From here on emission() brings a "spectrum" to luminance 1, as pbrt-v4 does.
  void bringLightsToLuminanceOne() { unitLights_ = true; }
  // More names that a scene may have meant by one that nobody read.
  void alsoKnown(const std::vector<std::string>& names) {
    known_.insert(known_.end(), names.begin(), names.end());
  }
  // The statement.
  const Location& where() const { return where_; }
  // Parameters of list `i` that nobody read, and the error that says so, with "did you mean".
  std::vector<const Param*> unread(std::size_t i = 0) const;
  Diagnostic unknown(const Param& param) const;
  // Throws if list `i` has unread parameters, with all of them at once.
  void refuseUnread(std::size_t i = 0) const;

 private:
  struct Use {
    const ParamList* list;
    std::vector<bool> read;
  };

  enum class Colour : std::uint8_t { ofSurface, ofLight };
  struct Search {
    std::filesystem::path found;     // empty: none of those that were tried is a file
    std::vector<std::string> tried;  // in their order
    std::string notAFile;            // one of them that is there: a folder, a device ...
    std::string allTried() const;    // for a message
  };

  const Param* find(const std::string& name, std::span<const ParamType> types,
                    std::string_view wanted);
  void refuseOthers(const std::string& name, const std::string& value,
                    std::span<const std::string_view> allowed) const;
  void declare(const std::string& name, std::string_view type, std::string fallback,
               std::string_view meaning, std::string_view unit = "");
  template <class V>
  std::vector<V> list(const std::string& name, std::span<const ParamType> types,
                      std::string_view type, std::string_view meaning, std::string_view unit = "");
  float onlyNumber(const Param& p) const;
  Spectrum colour(const Param& p, Colour kind) const;
  std::vector<Spectrum> colours(const Param& p, Colour kind) const;
  std::vector<Spectrum> blackbodies(const Param& p) const;
  SampledSpectrum samples(const Param& p) const;
  SampledSpectrum fileOrNamed(const Param& p, const std::string& given) const;
  Search search(const std::string& name, const std::string& given) const;
  template <class T>
  std::shared_ptr<const Texture<T>> named(
      const Param& p,
      std::shared_ptr<const Texture<T>> (TextureLibrary::*lookUp)(const std::string&));
  Location place(const std::string& name) const;
  std::string message(const std::string& text) const { return what_ + ": " + text; }

  std::string what_;
  Location where_;
  std::vector<Use> uses_;
  const ParamList* defaults_ = nullptr;
  TextureLibrary* textures_ = nullptr;
  Reporter report_;
  std::filesystem::path alsoSearch_;
  bool unitLights_ = false;
  std::vector<std::string> known_;  // every name asked for, for "did you mean"
  std::vector<Declaration>* declarations_ = nullptr;
};

template <>
Textured<float> Params::texture<float>(const std::string& name, float fallback,
                                       std::string_view meaning);
template <>
Textured<Spectrum> Params::texture<Spectrum>(const std::string& name, float fallback,
                                             std::string_view meaning);

}  // namespace pbrt
