#pragma once
// Films on disk (*.film): the sums of a render before they are divided, so that it can be continued
// and put together with others.

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "core/base/image.h"
#include "core/scene/film.h"
#include "core/scene/render_key.h"

namespace pbrt {

// What a film file says of itself.
struct FilmInfo {
  RenderKey key;
  Point2i resolution{0};          // of the whole picture
  Bounds2i window;                // its pixels
  AovSet aovs = 0;                // what is stored for each
  AovSet hidden = 0;              // of it, what pictures do not show
  std::uint32_t firstSample = 0;  // of each pixel
  // One past the last sample that each tile of the film has (Film::tiles()): they differ if the
  // render was interrupted. Empty: all have `endSample`, and there may be no such tiles, as in a
  // merged film.
  std::vector<std::uint32_t> reached;
  std::uint32_t endSample = 0;  // the least of them
  // To which sample the pass was to go that was interrupted, where passes end by the estimated
  // error: gone on with, they end there again. 0: passes are free.
  std::uint32_t passEnd = 0;
  DPoint3 origin{0};                                 // of render space in the world
  std::uint64_t badSamples = 0;                      // that were not a number or threw
  double seconds = 0;                                // of rendering, of all runs together
  std::map<std::string, ImageAttribute> attributes;  // for the picture

  bool interrupted() const { return !reached.empty(); }
  // As endSample, but the greatest.
  std::uint32_t mostEndSample() const {
    return interrupted() ? *std::ranges::max_element(reached) : endSample;
  }
};

// By its name.
bool isFilm(const std::filesystem::path& file);

// Reads one: its header at once, then row by row. Throws Error, Failure::io: not there, no film
// file, of another version, damaged (every byte is under a check sum), cut off.
class FilmReader {
 public:
  explicit FilmReader(const std::filesystem::path& file);
  ~FilmReader();
  FilmReader(const FilmReader&) = delete;
  FilmReader& operator=(const FilmReader&) = delete;

  const FilmInfo& info() const;
  // The next row of the window, from the top: window.width() pixels.
  void read(std::span<FilmPixel> row);
  // After the last row: throws if the check sum is wrong.
  void finish();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// Writes one: whole or not at all, and on the disk before an old one of this name goes. Throws
// Error, Failure::io.
class FilmWriter {
 public:
  FilmWriter(const std::filesystem::path& file, const FilmInfo& info);
  ~FilmWriter();
  FilmWriter(const FilmWriter&) = delete;
  FilmWriter& operator=(const FilmWriter&) = delete;

  void write(std::span<const FilmPixel> row);
  void commit();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

// A whole film. `info` gives what the film does not know itself: all but resolution, window, aovs
// and origin; endSample follows from `reached`, which comes to be empty if all tiles are equal.
void writeFilm(const std::filesystem::path& file, const Film& film, FilmInfo info);
// Adds what a file holds to a film of the same window and AOVs, which must be empty and is not to
// be used after an error: damage may show at the end. The caller has compared the keys.
FilmInfo readFilm(const std::filesystem::path& file, Film& film);

}  // namespace pbrt
