#include <sightline/sightline.h>

#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/algorithms/bsp/order_cuts.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/line_drawing.h>
#include <sightline/algorithms/priority/certificate.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/kernel/threads.h>
#include <sightline/model_inside.h>
#include <sightline/told_text.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <ostream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <variant>

namespace sightline {

// ---- An order

Visibility_order order(const Model& model, const Exact_point& eye, const Asking& asking) {
  const Asking::Progress in_time = progress_within_budget(asking);
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  const Exact_traits& traits = inside->traits(in_time);
  const Scene& scene = inside->scene();
  const Bsp_tree<Exact_traits>& tree =
      inside->tree(asking.threads, in_time);  // which an earlier question may have made
  std::vector<Part> parts;
  Order_cuts cuts;
  traverse_with_cuts(traits, tree, traits.eye(eye), &scene, cuts, [&](const Fragment<Exact_traits>& fragment, Sign) {
    if (in_time) in_time(parts.size(), tree.fragments.size());
    const Piece& piece = scene.pieces()[fragment.polygon.piece];
    Part& part = parts.emplace_back(Part{piece.face, piece.number, {}});
    for (const Corner<Exact_traits>& corner : fragment.polygon) part.corners.push_back(traits.position(*corner.vertex));
  });
  auto certify = [inside, eye, parts, cuts = std::move(cuts)](const Asking::Progress& progress) {
    return told_text(progress, [&](std::ostream& out, const Asking::Progress&) {
      Order_certificate certificate;
      certificate.cuts = cuts;
      certificate.eye = eye;
      for (const Part& part : parts) certificate.fragments.push_back({part.face, part.piece, part.corners});
      add_pieces(certificate, inside->scene());
      write_certificate(out, certificate);
    });
  };
  return {Answer(std::move(certify)), eye, std::move(parts)};
}

// ---- The priority graph

Priority priority_graph(const Model& model, const Asking& asking) {
  const Asking::Progress in_time = progress_within_budget(asking);
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  const auto faces = std::make_shared<const Priority_relation<Exact_traits>>(inside->traits(in_time));
  Implicit_priority_graph<Priority_relation<Exact_traits>> graph(*faces);
  Component_trees trees;
  if (in_time) in_time(0, 1);  // few faces take no step that tells
  const Priority_components found = graph.find_components(&trees, in_time);
  auto certify = [inside, faces, found, trees = std::move(trees)](const Asking::Progress& progress) {
    return told_text(progress, [&](std::ostream& out, const Asking::Progress&) {
      write_certificate(out, graph_certificate(inside->scene(), *faces, found, trees));
    });
  };
  Priority answer{Answer(std::move(certify)), {}};
  for (std::size_t c = 0; c < found.size(); ++c) answer.components.emplace_back(found[c].begin(), found[c].end());
  answer.cyclic = found.cyclic();
  return answer;
}

// ---- A tracker

struct Tracker::Inside {
  explicit Inside(std::shared_ptr<const Model::Inside> of)
      : model(std::move(of)),
        graph(model->scene()),
        tracker(model->traits(), graph),
        nodes_on(model->soup.face_count()),
        faces_of(graph.size()) {
    const std::vector<Piece>& pieces = model->scene().pieces();
    for (std::uint32_t i = 0; i < pieces.size(); ++i) {
      std::vector<Face_id>& faces = faces_of[graph.node(i)];
      const Face_id face = pieces[i].face;
      if (faces.empty() || faces.back() != face) faces.push_back(face);
    }
  }

