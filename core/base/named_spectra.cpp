#include "core/base/named_spectra.h"

#include <functional>

#include "core/base/illuminants.h"
#include "core/base/optical_constants.h"

namespace pbrt {

namespace {

using Catalogue = std::map<std::string, std::function<SampledSpectrum()>, std::less<>>;

SampledSpectrum tabulated(const Metal& metal, double OpticalConstants::*part) {
  SampledSpectrum::Samples samples;
  for (const OpticalConstants& row : metal.constants) samples.emplace(row.nm, row.*part);
  return SampledSpectrum(std::move(samples));
}

SampledSpectrum clear() {
  return constantSpectrum(0);
}

Catalogue makeCatalogue() {
  Catalogue all;
  for (const Metal& metal : kMetals) {
    const std::string name = "metal-" + std::string(metal.name);
    all[name + "-eta"] = [&metal] { return tabulated(metal, &OpticalConstants::eta); };
    all[name + "-k"] = [&metal] { return tabulated(metal, &OpticalConstants::k); };
  }
  all["metal-MgO-eta"] = [] { return sampleVisible(magnesiaIndex); };
  all["metal-MgO-k"] = clear;
  all["metal-TiO2-eta"] = [] { return sampleVisible(rutileIndex); };
  all["metal-TiO2-k"] = clear;
  for (const Glass& glass : kGlasses)
    all["glass-" + std::string(glass.name)] = [&glass] {
      return sampleVisible([&glass](double nm) { return glass.index(nm); });
    };
  all["stdillum-A"] = illuminantA;
  all["stdillum-D50"] = illuminantD50;
  all["stdillum-D65"] = illuminantD65;
  for (int i = 1; i <= static_cast<int>(kFluorescent.size()); ++i)
    all["stdillum-F" + std::to_string(i)] = [i] { return fluorescent(i); };
  // The white of ACES is that of daylight at 6000 K (TB-2014-004).
  all["illum-acesD60"] = [] { return daylight(6000); };
  return all;
}

const Catalogue& catalogue() {
  static const Catalogue all = makeCatalogue();
  return all;
}

}  // namespace

std::optional<SampledSpectrum> namedSpectrum(std::string_view name) {
  const auto found = catalogue().find(name);
  if (found == catalogue().end()) return {};
  return found->second();
}

std::vector<std::string> spectrumNames() {
  std::vector<std::string> names;
  for (const auto& entry : catalogue()) names.push_back(entry.first);
  return names;
}

bool isIlluminant(std::string_view name) {
  return name.starts_with("stdillum-") || name.starts_with("illum-");
}

}  // namespace pbrt
