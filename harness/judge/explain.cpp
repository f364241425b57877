#include <sightline/harness/judge/explain.h>

#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/verify/polygons.h>
#include <sightline/algorithms/verify/weak.h>
#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/occluders.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/algorithms/rays/tracer.h>
#include <sightline/harness/judge/truth.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/time_limit.h>
#include <sightline/kernel/vectors.h>
#include <sightline/sightline.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdio>
#include <numbers>
#include <set>
#include <unordered_map>
#include <utility>
#include <vector>

namespace sightline::judge {
namespace {

using Polygon = std::vector<Exact_point>;
using certificate_check::newell_normal;

// ---- Words

std::string short_number(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.4g", x);
  return text;
}
std::string words_of(const Exact_point& p) {
  std::string text = "(";
  for (std::size_t k = 0; k < 3; ++k) text += (k == 0 ? "" : ", ") + short_number(nearest_double(p[k]));
  return text + ")";
}
std::string percent(double share) { return short_number(100 * share) + " %"; }
std::string face_words(Face_id face) { return "face " + std::to_string(face); }

// ---- Convex polygons

/// The part where the normal's product with p - origin is not negative.
Polygon clipped(const Polygon& polygon, const certificate_check::Integer_vector& normal, const Exact_point& origin) {
  Polygon kept;
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
    const Rational at = certificate_check::dot(normal, minus(p, origin)),
                   next = certificate_check::dot(normal, minus(q, origin));
    if (at >= 0) kept.push_back(p);
    if (sgn(at) * sgn(next) >= 0) continue;
    const Rational t = at / (at - next);
    kept.push_back(
        {Rational(p[0] + t * (q[0] - p[0])), Rational(p[1] + t * (q[1] - p[1])), Rational(p[2] + t * (q[2] - p[2]))});
  }
  return kept;
}
bool has_area(const Polygon& polygon) {
  return polygon.size() > 2 && !certificate_check::is_zero(newell_normal(polygon));
}

/// Of which areas and solid angles are asked.
Part part_of(const Polygon& polygon) { return {0, 0, polygon}; }
double share_of_directions(double angle) { return angle / (4 * std::numbers::pi); }

// ---- A scene in convex pieces

struct Flat_piece {
  Face_id face;
  std::uint32_t support;  // its plane's id
  Polygon corners;
  certificate_check::Plane plane;
};

std::vector<Flat_piece> pieces_of(const Scene& scene) {
  std::vector<Flat_piece> pieces;
  for (const Piece& piece : scene.pieces()) {
    Flat_piece flat{piece.face, piece.support.id(), scene.corner_points(piece), {}};
    flat.plane = {newell_normal(flat.corners), flat.corners[0]};
    pieces.push_back(std::move(flat));
  }
  return pieces;
}

/// By face: its pieces.
std::vector<std::vector<const Flat_piece*>> by_face(const std::vector<Flat_piece>& pieces, std::size_t faces) {
  std::vector<std::vector<const Flat_piece*>> found(faces);
  for (const Flat_piece& piece : pieces) found[piece.face].push_back(&piece);
  return found;
}

/// Where a segment first meets a closed piece strictly between its ends, and that piece's face.
std::optional<std::pair<Face_id, Exact_point>> first_met(const std::vector<Flat_piece>& pieces, const Exact_point& from,
                                                         const Exact_point& to) {
  const Exact_point d = minus(to, from);
  std::optional<std::pair<Face_id, Exact_point>> found;
  Rational nearest = 1;
  for (const Flat_piece& piece : pieces) {
    const Rational rise = certificate_check::dot(piece.plane.normal, d);
    if (rise == 0) continue;
    const Rational t = certificate_check::dot(piece.plane.normal, minus(piece.corners[0], from)) / rise;
    if (t <= 0 || t >= nearest) continue;
    const Exact_point at{Rational(from[0] + t * d[0]), Rational(from[1] + t * d[1]), Rational(from[2] + t * d[2])};
    bool inside = true;
    for (std::size_t k = 0; k < piece.corners.size() && inside; ++k) {
      const Exact_point &p = piece.corners[k], &q = piece.corners[(k + 1) % piece.corners.size()];
      inside = certificate_check::dot(piece.plane.normal, cross(minus(q, p), minus(at, p))) >= 0;
    }
    if (!inside) continue;
    nearest = t;
    found.emplace(piece.face, at);
  }
  return found;
}

/// A line to a face that is not seen, past its back or something in the way.
std::optional<Refutation> hidden_face(const std::vector<Flat_piece>& pieces, const Exact_point& from, Face_id face,
                                      bool two_sided, const std::string& looker) {
  for (const Flat_piece& piece : pieces) {
    if (piece.face != face) continue;
    Refutation line{face, from, middle_of(piece.corners), {}, {}, {}};
    const int side = piece.plane.side(from);
    if (side == 0 || (side < 0 && !two_sided)) {
      line.words = looker + (side == 0 ? " is in the plane of " : " is behind ") + face_words(face);
      return line;
    }
    // A line may pass along an edge: then one to another point of it tells.
    for (std::size_t k = 0; k <= piece.corners.size(); ++k) {
      if (k > 0)
        for (std::size_t x = 0; x < 3; ++x) line.to[x] = (2 * line.to[x] + piece.corners[k - 1][x]) / 3;
      const auto met = first_met(pieces, from, line.to);
      if (!met) continue;
      line.by = met->first;
      line.at = met->second;
      line.words = "on the way from " + words_of(from) + " to " + words_of(line.to) + " on " + face_words(face) + ", " +
                   face_words(met->first) + " is met at " + words_of(met->second);
      return line;
    }
  }
  return std::nullopt;
}

// ---- By question

/// Parts in the plane of a face, cut to the cone that the eye sees the face in. `face`: its pieces; `parts`: all that
/// are in their plane.
std::vector<Polygon> parts_on(const std::vector<const Flat_piece*>& face,
                              const std::vector<const Seen::Visible_part*>& parts, const Exact_point& eye,
                              bool two_sided) {
  std::vector<Polygon> found;
  for (const Seen::Visible_part* part : parts) {
    if (part->face == face[0]->face) {
      if (part->from_front || two_sided) found.push_back(part->corners);
      continue;
    }
    for (const Flat_piece* piece : face) {  // of faces in one plane the part is one's, and all are visible
      if (piece->plane.side(eye) < 0 && !two_sided) continue;
      Polygon common = part->corners;
      for (const auto& edge : certificate_check::Cone(piece->corners, eye).edge_planes)
        common = clipped(common, edge, eye);
      if (has_area(common)) found.push_back(std::move(common));
    }
  }
  return found;
}

Explanation explain_seen(const Polygon_soup& soup, const Query& query, const Grade& grade, bool missing_first) {
  const Seen seen = sightline::see(Model(soup), query.eye);
  const std::vector<Flat_piece> pieces = pieces_of(Scene(soup));
  const auto faces = by_face(pieces, soup.face_count());
  std::unordered_map<std::uint32_t, std::vector<const Seen::Visible_part*>> in_plane;  // faces are planar
  for (const Seen::Visible_part& part : seen.parts) in_plane[faces[part.face].at(0)->support].push_back(&part);
  Explanation why;
  double missing = 0, largest = -1;
  std::optional<Refutation> of_missing;
  for (const Face_id face : grade.wrong_hidden) {
    if (faces[face].empty()) continue;
    const std::vector<const Seen::Visible_part*>& there = in_plane[faces[face][0]->support];
    for (const Polygon& part : parts_on(faces[face], there, query.eye, query.two_sided)) {
      const double angle = part_of(part).solid_angle(query.eye);
      missing += angle;
      if (angle <= largest) continue;
      largest = angle;
      const Exact_point to = middle_of(part);
      of_missing = {
          face,
          query.eye,
          to,
          {},
          {},
          face_words(face) + " is seen at " + words_of(to) + ": nothing is between it and the eye " + words_of(query.eye)};
    }
  }
  double shown = 0;
  for (const Flat_piece& piece : pieces)
    if (std::binary_search(grade.wrong_visible.begin(), grade.wrong_visible.end(), piece.face))
      shown += part_of(piece.corners).solid_angle(query.eye);
  std::optional<Refutation> of_shown;
  for (std::size_t k = 0; k < grade.wrong_visible.size() && !of_shown; ++k)
    of_shown = hidden_face(pieces, query.eye, grade.wrong_visible[k], query.two_sided, "the eye");
  why.refutation = of_missing && (missing_first || !of_shown) ? of_missing : of_shown;
  why.share = share_of_directions(missing);
  why.share_words = percent(why.share) + " of all directions show a face that the answer leaves out";
  if (!grade.wrong_visible.empty())
    why.share_words += (grade.wrong_hidden.empty() ? "; " : ", and ") +
                       std::string("hidden faces that it shows would fill ") + percent(share_of_directions(shown)) +
                       ", each by itself";
  return why;
}

/// The directions in which one face is nearer than another, as polygons on the first.
std::vector<Polygon> nearer(const std::vector<const Flat_piece*>& near, const std::vector<const Flat_piece*>& far,
                            const Exact_point& eye) {
  std::vector<Polygon> found;
  for (const Flat_piece* a : near)
    for (const Flat_piece* b : far) {
      if (a->plane.side(eye) == 0 || b->plane.side(eye) == 0) continue;
      Polygon common = a->corners;
      for (const auto& edge : certificate_check::Cone(b->corners, eye).edge_planes) common = clipped(common, edge, eye);
      common = clipped(common, b->plane.side(eye) > 0 ? b->plane.normal : certificate_check::negated(b->plane.normal),
                       b->corners[0]);
      if (has_area(common) &&
          !std::all_of(common.begin(), common.end(), [&](const Exact_point& p) { return b->plane.side(p) == 0; }))
        found.push_back(std::move(common));
    }
  return found;
}

constexpr std::size_t most_pairs = 10'000;  // of an order that is all wrong there are as many as pairs of faces

Explanation explain_order(const Polygon_soup& soup, const Query& query, const Answer& answer, const Grade& grade) {
  const std::vector<Flat_piece> pieces = pieces_of(Scene(soup));
  const auto faces = by_face(pieces, soup.face_count());
  std::vector<bool> in_parts(soup.face_count());
  for (const Drawn_face& drawn : answer.order)
    if (!drawn.part.empty()) in_parts[drawn.face] = true;
  Explanation why;
  double wrong = 0, largest = -1;
  bool left_out = false;
  std::size_t looked_at = 0;
  for (const auto& [earlier, later] : grade.wrong_pairs) {
    if (looked_at == most_pairs) break;
    ++looked_at;
    left_out = left_out || in_parts[earlier] || in_parts[later];
    if (in_parts[earlier] || in_parts[later]) continue;
    for (const Polygon& part : nearer(faces[earlier], faces[later], query.eye)) {
      const double angle = part_of(part).solid_angle(query.eye);
      wrong += angle;
      if (angle <= largest) continue;
      largest = angle;
      const Exact_point to = middle_of(part);
      why.refutation = {earlier,
                        query.eye,
                        to,
                        {},
                        {},
                        "from " + words_of(query.eye) + " through " + words_of(to) + ", " + face_words(earlier) +
                            " is nearer than " + face_words(later) + ", which is drawn over it",
                        later};
    }
  }
  for (const Face_id face : grade.wrong_hidden) {
    if (why.refutation || faces[face].empty() || in_parts[face]) continue;
    why.refutation = {face, query.eye, middle_of(faces[face][0]->corners),
                      {},   {},        face_words(face) + " is missing in the order"};
  }
  why.share = share_of_directions(wrong);
  why.share_words = percent(why.share) + " of all directions are drawn in the wrong order, summed over " +
                    (looked_at < grade.wrong_pairs.size()
                         ? std::to_string(looked_at) + " of " + std::to_string(grade.wrong_pairs.size()) + " pairs"
                         : std::string("pairs")) +
                    (left_out ? ", without faces drawn in parts" : "");
  return why;
}

/// A sightline to one of the faces, proved.
std::optional<Refutation> sightline_to(const Scene& scene, const Query& query, const std::vector<Face_id>& faces,
                                       double seconds) {
  const Occluders occluders(scene);
  Weak_options options;
  options.search.two_sided = query.two_sided;
  options.faces = faces;
  options.search.out_of_time = [watch = Stopwatch(), seconds] { return watch.seconds() > seconds; };
  const Weakly_visible found = weakly_visible(occluders, {weak_source(occluders, query.source)}, options);
  const Weak_certificate proof = weak_certificate(scene, {query.source}, query.two_sided, found);
  if (proof.visible.empty()) return std::nullopt;
  const Weak_certificate::Sightline& line = proof.visible.front();
  const Face_id face = proof.fragments[line.fragment].face;
  return Refutation{face,
                    line.from,
                    line.to,
                    {},
                    {},
                    face_words(face) + " is seen from " + words_of(line.from) + " on the source at " +
                        words_of(line.to) + ": nothing is between"};
}

/// A line to a face that no point of the source sees: behind the source, or past what hides it from a point of that,
/// the middle where it tells, to a point in front of the source.
std::optional<Refutation> weakly_hidden_face(const std::vector<Flat_piece>& pieces, const Query& query, Face_id face) {
  const Exact_point from = middle_of(query.source);
  const certificate_check::Plane plane{newell_normal(query.source), from};
  const Flat_piece* last = nullptr;
  bool behind = true;
  for (const Flat_piece& piece : pieces) {
    if (piece.face != face) continue;
    last = &piece;
    for (const Exact_point& p : piece.corners) behind = behind && plane.side(p) <= 0;
  }
  if (last == nullptr) return std::nullopt;
  if (behind)
    return Refutation{face, from, middle_of(last->corners),
                      {},   {},   face_words(face) + " is behind the source, or in its plane"};
  // Of a face that the source's plane cuts, what is in front of that: to what is behind it nothing need be in the way.
  std::vector<Flat_piece> in_front;
  for (Flat_piece piece : pieces) {
    if (piece.face == face) piece.corners = clipped(piece.corners, plane.normal, from);
    if (piece.face != face || has_area(piece.corners)) in_front.push_back(std::move(piece));
  }
  for (std::size_t k = 0; k <= query.source.size(); ++k) {
    Exact_point point = from;
    if (k > 0)
      for (std::size_t x = 0; x < 3; ++x) point[x] = (2 * from[x] + query.source[k - 1][x]) / 3;
    std::optional<Refutation> line = hidden_face(in_front, point, face, query.two_sided,
                                                 k == 0 ? "the middle of the source" : "a point of the source");
    if (!line) continue;
    line->words += "; that no other line reaches it is proved";
    return line;
  }
  return std::nullopt;
}

/// How large faces are, the largest about 1, so that doubles hold their sum.
std::vector<double> areas_of(const Polygon_soup& soup) {
  std::vector<Rational> squares;
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    const Exact_point vector = doubled_area_vector(soup, f);
    squares.push_back(dot(vector, vector));
  }
  const Rational largest = *std::max_element(squares.begin(), squares.end());
  std::vector<double> areas;
  for (const Rational& square : squares) areas.push_back(square_root(Rational(square / largest)));
  return areas;
}

