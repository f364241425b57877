#pragma once
// Which header may include which: kernel <- {algorithms, io} <- apps.

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace include_rules {

struct Rules {
  std::filesystem::path root;  ///< the folder that holds kernel/, algorithms/, io/, apps/ ...
  std::vector<std::string>
      outside;  ///< what library headers may include of other libraries: "gmp.h", or a folder "CGAL/"
};

struct Include {
  std::size_t line;
  char open;  ///< '<' or '"'
  std::string name;
};

/// The include directives of a file, in order; comments that hold one are not directives.
inline std::vector<Include> includes_of(const std::filesystem::path& file) {
  std::vector<Include> found;
  std::ifstream in(file);
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

/// Every breach of the rules, as "file:line: what is wrong"; sorted by file. Empty: all is well.
inline std::vector<std::string> breaches(const Rules& rules) {
  const std::map<std::string, std::set<std::string>> may_include = {{"kernel", {"kernel"}},
                                                                    {"algorithms", {"kernel", "algorithms"}},
                                                                    {"io", {"kernel", "io"}},
                                                                    {"apps", {"kernel", "algorithms", "io"}},
                                                                    {"tests", {"kernel", "algorithms", "io"}},
                                                                    {"bench", {"kernel", "algorithms", "io"}}};
  std::vector<std::string> found;
  for (const auto& [layer, allowed] : may_include) {
    const bool library = layer == "kernel" || layer == "algorithms" || layer == "io";
    for (const std::string& file : sources_in(rules.root, layer)) {
      const std::filesystem::path path = rules.root / file;
      const auto report = [&](std::size_t line, const std::string& what) {
        found.push_back(file + ':' + std::to_string(line) + ": " + what);
      };

      // A library file is a header that guards itself in its first line.
      if (path.extension() == ".h") {
        std::ifstream in(path);
        std::string first;
        std::getline(in, first);
        if (first != "#pragma once") report(1, "does not begin with #pragma once");
      } else if (library) {
        report(1, "the library is headers only");
      }

      for (const auto& [line, open, name] : includes_of(path)) {
        // Quotes are for a neighbour that is no part of the library.
        if (open == '"') {
          if (library) report(line, "own includes are spelled <sightline/...>: \"" + name + '"');
          else if (!std::filesystem::is_regular_file(path.parent_path() / name))
            report(line, "no such neighbour: \"" + name + '"');
          continue;
        }
        // Our own headers: the direction, and that they are there.
        if (name.starts_with("sightline/")) {
          const std::string own = name.substr(name.find('/') + 1);
          const std::string target = own.substr(0, own.find('/'));
          if (!allowed.contains(target)) report(line, layer + " must not include <" + name + '>');
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
      if (include.name.starts_with("sightline/") && self(self, include.name.substr(10))) return true;
    state[file] = 2;
    path.pop_back();
    return false;
  };
  for (const std::string layer : {"kernel", "algorithms", "io"})
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
