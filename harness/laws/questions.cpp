#include <sightline/harness/laws/questions.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/image/blend.h>
#include <sightline/algorithms/image/bsp2d.h>
#include <sightline/algorithms/image/centres.h>
#include <sightline/algorithms/image/means.h>
#include <sightline/algorithms/image/newell.h>
#include <sightline/algorithms/image/painter.h>
#include <sightline/algorithms/image/scan_line.h>
#include <sightline/algorithms/image/warnock.h>
#include <sightline/algorithms/levels/cell_pvs.h>
#include <sightline/algorithms/levels/cells.h>
#include <sightline/algorithms/levels/coarse.h>
#include <sightline/algorithms/levels/pvs.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/line_drawing.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/priority/certificate.h>
#include <sightline/algorithms/priority/explicit_graph.h>
#include <sightline/algorithms/priority/tree.h>
#include <sightline/algorithms/shadow/shadow.h>
#include <sightline/algorithms/shadow/volume.h>
#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/rounding.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/solids/without_holes.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/conservative.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/harness/generate/pixel_views.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/generate/rays.h>
#include <sightline/harness/laws/solids.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/traits/exact_traits.h>
#include <sightline/sightline.h>

#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

namespace sightline::harness {

namespace questions {

// ---- Text

template <class Numbers>
void put_all(std::ostream& out, const Numbers& numbers) {
  for (const auto& number : numbers) out << number << ' ';
  out << '\n';
}

void put_points(std::ostream& out, const std::vector<Exact_point>& points) {
  for (const Exact_point& p : points) out << p[0] << ' ' << p[1] << ' ' << p[2] << ", ";
  out << '\n';
}

void put_soup(std::ostream& out, const Polygon_soup& soup) {
  for (Face_id f = 0; f < soup.face_count(); ++f)
    for (std::size_t k = 0; k < soup.loop_count(f); ++k) {
      std::vector<Exact_point> points;
      for (const Point_id p : soup.loop(f, k)) points.push_back(soup.point(p));
      put_points(out, points);
    }
}

void put_verdict(std::ostream& out, const Verdict& verdict) { out << verdict.accepted << ' ' << verdict.why << '\n'; }

/// Throws where a counter went below zero, which makes it very large.
template <class Counters>
void require_counted(const Counters& counters) {
  constexpr std::size_t most = std::size_t{1} << 48;
  Counters::each([&](std::string_view key, auto member, auto...) {
    const auto& value = counters.*member;
    if constexpr (std::is_class_v<std::remove_cvref_t<decltype(value)>>) require_counted(value);
    else if (static_cast<std::size_t>(value) > most)
      throw std::logic_error("a counter is below zero: " + std::string(key));
  });
}

Verify_options verifying(const Manner& manner) { return {manner.threads, manner.progress}; }

// ---- From a point

Visible_options visible_options(const Manner& manner) { return {manner.threads, manner.progress}; }

std::string surface(const Posed_scene& posed, const Manner& manner, std::uint64_t) {
  const Scene scene(posed.soup);
  const Exact_view view(scene, posed.eye);
  const auto seen = visible_surface(view, Piece_boxes(scene), visible_options(manner));
  require_counted(seen.counters);
  std::ostringstream out;
  write_visible_certificate(out, view, seen, posed.eye);
  return out.str();
}

std::string seen_certificate(const Posed_scene& posed, const Manner& manner, std::uint64_t) {
  const Scene scene(posed.soup);
  const Exact_view view(scene, posed.eye);
  const auto seen = visible_surface(view, Piece_boxes(scene), visible_options({}));
  std::ostringstream out;
  write_visible_certificate(out, view, seen, posed.eye, {}, manner.progress);
  return out.str();
}

std::string seen_verdict(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Scene scene(posed.soup);
  const Exact_view view(scene, posed.eye);
  Visible_certificate claim =
      visible_certificate(view, visible_surface(view, Piece_boxes(scene), visible_options({})), posed.eye);
  if (choice % 2 != 0 && !claim.fragments.empty()) claim.fragments.erase(claim.fragments.begin());
  std::ostringstream out;
  put_verdict(out, verify_visible(posed.soup, claim, verifying(manner)));
  return out.str();
}

std::string lines(const Posed_scene& posed, const Manner& manner, std::uint64_t) {
  const Scene scene(posed.soup);
  const Exact_view view(scene, posed.eye);
  const Piece_boxes boxes(scene);
  std::ostringstream out;
  for (const Drawn_line& line :
       line_drawing(view, visible_surface(view, boxes, visible_options({})), boxes, manner.threads, manner.progress)) {
    put_points(out, {line.ends.begin(), line.ends.end()});
    out << line.kind << ' ' << line.parts.size() << '\n';
    for (const Line_part& part : line.parts) out << part.from << ' ' << part.to << ' ' << part.hidden_by << '\n';
    put_all(out, line.faces);
  }
  return out.str();
}

std::string way(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Scene scene(posed.soup);
  if (scene.pieces().empty()) return {};
  Exact_point to = posed.eye;
  to[choice % 3] += static_cast<long>(1 + choice / 3 % 8);
  Along_options options;
  options.with_proofs = true;
  options.two_sided = choice % 2 != 0;
  options.threads = manner.threads;
  options.progress = manner.progress;
  const Occluders occluders(scene);
  const auto along = visible_along(occluders, posed.eye, to, options);
  require_counted(along.counters);
  const Along_certificate claim = along_certificate(scene, along, posed.eye, to, options.two_sided);
  std::ostringstream out;
  write_certificate(out, claim);
  put_verdict(out, verify_along(posed.soup, claim, verifying(manner)));
  return out.str();
}

/// Of more rays than one thread takes at a time.
std::string hits(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  constexpr std::size_t many = 600;
  Random random(choice);
  std::vector<Exact_ray> rays;
  std::vector<Double_ray> doubles;
  for (const generate::Ray_kind& kind : generate::ray_kinds()) rays.push_back(kind.make(posed.soup, random));
  for (std::size_t k = 0; rays.size() < many; ++k) rays.push_back(rays[k]);
  for (const Exact_ray& exact : rays)
    if (const Double_ray ray = in_doubles(exact); is_ray(ray)) doubles.push_back(ray);
  const Ray_start start = choice % 2 != 0 ? Ray_start::open : Ray_start::closed;
  const Asking asking{manner.threads, manner.progress};
  const Model model(posed.soup);
  std::ostringstream out;
  if (choice / 2 % 3 == 0) {
    for (const Nearest_face& hit : nearest(model, doubles, start, asking))
      out << hit.face << ' ' << static_cast<int>(hit.side) << ' ' << hit.tied << ' ' << std::hexfloat << hit.low << ' '
          << hit.high << '\n';
    return out.str();
  }
  for (const auto& its :
       choice / 2 % 3 == 1 ? trace(model, rays, start, asking) : trace_all(model, rays, start, asking)) {
    for (const Face_hit& hit : its)
      out << hit.face << ' ' << static_cast<int>(hit.side) << ' ' << hit.t << ' ' << hit.until << ", ";
    out << '\n';
  }
  return out.str();
}

// ---- Orders

std::string tree(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  Bsp_options options;
  options.seed = choice;
  options.threads = manner.threads;
  options.progress = manner.progress;
  const auto tree = build_bsp(traits, options);
  std::ostringstream out;
  for (const auto& node : tree.nodes)
    out << node.plane.id() << ' ' << node.plane.flipped() << ' ' << node.front << ' ' << node.behind << ' '
        << node.first << ' ' << node.count << '\n';
  for (const auto& fragment : tree.fragments) {
    out << fragment.polygon.piece << ' ' << fragment.same_sense << ' ' << fragment.number << ": ";
    std::vector<Exact_point> corners;
    for (const auto& corner : fragment.polygon) corners.push_back(traits.position(*corner.vertex));
    put_points(out, corners);
  }
  return out.str();
}

std::string priority_tree(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const auto tree = build_priority_tree(traits, {choice % 2 != 0, choice / 2 % 2 != 0, manner.progress});
  require_counted(tree.counters);
  std::ostringstream out;
  for (const auto& node : tree.nodes)
    out << static_cast<int>(node.kind) << ' ' << node.first << ' ' << node.count << '\n';
  put_all(out, tree.slots);
  return out.str();
}

/// Of the faces as a tree draws them, or of two of them exchanged, with its planes or without.
std::string order_verdict(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  std::istringstream told(sightline::order(Model(posed.soup), posed.eye, {1, {}}).certificate());
  Order_certificate claim = std::get<Order_certificate>(read_certificate(told));
  if (choice % 2 != 0) claim.cuts = {};
  if (choice / 2 % 2 != 0 && claim.fragments.size() > 1) {
    const std::size_t at = choice / 4 % claim.fragments.size(), other = choice / 64 % claim.fragments.size();
    std::swap(claim.fragments[at], claim.fragments[other]);
  }
  std::ostringstream out;
  put_verdict(out, verify_order(posed.soup, claim, verifying(manner)));
  return out.str();
}

std::string components(const Posed_scene& posed, const Manner& manner, std::uint64_t) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> faces(traits);
  Implicit_priority_graph<Priority_relation<Exact_traits>> graph(faces);
  Component_trees trees;
  const Priority_components found = graph.find_components(&trees, manner.progress);
  const Graph_certificate claim = graph_certificate(scene, faces, found, trees);
  std::ostringstream out;
  write_certificate(out, claim);
  put_verdict(out, verify_graph(posed.soup, claim, verifying(manner)));
  return out.str();
}

std::string arcs(const Posed_scene& posed, const Manner& manner, std::uint64_t) {
  const Scene scene(posed.soup);
  const Exact_traits traits(scene);
  const Priority_relation<Exact_traits> faces(traits);
  const Explicit_priority_graph graph(faces, manner.progress);
  std::ostringstream out;
  for (std::uint32_t i = 0; i < faces.size(); ++i)
    for (std::uint32_t j = 0; j < faces.size(); ++j)
      if (graph.has_arc(i, j)) out << i << ' ' << j << '\n';
  return out.str();
}

// ---- From a polygon

std::string possibly(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Scene scene(posed.soup);
  const Occluders occluders(scene);
  const Weakly_visible found = possibly_visible(occluders, {weak_source(occluders, posed.source)},
                                                {choice % 2 != 0, manner.threads, manner.progress});
  require_counted(found.counters);
  std::ostringstream out;
  put_all(out, found.visible);
  put_all(out, found.hidden);
  return out.str();
}

std::string weakly(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  constexpr std::size_t most_cells = 300;
  const Scene scene(posed.soup);
  const Occluders occluders(scene);
  Weak_options options;
  options.search.two_sided = choice % 2 != 0;
  options.search.cells = most_cells;
  options.threads = manner.threads;
  options.progress = manner.progress;
  const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, posed.source)}, options);
  require_counted(found.counters);
  const Weak_certificate claim = weak_certificate(scene, {posed.source}, options.search.two_sided, found);
  std::ostringstream out;
  write_certificate(out, claim);
  put_verdict(out, verify_weak(posed.soup, claim, verifying(manner)));
  return out.str();
}