Explanation explain_weak(const Polygon_soup& soup, const Query& query, const Grade& grade, const Answer& answer,
                         bool missing_first, double seconds) {
  const Scene scene(soup);
  const std::vector<Flat_piece> pieces = pieces_of(scene);
  Explanation why;
  std::optional<Refutation> of_missing, of_shown;
  if (!grade.wrong_hidden.empty()) of_missing = sightline_to(scene, query, grade.wrong_hidden, seconds);
  for (std::size_t k = 0; k < grade.wrong_visible.size() && !of_shown; ++k)
    of_shown = weakly_hidden_face(pieces, query, grade.wrong_visible[k]);
  why.refutation = of_missing && (missing_first || !of_shown) ? of_missing : of_shown;
  double wrong = 0, all = 0;
  const auto holds = [](const std::vector<Face_id>& faces, Face_id f) {
    return std::binary_search(faces.begin(), faces.end(), f);
  };
  const std::vector<double> areas = areas_of(soup);
  std::set<Face_id> answered;
  for (const Flat_piece& piece : pieces)
    if (!holds(answer.abstained, piece.face)) answered.insert(piece.face);
  for (const Face_id face : answered) {
    all += areas[face];
    if (holds(grade.wrong_visible, face) || holds(grade.wrong_hidden, face)) wrong += areas[face];
  }
  why.share = all > 0 ? wrong / all : 0;
  why.share_words = percent(why.share) + " of the area that is answered for is of wrong faces";
  return why;
}

