// Asking a program, and grading what it answers.

#include "court.h"

#include "kept.h"

#include <sightline/io/file.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>
#include <sightline/io/exact_text.h>
#include <sightline/kernel/quoted.h>

#include <csignal>
#include <cstring>
#include <sstream>

namespace sightline::app {

namespace fs = std::filesystem;

static std::string in_words(const judge::Grade& grade) {
  std::vector<std::string> all;
  for (const judge::Wrong_ray& wrong : grade.wrong_rays)
    all.push_back(fmt::format("ray {} first meets {}, not {}", wrong.ray,
                              wrong.nothing ? std::string("nothing") : fmt::format("face {}", wrong.right.front()),
                              wrong.said ? fmt::format("face {}", *wrong.said) : std::string("nothing")));
  for (const judge::Wrong_point& wrong : grade.wrong_points)
    all.push_back(fmt::format(
        "a point beside face {} is {}, and {}", wrong.face, wrong.inside ? "inside" : "outside",
        wrong.winding ? fmt::format("wound round {} times", *wrong.winding) : std::string("on a face of the answer")));
  if (all.empty() && grade.volume_error != 0)
    all.push_back(fmt::format("the volume is off by {:.2g} of it", grade.volume_error));
  if (all.empty() && grade.area_error != 0)
    all.push_back(fmt::format("the area is off by {:.2g} of it", grade.area_error));
  for (const auto& [earlier, later] : grade.wrong_pairs)
    all.push_back(fmt::format("face {} is drawn before face {} but is nearer somewhere", earlier, later));
  if (all.empty()) {
    for (const Face_id face : grade.wrong_visible) all.push_back(fmt::format("face {} is shown but hidden", face));
    for (const Face_id face : grade.wrong_hidden) all.push_back(fmt::format("face {} is missing but visible", face));
  }
  std::string text;
  for (std::size_t i = 0; i < std::min<std::size_t>(all.size(), 4); ++i) text += (i == 0 ? "" : ", ") + all[i];
  return text + (all.size() > 4 ? fmt::format(", and {} more", all.size() - 4) : "");
}

/// Of faces that are judged one by one: not in orders.
static void count_kinds(const Judge_case& asked, const judge::Truth& truth, Judged& judged) {
  const Scene scene(asked.soup);
  const auto holds = [](const std::vector<Face_id>& faces, Face_id f) {
    return std::binary_search(faces.begin(), faces.end(), f);
  };
  const judge::Grade& grade = judged.grade;
  for (const std::vector<Face_id>* faces : {&truth.visible, &truth.hidden})
    for (const Face_id face : *faces) {
      if (holds(grade.abstained, face)) continue;
      const bool wrong = holds(grade.wrong_visible, face) || holds(grade.wrong_hidden, face);
      judge::Kinds& kinds = judged.kinds;
      ++(holds(scene.concave(), face) ? (wrong ? kinds.concave_wrong : kinds.concave_right)
                                      : (wrong ? kinds.convex_wrong : kinds.convex_right));
    }
}

Court::Court(Court_options options) : options_(std::move(options)) {
  try {
    words_ = split_words(options_.program);
  } catch (const std::invalid_argument& error) {
    throw Usage_error(std::string("--program: ") + error.what());
  }
  for (const char* place : {"{scene}", "{query}", "{answer}"})
    if (options_.program.find(place) == std::string::npos)
      throw Usage_error(std::string("--program has no ") + place +
                        ": give the command with {scene} {query} {answer} where the names of these files belong");
}

Judged Court::judge(const Judge_case& asked, std::uint64_t seed) const {
  Judged judged;
  judged.seed = seed;
  judged.faces = asked.soup.face_count();
  judged.not_asked = asked.not_asked;
  if (!judged.not_asked.empty()) return judged;
  const judge::Truth truth = judge::truth_of(asked.soup, asked.query, options_.truth);
  judged.not_asked = truth.not_asked;
  if (!judged.not_asked.empty()) return judged;
  for (const auto& [known, found] :
       {std::pair(&asked.visible, &truth.hidden), std::pair(&asked.hidden, &truth.visible)})
    for (const Face_id face : *known)
      if (std::binary_search(found->begin(), found->end(), face))
        throw std::logic_error(fmt::format(
            "the library says of face {} what its construction excludes (seed {}); please report it", face, seed));
  try {
    write_case(asked);
  } catch (const Not_representable& error) {
    judged.not_asked = "the format cannot hold the scene";
    return judged;
  }
  run(asked, truth, judged);
  return judged;
}

std::string Court::scene_text(const Judge_case& asked) const {
  std::ostringstream text;
  write_scene(asked.soup, text, *format_of_ending(scene()));
  return std::move(text).str();
}
static std::string query_text(const Judge_case& asked) { return judge::to_json(asked.query).dump() + "\n"; }

/// The files of a case, without an answer. Where a program left what cannot be removed in the place of one, as a folder
/// whose content is somebody else's, that stays, and they have other names.
void Court::write_case(const Judge_case& asked) const {
  std::error_code stays;
  for (const fs::path& file : {scene(), query(), answer()})
    if (!stays) fs::remove_all(file, stays);
  if (stays) ++blocked_;
  write_temporary(scene(), scene_text(asked));
  write_temporary(query(), query_text(asked));
}

std::optional<std::string> Court::said() const {
  if (!fs::is_regular_file(answer())) return std::nullopt;
  return read_bytes(answer());
}

judge::Answer Court::read(const Judge_case& asked, const std::string& said) const {
  return judge::read_answer(said, asked.query.question, asked.soup.face_count(), asked.query.rays.size());
}

void Court::run(const Judge_case& asked, const judge::Truth& truth, Judged& judged) const {
  std::vector<std::string> words = words_;
  for (std::string& word : words)
    for (const auto& [place, file] :
         {std::pair("{scene}", scene()), std::pair("{query}", query()), std::pair("{answer}", answer())})
      for (std::size_t at = word.find(place); at != std::string::npos; at = word.find(place, at + file.string().size()))
        word.replace(at, std::string_view(place).size(), file.string());
  Process_end end;
  try {
    end = run_limited(words, options_.limits, (folder_ / "said").string());
  } catch (const Usage_error& error) {
    throw Usage_error(std::string("--program: ") + error.what());
  }
  judged.seconds = end.seconds;
  judged.bytes = end.bytes;
  constexpr std::size_t most_said = 1000;
  const std::string said =
      end.said.empty() ? ""
                       : "; it said: " + printable(end.said.substr(end.said.find_last_of('\n') + 1), most_said, false);
  const auto crashed = [&](const std::string& how) {
    judged.mark = judge::Mark::crashed;
    judged.why = how + said;
  };
  switch (end.kind) {
    case Process_end::timed_out: {
      judged.mark = judge::Mark::timed_out;
      judged.why = fmt::format("no end within {} s", options_.limits.seconds);
    } break;
    case Process_end::out_of_memory: {
      judged.mark = judge::Mark::out_of_memory;
      judged.why = fmt::format("more than {} MB", options_.limits.bytes >> 20);
    } break;
    case Process_end::signalled: crashed(fmt::format("signal {} ({})", end.number, strsignal(end.number))); break;
    case Process_end::exited:
      if (end.number != 0) crashed(fmt::format("exit code {}", end.number));
      else grade_answer(asked, truth, judged);
  }
  judged.breaks = judge::breaks(options_.contract, judged.mark, judged.grade);
}

/// What the program wrote takes as much time and memory as it pleases to be read and graded: so a copy of this process
/// does it, within the program's limits.
void Court::grade_answer(const Judge_case& asked, const judge::Truth& truth, Judged& judged) const {
  // 1. The grade, or why there is none.
  const auto graded = [&]() -> std::string {
    try {
      const std::optional<std::string> text = said();
      if (!text) throw std::invalid_argument("it wrote no answer");
      return to_text({{"grade", grade_json(judge::grade(truth, read(asked, *text)))}});
    } catch (const std::invalid_argument& error) {
      return to_text({{"why", std::string("the answer: ") + error.what()}});
    } catch (const std::runtime_error& error) {  // no file that can be read
      return to_text({{"why", error.what()}});
    } catch (const std::logic_error& error) {
      return to_text({{"fault", error.what()}});
    }
  };
  const fs::path file = folder_ / "graded";
  const Process_end end = work_limited(graded, options_.limits, file);
  if (end.kind != Process_end::exited || end.number != 0) {
    judged.mark = end.kind == Process_end::timed_out ? judge::Mark::timed_out : judge::Mark::out_of_memory;
    judged.why = end.kind == Process_end::timed_out
                     ? fmt::format("its answer is not graded within {} s", options_.limits.seconds)
                     : fmt::format("its answer takes more than {} MB to grade", options_.limits.bytes >> 20);
    return;
  }
  // 2. What it says.
  const nlohmann::json found = parse_json(read_own_bytes(file), file.string());
  if (found.contains("fault")) throw std::logic_error(found["fault"].get<std::string>());
  if (found.contains("why")) {
    judged.mark = judge::Mark::invalid;
    judged.why = found["why"].get<std::string>();
    return;
  }
  judged.answer = read(asked, said().value());
  judged.grade = grade_from_json(found.at("grade"));
  judged.mark = judge::mark_of(judged.grade);
  judged.why = in_words(judged.grade);
  count_kinds(asked, truth, judged);
}

std::vector<std::string> Court::keep_files(const std::string& folder, const std::string& stem, const Judge_case& asked,
                                           const std::optional<std::string>& said) const {
  std::vector<std::string> kept;
  fs::create_directories(folder);
  const auto keep = [&](const std::string& ending, const std::string& text) {
    write_file(kept.emplace_back((fs::path(folder) / (stem + '.' + ending)).string()), text);
  };
  keep(options_.format, scene_text(asked));
  keep("json", query_text(asked));
  if (said) keep("answer", *said);
  // What an earlier run left of another case.
  std::vector<std::string> stale{stem + ".svg"};
  if (!said) stale.push_back(stem + ".answer");
  if (stem == "smallest")
    for (const std::string& ending : kept_endings(options_.format)) stale.push_back("reduced." + ending);
  for (const std::string& name : stale) fs::remove(fs::path(folder) / name);
  return kept;
}

}  // namespace sightline::app
