// sightline boolean: set operations on solids, exactly.

#include "support/drawing.h"
#include "support/page.h"
#include "support/solid_file.h"

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/io/exact_text.h>
#include <sightline/io/file.h>
#include <sightline/io/format.h>
#include <sightline/io/input.h>
#include <sightline/io/off.h>
#include <sightline/io/quake_map.h>
#include <sightline/io/read.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/threads.h>

#include <array>
#include <cmath>

namespace sightline::app {

namespace {

struct Boolean_arguments {
  std::string operation, out, json, certificate, html, mesh, inside = "positive", coordinates = "exact",
                                                             round = "double", repair = "none";
  std::vector<std::string> solids;
  Scene_format format;
  bool snap = false;
  std::size_t snap_rounds = most_snap_rounds;
  int threads = 0;
  double budget = 0;  ///< seconds; 0: no limit

  bool rounds() const { return !out.empty() && format_of_ending(out) != Format::qoff; }
  Read_options reading() const {
    Read_options options;
    options.round_to_double = coordinates == "double";
    return options;
  }
};

/// Ends the work once its seconds are over; not while it writes. `when`: with its values, how far it came.
template <class... Values>
void end_if_over(const Time_limit& limit, fmt::format_string<Values...> when, Values... values) {
  if (limit.is_over())
    throw Out_of_budget(fmt::format("undecided: the budget of {} s ran out {}; nothing is written", limit.seconds(),
                                    fmt::format(when, std::move(values)...)));
}

template <class List>
auto named(const List& list, const std::string& name) {
  return *std::find_if(list.begin(), list.end(), [&](auto one) { return sightline::name(one) == name; });
}
template <class List>
std::vector<std::string> names_of(const List& list) {
  std::vector<std::string> names;
  for (const auto one : list) names.emplace_back(name(one));
  return names;
}

std::string place_text(const Exact_point& p) {
  return fmt::format("({}, {}, {})", to_string(p[0]), to_string(p[1]), to_string(p[2]));
}

Json operands_json(const std::vector<Polygon_soup>& solids, const Operands& operands) {
  Json files = Json::array(), set_aside = Json::array();
  for (const Polygon_soup& solid : solids) files.push_back({{"file", solid.file}, {"faces_read", solid.face_count()}});
  for (const Set_aside& entry : operands.set_aside()) {
    const auto [operand, face] = operands.source_of(entry.face);
    set_aside.push_back({{"operand", operand}, {"face", face}, {"why", entry.why}});
  }
  Json non_planar = Json::array();
  for (const Face_id f : operands.non_planar()) {
    const auto [operand, face] = operands.source_of(f);
    non_planar.push_back({operand, face});
  }
  return {{"operands", std::move(files)},
          {"set_aside", std::move(set_aside)},
          {"non_planar", std::move(non_planar)},
          {"grid_bits", operands.points().bits()},
          {"arithmetic", std::string(name(operands.predicates().arithmetic()))}};
}

/// Whether a solid winds round less than nothing, all in all: by doubles, unless what they lose may matter.
bool is_inside_out(const Polygon_soup& solid) {
  std::vector<std::array<double, 3>> points;
  double farthest = 0;
  for (Point_id p = 0; p < solid.point_count(); ++p) {
    const Exact_point at = solid.point(p);
    points.push_back({nearest_double(at[0]), nearest_double(at[1]), nearest_double(at[2])});
    for (const double x : points.back()) farthest = std::max(farthest, std::fabs(x));
  }
  double sum = 0, terms = 0;  // six times the volume
  for (Face_id f = 0; f < solid.face_count(); ++f) {
    const auto loop = solid.loop(f);
    for (std::size_t k = 1; k + 1 < loop.size(); ++k, ++terms) {
      const auto &p = points[loop[0]], &q = points[loop[k]], &r = points[loop[k + 1]];
      sum +=
          p[0] * (q[1] * r[2] - q[2] * r[1]) - p[1] * (q[0] * r[2] - q[2] * r[0]) + p[2] * (q[0] * r[1] - q[1] * r[0]);
    }
  }
  // Far more than 6 products a term do, and what underflows; and none of them is too large.
  const double lost = 0x1p-40 * terms * farthest * farthest * farthest + 0x1p-900 * (1 + farthest);
  return !(sum > lost && farthest < 0x1p300) && volume(solid) < 0;
}

/// What the user may not know of the solids: what was set aside or cut into triangles, and what is inside out.
void solid_rows(const std::vector<Polygon_soup>& solids, const Operands& operands, bool by_sign) {
  constexpr std::size_t shown = 6;
  const auto listed = [&](const auto& all, auto text_of) {
    std::string text = std::to_string(all.size());
    for (std::size_t k = 0; k < std::min(all.size(), shown); ++k) text += (k == 0 ? ": " : ", ") + text_of(all[k]);
    return text + (all.size() > shown ? ", ..." : "");
  };
  const auto face_of = [&](Face_id face) {
    const auto [operand, own] = operands.source_of(face);
    return fmt::format("face {} of {}", own, solids[operand].file);
  };
  if (!operands.set_aside().empty())
    row("set aside",
        listed(operands.set_aside(), [&](const Set_aside& entry) { return face_of(entry.face) + ", " + entry.why; }));
  if (!operands.non_planar().empty()) row("not planar", listed(operands.non_planar(), face_of) + "; now triangles");
  std::vector<std::string> inwards;
  for (const Polygon_soup& solid : solids)
    if (by_sign && is_inside_out(solid)) inwards.push_back(solid.file);
  if (!inwards.empty())
    row("inside out", listed(inwards, [](const std::string& file) { return file; }) +
                          ": fronts look inwards, and nothing is inside; --inside nonzero takes it as it was meant");
}

/// All that is wrong with solids, by file.
void write_refusal(const Boolean_arguments& a, const std::vector<Polygon_soup>& solids, const Operands& operands,
                   const std::vector<Operand_flaw>& all) {
  Json refused = Json::array();
  for (const Operand_flaw& flaw : all) {
    if (refused.empty() || refused.back()["operand"] != flaw.operand)
      refused.push_back({{"operand", flaw.operand},
                         {"file", solids[flaw.operand].file},
                         {"faces", Json::array()},
                         {"open_edges", Json::array()}});
    if (!flaw.why.empty()) refused.back()["faces"].push_back({{"face", flaw.face}, {"why", flaw.why}});
    else
      refused.back()["open_edges"].push_back(
          {{"face", flaw.face}, {"from", point_json(flaw.from)}, {"to", point_json(flaw.to)}});
  }
  Json document;
  document["command"] = "boolean";
  document["scene"] = operands_json(solids, operands);
  document["result"] = {{"operation", a.operation}, {"refused", std::move(refused)}};
  document["counters"] = document["seconds"] = Json::object();
  write_file(a.json, to_text(document, 1) + "\n");
}

/// What does not bound a solid is refused, with its edges: some of them, and all in the JSON.
void refuse_flaws(const Boolean_arguments& a, const std::vector<Polygon_soup>& solids, const Operands& operands) {
  const std::vector<Operand_flaw> all = flaws(operands);
  if (all.empty()) return;
  if (!a.json.empty()) write_refusal(a, solids, operands, all);
  const std::uint32_t operand = all[0].operand;
  std::string faces, edges;
  std::size_t open = 0, crossed = 0;
  constexpr std::size_t shown = 6;
  for (const Operand_flaw& flaw : all) {
    if (flaw.operand != operand) continue;
    if (!flaw.why.empty()) {
      if (++crossed <= shown) faces += fmt::format("{}face {} is {}", crossed == 1 ? "" : ", ", flaw.face, flaw.why);
    } else if (++open <= shown) {
      edges += fmt::format("{} {}-{} of face {}", open == 1 ? "" : ",", place_text(flaw.from), place_text(flaw.to),
                           flaw.face);
    }
  }
  std::string what = "is not closed, so it bounds no solid: ";
  if (crossed > 0) what += faces + (crossed > shown ? ", ..." : "") + (open > 0 ? "; " : "");
  if (open > 0)
    what += fmt::format("{} edge{} without an opposite:{}{}", open, open == 1 ? "" : "s", edges,
                        open > shown ? ", ..." : "");
  const std::string more =
      a.json.empty() && (open > shown || crossed > shown || all.back().operand != operand) ? ", --json lists all" : "";
  throw Input_error::of_file(a.solids[operand], what + "; close the surface first" + more);
}

/// By face of a level of brushes the numbers of its entity and brush; of other solids nothing.
std::vector<Json> brushes_of_faces(const std::string& file, const Read_options& reading) {
  std::vector<Json> brushes;
  if (file == "-" || format_of_ending(file) != Format::map) return brushes;
  const std::string bytes = read_bytes(file);
  for (const Map_brush& brush : read_map_brushes({file, bytes}, reading))
    brushes.insert(brushes.end(), brush.faces, Json::array({brush.entity, brush.brush}));
  return brushes;
}

/// The result, each face in the colour of the solid that it is of.
void write_page(const Boolean_arguments& a, const Hole_free& flat, const Set_result& result, const Rational& size) {
  const Scene scene(flat.soup);
  Page page("boolean", scene);
  page.add_fact("operation", a.operation);
  page.add_fact("result", fmt::format("{} faces, {} points", result.soup.face_count(), result.soup.point_count()));
  page.add_fact("volume", to_string(size));
  const auto of = [&](std::uint32_t piece) -> const Result_face& {
    return result.faces[flat.face_of[scene.pieces()[piece].face]];
  };
  constexpr std::size_t most_colours = 30;  // of solids
  const bool by_solid = a.solids.size() <= most_colours;
  for (const std::string& solid : a.solids)
    for (const char* turned : {"", ", turned round"})
      if (by_solid) page.add_group(std::filesystem::path(solid).filename().string() + turned, "one a solid");
  if (!by_solid) page.add_group("of so many solids", "one a face");
  page.add_pieces(
      scene, [&](std::uint32_t piece) { return by_solid ? 2 * of(piece).operand + (of(piece).turned ? 1u : 0u) : 0u; });
  constexpr std::size_t most_names = 1000000;
  std::vector<std::uint32_t> faces;
  if (scene.pieces().size() <= most_names)
    for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) faces.push_back(of(i).face);
  page.more()["operand_faces"] = packed(faces);
  if (!result.crowded.empty()) page.add_note(fmt::format("{} edges of more than two faces", result.crowded.size()));
  page.write(a.html);
}

/// The result as convex pieces, each in the colour of the solid that it is of, with what it is a part of.
Grouped_polygons drawing_of(const Boolean_arguments& a, const Hole_free& flat, const Set_result& result) {
  const Scene scene(flat.soup);
  Grouped_polygons polygons;
  for (std::size_t k = 0; k < a.solids.size(); ++k) {
    std::string name = std::filesystem::path(a.solids[k]).stem().string();
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return c <= ' ' || c >= 0x7f; }, '_');
    const auto& colours = drawing_colours::in_turn;
    polygons.add_group(fmt::format("{}-{}", k, name), colours.at(k % colours.size()));
  }
  std::vector<std::uint32_t> operands, faces, turned;
  add_pieces(polygons, scene, [&](std::uint32_t piece) {
    const Result_face& face = result.faces[flat.face_of[scene.pieces()[piece].face]];
    operands.push_back(face.operand);
    faces.push_back(face.face);
    turned.push_back(face.turned ? 1 : 0);
    return face.operand;
  });
  polygons.add_column("operand", std::move(operands));
  polygons.add_column("operand_face", std::move(faces));
  polygons.add_column("turned", std::move(turned));
  return polygons;
}

