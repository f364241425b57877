#include <sightline/sightline.h>

#include <sightline/algorithms/bsp/build.h>
#include <sightline/algorithms/bsp/traverse.h>
#include <sightline/algorithms/covering_of_scene.h>
#include <sightline/algorithms/order_cuts.h>
#include <sightline/algorithms/cutset/tracker.h>
#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/line_drawing.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/priority/certificate.h>
#include <sightline/algorithms/priority/implicit_graph.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/verify/solids_json.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/conservative.h>
#include <sightline/algorithms/weak_visibility/settle.h>
#include <sightline/algorithms/weak_visibility/volume.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/io/read.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/closed.h>
#include <sightline/kernel/threads.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <list>
#include <mutex>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <variant>

namespace sightline {

// ---- What is made when it is first asked for

template <class T>
class Once {
 public:
  template <class Make>
  const T& get(const Make& make) const {
    std::call_once(flag_, [&] { value_ = std::make_unique<T>(make()); });
    return *value_;
  }

 private:
  mutable std::once_flag flag_;
  mutable std::unique_ptr<T> value_;
};

namespace {

// ---- Measures: exact vectors, one root at the end

/// The root of a rational in doubles, where that is within their range, to three units in the last place.
double root(const Rational& square) { return std::sqrt(nearest_double(square)); }

/// Of a triangle by Van Oosterom and Strackee's formula: the volume is exact, so thin triangles keep their precision.
double solid_angle_of(const Exact_point& a, const Exact_point& b, const Exact_point& c) {
  const double volume = std::fabs(nearest_double(dot(a, cross(b, c))));
  const double la = root(dot(a, a)), lb = root(dot(b, b)), lc = root(dot(c, c));
  const double below =
      la * lb * lc + nearest_double(dot(a, b)) * lc + nearest_double(dot(b, c)) * la + nearest_double(dot(c, a)) * lb;
  const double angle = 2 * std::atan2(volume, below);
  return angle < 0 ? angle + 4 * std::numbers::pi : angle;
}

void require_index(std::uint32_t index, std::size_t count) {
  if (index >= count)
    throw std::out_of_range("corner " + std::to_string(index) + " is no point: there are " + std::to_string(count));
}

}  // namespace

// ---- Budgets

std::function<bool()> end_of_budget(const Asking& asking) { return Time_limit(asking.budget).end(); }

std::function<void(std::size_t, std::size_t)> progress_within_budget(const Asking& asking) {
  const std::function<bool()> is_over = end_of_budget(asking);
  if (!is_over) return asking.progress;
  return [is_over, progress = asking.progress](std::size_t done, std::size_t all) {
    if (is_over()) throw Out_of_budget("undecided: the budget ran out; give it more seconds, or a smaller scene");
    if (progress) progress(done, all);
  };
}

// ---- Parts

double Part::area() const {
  Exact_point twice{0, 0, 0};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Exact_point part = cross(minus(corners[i], corners[0]), minus(corners[i + 1], corners[0]));
    for (std::size_t k = 0; k < 3; ++k) twice[k] += part[k];
  }
  return root(dot(twice, twice)) / 2;
}

double Part::solid_angle(const Exact_point& eye) const {
  double sum = 0;
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    sum += solid_angle_of(minus(corners[0], eye), minus(corners[i], eye), minus(corners[i + 1], eye));
  return sum;
}

// ---- The model

struct Model::Inside {
  explicit Inside(Polygon_soup from) : soup(std::move(from)), scene(soup), traits(scene) {
    for (const Set_aside& entry : scene.set_aside()) left_out.push_back({entry.face, entry.why});
  }

  const std::vector<Part>& parts() const {
    return parts_.get([&] {
      std::vector<Part> parts;
      parts.reserve(scene.pieces().size());
      for (const Piece& piece : scene.pieces()) {
        Part& part = parts.emplace_back(Part{piece.face, piece.number, {}});
        for (const Piece_corner& corner : scene.corners(piece)) part.corners.push_back(scene.position(corner.point));
      }
      return parts;
    });
  }

