// Moving eyes against brute force: all moments at which any three lines of the scene look concurrent, by rational
// arithmetic of its own, and `see` between each and the next.

#include "../sample.h"

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/exact_view.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/algorithms/weak_visibility/along/along.h>
#include <sightline/algorithms/weak_visibility/along/certificate.h>
#include <sightline/harness/generate/families.h>
#include <sightline/harness/generate/random.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/harness/laws/along_edges.h>
#include <sightline/io/read.h>
#include <sightline/kernel/vectors.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace {

using namespace sightline;

using Line_points = std::array<Exact_point, 2>;

Exact_point point_at(const Exact_point& a, const Exact_point& b, const Rational& t) {
  return {a[0] + t * (b[0] - a[0]), a[1] + t * (b[1] - a[1]), a[2] + t * (b[2] - a[2])};
}

/// All edges, and where planes of pieces meet.
std::vector<Line_points> lines_of(const Scene& scene) {
  std::vector<Line_points> lines;
  for (const Piece& piece : scene.pieces()) {
    const auto corners = scene.corners(piece);
    for (std::size_t i = 0; i < corners.size(); ++i)
      lines.push_back({scene.position(corners[i].point), scene.position(corners[(i + 1) % corners.size()].point)});
  }
  for (const Piece& f : scene.pieces())
    for (const Piece& g : scene.pieces()) {
      if (g.support.id() <= f.support.id()) continue;
      const auto h = scene.file_coefficients(f.support), k = scene.file_coefficients(g.support);
      const Exact_point n{h[0], h[1], h[2]}, m{k[0], k[1], k[2]}, d = cross(n, m);
      if (is_zero(d)) continue;
      // (k3 n - h3 m) x d / d.d is on both.
      const Exact_point v{k[3] * n[0] - h[3] * m[0], k[3] * n[1] - h[3] * m[1], k[3] * n[2] - h[3] * m[2]};
      Exact_point p = cross(v, d);
      for (Rational& x : p) x /= dot(d, d);
      lines.push_back({p, {p[0] + d[0], p[1] + d[1], p[2] + d[2]}});
    }
  std::sort(lines.begin(), lines.end());
  lines.erase(std::unique(lines.begin(), lines.end()), lines.end());
  return lines;
}

/// The integer quadratic through three values at 0, 1/2 and 1.
Quadratic through(const std::array<Rational, 3>& values) {
  std::array<Rational, 3> c{values[0], Rational(4 * values[1] - 3 * values[0] - values[2]),
                            Rational(2 * values[0] + 2 * values[2] - 4 * values[1])};
  Integer denominators = 1;
  for (const Rational& x : c) denominators = lcm(denominators, x.get_den());
  Quadratic f;
  for (std::size_t k = 0; k < 3; ++k) f.c[k] = Rational(c[k] * denominators).get_num();
  return f;
}

/// Moments of (0, 1) at which anything can change, with 0 and 1.
std::vector<Quadratic_root> candidates(const Scene& scene, const Exact_point& a, const Exact_point& b) {
  const std::vector<Line_points> lines = lines_of(scene);
  const std::array<Rational, 3> at{0, Rational(1, 2), 1};
  std::array<std::vector<Exact_point>, 3> normals;
  for (std::size_t s = 0; s < 3; ++s)
    for (const auto& [p, q] : lines) {
      const Exact_point eye = point_at(a, b, at[s]);
      normals[s].push_back(cross(minus(p, eye), minus(q, eye)));
    }
  std::vector<Quadratic_root> roots{Quadratic_root(0), Quadratic_root(1)};
  const Parameter_range all{roots[0], roots[1]};
  for (std::size_t i = 0; i < lines.size(); ++i)
    for (std::size_t j = 0; j < i; ++j) {
      std::array<Exact_point, 3> crossed;
      for (std::size_t s = 0; s < 3; ++s) crossed[s] = cross(normals[s][i], normals[s][j]);
      for (std::size_t k = 0; k < j; ++k)
        append_roots(
            through({dot(crossed[0], normals[0][k]), dot(crossed[1], normals[1][k]), dot(crossed[2], normals[2][k])}),
            all, roots);
    }
  for (const Piece& piece : scene.pieces()) {
    const auto h = scene.file_coefficients(piece.support);
    std::array<Rational, 3> values;
    for (std::size_t s = 0; s < 3; ++s) {
      const Exact_point eye = point_at(a, b, at[s]);
      values[s] = h[0] * eye[0] + h[1] * eye[1] + h[2] * eye[2] + h[3];
    }
    append_roots(through(values), all, roots);
  }
  std::sort(roots.begin(), roots.end());
  roots.erase(std::unique(roots.begin(), roots.end()), roots.end());
  return roots;
}

