#pragma once
// Which file may include which: kernel <- {algorithms, io} <- sightline <- harness <- apps, and finer rules for some
// rooms; and that a file of the library includes what it uses of the standard library, itself or by our headers.

#include "standard_names.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <functional>
#include <istream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace include_rules {

struct Rules {
  std::filesystem::path root;  ///< the folder that holds kernel/, algorithms/, io/, harness/, apps/ ...
  std::vector<std::string>
      outside;  ///< what library headers may include of other libraries: "gmp.h", or a folder "CGAL/"
};

struct Include {
  std::size_t line;
  char open;  ///< '<' or '"'
  std::string name;
};

/// The include directives of a text, in order; comments that hold one are not directives.
inline std::vector<Include> includes_of(std::istream& in) {
  std::vector<Include> found;
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line) {
    // blanks # blanks include blanks <name> or "name"
    std::string_view rest = text;
    const auto accept = [&](std::string_view word) {
      rest.remove_prefix(std::min(rest.find_first_not_of(" \t"), rest.size()));
      const bool there = rest.starts_with(word);
      if (there) rest.remove_prefix(word.size());
      return there;
    };
    if (!accept("#") || !accept("include") || !(accept("<") || accept("\""))) continue;
    const char open = rest.data()[-1];
    found.push_back({line, open, std::string(rest.substr(0, rest.find(open == '<' ? '>' : '"')))});
  }
  return found;
}

inline std::vector<Include> includes_of(const std::filesystem::path& file) {
  std::ifstream in(file);
  return includes_of(in);
}

/// The sources below root/layer, as sorted paths relative to root.
inline std::vector<std::string> sources_in(const std::filesystem::path& root, const std::string& layer) {
  std::vector<std::string> found;
  if (!std::filesystem::is_directory(root / layer)) return found;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(root / layer))
    if (entry.is_regular_file() && (entry.path().extension() == ".h" || entry.path().extension() == ".cpp"))
      found.push_back(std::filesystem::relative(entry.path(), root).generic_string());
  std::sort(found.begin(), found.end());
  return found;
}

/// A folder, or one header with its source ("x/y."), and what may be included there: folders ("io/"), folders without
/// their subfolders ("kernel/."), headers.
struct Room {
  std::string_view folder;
  std::vector<std::string_view> allowed;
};

/// What the two methods of weak visibility, search/ and events/, both stand on; it knows neither.
inline const std::vector<std::string_view> weak_ground{"kernel/",
                                                       "algorithms/point_visibility/boxes.h",
                                                       "algorithms/weak_visibility/edge_lines.h",
                                                       "algorithms/weak_visibility/line_space.h",
                                                       "algorithms/weak_visibility/occluders.h",
                                                       "algorithms/weak_visibility/weak_answer.h",
                                                       "algorithms/weak_visibility/weak_source.h"};

/// What is allowed on that ground, and a folder besides.
inline std::vector<std::string_view> weak_ground_and(std::string_view folder) {
  std::vector<std::string_view> allowed = weak_ground;
  allowed.push_back(folder);
  return allowed;
}

