#include "core/scene/film_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <bit>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <system_error>

#include "core/base/error.h"
#include "core/base/hash.h"
#include "core/base/replacement.h"
#include "core/scene/film_header.h"

// A film file is
//   kMagic;
//   a line of JSON (film_header.h), its length before it in 8 bytes, its hash behind it in 8;
//   row by row, from the top, pixel by pixel, the sums that are stored (FilmPixel::visit): doubles
//   as they are in memory, 8 bytes each;
//   in 8 bytes the hash of all rows, one after the other, upon that of the header.
// All numbers are little-endian. The header can be trusted before the first row is read, the rows
// after the last.

namespace pbrt {

namespace {

static_assert(std::endian::native == std::endian::little, "film files hold what memory holds");

constexpr std::string_view kMagic = "pbrt film 1\n";

// Of the sums that a film with these AOVs stores of a pixel.
std::size_t bytesPerPixel(AovSet aovs) {
  std::size_t bytes = 0;
  const FilmPixel pixel;
  FilmPixel::visit(aovs, pixel, [&](const auto& sums) { bytes += sizeof(sums); });
  return bytes;
}

Error ioError(std::string_view verb, const std::filesystem::path& file, std::string_view why) {
  return Error(fmt::format("cannot {} {}: {}", verb, file.string(), why), Failure::io);
}

std::string systemMessage() {
  return std::generic_category().message(errno);
}

struct Closer {
  void operator()(std::FILE* stream) const { std::fclose(stream); }
};

}  // namespace

bool isFilm(const std::filesystem::path& file) {
  return file.extension() == ".film";
}

struct FilmReader::State {
  std::filesystem::path file;
  std::unique_ptr<std::FILE, Closer> stream;
  std::uint64_t left = 0;  // bytes of the file that have not been read
  std::uint64_t sum = 0;   // the hash so far
  FilmInfo info;
  std::string row;

  [[noreturn]] void fail(std::string_view why) const { throw ioError("read", file, why); }
  void take(void* to, std::size_t n) {
    if (n > left || std::fread(to, 1, n, stream.get()) != n)
      fail(std::ferror(stream.get()) ? systemMessage() : "it is cut off");
    left -= n;
  }
  std::uint64_t takeNumber() {
    std::uint64_t n = 0;
    take(&n, sizeof(n));
    return n;
  }
  void readHeader();
};

void FilmReader::State::readHeader() {
  std::string magic(kMagic.size(), '\0');
  if (left < magic.size()) fail("it is no film");
  take(magic.data(), magic.size());
  if (magic != kMagic)
    fail(magic.starts_with("pbrt film ") ? "it is a film of another version of pbrt"
                                         : "it is no film");
  const std::uint64_t length = takeNumber();
  if (length > left) fail("it is cut off or damaged");
  std::string header(length, '\0');
  take(header.data(), length);
  sum = hashBytes(header);
  if (takeNumber() != sum) fail("it is damaged");
  try {
    info = readFilmHeader(header);
  } catch (const std::exception& error) {
    fail(error.what());
  }
  const std::uint64_t pixel = bytesPerPixel(info.aovs), rest = left - std::min(left, sizeof(sum));
  const auto pixels = static_cast<std::uint64_t>(info.window.width()) * info.window.height();
  if (rest / pixel < pixels) fail("it is cut off");
  if (rest != pixels * pixel) fail("it is longer than it should be");
}

FilmReader::FilmReader(const std::filesystem::path& file) : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.file = file;
  // Nobody waits at a pipe that is about to be refused.
  const int descriptor = open(file.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
  if (descriptor < 0) s.fail(systemMessage());
  s.stream.reset(fdopen(descriptor, "rb"));
  if (!s.stream) close(descriptor);
  struct stat status = {};
  if (!s.stream || fstat(descriptor, &status) != 0) s.fail(systemMessage());
  if (!S_ISREG(status.st_mode)) s.fail("it is no file on a disk");
  s.left = static_cast<std::uint64_t>(status.st_size);
  s.readHeader();
}

FilmReader::~FilmReader() = default;

const FilmInfo& FilmReader::info() const {
  return state_->info;
}

void FilmReader::read(std::span<FilmPixel> row) {
  State& s = *state_;
  s.row.resize(row.size() * bytesPerPixel(s.info.aovs));
  s.take(s.row.data(), s.row.size());
  s.sum = hashBytes(s.row, s.sum);
  const char* from = s.row.data();
  for (FilmPixel& pixel : row) {
    pixel = {};
    FilmPixel::visit(s.info.aovs, pixel, [&](auto& sums) {
      std::memcpy(&sums, from, sizeof(sums));
      from += sizeof(sums);
    });
  }
}

void FilmReader::finish() {
  if (state_->takeNumber() != state_->sum) state_->fail("it is damaged");
}

struct FilmWriter::State {
  std::filesystem::path file;
  std::unique_ptr<Replacement> replacement;
  AovSet aovs = 0;
  std::uint64_t sum = 0;
  std::string row;

