#include <sightline/harness/judge/guess.h>

#include <sightline/algorithms/verify/polygons.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/harness/judge/rays.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/vectors.h>

#include <algorithm>
#include <bit>
#include <cstdlib>
#include <utility>

namespace sightline::judge {
namespace {

bool graded_right(const Polygon_soup& soup, const Query& query, const Answer& answer, const Truth_options& options) {
  const Truth truth = truth_of(soup, query, options);
  return truth.not_asked.empty() && !grade(truth, answer).wrong();
}

bool traced_right(const Polygon_soup& soup, const Query& query, const Answer& answer, const Ray_rule& rule) {
  return !grade_rays(ray_truths(soup, Scene(soup), query.rays, rule), answer).wrong();
}

/// The truth if faces hid nothing.
Truth with_nothing_hidden(const Polygon_soup& soup, const Query& query) {
  Truth truth;
  const Scene scene(soup);
  std::vector<bool> in_front(soup.face_count()), kept(soup.face_count());
  for (const Piece& piece : scene.pieces()) {
    const certificate_check::Polygon corners = scene.corner_points(piece);
    const int side = certificate_check::Plane{certificate_check::newell_normal(corners), corners[0]}.side(query.eye);
    kept[piece.face] = true;
    in_front[piece.face] = side > 0 || (query.two_sided && side < 0);
  }
  for (Face_id f = 0; f < soup.face_count(); ++f)
    if (kept[f]) (in_front[f] ? truth.visible : truth.hidden).push_back(f);
  return truth;
}

std::string distance_words(std::int64_t ulps) {
  const auto size = static_cast<std::uint64_t>(std::abs(ulps));
  if (size == 1) return "one ulp";
  if (!std::has_single_bit(size)) return std::to_string(size) + " ulps";
  return "2^-" + std::to_string(52 - static_cast<int>(std::bit_width(size) - 1)) + " of the scene's size";
}

}  // namespace

std::vector<Reading> readings_of(Question question) {
  switch (question) {
    case Question::order: return {Reading::reversed, Reading::from_one};
    case Question::see:
      return {Reading::turned, Reading::other_sides, Reading::nothing_hides, Reading::complement, Reading::from_one};
    case Question::weak:
      return {Reading::turned, Reading::other_sides, Reading::source_turned, Reading::complement, Reading::from_one};
    case Question::trace:
      return {Reading::to_points, Reading::closed_start, Reading::fronts_only, Reading::farthest, Reading::from_one};
    case Question::boolean: return {Reading::inside_out, Reading::swapped};
  }
  return {};
}

bool lists_faces(const Answer& answer) {
  return !answer.visible.empty() || !answer.order.empty() || (answer.surface && answer.surface->face_count() > 0) ||
         std::any_of(answer.first.begin(), answer.first.end(), [](const auto& face) { return face.has_value(); });
}

bool is_right(Reading reading, const Polygon_soup& soup, const Query& query, const Answer& answer,
              const Truth_options& options) {
  Query other = query;
  Answer read = answer;
  Ray_rule rule;
  rule.excuse_touching = options.excuse_touching;
  switch (reading) {
    case Reading::turned: return graded_right(generate::faces_reversed(soup), query, answer, options);
    case Reading::other_sides: other.two_sided = !query.two_sided; break;
    case Reading::source_turned: std::reverse(other.source.begin(), other.source.end()); break;
    case Reading::nothing_hides: return !grade(with_nothing_hidden(soup, query), answer).wrong();
    case Reading::complement: {
      read.visible.clear();
      for (Face_id f = 0; f < soup.face_count(); ++f)
        if (!std::binary_search(answer.visible.begin(), answer.visible.end(), f) &&
            !std::binary_search(answer.abstained.begin(), answer.abstained.end(), f))
          read.visible.push_back(f);
    } break;
    case Reading::reversed: std::reverse(read.order.begin(), read.order.end()); break;
    case Reading::from_one: {
      for (const Face_id face : answer.visible)
        if (face == 0) return false;
      for (const Drawn_face& drawn : answer.order)
        if (drawn.face == 0) return false;
      for (const std::optional<Face_id>& face : answer.first)
        if (face == Face_id{0}) return false;
      for (Face_id& face : read.visible) --face;
      for (Drawn_face& drawn : read.order) --drawn.face;
      for (std::optional<Face_id>& face : read.first)
        if (face) --*face;
    } break;
    case Reading::to_points:
      for (Exact_ray& ray : other.rays) ray.direction = minus(ray.direction, ray.origin);
      break;
    case Reading::closed_start: rule.start = Ray_start::closed; return traced_right(soup, query, answer, rule);
    case Reading::fronts_only: rule.fronts_only = true; return traced_right(soup, query, answer, rule);
    case Reading::farthest: rule.farthest = true; return traced_right(soup, query, answer, rule);
    case Reading::inside_out:
      if (read.surface) read.surface = generate::faces_reversed(*read.surface);
      break;
    case Reading::swapped: {
      std::array<Polygon_soup, 2> solids = solids_of(soup, query.first);
      std::swap(solids[0], solids[1]);
      other.first = solids[0].face_count();
      return graded_right(joined(solids), other, answer, options);
    }
  }
  return graded_right(soup, other, read, options);
}

std::string words_of(Reading reading, bool two_sided) {
  switch (reading) {
    case Reading::turned: return "as if the front of a face were where it is clockwise";
    case Reading::other_sides:
      return two_sided ? "as if only fronts counted" : "as if faces seen from behind counted too";
    case Reading::source_turned: return "as if the source looked to the side from which it is clockwise";
    case Reading::nothing_hides: return "as if no face hid another: all are shown that the eye is in front of";
    case Reading::complement: return "as if hidden faces were to be listed, not visible ones";
    case Reading::reversed: return "as if the nearest face came first";
    case Reading::from_one: return "as if faces were counted from 1";
    case Reading::to_points: return "as if a direction were the point that the ray goes to";
    case Reading::closed_start: return "as if faces that hold the origin were met there";
    case Reading::fronts_only: return "as if faces were met from the front only";
    case Reading::farthest: return "as if the last face were asked for, not the first";
    case Reading::inside_out: return "as if fronts looked inwards";
    case Reading::swapped: return "as if the first solid were to be taken from the second";
  }
  return {};
}

std::string words_of(std::vector<Neighbour> neighbours, const std::string& exactly) {
  const auto size = [](const Neighbour& n) { return std::abs(n.ulps); };
  std::stable_sort(neighbours.begin(), neighbours.end(),
                   [&](const Neighbour& a, const Neighbour& b) { return size(a) < size(b); });
  std::vector<Neighbour> wrong, right;
  for (const Neighbour& n : neighbours) (n.wrong ? wrong : right).push_back(n);
  if (wrong.empty()) return {};
  const Neighbour &last_wrong = wrong.back(), &farthest = neighbours.back();
  if (farthest.ulps == 0) return "wrong where it is " + exactly + "; of where it is moved nothing is known";
  if (right.empty())
    return "wrong wherever it is moved, as far as " + distance_words(farthest.ulps) + ": no tolerance explains that";
  if (last_wrong.ulps == 0)
    return "wrong only where it is " + exactly + ", right when moved by " + distance_words(right.front().ulps) +
           ": contact is decided wrongly, all else is right";
  // Which side all are on that are moved and wrong; none of that side is right then.
  const auto only_on = [&](bool positive) {
    return std::all_of(neighbours.begin(), neighbours.end(),
                       [&](const Neighbour& n) { return n.ulps == 0 || !n.wrong || (n.ulps > 0) == positive; });
  };
  const bool one = only_on(true), other = only_on(false);
  const std::string side = one ? " to the one side (+)" : other ? " to the other side (-)" : "";
  const auto beyond = std::find_if(right.begin(), right.end(), [&](const Neighbour& n) {
    return size(n) > size(last_wrong) && (side.empty() || (n.ulps > 0) == one);
  });
  if (beyond != right.end())
    return "wrong when moved by up to " + distance_words(last_wrong.ulps) + side + ", right from " +
           distance_words(beyond->ulps) + " on: a tolerance of a size between, or rounding";
  const auto is_right_moved = [&](bool positive) {
    return std::any_of(right.begin(), right.end(),
                       [&](const Neighbour& n) { return n.ulps != 0 && (n.ulps > 0) == positive; });
  };
  if (!side.empty() && !is_right_moved(one) && is_right_moved(!one))
    return "wrong when moved" + side + ", as far as " + distance_words(last_wrong.ulps) +
           ", right when moved to the opposite one: no tolerance explains that";
  return "wrong when moved by " + distance_words(last_wrong.ulps) + ", right when moved by " +
         (right.front().ulps == 0 ? std::string("nothing") : distance_words(right.front().ulps)) +
         ": it does not come from being " + exactly;
}

std::string words_of(const Kinds& kinds) {
  if (kinds.concave_wrong > 0 && kinds.convex_wrong == 0 && kinds.convex_right > 0)
    return std::to_string(kinds.concave_wrong) + " of " + std::to_string(kinds.concave_wrong + kinds.concave_right) +
           " concave faces are wrong, and none of " + std::to_string(kinds.convex_right) + " convex ones";
  return {};
}

}  // namespace sightline::judge
