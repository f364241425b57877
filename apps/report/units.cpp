#include "units.h"

#include "../support/journal.h"

#include <sightline/harness/generate/families.h>
#include <sightline/io/read.h>

#include <filesystem>
#include <map>
#include <utility>

namespace sightline::app {

Usual usual(bool quick) {
  if (quick)
    return {{"hinged", "boxes", "cyclic", "edge_on", "leaves", "touching_faces", "triangles_between_squares",
             "city_rotated", "convex_sphere"},
            {"0", "1", "-1", "1000", "-1000", "far"},
            {0, 20},
            1,
            60,
            2};
  std::vector<std::string> all;
  for (const generate::Family& family : generate::families())
    if (!family.holes) all.push_back(family.name);
  return {all, {"0", "1", "-1", "1000", "-1000", "far"}, {0, 50, 200}, 3, 1000, 10};
}

namespace {

std::size_t faces_of(const generate::Family& family, std::size_t size) {
  try {
    return family.make({1, size, 0, {0, 0, 0}, 1}).soup.face_count();
  } catch (const std::invalid_argument&) {
    return 0;
  }
}
/// The family's own size with which it has so many faces, or somewhat more; nothing where it has no such scene.
std::optional<std::size_t> size_with(const generate::Family& family, std::size_t faces) {
  if (faces == 0) return family.small_size;
  constexpr std::size_t most = 1 << 20;
  std::size_t low = 0, high = 1;  // with low it has fewer
  while (faces_of(family, high) < faces) {
    low = high;
    high *= 2;
    if (high > most) return std::nullopt;
  }
  while (high - low > 1) {
    const std::size_t middle = (low + high) / 2;
    (faces_of(family, middle) < faces ? low : high) = middle;
  }
  if (faces_of(family, high) > 3 * faces) return std::nullopt;
  return high;
}

/// The families' own sizes for numbers of faces, each looked for once.
class Family_sizes {
 public:
  /// Nothing where the family has no such scene. Errors: Usage_error where there is no such family.
  std::optional<std::size_t> size(const std::string& family, std::size_t faces) {
    const auto [found, is_new] = sizes_.try_emplace({family, faces});
    if (!is_new) return found->second;
    try {
      found->second = size_with(generate::family(family), faces);
    } catch (const std::invalid_argument& error) {
      throw Usage_error(std::string("--families: ") + error.what());
    }
    return found->second;
  }

 private:
  std::map<std::pair<std::string, std::size_t>, std::optional<std::size_t>> sizes_;
};

}  // namespace

std::vector<Unit> units_of(const Report_arguments& a) {
  std::vector<Unit> units;
  Family_sizes sizes;
  for (const std::string& name : a.questions) {
    const Report_question& question = report_question(name);
    const Case_options options{case_question(name), false, true};
    const auto add = [&](std::size_t size, Case_group group, bool is_of_a_folder = false) {
      units.push_back({units.size(), &question, size, std::move(group), is_of_a_folder});
    };
    for (const std::string& family : a.families)
      for (const std::string& distance : a.distances)
        for (const std::size_t faces : a.sizes) {
          const std::optional<std::size_t> size = sizes.size(family, faces);
          if (!size || (a.quick && faces > question.quick_size)) continue;
          Case_choice choice;
          choice.families = {family};
          choice.ulps = {distance};
          choice.size = *size;
          add(faces, groups_of(choice, options).at(0));
        }
    for (const std::string& scene : a.scenes) {
      Case_choice choice;
      choice.scenes = scene;
      choice.ask = a.ask;
      for (Case_group& group : groups_of(choice, options)) {
        group.distance = as_given;
        add(0, std::move(group), std::filesystem::is_directory(scene));
      }
    }
  }
  return units;
}

Json asked_json(const Report_arguments& a) {
  return {{"questions", a.questions}, {"families", a.families}, {"distances", a.distances}, {"sizes", a.sizes},
          {"scenes", a.scenes},       {"ask", a.ask},           {"programs", a.programs},   {"cases", a.cases},
          {"seed", a.seed},           {"limit", a.limit},       {"memory", a.memory},       {"quick", a.quick}};
}

Json contents_json(const Report_arguments& a, const std::vector<Unit>& units) {
  Json contents = Json::object();
  if (!a.ask.empty()) contents[a.ask] = content_hash(a.ask);
  for (const Unit& unit : units) {
    const std::string& file = unit.group.file;
    if (file.empty() || contents.contains(file)) continue;
    try {
      contents[file] = identity(unit.group);
    } catch (const Input_error& error) {
      contents[file] = error.what();
    }
  }
  return contents;
}

}  // namespace sightline::app