std::vector<Face_id> seen_from(const Scene& scene, const Piece_boxes& boxes, const Exact_point& eye, bool two_sided) {
  const Exact_view view(scene, eye);
  Visible_options serial;
  serial.threads = 1;
  const auto surface = visible_surface(view, boxes, serial);
  std::set<Face_id> seen(surface.visible.begin(), surface.visible.end());
  if (two_sided) seen.insert(surface.from_behind.begin(), surface.from_behind.end());
  return {seen.begin(), seen.end()};
}

/// What events make of what is seen at first.
std::vector<Face_id> after_events(const Visible_along& along, const Quadratic_root& t) {
  std::set<Face_id> seen(along.at_start.begin(), along.at_start.end());
  for (const Along_event& event : along.events) {
    if (t < event.t) break;
    for (const Along_event::Change& change : event.changes) {
      EXPECT_FALSE(change.before == change.at && change.at == change.after);
      EXPECT_EQ(event.t == Quadratic_root(0) ? change.at : change.before, seen.contains(change.face));
      if (event.t == t ? change.at : change.after) seen.insert(change.face);
      else seen.erase(change.face);
    }
  }
  return {seen.begin(), seen.end()};
}

/// What was met in all scenes.
struct Met {
  std::size_t scenes = 0, events = 0, irrational = 0, momentary = 0, contacts = 0, triples = 0;
};

/// The certificate is accepted, as text.
void expect_certified(const Scene& scene, const Polygon_soup& soup, const Exact_point& from, const Exact_point& to,
                      bool two_sided) {
  Along_options options;
  options.two_sided = two_sided;
  options.with_proofs = true;
  const Occluders occluders(scene);
  const std::string text =
      certificate_text(along_certificate(scene, visible_along(occluders, from, to, options), from, to, two_sided));
  std::istringstream in(text);
  const Verdict verdict = verify_along(soup, std::get<Along_certificate>(read_certificate(in)));
  EXPECT_TRUE(verdict.accepted) << verdict.why << '\n' << text;
}

void expect_events_among_candidates(const Polygon_soup& soup, const Exact_point& from, const Exact_point& to,
                                    bool two_sided, Met& met) {
  constexpr std::size_t most_lines = 26;  // they have 2,600 triples
  const Scene scene(soup);
  if (scene.pieces().empty() || from == to || lines_of(scene).size() > most_lines) return;
  ++met.scenes;
  const Occluders occluders(scene);
  Along_options options;
  options.threads = 1;
  options.two_sided = two_sided;
  const Visible_along along = visible_along(occluders, from, to, options);
  expect_certified(scene, soup, from, to, two_sided);
  const Piece_boxes boxes(scene);
  const std::vector<Quadratic_root> all = candidates(scene, from, to);
  for (const Along_event& event : along.events) {
    EXPECT_TRUE(std::binary_search(all.begin(), all.end(), event.t)) << event.t.near();
    met.irrational += !event.t.rational();
    for (const Along_event::Change& change : event.changes) {
      EXPECT_EQ(harness::flaw_of_change(scene, from, to, event.t, change), "")
          << "face " << change.face << " at " << event.t.near();
      met.triples += change.kind == Along_kind::triple;
      met.momentary += change.before == change.after;
      met.contacts += change.kind == Along_kind::contact;
    }
  }
  met.events += along.events.size();
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (const auto t = all[k].rational(); t && k % 8 == 0) {
      EXPECT_EQ(after_events(along, all[k]), seen_from(scene, boxes, point_at(from, to, *t), two_sided)) << *t;
    }
    if (k + 1 == all.size()) break;
    const Rational t = inner_rational({all[k], all[k + 1]});
    ASSERT_EQ(after_events(along, moment(t)), seen_from(scene, boxes, point_at(from, to, t), two_sided)) << t;
  }
}

TEST(Along, events_are_those_among_all_candidates) {
  Met met;
  for (const generate::Family& family : generate::families())
    for (std::uint64_t seed = 0; seed < (test_scenes::is_sanitized() ? 1U : 4U); ++seed) {
      generate::Family_parameters parameters;
      parameters.seed = seed;
      parameters.size = family.small_size;
      const generate::Posed_scene posed = family.make(parameters);
      SCOPED_TRACE(posed.name);
      const Scene scene(posed.soup);
      if (scene.pieces().empty() || scene.pieces().size() > 6) continue;
      // To beyond a corner, or past all of it.
      const Exact_point corner = scene.position(scene.corners(scene.pieces().back())[0].point), &from = posed.eye,
                        past{from[0] - 5, from[1] + Rational(31, 7), from[2] + 3};
      expect_events_among_candidates(posed.soup, from, seed % 2 == 0 ? point_at(from, corner, Rational(3, 2)) : past,
                                     seed % 3 == 2, met);
    }
  EXPECT_GE(met.scenes, test_scenes::least(std::size_t{80}));
  EXPECT_GE(met.events, test_scenes::least(std::size_t{160}));
  EXPECT_GE(met.contacts, test_scenes::least(std::size_t{12}));
}

