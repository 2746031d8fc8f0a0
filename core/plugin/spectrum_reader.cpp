#include "core/plugin/spectrum_reader.h"

#include <fmt/format.h>

#include <cmath>

#include "core/base/file.h"
#include "core/base/words.h"

namespace pbrt {

namespace {

constexpr std::size_t kLargest = std::size_t{16} << 20U;  // bytes

double valueOf(const Location& word) {
  const std::optional<double> value = numberOf(word);
  if (!value) throw Error(word, "expected a number: pairs of a wavelength in nm and a value");
  return *value;
}

}  // namespace

void SpectrumReader::add(double nm, double value, const Location& where) {
  if (!(nm > 0)) throw Error(where, fmt::format("a wavelength must be above 0 nm, not {}", nm));
  if (!samples_.emplace(nm, value).second)
    throw Error(where, fmt::format("the spectrum has two values at {} nm", nm));
  ascending_ = ascending_ && nm > last_;
  last_ = nm;
}

SampledSpectrum SpectrumReader::finish(const Location& where, const Reporter& report) {
  if (samples_.empty())
    throw Error(where, "a spectrum needs pairs of a wavelength in nm and a value");
  const auto warn = [&](std::string text) {
    if (report) report(diagnose(Severity::warning, where, std::move(text)));
  };
  if (!ascending_) warn("the wavelengths of the spectrum do not ascend; they are sorted");
  const double first = samples_.begin()->first;
  const double last = samples_.rbegin()->first;
  const double visibleEnd =
      kVisibleBegin + kVisibleStep * static_cast<double>(kColourMatching.size() - 1);
  if (first < last && (last < kVisibleBegin || first > visibleEnd))
    warn(
        fmt::format("the spectrum says nothing of visible light, {} to {} nm: it runs from {} to "
                    "{} nm",
                    kVisibleBegin, visibleEnd, first, last));
  return SampledSpectrum(std::move(samples_));
}

SampledSpectrum readSpectrumFile(const std::filesystem::path& path, const Reporter& report) {
  const Source source{path.string(), readFile(path, FileKind::regular, kLargest)};
  const std::vector<Location> words = wordsOf(source);
  if (words.size() % 2 != 0) {
    valueOf(words.back());
    throw Error(words.back(), "a wavelength without a value ends the spectrum");
  }
  SpectrumReader reader;
  for (std::size_t i = 0; i < words.size(); i += 2) {
    const double nm = valueOf(words[i]);
    reader.add(nm, valueOf(words[i + 1]), words[i]);
  }
  return reader.finish({&source, 0, 1}, report);
}

}  // namespace pbrt
