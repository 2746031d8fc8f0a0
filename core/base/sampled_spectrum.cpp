#include "core/base/sampled_spectrum.h"

#include <cmath>

namespace pbrt {

double SampledSpectrum::at(double nm) const {
  const auto next = samples_.upper_bound(nm);
  if (next == samples_.begin()) return next->second;
  const auto last = std::prev(next);
  if (next == samples_.end()) return last->second;
  return std::lerp(last->second, next->second, (nm - last->first) / (next->first - last->first));
}

}  // namespace pbrt