/// Of two boxes about corners of the scene, which may be the same.
std::string solid_source(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  if (posed.soup.point_count() == 0) return {};
  Random random(choice);
  generate::Faces faces;
  for (std::size_t k = 0; k < 2; ++k) {
    const Exact_point low = posed.soup.point(static_cast<Point_id>(random.below(posed.soup.point_count())));
    const Rational size = generate::integer(random, 1, 3);
    generate::add(faces, generate::box(low, generate::along(low, size, {1, 1, 1})));
  }
  std::ostringstream out;
  run_with_threads(manner.threads, [&] {
    const Weak_volume volume(generate::soup_of(faces), manner.progress);
    for (const std::vector<Exact_point>& polygon : volume.surface()) put_points(out, polygon);
  });
  return out.str();
}

// ---- Levels

Level_cells level_of(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  Cell_options options;
  options.seed = choice;
  options.threads = manner.threads;
  options.progress = manner.progress;
  return Level_cells(posed.soup, options);
}
Pvs_options pvs_options(const Manner& manner) {
  constexpr std::size_t most_cells = 1000, most_event_edges = 12;
  Pvs_options options;
  options.search.cells = most_cells;
  options.event_edges = most_event_edges;
  options.outside = true;
  options.threads = manner.threads;
  options.progress = manner.progress;
  return options;
}
void put_rows(std::ostream& out, const std::vector<std::vector<std::uint32_t>>& rows) {
  for (const std::vector<std::uint32_t>& row : rows) put_all(out, row);
}