/// The rooms of the library, and then who stands above it. A file is in the first that its path begins with.
inline const std::vector<Room>& rooms() {
  static const std::vector<Room> all = {
      {"kernel/scene/", {"kernel/.", "kernel/scene/"}},
      {"kernel/traits/", {"kernel/"}},
      {"kernel/", {"kernel/."}},
      // The checkers share nothing with what they check: numbers, and what a file says.
      {"algorithms/verify/",
       {"algorithms/verify/", "kernel/number.h", "kernel/coordinates.h", "kernel/quoted.h",
        "kernel/scene/polygon_soup.h", "kernel/scene/set_aside.h"}},
      // Two methods for one question, each without the other, on common ground.
      {"algorithms/weak_visibility/search/", weak_ground_and("algorithms/weak_visibility/search/")},
      {"algorithms/weak_visibility/events/", weak_ground_and("algorithms/weak_visibility/events/")},
      {"algorithms/weak_visibility/edge_lines.", weak_ground},
      {"algorithms/weak_visibility/line_space.", weak_ground},
      {"algorithms/weak_visibility/occluders.", weak_ground},
      {"algorithms/weak_visibility/weak_answer.", weak_ground},
      {"algorithms/weak_visibility/weak_source.", weak_ground},
      {"algorithms/", {"kernel/", "algorithms/"}},
      {"io/", {"kernel/", "io/"}},
      {"harness/", {"kernel/", "algorithms/", "io/", "harness/", "sightline/"}},
      {"sightline/", {"kernel/", "algorithms/", "io/", "sightline/"}},
      {"apps/", {"kernel/", "algorithms/", "io/", "harness/", "sightline/"}},
      {"python/", {"kernel/", "algorithms/", "io/", "harness/", "sightline/"}},
      {"tests/", {"kernel/", "algorithms/", "io/", "harness/", "sightline/"}},
      {"bench/", {"kernel/", "algorithms/", "io/", "harness/", "sightline/"}}};
  return all;
}

/// Whether a room lets a header in.
inline bool lets_in(const Room& room, const std::string& header) {
  return std::any_of(room.allowed.begin(), room.allowed.end(), [&](std::string_view allowed) {
    if (!allowed.ends_with("/.")) return header.starts_with(allowed);
    allowed.remove_suffix(1);
    return header.starts_with(allowed) && header.find('/', allowed.size()) == std::string::npos;
  });
}

/// Our own header's place below the root: the front door stands in a folder of that name.
inline std::string own_file(const std::string& include) {
  return include.find('/', 10) == std::string::npos ? include : include.substr(10);
}

/// The headers that files include, directly or by our own, of which each is read once.
class Reached_headers {
 public:
  explicit Reached_headers(std::filesystem::path root) : root_(std::move(root)) {}

  std::set<std::string, std::less<>> of(const std::vector<Include>& first) {
    std::set<std::string, std::less<>> found;
    std::vector<Include> left = first;
    while (!left.empty()) {
      const std::string name = left.back().name;
      left.pop_back();
      if (!found.insert(name).second || !name.starts_with("sightline/")) continue;
      const std::vector<Include>& more = included_by(own_file(name));
      left.insert(left.end(), more.begin(), more.end());
    }
    for (const char* const derived : {"fstream", "iostream", "istream", "ostream", "sstream"})
      if (found.contains(derived)) found.insert("ios");
    return found;
  }

 private:
  const std::vector<Include>& included_by(const std::string& file) {
    const auto [place, is_new] = read_.try_emplace(file);
    if (is_new) place->second = includes_of(root_ / file);
    return place->second;
  }

  std::filesystem::path root_;
  std::map<std::string, std::vector<Include>> read_;
};

/// What lines use of the standard library without its header, as "line: what is wrong"; each name once.
inline std::vector<std::pair<std::size_t, std::string>> missing_headers(
    std::istream& in, const std::set<std::string, std::less<>>& included) {
  std::vector<std::pair<std::size_t, std::string>> found;
  std::set<std::string> seen;
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line)
    for (const std::string& name : standard_names_of(text)) {
      if (!seen.insert(name).second) continue;
      const std::set<std::string_view> headers = headers_of(name);
      if (headers.empty()) found.emplace_back(line, "std::" + name + " is not in tests/includes/standard_names.h");
      else if (std::none_of(headers.begin(), headers.end(), [&](std::string_view h) { return included.contains(h); }))
        found.emplace_back(line, "uses std::" + name + " without <" + std::string(*headers.begin()) + '>');
    }
  return found;
}

inline constexpr std::array<const char*, 5> library_layers{"kernel", "algorithms", "io", "harness", "sightline"};