  const Bsp_tree<Exact_traits>& tree(const Asking& asking) const {
    return tree_.get([&] {
      Bsp_options options;
      options.threads = asking.threads;
      options.progress = progress_within_budget(asking);
      return build_bsp(traits, options);
    });
  }
  const Piece_boxes& boxes() const {
    return boxes_.get([&] { return Piece_boxes(scene); });
  }
  const Occluders& occluders() const {
    return occluders_.get([&] { return Occluders(scene); });
  }
  const Ray_tracer& tracer() const {
    return tracer_.get([&] { return Ray_tracer(scene); });
  }
  const Facts& facts() const {
    return facts_.get([&] {
      const Scene_counters& c = scene.counters();
      std::vector<bool> supports(scene.planes().size());
      for (const Piece& piece : scene.pieces()) supports[piece.support.id()] = true;
      const auto planes = static_cast<std::size_t>(std::count(supports.begin(), supports.end(), true));
      Facts found{c.points_read, c.points,     c.faces_read, c.faces,      c.pieces, c.concave,
                  c.non_planar,  c.with_holes, planes,       scene.bits(), {},       closure(scene).closed,
                  std::nullopt};
      found.arithmetic = name(scene.predicates().arithmetic());
      if (c.faces > 0) found.box = scene.box();
      return found;
    });
  }

  const Polygon_soup soup;
  const Scene scene;
  const Exact_traits traits;
  std::vector<Left_out> left_out;

 private:
  Once<std::vector<Part>> parts_;
  Once<Bsp_tree<Exact_traits>> tree_;
  Once<Piece_boxes> boxes_;
  Once<Occluders> occluders_;
  Once<Ray_tracer> tracer_;
  Once<Facts> facts_;
};

Model::Model(Polygon_soup soup) : inside_(std::make_shared<const Inside>(std::move(soup))) {}

Model Model::read(const std::filesystem::path& file) { return Model(read_scene(file)); }

Model Model::of_triangles(std::span<const std::array<double, 3>> points,
                          std::span<const std::array<std::uint32_t, 3>> triangles) {
  const std::vector<std::uint32_t> sizes(triangles.size(), 3);
  std::vector<std::uint32_t> corners;
  corners.reserve(3 * triangles.size());
  for (const std::array<std::uint32_t, 3>& triangle : triangles)
    corners.insert(corners.end(), triangle.begin(), triangle.end());
  return of_polygons(points, corners, sizes);
}

Model Model::of_polygons(std::span<const std::array<double, 3>> points, std::span<const std::uint32_t> corners,
                         std::span<const std::uint32_t> sizes) {
  Polygon_soup soup;
  for (const std::array<double, 3>& p : points) {
    if (!std::isfinite(p[0]) || !std::isfinite(p[1]) || !std::isfinite(p[2]))
      throw std::domain_error("point " + std::to_string(soup.point_count()) + " has a coordinate that is no number");
    soup.add_point(p[0], p[1], p[2]);
  }
  for (const std::uint32_t corner : corners) require_index(corner, points.size());
  std::size_t next = 0;
  for (const std::uint32_t size : sizes) {
    if (size > corners.size() - next) throw std::invalid_argument("the sizes of faces are more than the corners");
    soup.add_face(corners.subspan(next, size));
    next += size;
  }
  if (next != corners.size()) throw std::invalid_argument("the sizes of faces are less than the corners");
  return Model(std::move(soup));
}

std::size_t Model::face_count() const { return inside_->soup.face_count(); }
const std::vector<Left_out>& Model::left_out() const { return inside_->left_out; }
const std::vector<Part>& Model::parts() const { return inside_->parts(); }
const Polygon_soup& Model::soup() const { return inside_->soup; }
const Scene& Model::scene() const { return inside_->scene; }
const std::shared_ptr<const Model::Inside>& Model::inside() const { return inside_; }

Facts Model::facts() const { return inside_->facts(); }

double Model::area(Face_id face) const {
  double sum = 0;
  for (const Part& part : parts())
    if (part.face == face) sum += part.area();
  return sum;
}

// ---- An order