std::string cells(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Level_cells level = level_of(posed, manner, choice);
  require_counted(level.counters());
  std::ostringstream out;
  put_points(out, level.points());
  for (const Level_cell& cell : level.cells()) {
    out << cell.winding << ' ' << cell.is_solid << ' ' << cell.is_outside << ' ' << cell.region << '\n';
    put_all(out, cell.walls);
    put_all(out, cell.faces);
  }
  for (const Cell_wall& wall : level.walls()) {
    out << wall.front << ' ' << wall.behind << '\n';
    put_rows(out, wall.open);
  }
  put_all(out, convex_regions(level, 1 + choice % 4, manner.progress));
  return out.str();
}

/// Of a table in which all is decided; what is not may be another pair each time.
template <class Table>
std::string text_of(const Table& table) {
  require_counted(table.counters);
  if (table.counters.undecided > 0) return {};
  std::ostringstream out;
  put_rows(out, table.visible);
  return out.str();
}
std::string faces_by_cell(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  return text_of(potentially_visible(level_of(posed, {}, choice), pvs_options(manner)));
}
std::string cells_by_cell(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  return text_of(mutually_visible_cells(level_of(posed, {}, choice), pvs_options(manner)));
}

// ---- Shadows

std::string parts(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Scene scene(posed.soup);
  const Shadows found =
      shadows(Exact_view(scene, posed.eye), Piece_boxes(scene), {choice % 2 != 0, manner.threads, manner.progress});
  require_counted(found.counters);
  std::ostringstream out;
  for (const Shadow_part& part : found.parts) {
    out << part.piece << ' ' << part.by << ' ' << int{part.side} << ": ";
    put_points(out, part.vertices);
  }
  put_all(out, found.lit);
  put_all(out, found.away);
  return out.str();
}

