#pragma once
// How files that a scene names are read: the one place that opens them, for reading alone.

#include <cstdint>
#include <filesystem>
#include <string>

namespace pbrt {

// What may be read. Pipes and devices may never end or wait for ever, so only those may be read
// that the user names on the command line, as in `pbrt <(generate)`.
enum class FileKind : std::uint8_t { regular, any };

// Longer files are refused; geometry of that size belongs in binary files of its own. So the
// numbers of a text can be counted in an int, and a gzipped file can state its true length.
constexpr std::size_t kLongestFile = std::size_t{4} << 30;

// All bytes of a file, unpacked if it is gzipped (told by its first bytes; RFC 1952). Throws Error,
// Failure::io: it cannot be opened or read, is of the wrong kind, is damaged, or would be longer
// than `longest` or halfOfMemory(), so that a few packed bytes cannot fill it.
std::string readFile(const std::filesystem::path& path, FileKind allowed = FileKind::regular,
                     std::size_t longest = kLongestFile);

}  // namespace pbrt