TEST(Along, events_of_triangles_anywhere_are_those_among_all_candidates) {
  Met met;
  generate::Random random(20);
  const auto place = [&](std::int64_t reach) {
    return Exact_point{random.between(-reach, reach), random.between(-reach, reach), random.between(-reach, reach)};
  };
  for (std::size_t n = 0; n < test_scenes::sample(std::size_t{20}); ++n) {
    Polygon_soup soup;
    for (std::size_t face = 0; face < 5; ++face) {
      std::vector<Point_id> ids;
      for (std::size_t k = 0; k < 3; ++k) {
        const Exact_point p = place(n % 2 == 0 ? 3 : 60);
        ids.push_back(soup.add_point(p[0], p[1], p[2]));
      }
      soup.add_face(ids);
    }
    SCOPED_TRACE(n);
    const std::int64_t reach = n % 2 == 0 ? 4 : 80;
    const Exact_point from = place(reach);
    expect_events_among_candidates(soup, from, place(reach), n % 3 != 0, met);
  }
  EXPECT_GE(met.scenes, test_scenes::least(std::size_t{18}));
  EXPECT_GE(met.irrational, test_scenes::least(std::size_t{2}));
  EXPECT_GE(met.momentary, test_scenes::least(std::size_t{4}));
}

/// A square with this middle, half as long and high, across the x axis, that looks to lower x.
void add_wall(Polygon_soup& soup, int x, int y, int z, int half) {
  const Point_id a = soup.add_point(x, y - half, z - half), b = soup.add_point(x, y - half, z + half),
                 c = soup.add_point(x, y + half, z + half), d = soup.add_point(x, y + half, z - half);
  soup.add_face({a, b, c, d});
}

TEST(Along, a_wall_hides_another_one_until_the_eye_is_far_enough_aside) {
  Polygon_soup soup;
  add_wall(soup, 2, 0, 0, 2);  // in front, from y = -2 to 2
  add_wall(soup, 4, 0, 0, 1);  // behind it
  const Scene scene(soup);
  const Occluders occluders(scene);
  // From (0, y) the corner (2, 2) hides y = 1 at x = 4 until y = 3.
  const Visible_along along = visible_along(occluders, {0, 0, 0}, {0, 4, 0});
  EXPECT_EQ(along.at_start, std::vector<Face_id>{0});
  EXPECT_EQ(along.at_end, (std::vector<Face_id>{0, 1}));
  ASSERT_EQ(along.events.size(), 1U);
  EXPECT_EQ(along.events[0].t.rational(), Rational(3, 4));
  ASSERT_EQ(along.events[0].changes.size(), 1U);
  const Along_event::Change& change = along.events[0].changes[0];
  EXPECT_EQ(change.face, 1U);
  EXPECT_EQ(change.kind, Along_kind::edge_vertex);
  EXPECT_FALSE(change.before || change.at);
  EXPECT_TRUE(change.after);
}

TEST(Along, an_eye_on_a_wall_sees_both_sides_of_it) {
  Polygon_soup soup;
  add_wall(soup, 2, 0, 0, 2);
  add_wall(soup, 4, 0, 0, 1);
  const Scene scene(soup);
  const Occluders occluders(scene);
  const Visible_along through = visible_along(occluders, {0, 0, 0}, {8, 0, 0});
  // At x = 2 it leaves the first wall's front and is on it; the second one is seen until x = 4.
  ASSERT_EQ(through.events.size(), 2U);
  EXPECT_EQ(through.events[0].t.rational(), Rational(1, 4));
  ASSERT_EQ(through.events[0].changes.size(), 2U);
  EXPECT_EQ(through.events[0].changes[0].kind, Along_kind::plane);
  EXPECT_EQ(through.events[0].changes[1].kind, Along_kind::contact);
  EXPECT_TRUE(through.events[0].changes[1].at);
  EXPECT_EQ(through.events[1].t.rational(), Rational(1, 2));
  EXPECT_TRUE(through.at_end.empty());
  // Both sides: the first wall is edge-on for a moment, and hides the second one again from no point.
  Along_options both;
  both.two_sided = true;
  const Visible_along two_sided = visible_along(occluders, {1, 0, 0}, {3, 0, 0}, both);
  ASSERT_EQ(two_sided.events.size(), 1U);
  const Along_event::Change& first = two_sided.events[0].changes[0];
  EXPECT_TRUE(first.before && !first.at && first.after);
}