std::string volume(const Posed_scene& posed, const Manner& manner, std::uint64_t) {
  constexpr std::size_t most_pieces = 12;
  const Scene scene(posed.soup);
  if (scene.pieces().size() > most_pieces) return {};
  std::ostringstream out;
  run_with_threads(manner.threads, [&] { put_soup(out, shadow_volume(scene, posed.eye, manner.progress).soup); });
  return out.str();
}

// ---- Images

Image_options image_options(const Manner& manner) { return {manner.threads, manner.progress}; }

std::string image(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  if (posed.soup.point_count() == 0) return {};
  const Scene scene(posed.soup);
  Random random(choice);
  const Pixel_view pixels = generate::any_pixel_view(posed.soup, posed.eye, random);
  const Image_options options = image_options(manner);
  const auto kernel = static_cast<Image_kernel>(choice / 8 % 3);
  const auto made = [&] {
    switch (choice % 5) {
      case 0: return centres(Exact_view(scene, pixels.eye), pixels, options);
      case 1: return newell(scene, pixels, kernel, options);
      case 2: return scan_line(scene, pixels, kernel, options);
      case 3: return warnock(scene, pixels, kernel, options);
      default: return heedless_painter(scene, pixels, Painter_key::mean, kernel, options);
    }
  };
  std::ostringstream out;
  put_all(out, made().pieces);
  return out.str();
}

