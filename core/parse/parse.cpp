#include "core/parse/parse.h"

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <new>

#include "core/base/file.h"
#include "core/base/numbered_name.h"
#include "core/parse/scanner.h"

namespace pbrt {
namespace {

constexpr std::size_t kDeepestInclude = 32;
// Files that include others twice each, 32 deep, would be read 2^32 times.
constexpr std::size_t kMostIncludes = 100000;

// The one name of a file; empty if it is not there.
std::filesystem::path realPath(const std::filesystem::path& path) {
  std::error_code none;
  return std::filesystem::canonical(path, none);
}

// Puts the number of a frame into all strings.
void insertNumber(Directive& d, int frame) {
  const auto insert = [&](std::string& text) { text = numbered(text, frame); };
  std::ranges::for_each(d.words, insert);
  for (Param& p : d.params)
    if (auto* strings = std::get_if<std::vector<std::string>>(&p.values))
      std::ranges::for_each(*strings, insert);
}

}  // namespace

Parser::Parser(DirectiveSink sink, Reporter passOver, std::optional<int> frame)
    : sink_(std::move(sink)), passOver_(std::move(passOver)), frame_(frame) {
  if (!frame) return;
  sink_ = [inner = std::move(sink_), frame](Directive&& d) {
    insertNumber(d, *frame);
    inner(std::move(d));
  };
}

void Parser::file(const std::filesystem::path& path) {
  const Source& source = keep(path.string(), readFile(path, FileKind::any));
  if (const auto real = realPath(path); !real.empty()) files_[real] = &source;
  parse(source, path);
}

void Parser::text(std::string name, std::string text, const std::filesystem::path& directory) {
  parse(keep(std::move(name), std::move(text)), directory / "");
}

const Source& Parser::keep(std::string name, std::string text) {
  return sources_.emplace_back(Source{std::move(name), std::move(text)});
}

void Parser::parse(const Source& source, std::filesystem::path path) {
  open_.push_back({source, std::move(path)});
  const std::shared_ptr<void> close(nullptr, [this](void*) { open_.pop_back(); });

  const IncludeHandler handler = [this](const Location& quoted) { include(quoted); };
  Scanner scanner(source);
  Statement statement(sink_);
  try {
    SceneParser(scanner, statement, handler).parse();
  } catch (const std::bad_alloc&) {
    throw Error(scanner.keyword, kNoMemory);
  }
}

void Parser::include(const Location& quoted) {
  Included file{};
  try {
    file = find(quoted);
  } catch (const Error& error) {
    if (!passOver_) throw;
    for (const Diagnostic& d : error.diagnostics()) passOver_(d);
    return;
  }
  parse(*file.source, file.path);
}

Parser::Included Parser::find(const Location& quoted) {
  if (open_.size() > kDeepestInclude)
    throw Error(quoted, fmt::format("includes are nested more than {} deep", kDeepestInclude));
  if (++includes_ > kMostIncludes)
    throw Error(quoted, fmt::format("more than {} files are included", kMostIncludes));
  const std::string text = unquote(quoted);
  const std::filesystem::path name = frame_ ? numbered(text, *frame_) : text;
  std::filesystem::path path = open_.back().path.parent_path() / name;
  std::filesystem::path real = realPath(path);
  if (real.empty()) {
    const std::filesystem::path fromFirst = open_.front().path.parent_path() / name;
    real = realPath(fromFirst);
    if (real.empty() && path != fromFirst)
      throw Error(quoted,
                  fmt::format("there is no file {}, nor {}", path.string(), fromFirst.string()));
    if (!real.empty()) path = fromFirst;
  }

  const Source*& source = files_[real];
  try {
    if (!source) source = &keep(path.string(), readFile(path));
  } catch (const Error& error) {
    throw Error(quoted, error.diagnostics()[0].message);
  }
  for (const Open& open : open_)
    if (&open.source == source)
      throw Error(quoted, fmt::format("{} includes itself", path.string()));
  return {source, path};
}

}  // namespace pbrt
