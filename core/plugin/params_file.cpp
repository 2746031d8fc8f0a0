// Where the files are that parameters name.

#include <fmt/format.h>

#include "core/plugin/params.h"

namespace pbrt {

Params::Search Params::search(const std::string& name, const std::string& given) const {
  const Source* scene = place(name).source;
  const std::filesystem::path folders[] = {
      scene ? std::filesystem::path(scene->name).parent_path() : "", alsoSearch_, ""};
  // As it is, then as exporters on Windows mean it.
  std::string slashes = given;
  std::replace(slashes.begin(), slashes.end(), '\\', '/');
  Search search;
  for (const std::string& file : {given, slashes})
    for (const std::filesystem::path& folder : folders) {
      const std::filesystem::path path = folder / file;
      const std::string shown = path.string();
      if (std::find(search.tried.begin(), search.tried.end(), shown) != search.tried.end())
        continue;
      search.tried.push_back(shown);
      std::error_code error;
      const auto status = std::filesystem::status(path, error);
      if (std::filesystem::is_regular_file(status)) {
        search.found = path;
        return search;
      }
      if (std::filesystem::exists(status)) search.notAFile = shown;
    }
  return search;
}

std::string Params::Search::allTried() const {
  return shown(fmt::format("{}", fmt::join(tried, ", ")), 1000);
}

std::filesystem::path Params::file(const std::string& name, std::string_view meaning) {
  const std::string given = text(name, "", meaning);
  if (given.empty()) return {};
  const Search s = search(name, given);
  if (!s.found.empty()) return s.found;
  if (!s.notAFile.empty()) fail(name, fmt::format("names {}, which is not a file", s.notAFile));
  fail(name, "names a file that is not there: " + s.allTried());
}

}  // namespace pbrt
