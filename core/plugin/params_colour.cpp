// Reading colours, indices of refraction, and what textures may stand for.

#include <fmt/format.h>

#include <array>
#include <numeric>

#include "core/base/colorimetry.h"
#include "core/base/colorspace.h"
#include "core/base/illuminants.h"
#include "core/base/named_spectra.h"
#include "core/plugin/params.h"
#include "core/plugin/spectrum_reader.h"

namespace pbrt {

namespace {

constexpr std::array kColour{ParamType::rgb, ParamType::xyz, ParamType::spectrum,
                             ParamType::blackbody};
constexpr std::array kIndex{ParamType::number, ParamType::integer, ParamType::spectrum};
constexpr std::array kIndexOrTexture{ParamType::number, ParamType::integer, ParamType::spectrum,
                                     ParamType::texture};
constexpr std::array kNumberOrTexture{ParamType::number, ParamType::integer, ParamType::texture};
constexpr std::array kColourOrTexture{ParamType::rgb, ParamType::xyz, ParamType::spectrum,
                                      ParamType::blackbody, ParamType::texture};
constexpr std::array kAnyOrTexture{ParamType::number, ParamType::integer,  ParamType::rgb,
                                   ParamType::xyz,    ParamType::spectrum, ParamType::blackbody,
                                   ParamType::texture};

// What --describe shows, and what completes `must be "..."`.
constexpr std::string_view kColourType = "rgb or spectrum";
constexpr std::string_view kColourWanted = "rgb\" or \"spectrum";
constexpr std::string_view kColourOrTextureType = "rgb, spectrum or texture";
constexpr std::string_view kColourOrTextureWanted = "rgb\", \"spectrum\" or \"texture";

std::string show(const Spectrum& c) {
  return fmt::format("{} {} {}", c.x, c.y, c.z);
}

// pbrt-v3's own files of metals, "spds/Cu.eta.spd", which exporters write: "metal-Cu-eta".
std::string metalOfFile(const std::string& given) {
  std::string base = given.substr(given.find_last_of("/\\") + 1);
  if (!base.ends_with(".eta.spd") && !base.ends_with(".k.spd")) return "";
  base.erase(base.size() - 4);
  base[base.rfind('.')] = '-';
  return "metal-" + base;
}

}  // namespace

SampledSpectrum Params::fileOrNamed(const Param& p, const std::string& given) const {
  if (auto named = namedSpectrum(given)) return *std::move(named);
  const Search s = search(p.name, given);
  if (s.found.empty()) {
    if (auto metal = namedSpectrum(metalOfFile(given))) return *std::move(metal);
    fail(p.name,
         fmt::format("is \"{}\", which is neither a file ({}) nor one of the named spectra{}",
                     shown(given), s.allTried(), didYouMean(given, spectrumNames())));
  }
  try {
    return readSpectrumFile(s.found, report_);
  } catch (const Error& error) {
    auto diagnostics = error.diagnostics();
    diagnostics.push_back(diagnose(Severity::note, p.valueWhere,
                                   message(fmt::format("\"{}\" is given by that file", p.name))));
    throw Error(std::move(diagnostics), error.failure());
  }
}

// The one spectrum of a parameter of that type.
SampledSpectrum Params::samples(const Param& p) const {
  if (const auto* names = std::get_if<std::vector<std::string>>(&p.values)) {
    if (names->size() != 1) fail(p.name, fmt::format("needs 1 spectrum, not {}", names->size()));
    return fileOrNamed(p, names->front());
  }
  const std::vector<float> flat = numbersOf(p);
  SpectrumReader reader;
  for (std::size_t i = 0; i + 1 < flat.size(); i += 2)
    reader.add(flat[i], flat[i + 1], p.valueWhere);
  return reader.finish(p.valueWhere, report_);
}

std::vector<Spectrum> Params::blackbodies(const Param& p) const {
  const std::vector<float> flat = numbersOf(p);
  for (std::size_t i = 0; i < flat.size(); i += 2)
    if (!(flat[i] > 0)) fail(p.name, fmt::format("needs a temperature above 0 K, not {}", flat[i]));
  if (flat.size() == 1) {
    const Spectrum lamp = colourOfLamp(blackbody(flat[0]));
    if (isBlack(lamp)) fail(p.name, fmt::format("gives no visible light at {} K", flat[0]));
    return {lamp};
  }
  std::vector<Spectrum> found;
  for (std::size_t i = 0; i + 1 < flat.size(); i += 2)
    found.push_back(flat[i + 1] * emittedColour(blackbody(flat[i])));
  return found;
}

std::vector<Spectrum> Params::colours(const Param& p, Colour kind) const {
  if (p.type == ParamType::blackbody) return blackbodies(p);
  const auto fromSpectrum = [kind](const SampledSpectrum& s) {
    return kind == Colour::ofLight ? emittedColour(s) : surfaceColour(s);
  };
  std::vector<Spectrum> found;
  if (const auto* names = std::get_if<std::vector<std::string>>(&p.values)) {
    for (const std::string& name : *names) {
      const SampledSpectrum s = fileOrNamed(p, name);
      found.push_back(isIlluminant(name) ? colourOfLamp(s) : fromSpectrum(s));
    }
    return found;
  }
  if (p.type == ParamType::spectrum) return {fromSpectrum(samples(p))};

  const std::vector<float> flat = numbersOf(p);
  if (flat.size() % 3 != 0)
    fail(p.name, fmt::format("has {} numbers, which is not a multiple of 3", flat.size()));
  for (std::size_t i = 0; i < flat.size(); i += 3) {
    const Spectrum c(flat[i], flat[i + 1], flat[i + 2]);
    found.push_back(p.type == ParamType::xyz ? Spectrum(rec709FromXyz() * DVec3(c)) : c);
  }
  return found;
}

// The only colour of a parameter that stands for one; black bodies shine together.
Spectrum Params::colour(const Param& p, Colour kind) const {
  const std::vector<Spectrum> found = colours(p, kind);
  if (found.empty() || (found.size() > 1 && p.type != ParamType::blackbody))
    fail(p.name, fmt::format("needs 1 colour, not {}", found.size()));
  return std::accumulate(found.begin(), found.end(), Spectrum(0));
}

Spectrum Params::spectrum(const std::string& name, const Spectrum& fallback,
                          std::string_view meaning) {
  declare(name, kColourType, show(fallback), meaning);
  const Param* p = find(name, kColour, kColourWanted);
  return p ? colour(*p, Colour::ofSurface) : fallback;
}

std::optional<Spectrum> Params::optionalSpectrum(const std::string& name,
                                                 std::string_view meaning) {
  if (available(name)) return spectrum(name, Spectrum(0), meaning);
  declare(name, kColourType, "-", meaning);
  return {};
}

Spectrum Params::emission(const std::string& name, const Spectrum& fallback,
                          std::string_view meaning) {
  declare(name, kColourType, show(fallback), meaning);
  const Param* p = find(name, kColour, kColourWanted);
  if (!p) return fallback;
  const Spectrum L = colour(*p, Colour::ofLight);
  const bool bring = unitLights_ && p->type == ParamType::spectrum && luminance(L) > 0;
  return bring ? L / luminance(L) : L;
}

std::vector<Spectrum> Params::spectra(const std::string& name, std::string_view meaning) {
  declare(name, kColourType, "-", meaning);
  const Param* p = find(name, kColour, kColourWanted);
  return p ? colours(*p, Colour::ofSurface) : std::vector<Spectrum>();
}

float Params::refractiveIndex(const std::string& name, float fallback, std::string_view meaning) {
  constexpr double kSodium = 589.3;  // nm, the mean of the D lines: n_D of glass makers
  declare(name, "float or spectrum", fmt::format("{}", fallback), meaning);
  const Param* p = find(name, kIndex, "float\" or \"spectrum");
  if (!p) return fallback;
  const float index =
      p->type == ParamType::spectrum ? static_cast<float>(samples(*p).at(kSodium)) : onlyNumber(*p);
  if (!(index > 0)) fail(name, fmt::format("must be above 0, not {}", index));
  return index;
}

std::optional<Textured<float>> Params::optionalRefractiveIndex(const std::string& name,
                                                               std::string_view meaning) {
  const Param* p = find(name, kIndexOrTexture, "float\", \"spectrum\" or \"texture");
  if (p && p->type == ParamType::texture) return floatTexture(name, 1, meaning);
  if (p) return Textured<float>(refractiveIndex(name, 1, meaning));
  declare(name, "float, spectrum or texture", "-", meaning);
  return {};
}

// The texture that a parameter names, by one of the library's two functions.
template <class T>
std::shared_ptr<const Texture<T>> Params::named(
    const Param& p,
    std::shared_ptr<const Texture<T>> (TextureLibrary::*lookUp)(const std::string&)) {
  if (!textures_) fail(p.name, "cannot be a texture here");
  try {
    return (textures_->*lookUp)(std::get<std::vector<std::string>>(p.values).at(0));
  } catch (const Error& error) {
    throw error.at(p.valueWhere);
  }
}

Textured<float> Params::floatTexture(const std::string& name, float fallback,
                                     std::string_view meaning, std::string_view unit) {
  declare(name, "float or texture", fmt::format("{}", fallback), meaning, unit);
  const Param* p = find(name, kNumberOrTexture, "float\" or \"texture");
  if (!p) return Textured<float>(fallback);
  if (p->type != ParamType::texture) return Textured<float>(onlyNumber(*p));
  return Textured<float>(named(*p, &TextureLibrary::floatTexture));
}

Textured<Spectrum> Params::spectrumTexture(const std::string& name, const Spectrum& fallback,
                                           std::string_view meaning) {
  declare(name, kColourOrTextureType, show(fallback), meaning);
  const Param* p = find(name, kColourOrTexture, kColourOrTextureWanted);
  if (!p) return Textured<Spectrum>(fallback);
  if (p->type != ParamType::texture) return Textured<Spectrum>(colour(*p, Colour::ofSurface));
  return Textured<Spectrum>(named(*p, &TextureLibrary::spectrumTexture));
}

std::optional<Textured<float>> Params::optionalFloatTexture(const std::string& name,
                                                            std::string_view meaning) {
  if (available(name)) return floatTexture(name, 0, meaning);
  declare(name, "float or texture", "-", meaning);
  return {};
}

std::optional<Textured<Spectrum>> Params::optionalSpectrumTexture(const std::string& name,
                                                                  std::string_view meaning) {
  if (available(name)) return spectrumTexture(name, Spectrum(0), meaning);
  declare(name, kColourOrTextureType, "-", meaning);
  return {};
}

template <>
Textured<float> Params::texture<float>(const std::string& name, float fallback,
                                       std::string_view meaning) {
  return floatTexture(name, fallback, meaning);
}

template <>
Textured<Spectrum> Params::texture<Spectrum>(const std::string& name, float fallback,
                                             std::string_view meaning) {
  // A grey value may stand for a colour: textures of both kinds share their scene files.
  const Param* p = find(name, kAnyOrTexture, kColourOrTextureWanted);
  if (!p || (p->type != ParamType::number && p->type != ParamType::integer))
    return spectrumTexture(name, Spectrum(fallback), meaning);
  declare(name, kColourOrTextureType, fmt::format("{}", fallback), meaning);
  return Textured<Spectrum>(Spectrum(onlyNumber(*p)));
}

}  // namespace pbrt
