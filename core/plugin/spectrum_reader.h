#pragma once
// Spectra as people write them: pairs of a wavelength and a value.

#include <filesystem>

#include "core/base/error.h"
#include "core/base/sampled_spectrum.h"

namespace pbrt {

// Takes the pairs in the order of the text.
class SpectrumReader {
 public:
  // `where`: the text of the pair. Throws Error for a wavelength that is not above 0 or came
  // before.
  void add(double nm, double value, const Location& where);
  // Warns if the wavelengths did not ascend, as they are sorted then, and if none of several is
  // visible; throws Error if there are none. `where`: the whole.
  SampledSpectrum finish(const Location& where, const Reporter& report);

 private:
  SampledSpectrum::Samples samples_;
  double last_ = 0;
  bool ascending_ = true;
};

// Reads a text file of pairs, divided by white space; # begins a comment. Throws Error with the
// place in that file; Failure::io if it cannot be read or has more than 16 MiB.
SampledSpectrum readSpectrumFile(const std::filesystem::path& path, const Reporter& report);

}  // namespace pbrt
