#include <sightline/harness/laws/see_lines.h>

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/crossings.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/hidden_lines.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/point_visibility/visible_region.h>
#include <sightline/harness/generate/polygons.h>
#include <sightline/harness/laws/line_flats.h>
#include <sightline/harness/laws/line_scenes.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <stdexcept>
#include <tuple>
#include <utility>

namespace sightline::harness {
namespace {

using namespace line_flats;
using generate::Points;

// ---- What the method says

struct Looked {
  Scene scene;
  Piece_boxes boxes;
  Exact_view view;
  Visible_surface<Exact_view> surface;

  explicit Looked(const Posed_scene& posed, const std::vector<Exact_point>& field = {})
      : scene(posed.soup),
        boxes(scene),
        view(scene, posed.eye, field.empty() ? std::vector<std::array<Integer, 3>>() : field_of(field)),
        surface(visible_surface(view, boxes, field.empty() ? whole_sphere(view) : field_of_view(view), serial())) {}

  std::vector<Drawn_edge> edges() const { return hidden_lines(view, surface, 1); }
  std::vector<Drawn_crossing> crossings() const { return visible_crossings(view, surface, boxes, 1); }

  static Visible_options serial() {
    Visible_options options;
    options.threads = 1;
    return options;
  }
};

std::string name_of(const Scene& scene, const Drawn_edge& drawn) {
  return "an edge of face " + std::to_string(scene.pieces()[drawn.edge.pieces[0]].face);
}

/// The visible parts of an edge within a range, neighbours joined.
std::vector<Interval> visible_in(const std::vector<Line_part>& parts, const Interval& range) {
  std::vector<Interval> found;
  for (const Line_part& part : parts) {
    const Rational from = std::max(part.from, range.first), to = std::min(part.to, range.second);
    if (part.hidden_by != Line_part::nothing || from >= to) continue;
    if (!found.empty() && found.back().second == from) found.back().second = to;
    else found.push_back({from, to});
  }
  return found;
}

// ---- Checks

/// A point of a part that is none of those few where lines touch a corner in the view.
Exact_point point_inside(const Exact_point& p, const Rational& from, const Rational& to, const Exact_point& q,
                         Random& random) {
  const Rational share(static_cast<long>(random.between(1, 99990)), 99991);
  return between(p, Rational(from + share * (to - from)), q);
}

/// Whether a point of an edge's line is on the edge: between its ends, or one of them.
bool is_on_edge(const Exact_point& p, const Exact_point& q, const Exact_point& x) {
  return is_zero(cross(minus(x, p), minus(q, p))) && dot(minus(x, p), minus(x, q)) <= 0;
}

/// That a point of each piece's side is on one edge that the piece bounds where the face ends there, else on none; and
/// that edges are in order, and bound nothing but sides.
std::string flaw_of_bounds(const Scene& scene, const Flat_pieces& flats, const std::vector<Drawn_edge>& edges,
                           Random& random) {
  std::vector<std::vector<const Scene_edge*>> of_piece(flats.size());
  for (std::size_t k = 0; k < edges.size(); ++k) {
    const Scene_edge& edge = edges[k].edge;
    if (edge.p >= edge.q || (k > 0 && std::pair(edges[k - 1].edge.p, edges[k - 1].edge.q) >= std::pair(edge.p, edge.q)))
      return "edges are not in the order of their points, once each";
    for (const std::uint32_t piece : edge.pieces) {
      const Points& c = flats[piece].corners;
      std::size_t sides = 0;
      for (std::size_t i = 0; i < c.size(); ++i)
        sides += is_on_edge(c[i], c[(i + 1) % c.size()], scene.position(edge.p)) &&
                 is_on_edge(c[i], c[(i + 1) % c.size()], scene.position(edge.q));
      if (sides != 1) return name_of(scene, edges[k]) + " is on " + std::to_string(sides) + " sides of a piece";
      of_piece[piece].push_back(&edge);
    }
  }
  std::map<Face_id, std::size_t> planes_of;
  for (std::size_t i = 0; i < flats.size(); ++i)
    planes_of[flats[i].face] += i == 0 || flats[i - 1].face != flats[i].face || !flats[i].is_in_plane_of(flats[i - 1]);
  for (std::size_t i = 0; i < flats.size(); ++i)
    for (std::size_t k = 0; k < flats[i].corners.size(); ++k) {
      const Exact_point &p = flats[i].corners[k], &q = flats[i].corners[(k + 1) % flats[i].corners.size()],
                        x = point_inside(p, 0, 1, q, random);
      // In a face of one plane by the point; surfaces of several may touch themselves: there by the side's ends.
      const auto goes_on = [&](std::size_t other) {
        if (other == i || flats[other].face != flats[i].face || flats[other].plane.height(x) != 0) return false;
        const auto has = [&](const Exact_point& corner) {
          return std::find(flats[other].corners.begin(), flats[other].corners.end(), corner) !=
                 flats[other].corners.end();
        };
        if (planes_of[flats[i].face] > 1) return has(p) && has(q);
        return is_within_walls(flats[other], x);
      };
      std::size_t inside = 0, listed = 0;
      for (std::size_t other = 0; other < flats.size(); ++other) inside += goes_on(other);
      for (const Scene_edge* edge : of_piece[i])
        listed += is_on_edge(scene.position(edge->p), scene.position(edge->q), x);
      const bool ends = planes_of[flats[i].face] > 1 ? inside != 1 : inside == 0;  // three may meet in one line
      if (listed != (ends ? 1u : 0u))
        return "of face " + std::to_string(flats[i].face) +
               (ends ? " an edge is not listed, or twice" : " an edge is listed that runs inside it");
    }
  return {};
}

/// That the parts of each edge go from its one end to the other, unless the eye is on its line.
std::string flaw_of_parts(const Scene& scene, const std::vector<Drawn_edge>& edges, const Exact_point& eye) {
  for (const Drawn_edge& drawn : edges) {
    const Exact_point p = scene.position(drawn.edge.p), q = scene.position(drawn.edge.q);
    if (is_zero(cross(minus(p, eye), minus(q, eye)))) {
      if (!drawn.parts.empty()) return name_of(scene, drawn) + " has parts, and the eye is on its line";
      continue;
    }
    Rational end = 0;
    for (const Line_part& part : drawn.parts) {
      if (part.from != end || part.to <= end) return name_of(scene, drawn) + " has a gap, or parts that overlap";
      end = part.to;
    }
    if (end != 1) return name_of(scene, drawn) + " has no parts up to its end";
  }
  return {};
}

/// That edges are of the kind that the pieces make them that they bound.
std::string flaw_of_kinds(const Scene& scene, const Flat_pieces& flats, const std::vector<Drawn_edge>& edges,
                          const Exact_point& eye) {
  for (const Drawn_edge& drawn : edges) {
    const std::vector<std::uint32_t>& pieces = drawn.edge.pieces;
    const auto in_front = static_cast<std::size_t>(std::count_if(
        pieces.begin(), pieces.end(), [&](std::uint32_t piece) { return flats[piece].plane.height(eye) > 0; }));
    Edge_class kind = Edge_class::crease;
    if (pieces.size() == 1) kind = Edge_class::boundary;
    else if (in_front > 0 && in_front < pieces.size()) kind = Edge_class::silhouette;
    else if (pieces.size() == 2 && flats[pieces[0]].is_in_plane_of(flats[pieces[1]])) kind = Edge_class::smooth;
    if (drawn.kind != kind) return name_of(scene, drawn) + " is said to be of another kind";
  }
  return {};
}

Outcome check_edges(const Looked& looked, const Flat_pieces& flats, const Exact_point& eye, Random& random) {
  const std::vector<Drawn_edge> edges = looked.edges();
  for (const std::string& flaw :
       {flaw_of_bounds(looked.scene, flats, edges, random), flaw_of_parts(looked.scene, edges, eye),
        flaw_of_kinds(looked.scene, flats, edges, eye)})
    if (!flaw.empty()) return Outcome::failed(flaw);
  for (const Drawn_edge& drawn : edges) {
    const Exact_point p = looked.scene.position(drawn.edge.p), q = looked.scene.position(drawn.edge.q);
    for (const Line_part& part : drawn.parts) {
      const Exact_point x = point_inside(p, part.from, part.to, q, random);
      if (part.hidden_by == Line_part::nothing ? !is_sightline(flats, eye, x) : !blocks(flats[part.hidden_by], eye, x))
        return Outcome::failed(name_of(looked.scene, drawn) + (part.hidden_by == Line_part::nothing
                                                                   ? " is hidden where it is listed as visible"
                                                                   : " is not behind what is listed as hiding it"));
    }
  }
  return {};
}

Outcome check_crossings(const Looked& looked, const Flat_pieces& flats, const Exact_point& eye, Random& random) {
  const std::vector<Drawn_crossing> drawn = looked.crossings();
  for (const Drawn_crossing& c : drawn) {
    const Exact_point x = point_inside(c.ends[0], 0, 1, c.ends[1], random);
    const std::set<Face_id> faces = crossing_at(flats, x, minus(c.ends[1], c.ends[0]));
    if (!std::equal(faces.begin(), faces.end(), c.faces.begin(), c.faces.end()))
      return Outcome::failed("a line is listed where its faces do not cross, " + face_name(c.faces[0]) +
                             " one of them");
    if (!is_sightline(flats, eye, x))
      return Outcome::failed("a line of crossing is hidden, on " + face_name(c.faces[0]));
  }
  // A point of each pair's line, if it is visible, is on one that is listed.
  for (std::size_t f = 0; f < flats.size(); ++f)
    for (std::size_t g = 0; g < f; ++g) {
      const auto common = common_segment(flats[f], flats[g]);
      if (!common) continue;
      const Exact_point d = minus((*common)[1], (*common)[0]),
                        x = point_inside((*common)[0], 0, 1, (*common)[1], random);
      const std::set<Face_id> faces = crossing_at(flats, x, d);
      if (faces.empty() || is_zero(cross(d, minus(x, eye))) || !is_sightline(flats, eye, x)) continue;
      const auto holds = [&](const Drawn_crossing& c) {
        if (!is_zero(cross(minus(x, c.ends[0]), d)) || !is_zero(cross(minus(x, c.ends[1]), d))) return false;
        return dot(minus(x, c.ends[0]), minus(x, c.ends[1])) <= 0;
      };
      if (std::none_of(drawn.begin(), drawn.end(), holds))
        return Outcome::failed("faces cross unlisted: " + std::to_string(flats[f].face) + " and " +
                               std::to_string(flats[g].face));
    }
  return {};
}

/// That lines on some pieces are all lines, as far as they are on these.
Outcome check_crossings_on(const Looked& looked, const Flat_pieces& flats, Random& random) {
  std::vector<bool> some(flats.size());
  const std::uint64_t share = 4 * (1 + random.below(2) * some.size() / 8);  // a quarter, or hardly two
  for (std::size_t i = 0; i < some.size(); ++i) some[i] = random.chance(1, share);
  const std::vector<Crossing> all = sightline::crossings(looked.scene, looked.boxes),
                              on_some = crossings_on(some, looked.scene, looked.boxes);
  struct Segment {
    std::array<Exact_point, 2> ends;
    bool holds(const Exact_point& x) const { return is_on_edge(ends[0], ends[1], x); }
  };
  const auto segment = [&](const Crossing& c) {
    return Segment{{looked.scene.position(c.ends[0].at), looked.scene.position(c.ends[1].at)}};
  };
  const auto is_on_some = [&](const Exact_point& x) {
    for (std::size_t i = 0; i < flats.size(); ++i)
      if (some[i] && flats[i].plane.height(x) == 0 && is_within_walls(flats[i], x)) return true;
    return false;
  };
  for (const auto* lists : {&all, &on_some})
    for (const Crossing& c : *lists) {
      const Segment own = segment(c);
      const Exact_point x = point_inside(own.ends[0], 0, 1, own.ends[1], random);
      const bool on = is_on_some(x);
      if (lists == &all && !on) continue;
      const auto is_there = [&](const Crossing& other) {
        if (!segment(other).holds(x)) return false;
        if (on) return other.faces == c.faces;
        return std::includes(other.faces.begin(), other.faces.end(), c.faces.begin(), c.faces.end());
      };
      const std::vector<Crossing>& others = lists == &all ? on_some : all;
      if (std::none_of(others.begin(), others.end(), is_there))
        return Outcome::failed("lines where faces cross are not on some pieces what they are on all, on " +
                               face_name(c.faces[0]));
    }
  return {};
}

/// A scene that nobody was told of, in one line.
std::string text_of_scene(const Posed_scene& posed) {
  const auto text = [](const Exact_point& p) {
    return '(' + sightline::to_string(p[0]) + ',' + sightline::to_string(p[1]) + ',' + sightline::to_string(p[2]) + ')';
  };
  std::string all = "eye " + text(posed.eye);
  for (Face_id face = 0; face < posed.soup.face_count(); ++face) {
    all += ", " + face_name(face);
    for (const Point_id p : posed.soup.loop(face)) all += ' ' + text(posed.soup.point(p));
  }
  return all;
}

Outcome check_lines(const Posed_scene& posed, Random& random) {
  const Looked looked(posed);
  const Flat_pieces flats = flat_pieces(looked.scene);
  const Outcome edges = check_edges(looked, flats, posed.eye, random);
  if (edges.state == Outcome::State::failed) return edges;
  const Outcome crossed = check_crossings(looked, flats, posed.eye, random);
  return crossed.state == Outcome::State::failed ? crossed : check_crossings_on(looked, flats, random);
}

/// The rays of a field around the eye: upright along an axis, or through three points of the scene.
std::vector<Exact_point> any_field(const Posed_scene& posed, Random& random) {
  std::vector<Exact_point> rays;
  const std::size_t n = posed.soup.point_count();
  if (n > 0 && random.chance(1, 2)) {
    for (int k = 0; k < 3; ++k)
      rays.push_back(minus(posed.soup.point(static_cast<Point_id>(random.below(n))), posed.eye));
  } else {
    const std::size_t axis = random.below(3);
    const long sense = random.chance(1, 2) ? 1 : -1, wide = static_cast<long>(random.between(1, 2)),
               high = static_cast<long>(random.between(1, 2));
    for (const auto& [across, up] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
      Exact_point& ray = rays.emplace_back(Exact_point{0, 0, 0});
      ray[axis] = sense;
      ray[(axis + 1) % 3] = across * wide;
      ray[(axis + 2) % 3] = up * high;
    }
  }
  if (dot(cross(rays[0], rays[1]), rays[2]) < 0) std::reverse(rays.begin(), rays.end());
  return rays;
}

using Segments = std::set<std::tuple<Exact_point, Exact_point, std::vector<Face_id>>>;

/// Segments within a field, each from its lower end.
Segments within(const std::vector<Drawn_crossing>& drawn, const std::vector<Level>& field) {
  Segments found;
  for (const Drawn_crossing& c : drawn)
    if (const auto range = clipped(field, c.ends[0], c.ends[1], {0, 1})) {
      const Exact_point p = between(c.ends[0], range->first, c.ends[1]),
                        q = between(c.ends[0], range->second, c.ends[1]);
      found.insert({std::min(p, q), std::max(p, q), c.faces});
    }
  return found;
}

/// A cone cut by planes through the eye and edges of the scene, or along an axis.
Cones<Exact_view> cut_apart(const Exact_view& view, Cones<Exact_view> cones, Random& random) {
  Predicate_counts counts;
  for (std::uint64_t cuts = 1 + random.below(3); cuts > 0; --cuts) {
    const std::size_t points = view.scene().points().size();
    const auto p = static_cast<std::uint32_t>(random.below(points)),
               q = static_cast<std::uint32_t>(random.below(points)), axis = static_cast<std::uint32_t>(random.below(3));
    const bool by_axis = p == q || random.chance(1, 4);
    const Exact_view::Plane w = by_axis ? view.axis(axis) : view.edge(p, q);
    Cones<Exact_view> parts;
    for (const auto& cone : cones) {
      const auto reaches = [&](Sign side) {
        return std::any_of(cone.rays.begin(), cone.rays.end(),
                           [&](const Exact_view::Ray& r) { return view.side(w, r, counts) == side; });
      };
      if (!reaches(CGAL::POSITIVE) || !reaches(CGAL::NEGATIVE)) parts.push_back(cone);
      else
        for (const auto& part : visible_detail::cut(view, cone, w, counts)) parts.push_back(part);
    }
    cones = std::move(parts);
  }
  return cones;
}

/// A half-space whose border holds an eye.
Level beyond_eye(const std::array<Integer, 3>& n, const Exact_point& eye) {
  const Exact_point normal{Rational(n[0]), Rational(n[1]), Rational(n[2])};
  return {normal, dot(normal, eye)};
}

/// That what is visible of lines in a surface's cones, which have these sides, is what is visible without them.
/// `where`: how messages call these.
Outcome same_within(const Looked& whole, const Looked& part, const Visible_surface<Exact_view>& surface,
                    const std::vector<Level>& sides, const std::string& where) {
  const std::vector<Drawn_edge> all = whole.edges(), some = hidden_lines(part.view, surface, 1);
  for (std::size_t k = 0; k < all.size(); ++k) {
    const Exact_point p = whole.scene.position(all[k].edge.p), q = whole.scene.position(all[k].edge.q);
    const std::optional<Interval> range = clipped(sides, p, q, {0, 1});
    if ((range ? visible_in(all[k].parts, *range) : std::vector<Interval>()) != visible_in(some[k].parts, {0, 1}))
      return Outcome::failed(name_of(whole.scene, all[k]) + " is not visible in " + where + " as it is without");
  }
  if (within(whole.crossings(), sides) != within(visible_crossings(part.view, surface, part.boxes, 1), sides))
    return Outcome::failed("lines where faces cross are not those in " + where + " as without");
  return {};
}

/// A view's field in parts of any shape, all of them or one.
Outcome check_parts_of_field(const Looked& whole, const Looked& part, std::vector<Level> sides, Random& random) {
  if (whole.scene.pieces().empty()) return {};
  Cones<Exact_view> cones = cut_apart(part.view, field_of_view(part.view), random);
  if (random.chance(1, 2)) {
    cones = {cones[random.below(cones.size())]};
    sides.clear();
    for (const Exact_view::Plane& w : cones[0].sides) sides.push_back(beyond_eye(part.view.normal(w), part.view.eye()));
  }
  return same_within(whole, part, visible_surface(part.view, part.boxes, std::move(cones), Looked::serial()), sides,
                     "parts of the field");
}

Outcome check_field(const Posed_scene& posed, Random& random) {
  std::vector<Exact_point> rays = any_field(posed, random);
  if (random.chance(1, 16)) std::reverse(rays.begin(), rays.end());
  const bool spans = dot(cross(rays[0], rays[1]), rays[2]) > 0;  // of a pyramid, too
  std::vector<Level> field;
  try {
    for (const std::array<Integer, 3>& n : field_of(rays)) field.push_back(beyond_eye(n, posed.eye));
  } catch (const std::invalid_argument&) {
    return spans ? Outcome::failed("a field whose rays go around its inside is refused") : Outcome::not_applicable();
  }
  if (!spans) return Outcome::failed("a field whose rays do not go around its inside is taken for one");
  const Looked whole(posed), part(posed, rays);
  const Outcome inside = same_within(whole, part, part.surface, field, "the field");
  if (inside.state == Outcome::State::failed) return inside;
  return check_parts_of_field(whole, part, field, random);
}

}  // namespace

Check lines_check() {
  return {"lines", "visible and hidden parts of edges, and lines where faces cross, by brute force in rationals",
          [](const Posed_scene& posed, const Answer&, Random& random) {
            const Outcome outcome = check_lines(posed, random);
            if (outcome.state == Outcome::State::failed || !random.chance(1, 4)) return outcome;
            const bool is_pages = random.chance(1, 2);
            const Posed_scene own = is_pages ? line_scenes::any_pages(random) : line_scenes::any_outlines(random);
            const Outcome of_own = check_lines(own, random);
            if (of_own.state != Outcome::State::failed) return outcome;
            return Outcome::failed((is_pages ? "of pages through a line, " : "of outlines in a plane, ") +
                                   text_of_scene(own) + ": " + of_own.what);
          }};
}

Check field_check() {
  return {"field", "the same parts of lines in a field of view, and in parts of it, as without",
          [](const Posed_scene& posed, const Answer&, Random& random) { return check_field(posed, random); }};
}

void label_crossings(const Posed_scene& posed, Answer& answer) {
  for (const Drawn_crossing& c : Looked(posed).crossings())
    for (const Face_id face : c.faces) answer.labels[face] |= 4;
}

Answer without_lines(const Answer& answer) {
  Answer other = answer;
  for (std::uint32_t& label : other.labels)
    if (label != Answer::none) label &= 3u;
  return other;
}

}  // namespace sightline::harness
