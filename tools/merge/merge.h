#pragma once
// Films that are parts of one render, put together.

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/scene/film_file.h"

namespace pbrt {

// Films on disk as one: the same sums, and so the same picture bit for bit, as if one process had
// rendered it all. They are read side by side, row by row.
class MergedFilm {
 public:
  // Opens all. Throws Error: Failure::io if one cannot be read; Failure::scene if they are not
  // parts of one render, hold a sample twice, leave a gap in the box that they span, or are
  // several of which one was interrupted. `files` is not empty.
  explicit MergedFilm(const std::vector<std::filesystem::path>& files);

  // Of all together: if there is one file, just as that says.
  const FilmInfo& info() const { return info_; }

  // Whether they come from processors of different instruction sets (instructionSet()).
  bool differentProcessors() const { return differentProcessors_; }

  // The next row of info().window, from the top. Throws Error, Failure::io.
  void read(std::span<FilmPixel> row);
  // After the last row. Throws Error, Failure::io, if a file is damaged: nothing of it counts then.
  void finish();

 private:
  std::vector<std::unique_ptr<FilmReader>> parts_;
  FilmInfo info_;
  bool differentProcessors_ = false;
  int y_ = 0;  // the next row
};

// What a person should know of a film: that it was interrupted, or is not all of its render. Empty:
// it is whole.
std::string incompleteness(const FilmInfo& info);

// Writes each output: sums if its name ends in .film, else a picture. No output appears before all
// is read and right. Throws Error.
void writeMerged(MergedFilm& film, const std::vector<std::filesystem::path>& outputs);

}  // namespace pbrt