/// Every breach of the rules, as "file:line: what is wrong"; sorted by file. Empty: all is well.
inline std::vector<std::string> breaches(const Rules& rules) {
  std::vector<std::string> found;
  Reached_headers reached(rules.root);
  for (const std::string layer :
       {"algorithms", "apps", "bench", "harness", "io", "kernel", "python", "sightline", "tests"}) {
    const bool library = std::find(library_layers.begin(), library_layers.end(), layer) != library_layers.end();
    for (const std::string& file : sources_in(rules.root, layer)) {
      const std::filesystem::path path = rules.root / file;
      const std::vector<Include> includes = includes_of(path);
      const Room& room =
          *std::find_if(rooms().begin(), rooms().end(), [&](const Room& r) { return file.starts_with(r.folder); });
      const auto report = [&](std::size_t line, const std::string& what) {
        found.push_back(file + ':' + std::to_string(line) + ": " + what);
      };

      // A header guards itself in its first line; a source of the library begins with its own header, so that each is
      // seen to compile alone, or, if it has none, with one of its folder, of which it holds a part.
      if (path.extension() == ".h") {
        std::ifstream in(path);
        std::string first;
        std::getline(in, first);
        if (first != "#pragma once") report(1, "does not begin with #pragma once");
      } else if (library) {
        const std::string stem = file.substr(0, file.size() - 4);
        const std::string own = (layer == "sightline" ? stem : "sightline/" + stem) + ".h";
        const bool has_own = std::filesystem::exists(rules.root / (stem + ".h"));
        const auto folder = [](const std::string& name) { return name.substr(0, name.rfind('/')); };
        if (includes.empty() || (has_own ? includes.front().name != own : folder(includes.front().name) != folder(own)))
          report(1, "does not begin with <" + own + '>');
      }

      if (library) {
        std::ifstream in(path);
        for (const auto& [line, what] : missing_headers(in, reached.of(includes))) report(line, what);
      }

      for (const auto& [line, open, name] : includes) {
        // Quotes are for a neighbour that is no part of the library.
        if (open == '"') {
          if (library) report(line, "own includes are spelled <sightline/...>: \"" + name + '"');
          else if (!std::filesystem::is_regular_file(path.parent_path() / name))
            report(line, "no such neighbour: \"" + name + '"');
          continue;
        }
        // Our own headers: the direction, and that they are there.
        if (name.starts_with("sightline/")) {
          const std::string own = own_file(name);
          if (!lets_in(room, own))
            report(line,
                   std::string(room.folder.substr(0, room.folder.size() - 1)) + " must not include <" + name + '>');
          else if (!std::filesystem::is_regular_file(rules.root / own)) report(line, "no such header: <" + name + '>');
          continue;
        }
        // Other libraries' headers: a package that is not announced would be missing where the library is installed.
        const bool standard = name.find('/') == std::string::npos && name.find('.') == std::string::npos;
        const bool announced =
            std::any_of(rules.outside.begin(), rules.outside.end(), [&, &name = name](const std::string& known) {
              return known.ends_with('/') ? name.starts_with(known) : name == known;
            });
        if (library && !standard && !announced)
          report(line, "<" + name + "> is not among the dependencies in CMakeLists.txt");
      }
    }
  }
  return found;
}

/// One cycle of library headers that include one another ("a -> b -> a"), or "" where there is none.
inline std::string cycle(const std::filesystem::path& root) {
  std::map<std::string, int> state;  // 1: being visited, 2: done
  std::vector<std::string> path;
  std::string found;
  const auto visit = [&](const auto& self, const std::string& file) -> bool {
    if (state[file] == 2) return false;
    path.push_back(file);
    if (state[file] == 1) return true;
    state[file] = 1;
    for (const Include& include : includes_of(root / file))
      if (include.name.starts_with("sightline/") && self(self, own_file(include.name))) return true;
    state[file] = 2;
    path.pop_back();
    return false;
  };
  for (const std::string layer : library_layers)
    for (const std::string& file : sources_in(root, layer)) {
      path.clear();
      if (!visit(visit, file)) continue;
      for (auto step = std::find(path.begin(), path.end(), path.back()); step != path.end(); ++step)
        found += (found.empty() ? "" : " -> ") + *step;
      return found;
    }
  return found;
}

}  // namespace include_rules
