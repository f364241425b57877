#include <sightline/kernel/scene/face_graph.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/plane_table.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/scene/face_mesh.h>
#include <sightline/kernel/union_find.h>
#include <sightline/kernel/vertex.h>

#include <OpenMesh/Core/System/omstream.hh>

#include <algorithm>
#include <array>
#include <mutex>
#include <utility>

namespace sightline {

struct Face_graph::Builder {
  explicit Builder(Face_graph& graph) : graph_(graph), scene_(graph.scene_) {}

  using Face = Face_mesh::FaceHandle;
  /// An input point by itself: the scene's incidences tell which faces' planes it is on.
  static Vertex vertex(const Predicates& predicates, std::uint32_t point) {
    return predicates.input_vertex(point, Vertex::no_plane, Vertex::no_plane, Vertex::no_plane);
  }
  std::uint32_t point_of(Face_mesh::VertexHandle v) const { return point_of_vertex_[index(v)]; }
  static std::uint32_t index(const auto& handle) { return static_cast<std::uint32_t>(handle.idx()); }

  void build_mesh();

  /// Calls f(half, piece, neighbour) for each edge that two pieces share.
  template <class Function>
  void for_each_shared_edge(Function f) const;

  void find_nodes();

  /// A point's place on the Z-order curve of the scene's cube: 21 bits of each coordinate in turn.
  std::uint64_t place_on_curve(std::uint32_t point) const;

  void find_edges();

  void find_components();

  // ---- Convex bodies: closed, bent outwards at each edge, all faces seen from behind by a point, and a ray from there
  // that meets one piece only. P-50

  std::optional<Exact_point> point_inside(const std::vector<std::uint32_t>& pieces) const;

  struct Ray {
    Exact_point from, direction;
    std::array<double, 3> start, along;  // grid's approximate coordinates
    double size, error;                  // of arms and of their error
  };
  Ray ray_from(const Exact_point& from, const Exact_point& through) const;
  /// Whether a ray meets a piece that it starts behind: the closed cone of its corners holds the direction.
  bool meets(const Ray& ray, const Piece& piece) const;
  int exact_side(const Ray& ray, std::uint32_t p, std::uint32_t q) const;

