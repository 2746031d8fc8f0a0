#include "input.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <fstream>
#include <memory>

namespace pbrt::files {
namespace {

// How many bytes to expect. A gzipped file says at its end what it holds, modulo 2^32 (RFC 1952,
// section 2.3.1); deflate packs no more than 1032 bytes into one.
std::size_t expectedSize(const std::filesystem::path& file, bool packed) {
  std::error_code unknown;
  const std::uintmax_t size = std::filesystem::file_size(file, unknown);
  if (unknown) return 0;
  unsigned char last[4]{};
  if (!packed || size < sizeof last) return size;
  std::ifstream in(file, std::ios::binary);
  in.seekg(-static_cast<std::streamoff>(sizeof last), std::ios::end);
  in.read(reinterpret_cast<char*>(last), sizeof last);
  const std::uintmax_t held =
      last[0] | last[1] << 8 | last[2] << 16 | std::uintmax_t{last[3]} << 24;
  return std::min(held, 1032 * size);
}

std::string readWhole(const std::filesystem::path& path) {
  constexpr unsigned kPiece = 1 << 18;
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> file(gzopen(path.c_str(), "rb"), &gzclose);
  const auto fail = [&](const char* reason) {
    throw Error(fmt::format("cannot read {}: {}", path.string(), reason), Failure::io);
  };
  if (!file) fail(std::strerror(errno));
  gzbuffer(file.get(), kPiece);

  std::string bytes;
  bytes.reserve(expectedSize(path, gzdirect(file.get()) == 0) + kPiece);
  int got = 0;
  do {
    const std::size_t length = bytes.size();
    bytes.resize(length + kPiece);
    got = gzread(file.get(), bytes.data() + length, kPiece);
    bytes.resize(length + static_cast<std::size_t>(std::max(got, 0)));
  } while (got == static_cast<int>(kPiece));

  int code = Z_OK;
  const char* reason = gzerror(file.get(), &code);
  if (code == Z_ERRNO) fail(std::strerror(errno));
  if (code < 0) fail(reason);
  return bytes;
}

}  // namespace

Input::Input(const std::filesystem::path& file) : Input(file.string(), readWhole(file)) {}

void Input::fail(const std::string& message) const {
  throw Error(fmt::format("{}: {}", name_, message));
}

void Input::failAtByte(const char* at, const std::string& message) const {
  fail(fmt::format("byte {}: {}", at - bytes_.data(), message));
}

void Input::failAtText(std::string_view marked, const std::string& message) const {
  const std::string_view before(bytes_.data(), marked.data() - bytes_.data());
  const std::size_t lineBegin = before.rfind('\n') + 1;  // npos + 1 == 0
  const std::size_t lineEnd = std::min(bytes_.find('\n', before.size()), bytes_.size());
  const Source line{name_, bytes_.substr(lineBegin, lineEnd - lineBegin)};
  Diagnostic d =
      diagnose(Severity::error, {&line, before.size() - lineBegin, marked.size()}, message);
  d.line = 1 + static_cast<std::size_t>(std::count(before.begin(), before.end(), '\n'));
  throw Error({std::move(d)});
}

}  // namespace pbrt::files