/// Of what does not go together.
void check_usage(const Boolean_arguments& a) {
  if (!a.rounds() && (a.snap || a.round == "float"))
    throw Usage_error(std::string(a.snap ? "--snap" : "--round float") +
                      " is for rounded points: give --out a format that rounds, .obj .off .ply .stl");
  if (!a.snap && a.snap_rounds != most_snap_rounds) throw Usage_error("--snap-rounds is for --snap");
  if (a.solids.size() < 2 && a.operation != name(Set_operation::unite))
    throw Usage_error(a.operation + " is of two solids or more: name another one; a union may be of one");
}

/// What the operation makes of the solids, and how long it took.
struct Combination {
  std::optional<Operands> operands;
  Set_result result;
  double prepare_seconds = 0, seconds = 0;
};

Combination combination_of(const Boolean_arguments& a, const std::vector<Polygon_soup>& solids,
                           const Set_options& options, const Time_limit& limit) {
  Combination made;
  Stopwatch watch;
  run_with_threads(a.threads, [&] {
    made.operands.emplace(solids);
    end_if_over(limit, "once the solids stood on one grid");
    refuse_flaws(a, solids, *made.operands);
    made.prepare_seconds = watch.seconds();
    watch = {};
    made.result = set_operation(*made.operands, options);
  });
  made.seconds = watch.seconds();
  return made;
}