Visibility_order order(const Model& model, const Exact_point& eye, const Asking& asking) {
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  const Exact_traits& traits = inside->traits;
  Visibility_order answer;
  answer.eye = eye;
  Order_cuts cuts;
  traverse_with_cuts(traits, inside->tree(asking), traits.eye(eye), &inside->scene, cuts,
                     [&](const Fragment<Exact_traits>& fragment, Sign) {
                       const Piece& piece = inside->scene.pieces()[fragment.polygon.piece];
                       Part& part = answer.parts.emplace_back(Part{piece.face, piece.number, {}});
                       for (const Corner<Exact_traits>& corner : fragment.polygon)
                         part.corners.push_back(traits.position(*corner.vertex));
                     });
  answer.certificate_ = [inside, eye, parts = answer.parts, cuts = std::move(cuts)] {
    Order_certificate certificate;
    certificate.cuts = cuts;
    certificate.eye = eye;
    for (const Part& part : parts) certificate.fragments.push_back({part.face, part.piece, part.corners});
    add_pieces(certificate, inside->scene);
    return certificate_text(certificate);
  };
  return answer;
}

// ---- The priority graph

Priority priority_graph(const Model& model, const Asking& asking) {
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  const auto faces = std::make_shared<const Priority_relation<Exact_traits>>(inside->traits);
  Implicit_priority_graph<Priority_relation<Exact_traits>> graph(*faces);
  Component_trees trees;
  const Priority_components found = graph.find_components(&trees, progress_within_budget(asking));
  Priority answer;
  for (std::size_t c = 0; c < found.size(); ++c) answer.components.emplace_back(found[c].begin(), found[c].end());
  answer.cyclic = found.cyclic();
  answer.certificate_ = [inside, faces, found, trees = std::move(trees)] {
    return certificate_text(graph_certificate(inside->scene, *faces, found, trees));
  };
  return answer;
}

// ---- A tracker

