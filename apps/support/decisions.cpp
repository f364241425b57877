#include "decisions.h"

#include "paths.h"

#include <sightline/io/input.h>

#include <algorithm>
#include <iostream>
#include <map>
#include <numeric>

namespace sightline::app {

void add_to(Command command, Decision_arguments& arguments) {
  command.add_flag(
      "--decision-tree", arguments.wanted,
      "the order of on-view tests that finds all on-view faces with the fewest expected, as a table (up to 24 planes)");
  command
      .add_option("--likelihood", arguments.likelihood,
                  "with --decision-tree: a file with WEIGHT,FACE,FACE,... a line, the faces that are on-view together; "
                  "without it all views from outside are alike")
      .reads_file();
  command.add_flag("--inside", arguments.inside, "with --decision-tree: no face on-view is possible too, at weight 0");
}

/// Errors: std::invalid_argument for a scene that has no such tree; those of reading the likelihood.
static Decisions decided(const Decision_arguments& arguments, const Face_graph& graph, const Report& in_time) {
  const auto ask = [&] { in_time(0, 1); };
  Decisions found;
  std::vector<std::uint32_t> nodes(graph.size());
  std::iota(nodes.begin(), nodes.end(), 0u);
  std::sort(nodes.begin(), nodes.end(),
            [&](std::uint32_t i, std::uint32_t j) { return graph.piece(i) < graph.piece(j); });
  std::vector<std::array<Rational, 4>> planes;
  for (const std::uint32_t node : nodes) {
    planes.push_back(graph.scene().file_coefficients(graph.plane(node)));
    found.faces.push_back(graph.scene().pieces()[graph.piece(node)].face);
  }
  if (planes.empty()) throw std::invalid_argument("no face is left, and a decision tree tells faces' views apart");
  const std::vector<View_cell> cells = view_cells(planes, ask);
  found.cells = cells.size();
  for (const View_cell& cell : cells) found.open_cells += cell.open;

  std::vector<Weighted_view> views;
  if (arguments.likelihood.empty()) {
    views = uniform_likelihood(cells, arguments.inside);
  } else {
    std::map<Rational, std::uint32_t> bits;  // by face: of several that hang together in one plane each has its bit
    for (std::uint32_t i = 0; i < graph.scene().pieces().size(); ++i) {
      const auto bit = std::find(nodes.begin(), nodes.end(), graph.node(i)) - nodes.begin();
      bits[graph.scene().pieces()[i].face] |= 1u << bit;
    }
    read_lines(arguments.likelihood,
               "a view WEIGHT,FACE,FACE,... that some viewpoint has, with a weight that is not negative and faces of "
               "this scene",
               [&](const std::vector<Rational>& n) {
                 std::uint32_t on_view = 0;
                 for (std::size_t k = 1; k < n.size(); ++k) {
                   const auto named = bits.find(n[k]);
                   if (named == bits.end()) return false;
                   on_view |= named->second;
                 }
                 views.push_back({on_view, n[0]});
                 return sgn(n[0]) >= 0 && std::any_of(cells.begin(), cells.end(),
                                                      [&](const View_cell& cell) { return cell.on_view == on_view; });
               });
  }
  found.tree = least_tests(views, static_cast<unsigned>(planes.size()), Decision_tree::most_states, ask);
  return found;
}

Decisions decide(const Decision_arguments& arguments, const Face_graph& graph, const Report& in_time) {
  try {
    return decided(arguments, graph, in_time);
  } catch (const std::invalid_argument& error) {
    throw Input_error::of_file(graph.scene().file(), error.what());
  }
}

static std::vector<Face_id> faces_of(const Decisions& decisions, std::uint32_t view) {
  std::vector<Face_id> faces;
  for (std::size_t k = 0; k < decisions.faces.size(); ++k)
    if (view >> k & 1) faces.push_back(decisions.faces[k]);
  return faces;
}

Json to_json(const Decisions& decisions) {
  const Decision_tree& tree = decisions.tree;
  const auto child = [](std::uint32_t at) -> Json {
    return at & Decision_tree::leaf ? Json{{"view", at - Decision_tree::leaf}} : Json{{"step", at}};
  };
  Json steps = Json::array(), views = Json::array();
  for (const Decision_tree::Step& step : tree.steps)
    steps.push_back({{"face", decisions.faces[step.face]}, {"on", child(step.on)}, {"off", child(step.off)}});
  for (const std::uint32_t view : tree.views) views.push_back(faces_of(decisions, view));
  return {{"expected", to_string(tree.expected)},
          {"bound", to_string(tree.bound)},
          {"cells", decisions.cells},
          {"open_cells", decisions.open_cells},
          {"states", tree.states},
          {"steps", std::move(steps)},
          {"views", std::move(views)}};
}

void print(const Decisions& decisions) {
  const Decision_tree& tree = decisions.tree;
  row("views", fmt::format("{} that some viewpoint has, {} of them from open sets of viewpoints; {} told apart",
                           decisions.cells, decisions.open_cells, tree.views.size()));
  row("expected tests", fmt::format("{} = {:.4f} of {}; no binary tree has fewer than {} = {:.4f}",
                                    to_string(tree.expected), nearest_double(tree.expected), decisions.faces.size(),
                                    to_string(tree.bound), nearest_double(tree.bound)));
  const auto child = [&](std::uint32_t at) {
    if (!(at & Decision_tree::leaf)) return fmt::format("step {}", at);
    std::string text = "on-view:";
    for (const Face_id face : faces_of(decisions, tree.views[at - Decision_tree::leaf]))
      text += fmt::format(" {}", face);
    return text;
  };
  constexpr std::size_t shown = 40;
  for (std::size_t k = 0; k < std::min(shown, tree.steps.size()); ++k)
    std::cout << fmt::format("step {:>3}: face {:>3}   on: {:<24} off: {}\n", k, decisions.faces[tree.steps[k].face],
                             child(tree.steps[k].on), child(tree.steps[k].off));
  if (tree.steps.size() > shown)
    std::cout << fmt::format("   ... {} more: --json - prints them all\n", tree.steps.size() - shown);
}

}  // namespace sightline::app