std::string blended(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  if (posed.soup.point_count() == 0) return {};
  const Scene scene(posed.soup);
  Random random(choice);
  const Pixel_view pixels = generate::any_pixel_view(posed.soup, posed.eye, random);
  std::vector<Tint> tints;
  for (std::size_t i = 0; i < scene.pieces().size(); ++i)
    tints.push_back({{double(i % 7), double(i % 5), double(i % 3)}, i % 3 == 0 ? 1 : 0.5});
  const Image_options options = image_options(manner);
  std::ostringstream out;
  const auto put_colour = [&](const Colour& colour) {
    out << colour[0] << ' ' << colour[1] << ' ' << colour[2] << '\n';
  };
  const Exact_view view(scene, pixels.eye, field_of(pixels));
  switch (choice % 3) {
    case 0: {
      const Blended_image image = blended_centres(Exact_view(scene, pixels.eye), pixels, tints, options);
      for (const auto& layer : image.layers) put_colour(layer.colour);
      break;
    }
    case 1: {
      const Mean_image image = blended_means(view, pixels, tints, options);
      for (const Colour& colour : image.colours) put_colour(colour);
      break;
    }
    default: {
      const auto surface = visible_surface(view, Piece_boxes(scene), field_of_view(view), visible_options({}));
      const Mean_image image = visible_means(
          view, surface, pixels, [&](std::uint32_t piece) { return tints[piece].colour; }, options);
      for (const Colour& colour : image.colours) put_colour(colour);
    }
  }
  return out.str();
}

std::string two_trees(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  const Scene scene(posed.soup);
  const Exact_view view(scene, posed.eye);
  Bsp2d_options options;
  options.skip_hidden = choice % 2 != 0;
  options.threads = manner.threads;
  options.progress = manner.progress;
  const auto found = bsp2d(view, whole_sphere(view), options).surface;
  std::ostringstream out;
  for (const auto& part : found.parts) {
    out << part.piece << ' ' << part.size << ' ';
    put_points(out, part.piece == found.nothing ? std::vector<Exact_point>() : vertices(view, found, part));
  }
  put_all(out, found.visible);
  return out.str();
}

// ---- Solids

std::string set_of_solids(const Posed_scene& posed, const Manner& manner, std::uint64_t choice) {
  Random random(choice);
  const std::vector<Polygon_soup> solids = solids_of(posed, random);
  if (solids.empty()) return {};
  const Operands operands(solids);
  Set_options options = drawn_operation(random);
  options.progress = manner.progress;
  std::ostringstream out;
  run_with_threads(manner.threads, [&] {
    const Set_result result = set_operation(operands, options);
    require_counted(result.counters);
    const Solid_certificate claim = solid_certificate(operands, options, result);
    write_solid_certificate(out, claim);
    put_soup(out, result.soup);
    put_verdict(out, verify_solids(solids, claim, &result.soup, verifying(manner)));
    const Polygon_soup flat = without_holes(result.soup).soup;
    const auto to = choice % 2 == 0 ? Rounding::to_double : Rounding::to_float;
    try {
      put_soup(out, (choice % 3 == 0 ? snapped(flat, to, false, manner.progress)
                                     : rounded(flat, to, choice % 5 == 0, manner.progress))
                        .soup);
    } catch (const std::domain_error& error) {  // beyond what the numbers hold
      out << error.what();
    }
  });
  return out.str();
}

}  // namespace questions

using namespace questions;

std::vector<Question> questions_of_see() {
  return {{"what is seen", surface, true, true},
          {"the certificate of what is seen", seen_certificate, true},
          {"the verdict on what is seen", seen_verdict},
          {"the line drawing", lines},
          {"what is seen on a way", way}};
}
std::vector<Question> questions_of_trace() { return {{"what rays meet", hits, true}}; }
std::vector<Question> questions_of_order() {
  return {{"the tree", tree, true, true},
          {"the priority tree", priority_tree, false, true},
          {"the verdict on the order", order_verdict, true}};
}
std::vector<Question> questions_of_graph() { return {{"components", components, true}, {"arcs", arcs, true}}; }
std::vector<Question> questions_of_weak() {
  return {{"what may be visible", possibly, true, true},
          {"what is weakly visible", weakly, false, true},
          {"a solid's surface", solid_source}};
}
std::vector<Question> questions_of_pvs() {
  return {{"cells", cells, true, true},
          {"faces by cell", faces_by_cell, false, true},
          {"cells by cell", cells_by_cell, false, true}};
}
std::vector<Question> questions_of_shadow() {
  return {{"what is lit", parts, true, true}, {"the shadow volume", volume}};
}
std::vector<Question> questions_of_render() {
  return {{"the image", image, true}, {"the blended image", blended}, {"the surface of two trees", two_trees}};
}
std::vector<Question> questions_of_boolean() { return {{"what is made of solids", set_of_solids}}; }

}  // namespace sightline::harness