/// The result's surface as --out holds it: without holes, and rounded where its format demands that.
struct Written_surface {
  Hole_free flat;
  Rational volume;
  std::optional<Rounded_surface> rounding;

  std::size_t face_count() const { return rounding ? rounding->face_of.size() : flat.face_of.size(); }
  /// The face of the result that a written one is a part of.
  Face_id face_of(std::size_t written) const {
    return flat.face_of[rounding ? rounding->face_of[written] : static_cast<Face_id>(written)];
  }
};

Written_surface written_surface(const Boolean_arguments& a, const Set_result& result, const Time_limit& limit) {
  Written_surface written{without_holes(result.soup), {}, {}};
  end_if_over(limit, "before its volume was known");
  written.volume = volume(result.soup);
  end_if_over(limit, "before its surface was ready to be written");
  if (!a.out.empty())
    written.rounding =
        write_solid(written.flat.soup, a.out, a.round == "float", a.snap ? a.snap_rounds : 0,
                    [&](std::size_t, std::size_t) { end_if_over(limit, "while its points were rounded"); });
  return written;
}

/// Of each written face: which face of which solid it is of, and whether turned round; of levels, in which brush.
void add_provenance(Json& to, const Boolean_arguments& a, const Set_result& result, const Written_surface& written) {
  std::vector<std::vector<Json>> brushes_of;  // by operand and face
  bool is_level = false;
  for (const std::string& file : a.solids)
    is_level |= !brushes_of.emplace_back(brushes_of_faces(file, a.reading())).empty();
  Json provenance = Json::array(), turned = Json::array(), brushes = Json::array();
  for (std::size_t f = 0; f < written.face_count(); ++f) {
    const Result_face& face = result.faces[written.face_of(f)];
    provenance.push_back({face.operand, face.face});
    if (face.turned) turned.push_back(f);
    const std::vector<Json>& of_operand = brushes_of[face.operand];
    brushes.push_back(of_operand.empty() ? Json() : of_operand[face.face]);
  }
  to["provenance"] = std::move(provenance);
  to["turned"] = std::move(turned);
  if (is_level) to["brushes"] = std::move(brushes);
}

