#include "merge.h"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>

#include "core/base/error.h"
#include "core/scene/film_pixel.h"
#include "core/scene/picture_attributes.h"
#include "sample_box.h"

namespace pbrt {

namespace fs = std::filesystem;

namespace {

struct Part {
  fs::path file;
  std::unique_ptr<FilmReader> reader;

  const FilmInfo& info() const { return reader->info(); }
  SampleBox box() const { return {info().window, info().firstSample, info().endSample}; }
};

// All parts are open at the same time; a process may have as many files open as the hard limit
// says, but has to ask for it.
void allowOpenFiles(std::size_t parts) {
  constexpr rlim_t kOthers = 64;
  const rlim_t needed = parts + kOthers;
  rlimit limit{};
  if (getrlimit(RLIMIT_NOFILE, &limit) != 0 || limit.rlim_cur >= needed) return;
  limit.rlim_cur = std::min(needed, limit.rlim_max);
  setrlimit(RLIMIT_NOFILE, &limit);
  if (limit.rlim_cur < needed)
    throw Error(fmt::format("{} films are more than this process may have open ({}): raise the "
                            "limit (ulimit -n), or merge groups of them to films first: the "
                            "result is the same",
                            parts, limit.rlim_max),
                Failure::io);
}

[[noreturn]] void refuse(const std::string& message) {
  throw Error(message, Failure::scene);
}

void checkSameRender(const Part& wanted, const Part& found) {
  const FilmInfo &a = wanted.info(), &b = found.info();
  std::string why = difference(a.key, b.key);
  if (why.empty() && (a.resolution != b.resolution || a.aovs != b.aovs || a.origin != b.origin))
    why = "its film is of another kind";
  if (!why.empty())
    refuse(fmt::format("{} is no part of the same render as {}: {}", found.file.string(),
                       wanted.file.string(), why));
}

// Of a film that was.
std::string interruption(const FilmInfo& info) {
  return fmt::format("was interrupted: pixels have {} to {} samples",
                     info.endSample - info.firstSample, info.mostEndSample() - info.firstSample);
}

void checkUninterrupted(const Part& part) {
  if (!part.info().interrupted()) return;
  const std::string name = part.file.string();
  refuse(fmt::format("{} {}; go on with it first (pbrt --resume --checkpoint {})", name,
                     interruption(part.info()), name));
}

void checkTiling(const std::vector<Part>& parts, const std::vector<SampleBox>& boxes,
                 const SampleBox& whole) {
  const Point2i resolution = parts[0].info().resolution;
  if (const auto both = overlapping(boxes)) {
    const auto [i, j] = *both;
    refuse(fmt::format("{} and {} hold the same samples: {}", parts[i].file.string(),
                       parts[j].file.string(), describe(common(boxes[i], boxes[j]), resolution)));
  }
  const std::vector<SampleBox> gaps = missing(whole, boxes);
  if (gaps.empty()) return;
  constexpr std::size_t kMost = 8;
  std::string message = "the films leave gaps; not there is";
  for (std::size_t i = 0; i < std::min(gaps.size(), kMost); ++i)
    message += "\n  " + describe(gaps[i], resolution);
  if (gaps.size() > kMost) message += fmt::format("\n  and {} more", gaps.size() - kMost);
  refuse(message);
}

// The instruction set that it was rendered by.
ImageAttribute instructions(const FilmInfo& info) {
  const auto found = info.attributes.find("instructionSet");
  return found == info.attributes.end() ? ImageAttribute() : found->second;
}

}  // namespace

MergedFilm::MergedFilm(const std::vector<fs::path>& files) {
  allowOpenFiles(files.size());
  std::vector<Part> parts;
  for (const fs::path& file : files) parts.push_back({file, std::make_unique<FilmReader>(file)});
  if (parts.size() > 1) {
    for (const Part& part : parts) {
      checkSameRender(parts[0], part);
      checkUninterrupted(part);
    }
  }
  // What is told of the whole does not depend on the order in which they were named.
  std::ranges::stable_sort(parts, [](const Part& a, const Part& b) {
    const SampleBox x = a.box(), y = b.box();
    return std::tuple(x.lo.z, x.lo.y, x.lo.x) < std::tuple(y.lo.z, y.lo.y, y.lo.x);
  });
  std::vector<SampleBox> boxes;
  for (const Part& part : parts) boxes.push_back(part.box());
  const SampleBox whole = hull(boxes);
  if (parts.size() > 1) checkTiling(parts, boxes, whole);

  info_ = parts[0].info();
  info_.window = whole.pixels();
  info_.firstSample = static_cast<std::uint32_t>(whole.lo.z);
  info_.endSample = static_cast<std::uint32_t>(whole.hi.z);
  y_ = info_.window.lo.y;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i > 0) {
      info_.hidden &= parts[i].info().hidden;  // not by those who asked for it
      info_.badSamples += parts[i].info().badSamples;
      info_.seconds += parts[i].info().seconds;
    }
    differentProcessors_ |= instructions(parts[i].info()) != instructions(info_);
    parts_.push_back(std::move(parts[i].reader));
  }
}

void MergedFilm::read(std::span<FilmPixel> row) {
  std::ranges::fill(row, FilmPixel());
  std::vector<FilmPixel> pixels;
  for (const auto& part : parts_) {
    const Bounds2i& window = part->info().window;
    if (y_ < window.lo.y || y_ >= window.hi.y) continue;
    pixels.resize(static_cast<std::size_t>(window.width()));
    part->read(pixels);
    for (std::size_t i = 0; i < pixels.size(); ++i)
      row[i + static_cast<std::size_t>(window.lo.x - info_.window.lo.x)] += pixels[i];
  }
  ++y_;
}

void MergedFilm::finish() {
  for (const auto& part : parts_) part->finish();
}

std::string incompleteness(const FilmInfo& info) {
  if (info.interrupted()) return "it " + interruption(info);
  const Bounds2i picture{Point2i(0), info.resolution};
  const auto samples = static_cast<std::uint32_t>(info.key.samplesPerPixel);
  if (info.window == picture && info.firstSample == 0 && info.endSample >= samples) return "";
  return fmt::format("it holds {} of --samples 0..{}",
                     describe({info.window, info.firstSample, info.endSample}, info.resolution),
                     samples);
}

void writeMerged(MergedFilm& film, const std::vector<fs::path>& outputs) {
  const FilmInfo& info = film.info();
  std::vector<std::unique_ptr<FilmWriter>> films;
  std::vector<fs::path> pictures;
  for (const fs::path& output : outputs)
    if (isFilm(output))
      films.push_back(std::make_unique<FilmWriter>(output, info));
    else
      checkWritable(pictures.emplace_back(output));

  const auto next = [&](std::span<FilmPixel> row) {
    film.read(row);
    for (const auto& out : films) out->write(row);
  };
  Image image;
  if (pictures.empty()) {
    std::vector<FilmPixel> row(static_cast<std::size_t>(info.window.width()));
    for (int y = info.window.lo.y; y < info.window.hi.y; ++y) next(row);
  } else {
    const AovSet shown = info.aovs & ~info.hidden;
    image = pictureOf({info.resolution, info.window, shown, info.origin},
                      [&](int, std::span<FilmPixel> row) { next(row); });
    image.attributes = pictureAttributes(info);
  }
  film.finish();
  for (const auto& out : films) out->commit();
  for (const fs::path& picture : pictures) writeImage(picture, image);
}

}  // namespace pbrt