/// A point of the ray beyond all of the scene.
Exact_point beyond(const Polygon_soup& soup, const Exact_ray& ray) {
  Rational t = 1;
  for (Point_id p = 0; p < soup.point_count(); ++p)
    t = std::max(t, Rational(dot(minus(soup.point(p), ray.origin), ray.direction) / dot(ray.direction, ray.direction)));
  return point_at(ray, t);
}

Explanation explain_traced(const Polygon_soup& soup, const Query& query, const Grade& grade, bool missing_first) {
  Explanation why;
  why.share = static_cast<double>(grade.wrong_rays.size()) / static_cast<double>(grade.judged - grade.abstained.size());
  why.share_words = percent(why.share) + " of the rays that are answered for are answered wrongly";
  const auto forbidden = [&](const Wrong_ray& wrong) {
    return missing_first ? !wrong.nothing : wrong.said.has_value();
  };
  auto worst = std::find_if(grade.wrong_rays.begin(), grade.wrong_rays.end(), forbidden);
  if (worst == grade.wrong_rays.end()) worst = grade.wrong_rays.begin();
  const Exact_ray& ray = query.rays[worst->ray];
  const Scene scene(soup);
  Ray_counters counters;
  const std::vector<Face_hit> hits = Ray_tracer(scene).all(ray, Ray_start::open, counters);
  const std::string begin = "ray " + std::to_string(worst->ray) + ", from " + words_of(ray.origin) + " towards " +
                            words_of(ray.direction) + ", ";
  const auto met = [](const Face_hit& hit) {
    return hit.side == Met_side::along ? " along itself" : hit.side == Met_side::back ? " from behind" : "";
  };
  if (hits.empty()) {
    why.refutation = {*worst->said, ray.origin, beyond(soup, ray), {}, {}, begin + "meets nothing"};
    return why;
  }
  const Face_hit& first = hits.front();
  const Exact_point at = point_at(ray, first.t);
  std::string words = begin + "first meets " + face_words(first.face) + met(first) + " at " + words_of(at);
  if (touches(soup, ray, first) && first.side != Met_side::along) words += ", on its border";
  if (!worst->said) {
    why.refutation = {first.face, ray.origin, at, {}, {}, words};
    return why;
  }
  const auto said =
      std::find_if(hits.begin(), hits.end(), [&](const Face_hit& hit) { return hit.face == *worst->said; });
  const Exact_point to = said == hits.end() ? beyond(soup, ray) : point_at(ray, said->t);
  words += said == hits.end() ? ", and not " + face_words(*worst->said)
                              : ", and " + face_words(*worst->said) + " only at " + words_of(to);
  why.refutation = {*worst->said, ray.origin, to, first.face, at, words};
  return why;
}

