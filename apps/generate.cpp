// sightline generate: scenes from a seed, degenerate as much as one wants, and what may be asked of them.

#include "support/common.h"
#include "support/solid_file.h"

#include <sightline/harness/generate/solids.h>
#include <sightline/harness/laws/query_json.h>
#include <sightline/io/write.h>

#include <charconv>

namespace sightline::app {

namespace {

struct Generate_arguments {
  std::string family, out, second, query, offset = "0,0,0", scale = "1", ulps = "0";
  std::size_t size = 0;
  std::uint64_t seed = 1;
};

std::int64_t parse_ulps(const std::string& text) {
  if (text == "far") return generate::far_ulps;
  if (text == "-far") return -generate::far_ulps;
  std::int64_t ulps = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), ulps);
  if (error != std::errc() || end != text.data() + text.size())
    throw Usage_error("--ulps wants a whole number, far or -far, not '" + text + "'");
  return ulps;
}

/// 2^K, or an exact number > 0.
Rational parse_scale(const std::string& text) {
  const std::string wanted = "--scale wants a number > 0, or 2^K with K from -1100 to 1100";
  if (text.starts_with("2^")) {
    int power = 0;
    const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), power);
    if (error != std::errc() || end != text.data() + text.size() || power < -1100 || power > 1100)
      throw Usage_error(wanted + ", not '" + text + "'");
    return generate::power_of_two(power);
  }
  const std::vector<Rational> numbers = parse_numbers(text, wanted);
  if (numbers.size() != 1 || sgn(numbers[0]) <= 0) throw Usage_error(wanted + ", not '" + text + "'");
  return numbers[0];
}

Exit run(const Generate_arguments& arguments) {
  generate::Family_parameters parameters;
  parameters.seed = arguments.seed;
  parameters.size = arguments.size;
  parameters.ulps = parse_ulps(arguments.ulps);
  parameters.offset = parse_point(arguments.offset, "--offset");
  parameters.scale = parse_scale(arguments.scale);
  generate::Posed_scene scene;
  try {
    const Waiting waiting("making the scene");
    const generate::Family& family = generate::family(arguments.family);
    if (!arguments.second.empty() && !family.pair)
      throw Usage_error("--second is for pairs of solids, and " + family.name + " is one scene");
    scene = family.make(parameters);
  } catch (const std::invalid_argument& error) {
    throw Usage_error(error.what());
  }
  Progress progress("writing");
  if (arguments.second.empty()) {
    write_scene(scene.soup, arguments.out, std::ref(progress));
  } else {
    const generate::Solid_pair pair = generate::solids_of(scene.soup, scene.first);
    write_scene(pair[0], arguments.out, std::ref(progress));
    write_scene(pair[1], arguments.second, std::ref(progress));
  }
  if (!arguments.query.empty())
    write_file(arguments.query, to_text(harness::query_json(scene, arguments.seed), 1) + "\n");
  return Exit::done;
}

/// The lines of --help. Kinds are families too; they are listed last, each with what its size means.
std::string list_of_families() {
  std::string families, pairs, kinds;
  for (const generate::Family& family : generate::families()) {
    const auto& all = generate::kinds();
    const bool is_kind =
        std::any_of(all.begin(), all.end(), [&](const generate::Kind& kind) { return kind.name == family.name; });
    if (family.pair) pairs += fmt::format("\n  {:<26} {}", family.name, family.what);
    else if (is_kind) kinds += fmt::format("\n  {:<26} {} (size: {})", family.name, family.what, family.size_means);
    else families += fmt::format("\n  {:<26} {}", family.name, family.what);
  }
  return "Families of small scenes with a question (size: faces, at least; 0: as the seed has it). --ulps 0 is exactly "
         "degenerate; K leaves a gap of K ulps, -K an overlap:" +
         families +
         "\nPairs of solids for `boolean` (size, --ulps: as above), which meet as said; --out and --second write one "
         "each, --out alone both as one scene, the first solid's faces first:" +
         pairs + "\nKinds of any size; --ulps K moves each coordinate by K ulps, or by none, or by -K:" + kinds;
}

}  // namespace

void add_generate(Command program) {
  const Command command = program.add_command(
      "generate", "Makes a scene from a seed, exactly degenerate or nearly so, and what may be asked of it");
  auto a = std::make_shared<Generate_arguments>();
  command.add_option("FAMILY", a->family, "which family or kind, see below").required();
  command.add_option("--size", a->size, "how large; 0: the family's own").check(whole_number()).show_default();
  command.add_option("--seed", a->seed, "of random choices").check(whole_number()).show_default();
  command
      .add_option(
          "--ulps", a->ulps,
          "how far beside its degeneracy, in units of 2^-52 of the scene's size; far: 2^44 of them, -far: as many "
          "the other way")
      .show_default();
  command.add_option("--offset", a->offset, "X,Y,Z added to all points, exact decimals or p/q").show_default();
  command.add_option("--scale", a->scale, "multiplies all coordinates, before --offset: a number or 2^K")
      .show_default();
  command.add_option("--out", a->out, "the file to write: .off .obj .ply .stl .qoff")
      .required()
      .writes_file()
      .check(surface_ending());
  command.add_option("--second", a->second, "of a pair, write the second solid to this file, and the first to --out")
      .writes_file()
      .check(surface_ending());
  command.add_option("--query", a->query, "write the eye, the source polygon and what is known of its answers, as JSON")
      .writes_file();
  command.footer(list_of_families() +
                 "\nExamples: sightline generate rooms --size 4 --out rooms.off\n          sightline generate regulus "
                 "--seed 7 --ulps 1 --out regulus.qoff --query regulus.json\n          sightline generate "
                 "solids_vertex_on_face --out a.off --second b.off; sightline boolean union a.off b.off");
  command.set_action([a] { return run(*a); });
}

}  // namespace sightline::app