TEST(Along, a_path_in_a_plane_sees_nothing_of_it_and_one_without_length_is_an_error) {
  Polygon_soup soup;
  add_wall(soup, 2, 0, 0, 2);
  const Scene scene(soup);
  const Occluders occluders(scene);
  const Visible_along along = visible_along(occluders, {2, -5, 0}, {2, 5, 0});
  EXPECT_TRUE(along.events.empty());
  EXPECT_TRUE(along.visible.empty());
  EXPECT_THROW(visible_along(occluders, {1, 2, 3}, {1, 2, 3}), std::invalid_argument);
}

TEST(Along, is_the_same_with_any_number_of_threads) {
  const Scene scene(read_scene(std::string(SIGHTLINE_SOURCE_DIR) + "/tests/corpus/general/two_rooms.off"));
  const Occluders occluders(scene);
  const auto changes_with = [&](int threads) {
    Along_options options;
    options.threads = threads;
    std::string text;
    for (const Along_event& event :
         visible_along(occluders, {1, Rational(3, 2), Rational(3, 2)}, {7, Rational(3, 2), Rational(3, 2)}, options)
             .events)
      for (const Along_event::Change& change : event.changes)
        text += event.t.polynomial().c[0].get_str() + ' ' + std::to_string(change.face) + ' ';
    return text;
  };
  const std::string alone = changes_with(1);
  EXPECT_FALSE(alone.empty());
  EXPECT_EQ(alone, changes_with(5));
}

TEST(Along, can_be_given_up_within_a_face) {
  // A budget of seconds ends what is asked of one large face, not only what is asked of the next one.
  const Scene scene(generate::triangles_between_squares(60, 3));
  const Occluders occluders(scene);
  std::size_t told = 0;
  Along_options options;
  options.threads = 1;
  options.progress = [&](std::size_t done, std::size_t all) {
    EXPECT_LE(done, all);
    ++told;
  };
  visible_along(occluders, {0, 0, 1}, {1, 1, 1}, options);
  EXPECT_GT(told, 3 * scene.pieces().size());
  struct Given_up {};
  options.progress = [&](std::size_t, std::size_t) {
    if (--told == 2) throw Given_up();
  };
  EXPECT_THROW(visible_along(occluders, {0, 0, 1}, {1, 1, 1}, options), Given_up);
}

TEST(Along, three_skew_edges_open_at_an_irrational_moment) {
  // Half-planes behind one another, each bounded by one of three skew lines; what is behind is seen through their gap.
  Polygon_soup soup;
  const auto triangle = [&](Exact_point a, Exact_point b, Exact_point c) {
    std::vector<Point_id> ids;
    for (const Exact_point& p : {a, b, c}) ids.push_back(soup.add_point(p[0], p[1], p[2]));
    soup.add_face(ids);
  };
  triangle({2, -40, -1}, {2, 40, 3}, {2, 0, 90});
  triangle({3, -40, 40}, {3, 37, -40}, {3, -90, -90});
  triangle({5, 41, 45}, {5, -35, -40}, {5, 90, -90});
  triangle({9, -60, -60}, {9, 0, 60}, {9, 60, -60});
  const Scene scene(soup);
  const Occluders occluders(scene);
  Along_options both;
  both.two_sided = true;
  const Visible_along along = visible_along(occluders, {-3, 1, -9}, {0, -2, 12}, both);
  const std::vector<Quadratic_root> all = candidates(scene, {-3, 1, -9}, {0, -2, 12});
  const bool is_triple = std::any_of(along.events.begin(), along.events.end(), [&](const Along_event& event) {
    return event.changes[0].kind == Along_kind::triple && !event.t.rational() &&
           std::binary_search(all.begin(), all.end(), event.t);
  });
  EXPECT_TRUE(is_triple);
}

TEST(Along_certificate, has_moments_apart_however_near_they_are) {
  // sqrt(1/2), and a root 2^-42 from it, as two faces appear and vanish.
  const Quadratic_root one(Integer(0), 1, Integer(2), Integer(2)),
      other(Integer(0), 1, Integer((Integer(1) << 41) + 1), Integer(Integer(1) << 21));
  Polygon_soup soup;
  soup.add_face({soup.add_point(0, 0, 0), soup.add_point(1, 0, 0), soup.add_point(0, 1, 0)});
  Visible_along found;
  found.faces.push_back({0, {Parameter_range{one, other}}, {}});
  const Along_certificate claim = along_certificate(Scene(soup), found, {0, 0, 1}, {1, 0, 1}, false);
  ASSERT_EQ(claim.moments.size(), 4u);
  for (std::size_t k = 0; k < 3; ++k) EXPECT_LT(claim.moments[k].high, claim.moments[k + 1].low) << k;
}

}  // namespace
