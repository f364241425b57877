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

#include <algorithm>
#include <array>
#include <atomic>
#include <map>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <variant>

namespace sightline {

// ---- An order

Visibility_order order(const Model& model, const Exact_point& eye, const Asking& asking) {
  Asking collecting;  // which counts too
  collecting.budget = asking.budget;
  const auto in_time = progress_within_budget(collecting);
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  const Exact_traits& traits = inside->traits();
  const Scene& scene = inside->scene();
  Visibility_order answer;
  answer.eye = eye;
  Order_cuts cuts;
  traverse_with_cuts(traits, inside->tree(asking), traits.eye(eye), &scene, cuts,
                     [&](const Fragment<Exact_traits>& fragment, Sign) {
                       if (in_time) in_time(answer.parts.size(), answer.parts.size());
                       const Piece& piece = scene.pieces()[fragment.polygon.piece];
                       Part& part = answer.parts.emplace_back(Part{piece.face, piece.number, {}});
                       for (const Corner<Exact_traits>& corner : fragment.polygon)
                         part.corners.push_back(traits.position(*corner.vertex));
                     });
  answer.certificate_ = [inside, eye, parts = answer.parts, cuts = std::move(cuts)] {
    Order_certificate certificate;
    certificate.cuts = cuts;
    certificate.eye = eye;
    for (const Part& part : parts) certificate.fragments.push_back({part.face, part.piece, part.corners});
    add_pieces(certificate, inside->scene());
    return certificate_text(certificate);
  };
  return answer;
}

// ---- The priority graph

Priority priority_graph(const Model& model, const Asking& asking) {
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  const auto faces = std::make_shared<const Priority_relation<Exact_traits>>(inside->traits());
  Implicit_priority_graph<Priority_relation<Exact_traits>> graph(*faces);
  Component_trees trees;
  const Priority_components found = graph.find_components(&trees, progress_within_budget(asking));
  Priority answer;
  for (std::size_t c = 0; c < found.size(); ++c) answer.components.emplace_back(found[c].begin(), found[c].end());
  answer.cyclic = found.cyclic();
  answer.certificate_ = [inside, faces, found, trees = std::move(trees)] {
    return certificate_text(graph_certificate(inside->scene(), *faces, found, trees));
  };
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

bool Tracker::on_view(Face_id face) const { return inside_->nodes_on.at(face) > 0; }

std::vector<Face_id> Tracker::on_view() const {
  std::vector<Face_id> faces;
  for (Face_id face = 0; face < inside_->nodes_on.size(); ++face)
    if (on_view(face)) faces.push_back(face);
  return faces;
}

// ---- What is seen from a point

namespace {

/// All around where there is no field.
Seen seen_from(const Model& model, const Exact_point& eye, const std::vector<Exact_point>& field,
               const Asking& asking) {
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  const auto view = field.empty() ? std::make_shared<const Exact_view>(inside->scene(), eye)
                                  : std::make_shared<const Exact_view>(inside->scene(), eye, field_of(field));
  Visible_options options;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  const auto surface = std::make_shared<const Visible_surface<Exact_view>>(
      visible_surface(*view, inside->boxes(), field.empty() ? whole_sphere(*view) : field_of_view(*view), options));
  Seen answer;
  answer.eye = eye;
  answer.visible = surface->visible;
  answer.from_behind = surface->from_behind;
  for (const auto& part : surface->parts) {
    if (part.piece == surface->nothing) continue;
    const Piece& piece = inside->scene().pieces()[part.piece];
    Seen::Visible_part& seen = answer.parts.emplace_back();
    seen.face = piece.face;
    seen.piece = piece.number;
    seen.corners = vertices(*view, *surface, part);
    seen.from_front = view->eye_side(part.piece) == CGAL::POSITIVE;
  }
  answer.measures_ = [made = std::make_shared<Once<std::map<Face_id, std::array<double, 2>>>>()](const Seen& seen,
                                                                                                 Face_id face) {
    const auto& measures = made->get([&] {
      std::map<Face_id, std::array<double, 2>> sums;
      for (const Seen::Visible_part& part : seen.parts) {
        if (!part.from_front) continue;
        std::array<double, 2>& sum = sums[part.face];
        sum[0] += part.area();
        sum[1] += part.solid_angle(seen.eye);
      }
      return sums;
    });
    const auto found = measures.find(face);
    return found == measures.end() ? std::array<double, 2>{} : found->second;
  };
  answer.certificate_ = [inside, view, surface, eye, field] {
    std::ostringstream out;
    write_visible_certificate(out, *view, *surface, eye, field);
    return std::move(out).str();
  };
  answer.lines_ = [inside, view, surface, threads = asking.threads](const Line_progress& progress) {
    std::vector<Seen::Line> lines;
    for (Drawn_line& drawn : line_drawing(*view, *surface, inside->boxes(), threads, progress)) {
      Seen::Line& line = lines.emplace_back(Seen::Line{drawn.ends, drawn.kind, std::move(drawn.faces), {}});
      for (const Line_part& part : drawn.parts) {
        Seen::Line::Stretch& stretch = line.stretches.emplace_back(Seen::Line::Stretch{part.from, part.to, {}});
        if (part.hidden_by != Line_part::nothing) stretch.hidden_by = inside->scene().pieces()[part.hidden_by].face;
      }
    }
    return lines;
  };
  return answer;
}

}  // namespace

Seen see(const Model& model, const Exact_point& eye, const Asking& asking) { return seen_from(model, eye, {}, asking); }

Seen see_in_field(const Model& model, const Exact_point& eye, const std::vector<Exact_point>& field,
                  const Asking& asking) {
  if (field.size() < 3) throw std::invalid_argument("a field of view has three rays or more");
  return seen_from(model, eye, field, asking);
}

// ---- Rays

namespace {

/// What `find(tracer, ray, counters)` says of each ray, in parallel blocks.
template <class Found, class Ray, class Find>
std::vector<Found> of_each_ray(const Model& model, std::span<const Ray> rays, const Asking& asking, Find find) {
  constexpr std::size_t block = 256;
  const auto progress = progress_within_budget(asking);
  std::vector<Found> found(rays.size());
  std::atomic<std::size_t> done{0};
  run_with_threads(asking.threads, [&] {
    const Ray_tracer& tracer = model.inside()->tracer();
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