  [[noreturn]] void fail(std::string_view why) const { throw ioError("write", file, why); }
  void put(std::string_view bytes) {
    if (std::fwrite(bytes.data(), 1, bytes.size(), replacement->stream()) != bytes.size())
      fail(systemMessage());
  }
  void putNumber(std::uint64_t n) { put({reinterpret_cast<const char*>(&n), sizeof(n)}); }
};

FilmWriter::FilmWriter(const std::filesystem::path& file, const FilmInfo& info)
    : state_(std::make_unique<State>()) {
  State& s = *state_;
  s.file = file;
  s.aovs = info.aovs;
  try {
    s.replacement = std::make_unique<Replacement>(file);
  } catch (const std::exception& error) {
    s.fail(error.what());
  }
  const std::string header = filmHeader(info) + '\n';
  s.sum = hashBytes(header);
  s.put(kMagic);
  s.putNumber(header.size());
  s.put(header);
  s.putNumber(s.sum);
}

FilmWriter::~FilmWriter() = default;

void FilmWriter::write(std::span<const FilmPixel> row) {
  State& s = *state_;
  s.row.resize(row.size() * bytesPerPixel(s.aovs));
  char* to = s.row.data();
  for (const FilmPixel& pixel : row)
    FilmPixel::visit(s.aovs, pixel, [&](const auto& sums) {
      std::memcpy(to, &sums, sizeof(sums));
      to += sizeof(sums);
    });
  s.sum = hashBytes(s.row, s.sum);
  s.put(s.row);
}

void FilmWriter::commit() {
  state_->putNumber(state_->sum);
  try {
    state_->replacement->commit(Durability::onDisk);
  } catch (const std::exception& error) {
    state_->fail(error.what());
  }
}

void writeFilm(const std::filesystem::path& file, const Film& film, FilmInfo info) {
  info.resolution = film.resolution();
  info.window = film.crop();
  info.aovs = film.aovs();
  info.origin = film.origin();
  if (!info.reached.empty()) {
    info.endSample = std::ranges::min(info.reached);
    if (std::ranges::max(info.reached) == info.endSample) info.reached.clear();
  }
  FilmWriter writer(file, info);
  std::vector<FilmPixel> row(static_cast<std::size_t>(info.window.width()));
  for (int y = info.window.lo.y; y < info.window.hi.y; ++y) {
    for (int x = info.window.lo.x; x < info.window.hi.x; ++x)
      row[x - info.window.lo.x] = film.pixel({x, y});
    writer.write(row);
  }
  writer.commit();
}

FilmInfo readFilm(const std::filesystem::path& file, Film& film) {
  FilmReader reader(file);
  const FilmInfo& info = reader.info();
  const auto tiles = static_cast<std::size_t>(film.tiles());
  if (info.resolution != film.resolution() || info.window != film.crop() ||
      info.aovs != film.aovs() || (info.interrupted() && info.reached.size() != tiles))
    throw ioError("go on with", file, "it is of another size, window or kind");
  std::vector<FilmPixel> row(static_cast<std::size_t>(info.window.width()));
  for (int y = info.window.lo.y; y < info.window.hi.y; ++y) {
    reader.read(row);
    for (int x = info.window.lo.x; x < info.window.hi.x; ++x)
      film.add({x, y}, row[x - info.window.lo.x]);
  }
  reader.finish();
  return info;
}

}  // namespace pbrt
