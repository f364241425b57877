#include <sightline/algorithms/weak_visibility/along/along_scene.h>

#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <utility>

namespace sightline {

double squared_size(std::span<const Near_point> corners) {
  Triple sum{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
    const Triple part = cross(minus(corners[i].near, corners[0].near), minus(corners[i + 1].near, corners[0].near));
    for (std::size_t k = 0; k < 3; ++k) sum[k] += part[k];
  }
  return dot(sum, sum);
}

Along_scene::Along_scene(const Occluders& occluders, const Exact_point& from, const Exact_point& to,
                         std::function<void()> ask)
    : occluders_(&occluders), ask_(std::move(ask)), eye_(occluders.scene(), occluders.frame(), from, to) {
  const auto count = static_cast<std::uint32_t>(occluders.scene().pieces().size());
  for (std::uint32_t piece = 0; piece < count; ++piece) {
    ask_();
    Eye_polygon& polygon = polygons_.emplace_back();
    polygon.piece = piece;
    polygon.eye_side = eye_.side(occluders.plane(piece).exact);
    if (polygon.eye_side.is_zero()) continue;
    polygon.corners = occluders.polygon(piece);
    polygon.size = squared_size(polygon.corners);
    for (std::uint32_t i = 0; i < polygon.corners.size(); ++i) {
      Exact_pluecker line = join(polygon.corners[i].exact, polygon.corners[(i + 1) % polygon.corners.size()].exact);
      const int sense = make_canonical(line);
      const auto [at, is_new] = numbers_.try_emplace(line, static_cast<std::uint32_t>(lines_.size()));
      if (is_new) {
        lines_.push_back(eye_line(eye_, occluders.frame(), line));
        edges_.emplace_back();
      }
      edges_[at->second].push_back({piece, i});
      polygon.edges.push_back({at->second, sense});
    }
    if (sgn(polygon.eye_side.c[1]) == 0) continue;
    Rational t(Integer(-polygon.eye_side.c[0]), polygon.eye_side.c[1]);
    t.canonicalize();
    if (t >= 0 && t <= 1 && is_on(polygon, eye_.at(t))) contacts_.push_back(t);
  }
  stops_ = contacts_;
  stops_.insert(stops_.end(), {Rational(0), Rational(1)});
  for (std::vector<Rational>* moments : {&contacts_, &stops_}) {
    std::sort(moments->begin(), moments->end());
    moments->erase(std::unique(moments->begin(), moments->end()), moments->end());
  }
}

bool Along_scene::is_on(const Eye_polygon& polygon, const Homogeneous& eye) const {
  // A point in front of the plane sees the point through the inside of all edges, or along them.
  const std::array<Integer, 4>& h = occluders_->plane(polygon.piece).exact;
  for (const Line_side& edge : polygon.edges) {
    const Homogeneous plane = join(eye, lines_[edge.line].line);
    if (edge.sign * sgn(Integer(plane[0] * h[0] + plane[1] * h[1] + plane[2] * h[2])) < 0) return false;
  }
  return true;
}

}  // namespace sightline