Explanation explain_solid(const Grade& grade, bool missing_first) {
  Explanation why;
  why.share = static_cast<double>(grade.wrong_points.size()) / static_cast<double>(grade.judged);
  why.share_words = percent(why.share) +
                    " of the points are inside and ought not, or the other way round; the volume is off by " +
                    percent(grade.volume_error) + ", the area by " + percent(grade.area_error);
  auto worst = std::find_if(grade.wrong_points.begin(), grade.wrong_points.end(),
                            [&](const Wrong_point& point) { return point.is_held() != missing_first; });
  if (worst == grade.wrong_points.end()) worst = grade.wrong_points.begin();
  if (worst == grade.wrong_points.end()) return why;
  why.refutation = {worst->face,
                    worst->at,
                    worst->on,
                    {},
                    {},
                    words_of(worst->at) + ", beside " + face_words(worst->face) + " at " + words_of(worst->on) +
                        ", is " + (worst->inside ? "inside" : "outside") + " the result, and the answer " +
                        (worst->winding ? "winds round it " + std::to_string(*worst->winding) + " times"
                                        : std::string("has a face through it"))};
  return why;
}

}  // namespace

Explanation explain(const Polygon_soup& soup, const Query& query, const Answer& answer, const Grade& grade,
                    Contract contract, double seconds) {
  const bool missing_first = contract != Contract::aggressive;
  switch (query.question) {
    case Question::order: return explain_order(soup, query, answer, grade);
    case Question::see: return explain_seen(soup, query, grade, missing_first);
    case Question::weak: return explain_weak(soup, query, grade, answer, missing_first, seconds);
    case Question::trace: return explain_traced(soup, query, grade, missing_first);
    case Question::boolean: return explain_solid(grade, missing_first);
  }
  return {};
}

}  // namespace sightline::judge