  Face_graph& graph_;
  const Scene* scene_;
  Face_mesh mesh_;
  std::vector<std::uint32_t>& point_of_vertex_ = graph_.point_of_vertex_;
  std::vector<std::uint32_t>& node_ = graph_.node_;
  std::vector<std::uint32_t>& piece_ = graph_.piece_;
  std::vector<std::uint32_t>& component_ = graph_.component_;
  std::vector<Edge>& edges_ = graph_.edges_;
  std::vector<std::size_t>& begin_ = graph_.begin_;
  std::vector<std::uint32_t>& incident_ = graph_.incident_;
  std::vector<Component>& components_ = graph_.components_;
};

Face_graph::Face_graph(const Scene& scene) : scene_(&scene) {
  Builder builder(*this);
  builder.build_mesh();
  builder.find_nodes();
  builder.find_edges();
  builder.find_components();
  mesh_ = std::make_shared<const Face_mesh>(std::move(builder.mesh_));
}

void Face_graph::Builder::build_mesh() {
  // OpenMesh complains of what it refuses, on a stream that all threads have.
  struct Silence {
    static std::mutex& one_at_a_time() {
      static std::mutex mutex;
      return mutex;
    }
    const std::scoped_lock<std::mutex> lock{one_at_a_time()};
    const bool was_enabled = omerr().is_enabled();
    Silence() { omerr().disable(); }
    ~Silence() {
      if (was_enabled) omerr().enable();
    }
    Silence(const Silence&) = delete;
  } const silence;
  const Grid_points& points = scene_->points();
  const auto add_vertex = [&](std::uint32_t p) {
    point_of_vertex_.push_back(p);
    return mesh_.add_vertex({points.approximate(p, 0), points.approximate(p, 1), points.approximate(p, 2)});
  };
  mesh_.reserve(points.size(), points.size() + scene_->pieces().size(), scene_->pieces().size());
  for (std::uint32_t p = 0; p < points.size(); ++p) add_vertex(p);
  std::vector<Face_mesh::VertexHandle> loop;
  for (const Piece& piece : scene_->pieces()) {
    loop.clear();
    for (const Piece_corner& corner : scene_->corners(piece)) loop.emplace_back(static_cast<int>(corner.point));
    if (mesh_.add_face(loop).is_valid()) continue;
    ++graph_.refused_;
    for (Face_mesh::VertexHandle& v : loop) v = add_vertex(point_of(v));
    mesh_.add_face(loop);
  }
}

template <class Function>
void Face_graph::Builder::for_each_shared_edge(Function f) const {
  for (const auto edge : mesh_.edges()) {
    const auto half = mesh_.halfedge_handle(edge, 0);
    const Face one = mesh_.face_handle(half), other = mesh_.opposite_face_handle(half);
    if (one.is_valid() && other.is_valid()) f(half, index(one), index(other));
  }
}

void Face_graph::Builder::find_nodes() {
  Union_find sets(scene_->pieces().size());
  for_each_shared_edge([&](auto, std::uint32_t i, std::uint32_t j) {
    if (scene_->pieces()[i].support == scene_->pieces()[j].support) sets.join(i, j);
  });
  node_ = sets.numbers(piece_);
  // Renumbered along a curve through space, so that what is near is near in memory.
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order;
  for (std::uint32_t i = 0; i < graph_.size(); ++i)
    order.emplace_back(place_on_curve(scene_->corners(scene_->pieces()[piece_[i]]).front().point), piece_[i]);
  std::sort(order.begin(), order.end());
  std::vector<std::uint32_t> number(graph_.size());
  for (std::uint32_t i = 0; i < graph_.size(); ++i) {
    number[node_[order[i].second]] = i;
    piece_[i] = order[i].second;
  }
  for (std::uint32_t& node : node_) node = number[node];
}

std::uint64_t Face_graph::Builder::place_on_curve(std::uint32_t point) const {
  std::uint64_t place = 0;
  const double range = scene_->points().range();
  if (range == 0) return 0;  // all of the scene is below the least double
  for (int axis = 0; axis < 3; ++axis) {
    const auto bits = static_cast<std::uint64_t>((scene_->points().approximate(point, axis) / range + 1) * 0x1p20);
    for (int k = 0; k < 21; ++k) place |= (bits >> k & 1) << (3 * k + axis);
  }
  return place;
}

void Face_graph::Builder::find_edges() {
  begin_.assign(graph_.size() + 1, 0);
  for_each_shared_edge([&](auto half, std::uint32_t i, std::uint32_t j) {
    if (node_[i] == node_[j]) return;
    edges_.push_back(
        {node_[i], node_[j], point_of(mesh_.from_vertex_handle(half)), point_of(mesh_.to_vertex_handle(half))});
    ++begin_[node_[i] + 1];
    ++begin_[node_[j] + 1];
  });
  const auto ends = [](const Edge& edge) { return std::minmax(edge.first, edge.second); };
  std::stable_sort(edges_.begin(), edges_.end(), [&](const Edge& e, const Edge& f) { return ends(e) < ends(f); });
  std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
  std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
  incident_.resize(2 * edges_.size());
  for (std::uint32_t e = 0; e < edges_.size(); ++e) {
    incident_[next[edges_[e].first]++] = e;
    incident_[next[edges_[e].second]++] = e;
  }
}

void Face_graph::Builder::find_components() {
  Union_find sets(graph_.size());
  for (const Edge& edge : edges_) sets.join(edge.first, edge.second);
  std::vector<std::uint32_t> first;
  component_ = sets.numbers(first);
  for (const std::uint32_t node : first) components_.push_back({node, 0, 0, true, std::nullopt});
  for (const std::uint32_t c : component_) ++components_[c].nodes;

  std::vector<std::vector<std::uint32_t>> pieces(components_.size());
  for (std::uint32_t i = 0; i < node_.size(); ++i) pieces[component_[node_[i]]].push_back(i);
  for (const auto half : mesh_.halfedges())
    if (const Face on = mesh_.face_handle(half); on.is_valid() && !mesh_.opposite_face_handle(half).is_valid())
      components_[component_[node_[index(on)]]].closed = false;
  std::vector<bool> bent_outwards(components_.size(), true);
  Predicate_counts counts;
  const Predicates predicates = scene_->predicates();
  for_each_shared_edge([&](auto half, std::uint32_t i, std::uint32_t j) {
    if (node_[i] == node_[j] || !bent_outwards[component_[node_[i]]]) return;
    const Prepared_plane plane = predicates.prepare(scene_->pieces()[i].support);
    // All corners of the other piece that are not on the edge are on one side, as the planes' line is the edge's.
    const auto next = mesh_.next_halfedge_handle(mesh_.opposite_halfedge_handle(half));
    const std::uint32_t corner = point_of(mesh_.to_vertex_handle(next));
    if (predicates.side(vertex(predicates, corner), plane, counts) == CGAL::POSITIVE)
      bent_outwards[component_[node_[i]]] = false;
  });
  for (std::size_t c = 0; c < components_.size(); ++c) {
    components_[c].pieces = static_cast<std::uint32_t>(pieces[c].size());
    if (components_[c].closed && bent_outwards[c]) components_[c].inside = point_inside(pieces[c]);
  }
}

std::optional<Exact_point> Face_graph::Builder::point_inside(const std::vector<std::uint32_t>& pieces) const {
  const Predicates predicates = scene_->predicates();
  Predicate_counts counts;
  const Piece& base = scene_->pieces()[pieces.front()];
  // Between three corners of a piece and the corner farthest behind it.
  const Prepared_plane below = predicates.prepare(base.support);
  std::uint32_t far = Vertex::no_point;
  double depth = 0;
  for (const std::uint32_t i : pieces)
    for (const Piece_corner& corner : scene_->corners(scene_->pieces()[i])) {
      const Vertex v = vertex(predicates, corner.point);
      const double height = below.a * v.x + below.b * v.y + below.c * v.z + below.d;
      if (far == Vertex::no_point || height < depth) {
        far = corner.point;
        depth = height;
      }
    }
  // Where doubles do not tell, any corner that is behind it.
  const auto is_behind = [&](std::uint32_t p) {
    return predicates.side(vertex(predicates, p), below, counts) == CGAL::NEGATIVE;
  };
  if (!is_behind(far))
    for (const std::uint32_t i : pieces)
      for (const Piece_corner& corner : scene_->corners(scene_->pieces()[i]))
        if (is_behind(corner.point)) far = corner.point;
  Exact_point inside = scene_->position(far), middle{};  // middle: of three corners of the base, inside it
  for (std::size_t k = 0; k < 3; ++k) {
    const Exact_point corner = scene_->position(scene_->corners(base)[k].point);
    for (std::size_t axis = 0; axis < 3; ++axis) {
      inside[axis] += corner[axis];
      middle[axis] += corner[axis] / 3;
    }
  }
  for (Rational& x : inside) x /= 4;
  const Located_point at = scene_->locate(inside);
  for (const std::uint32_t i : pieces)
    if (predicates.side(at, scene_->pieces()[i].support, counts) != CGAL::NEGATIVE) return std::nullopt;
  const Ray ray = ray_from(inside, middle);
  for (const std::uint32_t i : pieces)
    if (i != pieces.front() && meets(ray, scene_->pieces()[i])) return std::nullopt;
  return inside;
}

Face_graph::Builder::Ray Face_graph::Builder::ray_from(const Exact_point& from, const Exact_point& through) const {
  const Located_point p = scene_->locate(from), q = scene_->locate(through);
  Ray ray{from, {}, {p.ax, p.ay, p.az}, {q.ax - p.ax, q.ay - p.ay, q.az - p.az}, 4 * scene_->points().range(), 0};
  for (std::size_t k = 0; k < 3; ++k) ray.direction[k] = through[k] - from[k];
  ray.error = 0x1p-50 * ray.size + 2 * (p.error + q.error) + 0x1p-1000;
  return ray;
}

bool Face_graph::Builder::meets(const Ray& ray, const Piece& piece) const {
  const Grid_points& points = scene_->points();
  const std::span<const Piece_corner> corners = scene_->corners(piece);
  // A determinant of three vectors below `size`, each off by `error`: off by less than 18 size^2 error and 2^-49 of 6
  // size^3, which 2^-50 size <= error covers. Below 2^-1000 products may underflow; 2^50 error >= size makes the bound
  // infinite where a value may be. P-04b
  const double bound = 64 * ray.size * ray.size * (0x1p50 * ray.error) * 0x1p-50 + 0x1p-1000;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const std::uint32_t p = corners[k].point, q = corners[k + 1 == corners.size() ? 0 : k + 1].point;
    std::array<double, 3> a, b;
    for (int axis = 0; axis < 3; ++axis) {
      const std::size_t at = static_cast<std::size_t>(axis);
      a[at] = points.approximate(p, axis) - ray.start[at];
      b[at] = points.approximate(q, axis) - ray.start[at];
    }
    const double value = ray.along[0] * (a[1] * b[2] - a[2] * b[1]) + ray.along[1] * (a[2] * b[0] - a[0] * b[2]) +
                         ray.along[2] * (a[0] * b[1] - a[1] * b[0]);
    if (value > bound) continue;
    if (value < -bound || exact_side(ray, p, q) < 0) return false;
  }
  return true;
}

int Face_graph::Builder::exact_side(const Ray& ray, std::uint32_t p, std::uint32_t q) const {
  Exact_point a = scene_->position(p), b = scene_->position(q);
  for (std::size_t k = 0; k < 3; ++k) {
    a[k] -= ray.from[k];
    b[k] -= ray.from[k];
  }
  return sgn(Rational(ray.direction[0] * (a[1] * b[2] - a[2] * b[1]) + ray.direction[1] * (a[2] * b[0] - a[0] * b[2]) +
                      ray.direction[2] * (a[0] * b[1] - a[1] * b[0])));
}

}  // namespace sightline