  std::shared_ptr<const Model::Inside> model;
  Face_graph graph;
  Cut_set_tracker<Exact_traits> tracker;
  std::vector<std::uint32_t> nodes_on;         // of each face: how many of its nodes are on-view
  std::vector<std::vector<Face_id>> faces_of;  // each node
};

Tracker::Tracker(std::unique_ptr<Inside> inside) : inside_(std::move(inside)) {}
Tracker::~Tracker() = default;
Tracker::Tracker(Tracker&&) noexcept = default;
Tracker& Tracker::operator=(Tracker&&) noexcept = default;

Tracker track(const Model& model) { return Tracker(std::make_unique<Tracker::Inside>(model.inside())); }

std::vector<Face_id> Tracker::move_to(const Exact_point& viewpoint) {
  inside_->tracker.move_to({viewpoint});
  std::vector<std::pair<Face_id, bool>> before;
  for (const std::uint32_t node : inside_->tracker.changed())
    for (const Face_id face : inside_->faces_of[node]) {
      before.emplace_back(face, inside_->nodes_on[face] > 0);
      if (inside_->tracker.on_view(node)) ++inside_->nodes_on[face];
      else --inside_->nodes_on[face];
    }
  // A face of several nodes is here several times: the first time it says what it was.
  std::stable_sort(before.begin(), before.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<Face_id> changed;
  for (std::size_t k = 0; k < before.size(); ++k)
    if ((k == 0 || before[k - 1].first != before[k].first) && before[k].second != on_view(before[k].first))
      changed.push_back(before[k].first);
  return changed;
}

bool Tracker::on_view(Face_id face) const {
  require_face(face, inside_->nodes_on.size());
  return inside_->nodes_on[face] > 0;
}

std::vector<Face_id> Tracker::on_view() const {
  std::vector<Face_id> faces;
  for (Face_id face = 0; face < inside_->nodes_on.size(); ++face)
    if (on_view(face)) faces.push_back(face);
  return faces;
}

// ---- What is seen from a point

/// What a view keeps for what it is asked later.
struct Seen::Inside {
  std::shared_ptr<const Model::Inside> model;
  Exact_view view;
  Visible_surface<Exact_view> surface;
  std::vector<Exact_point> field;
  int threads;
  Once<std::map<Face_id, std::array<double, 2>>> measures;  // areas and solid angles of faces that have any

  /// Of the view that was asked for, all around where there is no field.
  static Seen answer(const Model& model, const Exact_point& eye, const std::vector<Exact_point>& field,
                     const Asking& asking);
  static const Inside& of(const Seen& seen) {
    if (!seen.inside_) throw std::logic_error("no question made this view: take that of see() or see_in_field()");
    return *seen.inside_;
  }
  static std::array<double, 2> measures_of(const Seen& seen, Face_id face);
};

Seen Seen::Inside::answer(const Model& model, const Exact_point& eye, const std::vector<Exact_point>& field,
                          const Asking& asking) {
  Visible_options options;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  const std::shared_ptr<const Model::Inside> of = model.inside();
  const Scene& scene = of->scene(options.progress);
  const std::shared_ptr<Inside> inside(
      new Inside{of,
                 field.empty() ? Exact_view(scene, eye) : Exact_view(scene, eye, field_of(field)),
                 {},
                 field,
                 asking.threads,
                 {}});
  const Exact_view& view = inside->view;
  inside->surface = visible_surface(view, of->boxes(options.progress),
                                    field.empty() ? whole_sphere(view) : field_of_view(view), options);
  const auto* surface = &inside->surface;
  Seen answer{};
  answer.eye = eye;
  answer.visible = surface->visible;
  answer.from_behind = surface->from_behind;
  for (std::size_t k = 0; k < surface->parts.size(); ++k) {
    if (options.progress && k % 1024 == 0) options.progress(k, surface->parts.size());
    const auto& part = surface->parts[k];
    if (part.piece == surface->nothing) continue;
    const Piece& piece = scene.pieces()[part.piece];
    Seen::Visible_part& seen = answer.parts.emplace_back();
    seen.face = piece.face;
    seen.piece = piece.number;
    seen.corners = vertices(view, *surface, part);
    seen.from_front = view.eye_side(part.piece) == CGAL::POSITIVE;
  }
  static_cast<Answer&>(answer) = Answer([inside](const Asking::Progress& progress) {
    return told_text(progress, [&](std::ostream& out, const Asking::Progress& steps) {
      write_visible_certificate(out, inside->view, inside->surface, inside->view.eye(), inside->field, steps);
    });
  });
  answer.inside_ = inside;
  return answer;
}

std::array<double, 2> Seen::Inside::measures_of(const Seen& seen, Face_id face) {
  const Inside& inside = of(seen);
  require_face(face, inside.model->soup.face_count());
  const auto& measures = inside.measures.get([&] {
    std::vector<std::array<double, 2>> of_parts(seen.parts.size());
    run_with_threads(inside.threads, [&] {
      parallel_for(of_parts.size(), [&](std::size_t k) {
        const Seen::Visible_part& part = seen.parts[k];
        if (part.from_front) of_parts[k] = {part.area(), part.solid_angle(seen.eye)};
      });
    });
    std::map<Face_id, std::array<double, 2>> sums;
    for (std::size_t k = 0; k < of_parts.size(); ++k) {
      if (!seen.parts[k].from_front) continue;
      std::array<double, 2>& sum = sums[seen.parts[k].face];
      for (std::size_t m = 0; m < sum.size(); ++m) sum[m] += of_parts[k][m];
    }
    return sums;
  });
  const auto found = measures.find(face);
  return found == measures.end() ? std::array<double, 2>{} : found->second;
}

double Seen::area(Face_id face) const { return Inside::measures_of(*this, face)[0]; }
double Seen::solid_angle(Face_id face) const { return Inside::measures_of(*this, face)[1]; }

std::vector<Seen::Line> Seen::lines(const Asking::Progress& progress) const {
  const Inside& inside = Inside::of(*this);
  const std::vector<Piece>& pieces = inside.model->scene().pieces();
  std::vector<Line> lines;
  for (Drawn_line& drawn : line_drawing(inside.view, inside.surface, inside.model->boxes(), inside.threads, progress)) {
    Line& line = lines.emplace_back(Line{drawn.ends, drawn.kind, std::move(drawn.faces), {}});
    for (const Line_part& part : drawn.parts) {
      Line::Stretch& stretch = line.stretches.emplace_back(Line::Stretch{part.from, part.to, {}});
      if (part.hidden_by != Line_part::nothing) stretch.hidden_by = pieces[part.hidden_by].face;
    }
  }
  return lines;
}

Seen see(const Model& model, const Exact_point& eye, const Asking& asking) {
  return Seen::Inside::answer(model, eye, {}, asking);
}

Seen see_in_field(const Model& model, const Exact_point& eye, const std::vector<Exact_point>& field,
                  const Asking& asking) {
  if (field.size() < 3) throw std::invalid_argument("a field of view has three rays or more");
  return Seen::Inside::answer(model, eye, field, asking);
}

// ---- Rays

namespace {

/// What `find(tracer, ray, counters)` says of each ray, in parallel blocks.
template <class Found, class Ray, class Find>
std::vector<Found> of_each_ray(const Model& model, std::span<const Ray> rays, const Asking& asking, Find find) {
  constexpr std::size_t block = 256;
  const Asking::Progress progress = progress_within_budget(asking);
  std::vector<Found> found(rays.size());
  std::atomic<std::size_t> done{0};
  run_with_threads(asking.threads, [&] {
    const Ray_tracer& tracer = model.inside()->tracer(progress);
    parallel_for((rays.size() + block - 1) / block, [&](std::size_t b) {
      Ray_counters counters;
      const std::size_t end = std::min(rays.size(), (b + 1) * block);
      for (std::size_t i = b * block; i < end; ++i) found[i] = find(tracer, rays[i], counters);
      done += end - b * block;
      if (progress) progress(done, rays.size());
    });
  });
  return found;
}

}  // namespace

std::vector<std::vector<Face_hit>> trace(const Model& model, std::span<const Exact_ray> rays, Ray_start start,
                                         const Asking& asking) {
  return of_each_ray<std::vector<Face_hit>>(
      model, rays, asking, [start](const Ray_tracer& tracer, const Exact_ray& ray, Ray_counters& counters) {
        return tracer.first(ray, start, counters);
      });
}

std::vector<std::vector<Face_hit>> trace_all(const Model& model, std::span<const Exact_ray> rays, Ray_start start,
                                             const Asking& asking) {
  return of_each_ray<std::vector<Face_hit>>(
      model, rays, asking, [start](const Ray_tracer& tracer, const Exact_ray& ray, Ray_counters& counters) {
        return tracer.all(ray, start, counters);
      });
}

std::vector<Nearest_face> nearest(const Model& model, std::span<const Double_ray> rays, Ray_start start,
                                  const Asking& asking) {
  return of_each_ray<Nearest_face>(model, rays, asking,
                                   [start](const Ray_tracer& tracer, const Double_ray& ray, Ray_counters& counters) {
                                     const Ray_tracer::Nearest hit = tracer.nearest(ray, start, counters);
                                     return Nearest_face{hit.face, hit.side, hit.tied, hit.low, hit.high};
                                   });
}

// ---- Checking

Checked verify(const Model& model, const std::string& certificate, const Asking& asking) {
  std::istringstream in(certificate);
  const Certificate claim = read_certificate(in);
  Verify_options options;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  const Polygon_soup& soup = model.soup();
  struct Check {
    const Polygon_soup& soup;
    const Verify_options& options;
    Verdict operator()(const Order_certificate& c) const { return verify_order(soup, c, options); }
    Verdict operator()(const Graph_certificate& c) const { return verify_graph(soup, c, options); }
    Verdict operator()(const Visible_certificate& c) const { return verify_visible(soup, c, options); }
    Verdict operator()(const Weak_certificate& c) const { return verify_weak(soup, c, options); }
    Verdict operator()(const Along_certificate& c) const { return verify_along(soup, c, options); }
  };
  const Verdict verdict = std::visit(Check{soup, options}, claim);
  return {verdict.accepted, verdict.why};
}

}  // namespace sightline
