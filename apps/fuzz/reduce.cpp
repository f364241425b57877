// sightline reduce: the smallest scene for which somebody's program still fails.

#include "../support/limited_process.h"
#include "../support/page.h"
#include "../support/query.h"
#include "../support/solid_file.h"

#include <sightline/harness/laws/reduce.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>
#include <sightline/io/exact_text.h>

#include <iostream>
#include <limits>
#include <sstream>

namespace sightline::app {

namespace {

struct Reduce_arguments {
  std::string scene, query, out, html;
  Scene_format format;
  std::vector<std::string> program;
  int code = -1;  ///< any but 0
  double limit = 10, seconds = 600;
};

constexpr int timed_out = 124;  // as timeout(1) has it

/// Runs a program with its output thrown away. Returns its exit code, 128 + S where signal S ended it, 124 where it did
/// not end in time. Errors: as run_limited().
int exit_code_of(const std::vector<std::string>& words, double limit) {
  const Process_end end = run_limited(words, {limit, std::numeric_limits<std::uint64_t>::max()}, "/dev/null");
  return end.kind == Process_end::timed_out ? timed_out
         : end.kind == Process_end::exited  ? end.number
                                            : 128 + end.number;
}

/// What is left, with the eye and the source of its query.
void write_page(const Reduce_arguments& arguments, const generate::Posed_scene& left, std::size_t faces, bool asked) {
  const Scene scene(left.soup);
  Page page("reduce", scene);
  page.add_fact("faces", fmt::format("{} of {}", left.soup.face_count(), faces));
  page.add_fact("points", fmt::format("{}", left.soup.point_count()));
  page.add_fact("fails", fmt::format("{}", fmt::join(arguments.program, " ")));
  for (const Set_aside& entry : scene.set_aside())
    page.add_note(fmt::format("face {} is not drawn: {}", entry.face, entry.why));
  page.add_group("faces", "one a face");
  const bool has_source = asked && !left.source.empty();
  if (has_source) page.add_group("source", "source");
  page.add_pieces(scene);
  page.more()["base"] = page.polygons();
  if (asked) {
    page.set_eye(left.eye);
    page.add_fact("eye", Page::text(left.eye));
    if (has_source) page.add_polygon(Page::no_face, left.source, 1);
  }
  page.write(arguments.html);
}

Exit run(const Reduce_arguments& arguments) {
  const auto names = [&](const char* what) {
    return std::any_of(arguments.program.begin(), arguments.program.end(),
                       [&](const std::string& word) { return word.find(what) != std::string::npos; });
  };
  if (!names("{}"))
    throw Usage_error(
        "the program's words hold no {}, which stands for the scene: sightline reduce SCENE --out FILE -- PROGRAM {}");
  if (names("{query}") && arguments.query.empty()) throw Usage_error("the program's words hold {query}; give --query");
  const Format format = format_of_ending(arguments.out).value();
  const std::string reduced_query = std::filesystem::path(arguments.out).replace_extension(".json").string();
  if (!arguments.query.empty())
    check_files({{"SCENE", arguments.scene}, {"--query", arguments.query}},
                {{"--out", arguments.out}, {"the query beside --out,", reduced_query}});
  Polygon_soup soup = arguments.format.read(arguments.scene);
  harness::Posed_query query;
  if (!arguments.query.empty()) query = read_query(arguments.query, soup.face_count());
  generate::Posed_scene& scene = query.scene;
  scene.soup = std::move(soup);
  scene.name = scene.soup.file;

  const Temporary_folder folder;
  const std::string scene_file =
                        (folder / ("scene" + std::filesystem::path(arguments.out).extension().string())).string(),
                    query_file = (folder / "query.json").string();
  std::vector<std::string> words = arguments.program;
  for (std::string& word : words)
    for (const auto& [mark, file] : {std::pair<std::string, std::string>{"{}", scene_file}, {"{query}", query_file}})
      for (std::size_t at = word.find(mark); at != std::string::npos; at = word.find(mark, at + file.size()))
        word.replace(at, mark.size(), file);
  const auto code_for = [&](const generate::Posed_scene& smaller) -> int {
    std::ostringstream text;
    write_scene(smaller.soup, text, format);
    write_temporary(scene_file, text.view());
    if (!arguments.query.empty())
      write_temporary(query_file, to_text(harness::query_json(smaller, query.seed), 1) + "\n");
    return exit_code_of(words, arguments.limit);
  };
  const auto is_failure = [&](int code) {
    return arguments.code < 0 ? code != 0 && code != timed_out : code == arguments.code;
  };
  const auto fails = [&](const generate::Posed_scene& smaller) {
    try {
      return is_failure(code_for(smaller));
    } catch (const Not_representable&) {
      return false;  // not a scene that can be handed over
    }
  };

  if (const int code = code_for(scene); !is_failure(code)) {
    std::cerr << fmt::format("sightline: the program does not fail on {}: its exit code is {}, {} is wanted\n",
                             arguments.scene, code, arguments.code < 0 ? "any but 0" : std::to_string(arguments.code));
    return Exit::disagreement;
  }
  Countdown time("reducing", arguments.seconds);
  harness::Reduce_options options;
  options.most_tests = 1000000;
  options.out_of_time = [&] { return time.over(); };
  const harness::Reduced reduced = harness::reduce(scene, fails, options);
  write_scene(reduced.scene.soup, arguments.out, format);
  if (!arguments.query.empty())
    write_file(reduced_query, to_text(harness::query_json(reduced.scene, query.seed), 1) + "\n");
  if (!arguments.html.empty()) write_page(arguments, reduced.scene, scene.soup.face_count(), !arguments.query.empty());
  row("faces", fmt::format("{} of {}", reduced.scene.soup.face_count(), scene.soup.face_count()));
  row("points", fmt::format("{} of {}", reduced.scene.soup.point_count(), scene.soup.point_count()));
  row("runs", fmt::format("{}, {} steps kept, {:.1f} seconds{}", reduced.tests, reduced.kept, time.seconds(),
                          reduced.finished ? "" : "; not to the end"));
  return Exit::done;
}

}  // namespace

void add_reduce(Command program) {
  const Command command = program.add_command(
      "reduce", "The smallest and roundest scene for which a program still fails, whatever program it is");
  auto a = std::make_shared<Reduce_arguments>();
  command.add_option("SCENE", a->scene, "a scene for which it fails: .obj .off .ply .stl .qoff")
      .required()
      .reads_file();
  a->format.add_to(command);
  command
      .add_option("PROGRAM", a->program,
                  "after --: the program and its arguments; {} stands for the scene's file, {query} for the query's")
      .required();
  command.add_option("--out", a->out, "the file to write; the program gets scenes with the same ending")
      .required()
      .writes_file()
      .check(surface_ending());
  command
      .add_option("--query", a->query,
                  "what is asked of the scene, as `generate --query` writes it: reduced with the scene, and "
                  "written beside --out as .json")
      .reads_file();
  command
      .add_option("--code", a->code,
                  "the exit code that counts as failing; 128 + S for signal S, 124 for no end in time. By default any "
                  "but 0 and 124")
      .check(range(0, 255));
  command.add_option("--html", a->html, "write a page to look at: the scene that is left, its eye and its source")
      .writes_file(".html");
  command.add_option("--limit", a->limit, "seconds for a run of the program")
      .check(positive() & finite_number())
      .show_default();
  command.add_option("--seconds", a->seconds, "seconds for all").check(positive() & finite_number()).show_default();
  command.footer(
      "The program and all that it starts end with its limit; it reads nothing, and cannot write a file beyond 256 "
      "MiB.\n"
      "Exit codes: 0 done, 1 the program does not fail on SCENE, 2 usage, 3 bad input.\nExample: sightline reduce "
      "room.off --out small.off -- ./mine --order {}");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
