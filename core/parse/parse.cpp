#include "core/parse/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>

#include "core/parse/scanner.h"

namespace pbrt {
namespace {

constexpr std::size_t kDeepestInclude = 32;

// All bytes of a file of any kind. Throws std::system_error.
std::string read(const std::filesystem::path& path) {
  const auto fail = [](int error) { throw std::system_error(error, std::generic_category()); };
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(path.c_str(), "rb"),
                                                             &std::fclose);
  if (!file) fail(errno);
  std::setbuf(file.get(), nullptr);  // straight into the text
  std::error_code unknown;           // as for a pipe, whose text grows as it comes
  const std::uintmax_t size = std::filesystem::file_size(path, unknown);
  // One byte more than there is, so that the end is seen at once.
  std::string text(unknown ? 1 << 16 : size + 1, '\0');
  std::size_t length = 0;
  while ((length += std::fread(text.data() + length, 1, text.size() - length, file.get())) ==
         text.size())
    text.resize(2 * length);
  if (std::ferror(file.get())) fail(errno);
  text.resize(length);
  return text;
}

std::string cannotRead(const std::filesystem::path& path, const std::system_error& error) {
  return fmt::format("cannot read {}: {}", path.string(), error.code().message());
}

}  // namespace

void Parser::file(const std::filesystem::path& path) {
  std::string text;
  try {
    text = read(path);
  } catch (const std::system_error& error) {
    throw Error(cannotRead(path, error), Failure::io);
  }
  parse(path.string(), std::move(text), path);
}

void Parser::text(std::string name, std::string text, const std::filesystem::path& directory) {
  parse(std::move(name), std::move(text), directory / "");
}

void Parser::parse(std::string name, std::string text, std::filesystem::path path) {
  sources_.push_back({std::move(name), std::move(text)});
  const Source& source = sources_.back();
  open_.push_back(std::move(path));
  const std::shared_ptr<void> close(nullptr, [this](void*) { open_.pop_back(); });

  const IncludeHandler handler = [this](const Location& quoted) { include(quoted); };
  Scanner scanner(source);
  SceneParser(scanner, sink_, handler).parse();
}

void Parser::include(const Location& quoted) {
  if (open_.size() > kDeepestInclude)
    throw Error(quoted, fmt::format("includes are nested more than {} deep", kDeepestInclude));
  const std::filesystem::path name = unquote(quoted);
  std::filesystem::path path = open_.back().parent_path() / name;
  std::error_code none;
  if (const auto fromFirst = open_.front().parent_path() / name;
      !std::filesystem::exists(path, none) && std::filesystem::exists(fromFirst, none))
    path = fromFirst;
  for (const std::filesystem::path& open : open_)
    if (std::filesystem::equivalent(open, path, none))
      throw Error(quoted, fmt::format("{} includes itself", path.string()));

  std::string text;
  try {
    text = read(path);
  } catch (const std::system_error& error) {
    throw Error(quoted, cannotRead(path, error));
  }
  parse(path.string(), std::move(text), path);
}

}  // namespace pbrt
