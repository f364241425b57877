#pragma once
// The exact truth about a query, as the library computes it, and answers graded against it.

#include <sightline/algorithms/judge/order.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/weak_visibility/certificate.h>

#include <chrono>
#include <memory>

namespace sightline::judge {

/// What is known about the faces of a scene.
struct Truth {
  std::string not_asked;         ///< why no answer can be right or wrong; empty: the query can be asked
  std::vector<Face_id> visible;  ///< of see and weak; sorted
  std::vector<Face_id> hidden;
  std::shared_ptr<const Order_truth> order;
};

struct Truth_options {
  int threads = 0;      ///< 0: as many as there are processors; the same truth at any number, unless time runs out
  double seconds = 20;  ///< for weak; what is undecided then is not judged
  bool cycles = false;  ///< orders are asked for also where no order of whole faces is right
};

/// A scene that programs can be asked about: faces that are not planar, or have holes, are replaced by the planar
/// convex pieces that the library cuts them into, at the same place in the list, on the same points. Where all are
/// planar and without holes, the soup itself. Post: what is asked means the same to everybody. Exact: yes.
inline Polygon_soup with_planar_faces(const Polygon_soup& soup) {
  const Scene scene(soup);
  std::vector<bool> cut(soup.face_count());
  for (const Face_id face : scene.non_planar()) cut[face] = true;
  for (Face_id f = 0; f < soup.face_count(); ++f)
    if (soup.loop_count(f) > 1) cut[f] = true;
  if (std::find(cut.begin(), cut.end(), true) == cut.end()) return soup;

  Polygon_soup result;
  result.file = soup.file, result.coordinates = soup.coordinates;
  std::map<Exact_point, Point_id> first;
  for (Point_id p = 0; p < soup.point_count(); ++p) first.try_emplace(soup.point(p), p);
  std::vector<std::vector<const Piece*>> pieces(soup.face_count());
  for (const Piece& piece : scene.pieces()) pieces[piece.face].push_back(&piece);
  for (Face_id f = 0; f < soup.face_count(); ++f) {
    if (!cut[f]) result.add_face(soup.loop(f));
    else
      for (const Piece* piece : pieces[f]) {
        std::vector<Point_id> corners;
        for (const Piece_corner& corner : scene.corners(*piece))
          corners.push_back(first.at(scene.position(corner.point)));
        result.add_face(corners);
      }
  }
  return result;
}

/// Every coordinate rounded to the nearest double, so that a program that reads doubles has the scene exactly. Errors:
/// std::domain_error where one is beyond their range.
inline Exact_point rounded_to_doubles(const Exact_point& p) {
  return {exact(nearest_double(p[0])), exact(nearest_double(p[1])), exact(nearest_double(p[2]))};
}
inline Polygon_soup rounded_to_doubles(const Polygon_soup& soup) {
  Polygon_soup result = soup;
  result.coordinates = {};
  for (Point_id p = 0; p < soup.point_count(); ++p)
    for (const Rational& x : rounded_to_doubles(soup.point(p))) result.coordinates.push(x);
  return result;
}
/// A source that is not planar any more becomes its first triangle that has area.
inline Query rounded_to_doubles(Query query) {
  query.eye = rounded_to_doubles(query.eye);
  for (Exact_point& p : query.source) p = rounded_to_doubles(p);
  const certificate_check::Integer_vector normal = certificate_check::newell_normal(query.source);
  if (query.source.empty() || certificate_check::is_zero(normal)) return query;
  const certificate_check::Plane plane{normal, query.source[0]};
  if (std::all_of(query.source.begin(), query.source.end(), [&](const Exact_point& p) { return plane.side(p) == 0; }))
    return query;
  for (std::size_t k = 2; k < query.source.size(); ++k) {
    const std::vector<Exact_point> triangle{query.source[0], query.source[k - 1], query.source[k]};
    if (!certificate_check::is_zero(certificate_check::newell_normal(triangle))) {
      query.source = triangle;
      break;
    }
  }
  return query;
}

namespace truth_detail {

inline void find_seen(const Scene& scene, const Query& query, const Truth_options& options, Truth& truth) {
  const Piece_boxes boxes(scene);
  Visible_options visible;
  visible.threads = options.threads;
  const auto surface = visible_surface(Exact_view(scene, query.eye), boxes, visible);
  truth.visible = surface.visible;
  if (!query.two_sided) return;
  truth.visible.clear();
  std::set_union(surface.visible.begin(), surface.visible.end(), surface.from_behind.begin(), surface.from_behind.end(),
                 std::back_inserter(truth.visible));
}

inline void find_lit(const Polygon_soup& soup, const Scene& scene, const Query& query, const Truth_options& options,
                     Truth& truth) {
  const Occluders occluders(scene);
  Weak_options weak;
  weak.threads = options.threads, weak.search.two_sided = query.two_sided;
  const auto start = std::chrono::steady_clock::now();
  weak.search.out_of_time = [&] {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() > options.seconds;
  };
  std::vector<Weak_source> sources;
  try {
    sources.push_back(weak_source(occluders, query.source));
  } catch (const std::invalid_argument& error) {
    truth.not_asked = error.what();
    return;
  }
  Weakly_visible found = weakly_visible(occluders, sources, weak);
  if (const Verdict verdict = verify_weak(soup, weak_certificate(scene, {query.source}, query.two_sided, found));
      !verdict.accepted)
    throw std::logic_error("the library's own answer is not accepted by its checker: " + verdict.why +
                           "; please report it");
  if (found.visible.empty() && found.hidden.empty() && !found.undecided.empty())
    truth.not_asked = "nothing is decided within the budget";
  truth.visible = std::move(found.visible), truth.hidden = std::move(found.hidden);
}

}  // namespace truth_detail

/// What is true of a query. Faces that are set aside (zero area, duplicates of earlier ones), and those that a search
/// leaves undecided, are neither visible nor hidden. Weak visibility is certified, and the certificate checked by
/// verify_weak(). Pre: faces are planar, with_planar_faces(). Degenerate: what visible_surface(), weakly_visible() and
/// Order_truth say. Cost: that of these, and of the check. Errors: std::logic_error where the checker does not accept
/// the library's own certificate. Exact: yes.
inline Truth truth_of(const Polygon_soup& soup, const Query& query, const Truth_options& options = {}) {
  Truth truth;
  const Scene scene(soup);
  if (scene.counters().faces == 0) truth.not_asked = "the scene has no faces";
  else if (scene.counters().self_intersecting > 0)
    truth.not_asked = "faces cross themselves, and bound nothing that all agree on";
  if (!truth.not_asked.empty()) return truth;
  switch (query.question) {
    case Question::order:
      truth.order = std::make_shared<const Order_truth>(scene, query.eye, query.two_sided);
      if (!options.cycles && !truth.order->whole_faces_do())
        truth.not_asked = "faces overlap in a cycle, so no order of whole faces is right";
      break;
    case Question::see: truth_detail::find_seen(scene, query, options, truth); break;
    case Question::weak: truth_detail::find_lit(soup, scene, query, options, truth); break;
  }
  if (query.question == Question::see)
    for (const Piece& piece : scene.pieces())
      if (piece.number == 0 && !std::binary_search(truth.visible.begin(), truth.visible.end(), piece.face))
        truth.hidden.push_back(piece.face);
  return truth;
}

/// What is wrong with an answer. Pre: the query could be asked, and the answer is about its scene. Exact: yes.
inline Grade grade(const Truth& truth, const Answer& answer) {
  if (truth.order) return truth.order->grade(answer);
  Grade grade;
  grade.judged = truth.visible.size() + truth.hidden.size();
  const auto judge = [&](const std::vector<Face_id>& faces, bool visible, std::vector<Face_id>& wrong) {
    for (const Face_id face : faces) {
      if (std::binary_search(answer.abstained.begin(), answer.abstained.end(), face)) grade.abstained.push_back(face);
      else if (std::binary_search(answer.visible.begin(), answer.visible.end(), face) != visible) wrong.push_back(face);
    }
  };
  judge(truth.visible, true, grade.wrong_hidden);
  judge(truth.hidden, false, grade.wrong_visible);
  std::sort(grade.abstained.begin(), grade.abstained.end());
  return grade;
}

}  // namespace sightline::judge