Json result_json(const Boolean_arguments& a, const Set_result& result, const Written_surface& written) {
  Json not_manifold = Json::array();
  for (const Crowded_edge& edge : result.crowded)
    not_manifold.push_back({{"from", point_json(result.soup.point(edge.from))},
                            {"to", point_json(result.soup.point(edge.to))},
                            {"faces", edge.faces}});
  Json json{{"operation", a.operation},
            {"inside", a.inside},
            {"faces", written.face_count()},
            {"maximal_faces", result.soup.face_count()},
            {"points", result.soup.point_count()},
            {"volume", to_string(written.volume)},
            {"area", area(result.soup)},
            {"not_manifold", std::move(not_manifold)}};
  add_provenance(json, a, result, written);
  if (written.rounding) json["rounding"] = rounding_json(*written.rounding, written.flat.soup);
  return json;
}

/// For people.
void print(const Boolean_arguments& a, const std::vector<Polygon_soup>& solids, const Combination& made,
           const Written_surface& written, double read_seconds) {
  const Set_result& result = made.result;
  const Set_counters& c = result.counters;
  row("solids", fmt::format("{}, of {} faces in {} convex pieces", solids.size(), c.faces, c.pieces));
  solid_rows(solids, *made.operands, a.inside == name(Inside_rule::positive));
  row("result", fmt::format("{} faces, {} points; written as {} faces without holes", result.soup.face_count(),
                            result.soup.point_count(), written.face_count()));
  if (written.rounding) row("rounded", rounding_text(*written.rounding));
  if (!a.out.empty() && !a.rounds())
    if (const std::string warning = warning_of_denominator(written.flat.soup, a.out, "`verify --result`");
        !warning.empty())
      row("exact", warning);
  row("volume", digits_of(written.volume, 17));
  row("edges", result.crowded.empty()
                   ? "each of two faces"
                   : fmt::format("{} of more than two faces: --json lists them", result.crowded.size()));
  row("met", fmt::format("{} pieces meet others and became {} fragments; {} rays", c.touched,
                         c.fragments - (c.pieces - c.touched), c.rays));
  row("seconds", fmt::format("{:.3f} to read, {:.3f} to prepare, {:.3f} for the operation", read_seconds,
                             made.prepare_seconds, made.seconds));
}

