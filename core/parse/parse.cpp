#include "core/parse/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>

#include "core/base/file.h"
#include "core/parse/scanner.h"

namespace pbrt {
namespace {

constexpr std::size_t kDeepestInclude = 32;

}  // namespace

void Parser::file(const std::filesystem::path& path) {
  parse(path.string(), readFile(path, FileKind::any), path);
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
  Statement statement(sink_);
  SceneParser(scanner, statement, handler).parse();
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
    text = readFile(path);
  } catch (const Error& error) {
    throw Error(quoted, error.diagnostics()[0].message);
  }
  parse(path.string(), std::move(text), path);
}

}  // namespace pbrt