struct Tracker::Inside {
  explicit Inside(std::shared_ptr<const Model::Inside> of)
      : model(std::move(of)),
        graph(model->scene),
        tracker(model->traits, graph),
        nodes_on(model->soup.face_count()),
        faces_of(graph.size()) {
    for (std::uint32_t i = 0; i < model->scene.pieces().size(); ++i) {
      std::vector<Face_id>& faces = faces_of[graph.node(i)];
      const Face_id face = model->scene.pieces()[i].face;
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
  const auto view = field.empty() ? std::make_shared<const Exact_view>(inside->scene, eye)
                                  : std::make_shared<const Exact_view>(inside->scene, eye, field_of(field));
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
    const Piece& piece = inside->scene.pieces()[part.piece];
    Seen::Visible_part& seen = answer.parts.emplace_back();
    seen.face = piece.face;
    seen.piece = piece.number;
    seen.corners = vertices(*view, *surface, part);
    seen.from_front = view->eye_side(part.piece) == CGAL::POSITIVE;
  }
  answer.certificate_ = [inside, view, surface, eye, field] {
    std::ostringstream out;
    write_visible_certificate(out, *view, *surface, eye, field);
    return std::move(out).str();
  };
  answer.lines_ = [inside, view, surface, threads = asking.threads] {
    std::vector<Seen::Line> lines;
    for (Drawn_line& drawn : line_drawing(*view, *surface, inside->boxes(), threads)) {
      Seen::Line& line = lines.emplace_back(Seen::Line{drawn.ends, drawn.kind, std::move(drawn.faces), {}});
      for (const Line_part& part : drawn.parts) {
        Seen::Line::Stretch& stretch = line.stretches.emplace_back(Seen::Line::Stretch{part.from, part.to, {}});
        if (part.hidden_by != Line_part::nothing) stretch.hidden_by = inside->scene.pieces()[part.hidden_by].face;
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

double Seen::area(Face_id face) const {
  double sum = 0;
  for (const Visible_part& part : parts)
    if (part.face == face && part.from_front) sum += part.area();
  return sum;
}

double Seen::solid_angle(Face_id face) const {
  double sum = 0;
  for (const Visible_part& part : parts)
    if (part.face == face && part.from_front) sum += part.solid_angle(eye);
  return sum;
}

// ---- Weak visibility

namespace {

std::vector<Weak_source> weak_sources(const Occluders& occluders,
                                      const std::vector<std::vector<Exact_point>>& sources) {
  std::vector<Weak_source> polygons;
  for (const std::vector<Exact_point>& source : sources) polygons.push_back(weak_source(occluders, source));
  return polygons;
}

/// What was found of faces, with its certificate.
Weak_visibility weak_answer(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                            const Asking& asking, std::shared_ptr<const Weakly_visible> found) {
  Weak_visibility answer;
  answer.visible = found->visible;
  answer.hidden = found->hidden;
  answer.undecided = found->undecided;
  answer.certificate_ = [inside = model.inside(), sources, found, two_sided = asking.two_sided] {
    return certificate_text(weak_certificate(inside->scene, sources, two_sided, *found));
  };
  return answer;
}

/// Faces that are seen from polygons, by lines, and by events where that helps.
Weakly_visible seen_by_lines(const Occluders& occluders, const std::vector<Weak_source>& polygons,
                             const Asking& asking) {
  Weak_options options;
  options.threads = asking.threads;
  options.progress = asking.progress;
  options.search.two_sided = asking.two_sided;
  options.search.out_of_time = end_of_budget(asking);
  Weakly_visible found = weakly_visible(occluders, polygons, options);
  Events_options events;
  events.threads = asking.threads;
  events.progress = asking.progress;
  events.two_sided = asking.two_sided;
  events.out_of_time = options.search.out_of_time;
  settle_by_events(occluders, polygons, usual_event_edges, events, found);
  decide_the_rest(occluders, polygons, options, usual_event_edges, events, found);
  return found;
}

/// A superset of them.
Weakly_visible seen_by_boxes(const Occluders& occluders, const std::vector<Weak_source>& polygons,
                             const Asking& asking) {
  Conservative_options options;
  options.two_sided = asking.two_sided;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  return possibly_visible(occluders, polygons, options);
}

/// What solids, which are given besides polygons, see outwards by `search`, and from within.
Weak_visibility seen_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                 std::vector<std::vector<Exact_point>> sources, const Asking& asking,
                                 Weakly_visible (*search)(const Occluders&, const std::vector<Weak_source>&,
                                                          const Asking&)) {
  const std::function<bool()> out_of_time = end_of_budget(asking);
  const Occluders& occluders = model.inside()->occluders();
  std::list<Weak_volume> volumes;
  for (const Polygon_soup& solid : solids) {
    const std::vector<std::vector<Exact_point>>& surface = volumes.emplace_back(solid).surface();
    sources.insert(sources.end(), surface.begin(), surface.end());
  }
  std::atomic<std::size_t> all = 1;
  Asking told = asking;
  told.progress = [&](std::size_t done, std::size_t of) {
    all = of;
    if (asking.progress) asking.progress(done, of);
  };
  const auto found = std::make_shared<Weakly_visible>(search(occluders, weak_sources(occluders, sources), told));
  for (const Weak_volume& volume : volumes)
    add_seen_from_within(occluders.scene(), volume, asking.two_sided, *found, [&] {
      told.progress(all, all);  // which may end the question
      return out_of_time && out_of_time();
    });
  return weak_answer(model, sources, asking, found);
}

}  // namespace

Weak_visibility weakly_visible(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                               const Asking& asking) {
  return seen_from_solids(model, {}, sources, asking, &seen_by_lines);
}

Weak_visibility weakly_visible(const Model& model, Face_id source, const Asking& asking) {
  return weakly_visible(model, sources_of(model, source), asking);
}

Weak_visibility possibly_visible(const Model& model, const std::vector<std::vector<Exact_point>>& sources,
                                 const Asking& asking) {
  return seen_from_solids(model, {}, sources, asking, &seen_by_boxes);
}

Weak_visibility weakly_visible_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                           const std::vector<std::vector<Exact_point>>& sources, const Asking& asking) {
  return seen_from_solids(model, solids, sources, asking, &seen_by_lines);
}

Weak_visibility possibly_visible_from_solids(const Model& model, const std::vector<Polygon_soup>& solids,
                                             const std::vector<std::vector<Exact_point>>& sources,
                                             const Asking& asking) {
  return seen_from_solids(model, solids, sources, asking, &seen_by_boxes);
}

std::vector<std::vector<Exact_point>> sources_of(const Model& model, Face_id face) {
  std::vector<std::vector<Exact_point>> sources;
  for (const Part& part : model.parts())
    if (part.face == face) sources.push_back(part.corners);
  if (sources.empty())
    throw std::out_of_range("face " + std::to_string(face) + " is not there, or was left out: see left_out()");
  return sources;
}

// ---- Along a path

Seen_along see_along(const Model& model, const Exact_point& from, const Exact_point& to, const Asking& asking) {
  const std::shared_ptr<const Model::Inside> inside = model.inside();
  Along_options options;
  options.two_sided = asking.two_sided;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  Visible_along found = visible_along(inside->occluders(), from, to, options);
  Seen_along answer;
  for (Along_event& event : found.events) {
    Seen_along::Event& told = answer.events.emplace_back(Seen_along::Event{std::move(event.t), {}});
    for (Along_event::Change& change : event.changes)
      told.changes.push_back(
          {change.face, change.before, change.at, change.after, name(change.kind), std::move(change.edges)});
  }
  answer.at_start = std::move(found.at_start);
  answer.at_end = std::move(found.at_end);
  answer.visible = std::move(found.visible);
  options.progress = {};
  options.with_proofs = true;
  answer.certificate_ = [inside, from, to, options] {
    const Visible_along proved = visible_along(inside->occluders(), from, to, options);
    return certificate_text(along_certificate(inside->scene, proved, from, to, options.two_sided));
  };
  return answer;
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

// ---- Solids

namespace {

std::vector<Polygon_soup> soups_of(const std::vector<Model>& models) {
  std::vector<Polygon_soup> soups;
  for (const Model& model : models) soups.push_back(model.soup());
  return soups;
}

}  // namespace

Combined combine(std::string_view operation, const std::vector<Model>& solids, std::string_view inside,
                 const Asking& asking) {
  Set_options options;
  options.progress = progress_within_budget(asking);
  const auto named = [](std::string_view word, auto& chosen, const auto& all) {
    std::string names;
    for (const auto one : all) {
      if (word == name(one)) {
        chosen = one;
        return;
      }
      names += (names.empty() ? "" : ", ") + std::string(name(one));
    }
    throw std::invalid_argument('"' + std::string(word) + "\" is none of " + names);
  };
  using enum Set_operation;
  using enum Inside_rule;
  named(operation, options.operation, std::array{unite, intersect, subtract, differ});
  named(inside, options.inside, std::array{positive, nonzero, odd});
  const std::vector<Polygon_soup> soups = soups_of(solids);
  const Operands operands(soups);
  if (options.progress) options.progress(0, 1);
  if (const std::vector<Operand_flaw> wrong = flaws(operands); !wrong.empty())
    throw std::invalid_argument(
        "solid " + std::to_string(wrong[0].operand) + " bounds no solid: face " + std::to_string(wrong[0].face) +
        (wrong[0].why.empty() ? " has an edge without an opposite; close its surface" : " is " + wrong[0].why));
  Set_result result;
  run_with_threads(asking.threads, [&] { result = set_operation(operands, options); });
  const Rational volume = sightline::volume(result.soup);
  std::vector<std::pair<std::uint32_t, Face_id>> sources;
  for (const Result_face& face : result.faces) sources.emplace_back(face.operand, face.face);
  result.soup.file = std::string(operation);
  options.progress = {};
  options.keep_fragments = true;
  const auto certificate = [solids, options, threads = asking.threads] {
    const Operands again(soups_of(solids));
    std::ostringstream out;
    run_with_threads(threads, [&] {
      write_solid_certificate(out, solid_certificate(again, options, set_operation(again, options)));
    });
    return std::move(out).str();
  };
  return {{certificate}, Model(std::move(result.soup)), std::move(sources), volume};
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

Checked verify(const std::vector<Model>& solids, const Model& result, const std::string& certificate,
               const Asking& asking) {
  const Solid_certificate claim = read_solid_certificate(certificate);
  Verify_options options;
  options.threads = asking.threads;
  options.progress = progress_within_budget(asking);
  const Verdict verdict = verify_solids(soups_of(solids), claim, &result.soup(), options);
  return {verdict.accepted, verdict.why};
}

}  // namespace sightline