Exit run(const Boolean_arguments& a, const Command& command) {
  check_usage(a);

  // 1. The solids.
  const Stopwatch watch;
  std::vector<Polygon_soup> solids;
  for (const std::string& file : a.solids) solids.push_back(a.format.read(file, a.reading()));
  const double read_seconds = watch.seconds();

  // 2. The operation.
  Progress progress(a.operation);
  const Time_limit limit(a.budget);
  Set_options options;
  options.operation = named(set_operations, a.operation);
  options.inside = named(inside_rules, a.inside);
  options.keep_fragments = !a.certificate.empty();
  options.progress = [&](std::size_t done, std::size_t all) {
    end_if_over(limit, "after {}% of the operation", all == 0 ? 0 : 100 * done / all);
    progress(done, all);
  };
  const Combination made = combination_of(a, solids, options, limit);
  progress.clear();

  // 3. What is written.
  const Written_surface written = written_surface(a, made.result, limit);
  if (!a.certificate.empty())
    write_file(a.certificate, [&](std::ostream& out) {
      write_solid_certificate(out, solid_certificate(*made.operands, options, made.result));
    });
  if (!a.html.empty()) write_page(a, written.flat, made.result, written.volume);
  if (!a.mesh.empty()) write_drawings("", a.mesh, drawing_of(a, written.flat, made.result));
  if (!a.json.empty()) {
    Json document;
    document["command"] = "boolean";
    document["scene"] = operands_json(solids, *made.operands);
    document["result"] = result_json(a, made.result, written);
    document["counters"] = counters_json(made.result.counters);
    document["seconds"] = {{"read", read_seconds}, {"prepare", made.prepare_seconds}, {"boolean", made.seconds}};
    write_file(a.json, to_text(document, 1) + "\n");
  }
  if (!command.writes_standard_output()) print(a, solids, made, written, read_seconds);
  return Exit::done;
}

}  // namespace

void add_boolean(Command program) {
  const Command command =
      program.add_command("boolean", "Union, intersection, difference, symmetric difference of solids, exactly");
  auto a = std::make_shared<Boolean_arguments>();
  command
      .add_option("OPERATION", a->operation,
                  "union, intersection, difference (the first less all others) or symmetric-difference (in an odd "
                  "number of them)")
      .required()
      .check(one_of(names_of(set_operations)));
  command
      .add_option(
          "SOLIDS", a->solids,
          "two closed surfaces or more, of a union also one: .obj .off .ply .stl .qoff; fronts look outwards. A .map "
          "of brushes is one: what is in any of them")
      .required()
      .expected(1, 1 << 20)
      .reads_file();
  a->format.add_to(command);
  command
      .add_option(
          "--out", a->out,
          "write the result's surface: .qoff holds it exactly; so do the others where all coordinates are finite "
          "decimals")
      .writes_file()
      .check(surface_ending());
  command
      .add_option(
          "--certificate", a->certificate,
          "write what `sightline verify A CERTIFICATE --solid B ...` reads: all fragments, and why each is kept")
      .writes_file();
  add_json_option(command, a->json);
  add_mesh_option(command, a->mesh,
                  "the exact result in convex pieces, by solids, with the face of the solid that each is of,");
  command.add_option("--html", a->html, "write a page to look at: the result, each face in its solid's colour")
      .writes_file(".html");
  command
      .add_option("--inside", a->inside,
                  "where a surface winds round its inside: a positive, nonzero or odd number of "
                  "times")
      .check(one_of(names_of(inside_rules)))
      .show_default();
  command
      .add_option("--coordinates", a->coordinates,
                  "what decimals of the solids mean: exact (0.1 is 1/10) or double (rounded first, as in other "
                  "programs)")
      .check(one_of({"exact", "double"}))
      .show_default();
  command.add_option("--repair", a->repair, "what is done to a surface that is not closed: none, so it is refused")
      .check(one_of({"none"}))
      .show_default();
  command.add_option("--round", a->round, "what coordinates of a format that cannot hold them are rounded to")
      .check(one_of({"double", "float"}))
      .show_default();
  command.add_flag(
      "--snap", a->snap,
      "where rounding breaks the surface, round what it winds round again until it is a solid; thin parts vanish");
  command
      .add_option("--snap-rounds", a->snap_rounds, "how often --snap rounds before it tries a grid 16 times as coarse")
      .check(range(1, 1000000))
      .show_default();
  command.add_option("--threads", a->threads, "threads; 0: one for each processor. The output does not depend on it")
      .check(range(0, 1024))
      .show_default();
  command
      .add_option("--budget", a->budget,
                  "seconds; 0: no limit. Where they run out, nothing is written, and the exit code is 4")
      .check(not_negative() & finite_number())
      .show_default();
  command.footer(
      "Example: sightline boolean difference block.off drill.off --out bored.qoff --json -\n"
      "         sightline boolean union level.map --out level.qoff\n"
      "What has no volume is left out. A surface that is not closed is refused with its open edges, of which --json "
      "lists all, exit code 3.");
  command.set_action([a, command] { return run(*a, command); });
}

}  // namespace sightline::app
