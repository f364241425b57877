// Lines where faces cross, and lines along the rim of a field, against brute force.

#include "support.h"

#include "../sample.h"

#include <sightline/algorithms/point_visibility/crossings.h>
#include <sightline/algorithms/point_visibility/hidden_lines.h>
#include <sightline/harness/generate/buildings.h>

#include <gtest/gtest.h>

#include <sys/resource.h>

#include <map>
#include <set>

namespace sightline::see_test {
namespace {

using oracle::Half_space;
using view_scenes::Points;
using view_scenes::Random;

/// A segment by its ends, the lower first, and the faces that cross there.
struct Segment {
  Exact_point from, to;
  std::vector<Face_id> faces;
  friend bool operator==(const Segment&, const Segment&) = default;
  friend bool operator<(const Segment& a, const Segment& b) {
    return std::tie(a.from, a.to, a.faces) < std::tie(b.from, b.to, b.faces);
  }
};
std::ostream& operator<<(std::ostream& out, const Segment& s) {
  for (const Exact_point& p : {s.from, s.to}) out << '(' << p[0] << ' ' << p[1] << ' ' << p[2] << ") ";
  for (const Face_id face : s.faces) out << face << ' ';
  return out;
}

/// Whether all of a field's sides have a point in front or in them.
bool is_inside(const std::vector<Half_space>& field, const Exact_point& p) {
  return std::all_of(field.begin(), field.end(), [&](const Half_space& side) { return sgn(side.height(p)) >= 0; });
}

/// Whether a flat holds x, which no edge off the line x + t u holds, and what is next to it in direction v.
bool holds_beside(const oracle::Flat& flat, const Exact_point& x, const Exact_point& v) {
  for (const Half_space& wall : oracle::walls(flat.corners, flat.plane.normal)) {
    const int at = sgn(wall.height(x));
    if (at < 0 || (at == 0 && sgn(oracle::dot(wall.normal, v)) < 0)) return false;
  }
  return true;
}

/// The faces that hold a point of a line in planes whose union has it inside, if these are two or more; and the planes,
/// by a flat of each. Pre: `flats` are in planes that hold the line.
std::pair<std::set<Face_id>, std::set<std::size_t>> crossing_at(const oracle::Flats& flats,
                                                                const std::vector<std::size_t>& around,
                                                                const Exact_point& direction, const Exact_point& x) {
  std::set<Face_id> faces;
  std::set<std::size_t> planes;
  for (const std::size_t i : around) {
    const auto first = [&](std::size_t k) { return oracle::coplanar(flats[i], flats[k]); };
    if (*std::find_if(around.begin(), around.end(), first) != i) continue;
    const Exact_point left = oracle::cross(direction, flats[i].plane.normal), right = oracle::minus({0, 0, 0}, left);
    std::set<Face_id> on_left, on_right;
    for (const std::size_t k : around)
      if (first(k)) {
        if (holds_beside(flats[k], x, left)) on_left.insert(flats[k].face);
        if (holds_beside(flats[k], x, right)) on_right.insert(flats[k].face);
      }
    if (on_left.empty() || on_right.empty()) continue;
    planes.insert(i);
    faces.insert(on_left.begin(), on_left.end());
    faces.insert(on_right.begin(), on_right.end());
  }
  if (planes.size() < 2) return {};
  return {faces, planes};
}

/// Where faces cross as an eye sees it, by definition: the line of each pair of flats is cut wherever anything can
/// change, and the middle of each stretch is asked.
std::set<Segment> crossings_seen(const oracle::Flats& flats, const Exact_point& eye,
                                 const std::vector<Half_space>& field = {}) {
  using namespace oracle;
  std::set<Segment> found;
  std::set<std::pair<Exact_point, Exact_point>> done;
  for (std::size_t f = 0; f < flats.size(); ++f)
    for (std::size_t g = 0; g < f; ++g) {
      // The line: a point where its main coordinate is 0, and a direction where that is 1.
      Exact_point d = cross(flats[f].plane.normal, flats[g].plane.normal);
      if (is_zero(d)) continue;
      const std::size_t k = sgn(d[0]) != 0 ? 0 : sgn(d[1]) != 0 ? 1 : 2, i = (k + 1) % 3, j = (k + 2) % 3;
      const Rational length = d[k];
      for (Rational& x : d) x /= length;
      const Exact_point &m = flats[f].plane.normal, &n = flats[g].plane.normal;
      const Rational a = flats[f].plane.offset, b = flats[g].plane.offset, whole = Rational(m[i] * n[j] - m[j] * n[i]);
      Exact_point x0{0, 0, 0};
      x0[i] = (a * n[j] - m[j] * b) / whole;
      x0[j] = (m[i] * b - a * n[i]) / whole;
      if (!done.insert({x0, d}).second) continue;

      // Where anything can change.
      std::set<Rational> places;
      const auto cut = [&](const Half_space& h) {
        const Rational rise = dot(h.normal, d);
        if (sgn(rise) != 0) places.insert(Rational(-h.height(x0) / rise));
      };
      const Exact_point across = cross(d, minus(x0, eye));  // zero: the eye is on the line, and sees none of it
      if (is_zero(across)) continue;
      std::vector<std::size_t> around;
      for (std::size_t h = 0; h < flats.size(); ++h) {
        cut(flats[h].plane);
        for (const Half_space& wall : walls(flats[h].corners, flats[h].plane.normal)) cut(wall);
        for (std::size_t c = 0; c < flats[h].corners.size(); ++c) {
          const Exact_point p = flats[h].corners[c], q = flats[h].corners[(c + 1) % flats[h].corners.size()];
          const Exact_point normal = cross(minus(p, eye), minus(q, eye)), beside = cross(minus(p, eye), across);
          cut({normal, dot(normal, eye)});
          cut({beside, dot(beside, eye)});
        }
        if (sgn(flats[h].height(x0)) == 0 && sgn(dot(flats[h].plane.normal, d)) == 0) around.push_back(h);
      }
      for (const Half_space& side : field) cut(side);

      // Each stretch, joined with the one before where nothing does change.
      std::optional<Segment> open;
      std::set<std::size_t> open_planes;
      for (auto at = places.begin(); at != places.end(); ++at) {
        const auto next = std::next(at);
        std::set<Face_id> faces;
        std::set<std::size_t> planes;
        if (next != places.end()) {
          const Exact_point middle = along(x0, Rational((*at + *next) / 2), d);
          std::tie(faces, planes) = crossing_at(flats, around, d, middle);
          if (!is_inside(field, middle) || (!faces.empty() && !is_sightline(flats, eye, middle))) faces.clear();
        }
        if (open && (planes != open_planes || std::vector<Face_id>(faces.begin(), faces.end()) != open->faces)) {
          found.insert(*open);
          open.reset();
        }
        if (faces.empty()) continue;
        if (!open) {
          open = Segment{along(x0, *at, d), {}, {faces.begin(), faces.end()}};
          open_planes = planes;
        }
        open->to = along(x0, *next, d);
      }
    }
  return found;
}

std::set<Segment> segments(const std::vector<Drawn_crossing>& drawn) {
  std::set<Segment> found;
  for (const Drawn_crossing& c : drawn)
    EXPECT_TRUE(found.insert({std::min(c.ends[0], c.ends[1]), std::max(c.ends[0], c.ends[1]), c.faces}).second)
        << "listed twice";
  return found;
}
std::set<Segment> crossings_in(const Polygon_soup& soup, const Exact_point& eye) {
  const Scene scene(soup);
  const Exact_view view(scene, eye);
  const Piece_boxes boxes(scene);
  return segments(visible_crossings(view, visible_surface(view, boxes), boxes, 1));
}

/// Faces on a small lattice, many of them in one plane or through one line, and an eye on it.
view_scenes::Case on_a_small_lattice(std::uint64_t seed) {
  Random random(seed);
  const auto any = [&] { return static_cast<long>(random.between(-2, 2)); };
  std::vector<Points> faces;
  for (std::size_t count = 2 + random.below(5); count > 0; --count) {
    const Exact_point p{any(), any(), any()}, q{any(), any(), any()}, r{any(), any(), any()};
    if (oracle::is_zero(oracle::cross(oracle::minus(q, p), oracle::minus(r, p)))) continue;
    const Exact_point s = oracle::along(p, 1, oracle::minus(r, q));
    faces.push_back(random.chance(1, 2) ? Points{p, q, r} : Points{p, q, r, s});
  }
  if (faces.empty()) faces.push_back(view_scenes::rectangle(0, 1, 0, 1, 0));
  const auto away = [&] { return static_cast<long>(random.between(-4, 4)); };
  return {"lattice " + std::to_string(seed), view_scenes::soup_of(faces), {away(), away(), away()}};
}

/// Pages through the z-axis, strips that may hide them, and an eye in the plane of a page, as often as not.
view_scenes::Case pages_through_a_line(std::uint64_t seed) {
  Random random(seed);
  const auto any = [&](int least, int most) { return static_cast<long>(random.between(least, most)); };
  std::vector<Points> faces;
  Exact_point way;
  for (std::size_t count = 2 + random.below(4); count > 0; --count) {
    way = {any(-2, 2), any(-2, 2), 0};
    if (oracle::is_zero(way)) way[0] = 1;
    const auto corner = [&](int side, long z) { return Exact_point{way[0] * side, way[1] * side, z}; };
    const long low[] = {any(-4, 0), any(-4, 0)}, high[] = {any(1, 4), any(1, 4)};
    faces.push_back({corner(-1, low[0]), corner(1, low[1]), corner(1, high[0]), corner(-1, high[1])});
  }
  const long far = any(3, 6);
  const Exact_point eye{way[0] * far, way[1] * far, any(-2, 2)};
  for (std::size_t count = random.below(3); count > 0; --count) {
    const Exact_point at{way[0] * 2, way[1] * 2, Rational(any(-8, 8)) / 3}, across{-way[1], way[0], 0};
    faces.push_back({oracle::along(at, -1, across), oracle::along(at, 1, across),
                     oracle::along(oracle::along(at, 1, across), 1, {0, 0, Rational(1) / 4}),
                     oracle::along(oracle::along(at, -1, across), 1, {0, 0, Rational(1) / 4})});
  }
  std::rotate(faces.begin(), faces.begin() + any(0, static_cast<int>(faces.size()) - 1), faces.end());
  return {"pages " + std::to_string(seed), view_scenes::soup_of(faces), eye};
}

TEST(Crossing_lines, that_a_face_in_the_plane_of_the_eye_ends_are_those_of_brute_force) {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{300}) && !HasFailure(); ++seed) {
    const view_scenes::Case given = pages_through_a_line(seed);
    SCOPED_TRACE(given.name);
    const std::set<Segment> found = crossings_in(given.soup, given.eye);
    EXPECT_EQ(found, crossings_seen(oracle::flats_of(Scene(given.soup)), given.eye, {}));
    seen += found.size();
  }
  EXPECT_GT(seen, test_scenes::least(std::size_t{100}));
}

TEST(Crossing_lines, of_small_lattices_are_those_of_brute_force) {
  std::size_t seen = 0;
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{150}) && !testing::Test::HasFailure();
       ++seed) {
    const view_scenes::Case given = on_a_small_lattice(seed);
    SCOPED_TRACE(given.name);
    const std::set<Segment> found = crossings_in(given.soup, given.eye);
    EXPECT_EQ(found, crossings_seen(oracle::flats_of(Scene(given.soup)), given.eye));
    seen += found.size();
  }
  EXPECT_GT(seen, test_scenes::least(std::size_t{100}));
}

class Crossing_lines_in : public testing::TestWithParam<view_scenes::Family> {};

TEST_P(Crossing_lines_in, are_those_of_brute_force) {
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{6}) && !HasFailure(); ++seed)
    for (const view_scenes::Case& given : view_scenes::make(GetParam(), seed)) {
      SCOPED_TRACE(given.name);
      EXPECT_EQ(crossings_in(given.soup, given.eye), crossings_seen(oracle::flats_of(Scene(given.soup)), given.eye));
    }
}
INSTANTIATE_TEST_SUITE_P(All, Crossing_lines_in, testing::ValuesIn(view_scenes::families),
                         [](const auto& of) { return std::string(view_scenes::name(of.param)); });

// ---- By hand

/// Rectangles through the y-axis between y = -3 and 3, z = slope x for |x| <= 3.
Points ramp(long slope) { return {{-3, -3, -3 * slope}, {3, -3, 3 * slope}, {3, 3, 3 * slope}, {-3, 3, -3 * slope}}; }

TEST(Crossing_lines, through_one_line_are_one_and_do_not_depend_on_the_order_of_faces) {
  std::vector<Points> faces{ramp(1), ramp(-1), ramp(2)};
  for (int turn = 0; turn < 3; ++turn) {
    EXPECT_EQ(crossings_in(view_scenes::soup_of(faces), {view_scenes::ratio(1, 9), view_scenes::ratio(1, 4), 12}),
              (std::set<Segment>{{{0, -3, 0}, {0, 3, 0}, {0, 1, 2}}}));
    std::rotate(faces.begin(), faces.begin() + 1, faces.end());
  }
}

TEST(Crossing_lines, of_many_faces_through_one_line_take_memory_in_proportion_to_these) {
  const int n = test_scenes::is_sanitized() ? 100 : 1000;
  std::vector<Points> faces;
  for (int i = 0; i < n; ++i) faces.push_back({{n, i, -1}, {n, i, 1}, {-n, -i, 1}, {-n, -i, -1}});
  const Scene scene(view_scenes::soup_of(faces));
  const Piece_boxes boxes(scene);
  rusage before, after;
  getrusage(RUSAGE_SELF, &before);
  const std::vector<Crossing> found = crossings(scene, boxes);
  getrusage(RUSAGE_SELF, &after);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].faces.size(), faces.size());
  if (test_scenes::is_sanitized()) GTEST_SKIP() << "memory is what sanitizers have it be";
  EXPECT_LT(after.ru_maxrss - before.ru_maxrss, 40000);  // kB; all pairs take 80 000
}

TEST(Crossing_lines, that_a_third_face_hides_are_not_listed_in_any_order) {
  // Slopes 1 and -1 cross at x = 0, under a roof that crosses both where it ends.
  std::vector<std::pair<int, Points>> faces{
      {0, ramp(1)}, {1, ramp(-1)}, {2, {{-2, -4, 1}, {2, -4, 1}, {2, 4, 1}, {-2, 4, 1}}}};
  std::sort(faces.begin(), faces.end());
  do {
    std::vector<Points> points;
    for (const auto& [name, face] : faces) points.push_back(face);
    std::set<std::pair<Exact_point, std::set<int>>> found;
    for (const Segment& s : crossings_in(view_scenes::soup_of(points), {view_scenes::ratio(1, 7), 0, 12})) {
      EXPECT_EQ(s.from[1], -3);
      EXPECT_EQ(s.to[1], 3);
      std::set<int> of;
      for (const Face_id face : s.faces) of.insert(faces[face].first);
      found.insert({s.from, of});
    }
    EXPECT_EQ(found, (std::set<std::pair<Exact_point, std::set<int>>>{{{-1, -3, 1}, {1, 2}}, {{1, -3, 1}, {0, 2}}}));
  } while (std::next_permutation(faces.begin(), faces.end()));
}

TEST(Crossing_lines, between_faces_that_are_not_seen_are_listed_where_what_is_seen_ends_in_them) {
  // A valley, steeper than the ramps and on top of them: what it hides meets its bottom from below.
  std::vector<Points> faces{{{0, -4, 0}, {4, -4, 8}, {4, 4, 8}, {0, 4, 0}},
                            {{-4, -4, 8}, {0, -4, 0}, {0, 4, 0}, {-4, 4, 8}},
                            ramp(1),
                            ramp(-1)};
  const Exact_point eye{view_scenes::ratio(1, 9), view_scenes::ratio(1, 4), 12};
  const Scene scene(view_scenes::soup_of(faces));
  EXPECT_EQ(visible_surface(Exact_view(scene, eye), Piece_boxes(scene)).visible, (std::vector<Face_id>{0, 1}));
  EXPECT_EQ(crossings_in(view_scenes::soup_of(faces), eye), (std::set<Segment>{{{0, -3, 0}, {0, 3, 0}, {2, 3}}}));
  // Through the bottom, the lower half of a wall that goes on as one side of the valley does not.
  faces[2] = {{-3, -3, -3}, {0, -3, 0}, {0, 3, 0}, {-3, 3, -3}};
  faces.push_back({{0, -2, 0}, {3, -2, 3}, {3, 2, 3}, {0, 2, 0}});
  EXPECT_EQ(crossings_in(view_scenes::soup_of(faces), eye), (std::set<Segment>{{{0, -2, 0}, {0, 2, 0}, {2, 3, 4}}}));
}

TEST(Crossing_lines, are_sought_on_what_is_seen) {
  constexpr std::size_t n = 30;
  const Scene scene(generate::lattice(n));
  const Piece_boxes boxes(scene);
  std::vector<bool> some(scene.pieces().size(), false);
  EXPECT_TRUE(crossings_on(some, scene, boxes).empty());
  some[0] = true;  // a side of the cube, which no other square goes through
  EXPECT_TRUE(crossings_on(some, scene, boxes).empty());
  some[n / 2] = true;
  EXPECT_EQ(crossings_on(some, scene, boxes).size(), 2 * (n - 1));
  EXPECT_EQ(crossings(scene, boxes).size(), 3 * (n - 1) * (n - 1));
}

TEST(Crossing_lines, in_the_side_plane_of_an_octant_are_listed) {
  for (const Exact_point& eye : {Exact_point{0, view_scenes::ratio(1, 5), 9}, Exact_point{0, 0, 9}})
    EXPECT_EQ(crossings_in(view_scenes::soup_of({ramp(1), ramp(-1)}), eye),
              (std::set<Segment>{{{0, -3, 0}, {0, 3, 0}, {0, 1}}}));
}

TEST(Crossing_lines, are_none_where_a_face_ends_on_another_or_is_edge_on) {
  using view_scenes::rectangle;
  const Points floor = rectangle(-3, 3, -3, 3, 0);
  const Points up{{0, -1, 0}, {0, 1, 0}, {0, 1, 2}, {0, -1, 2}},
      through{{0, -1, -2}, {0, 1, -2}, {0, 1, 2}, {0, -1, 2}};
  EXPECT_TRUE(crossings_in(view_scenes::soup_of({floor, up}), {3, 0, 9}).empty());
  EXPECT_EQ(crossings_in(view_scenes::soup_of({floor, through}), {3, 0, 9}).size(), 1u);
  EXPECT_TRUE(crossings_in(view_scenes::soup_of({floor, through}), {0, 0, 9}).empty());
}

TEST(Crossing_lines, go_through_a_face_in_two_as_through_one) {
  using view_scenes::rectangle;
  // The floor is cut along the line, and the wall across it: up to who holds what, the points are the same.
  const Points through{{0, -1, -2}, {0, 1, -2}, {0, 1, 2}, {0, -1, 2}};
  const auto whole = crossings_in(view_scenes::soup_of({rectangle(-3, 3, -3, 3, 0), through}), {3, 0, 9}),
             halves = crossings_in(
                 view_scenes::soup_of({rectangle(-3, 0, -3, 3, 0), rectangle(0, 3, -3, 3, 0), through}), {3, 0, 9});
  EXPECT_EQ(whole, (std::set<Segment>{{{0, -1, 0}, {0, 1, 0}, {0, 1}}}));
  EXPECT_EQ(halves, (std::set<Segment>{{{0, -1, 0}, {0, 1, 0}, {0, 1, 2}}}));
  // A wall up and a wall down are one surface.
  EXPECT_EQ(crossings_in(view_scenes::soup_of({rectangle(-3, 3, -3, 3, 0),
                                               {{0, -1, -2}, {0, 1, -2}, {0, 1, 0}, {0, -1, 0}},
                                               {{0, 0, 0}, {0, 2, 0}, {0, 2, 2}, {0, 0, 2}}}),
                         {3, 0, 9}),
            (std::set<Segment>{{{0, 0, 0}, {0, 1, 0}, {0, 1, 2}}}));
}

// ---- In a field of view

/// Four rays around an axis, at 45 degrees or less, so that a lattice has points in the sides.
std::vector<Exact_point> rays_around(std::size_t axis, long sense, long narrow) {
  std::vector<Exact_point> rays;
  for (const auto& [across, up] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    Exact_point& ray = rays.emplace_back(Exact_point{0, 0, 0});
    ray[axis] = sense * narrow;
    ray[(axis + 1) % 3] = across;
    ray[(axis + 2) % 3] = up;
  }
  if (sense < 0) std::reverse(rays.begin(), rays.end());
  return rays;
}
std::vector<Half_space> sides_of(const std::vector<Exact_point>& rays, const Exact_point& eye) {
  std::vector<Half_space> sides;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const Exact_point normal = oracle::cross(rays[k], rays[(k + 1) % rays.size()]);
    sides.push_back({normal, oracle::dot(normal, eye)});
  }
  return sides;
}

using Intervals = std::vector<std::pair<Rational, Rational>>;

/// What of the intervals of a + s (b - a) is in a field.
Intervals within(const std::vector<oracle::Interval>& intervals, const std::vector<Half_space>& field,
                 const Exact_point& a, const Exact_point& b) {
  Rational least = 0, most = 1;
  for (const Half_space& side : field) {
    const Rational at = side.height(a), rise = Rational(side.height(b) - at);
    if (sgn(rise) == 0 && sgn(at) < 0) return {};
    if (sgn(rise) > 0) least = std::max(least, Rational(-at / rise));
    if (sgn(rise) < 0) most = std::min(most, Rational(-at / rise));
  }
  Intervals found;
  for (const auto& i : intervals)
    if (const Rational from = std::max(i.from, least), to = std::min(i.to, most); from < to)
      found.push_back({from, to});
  return found;
}

void expect_lines_of_the_field(const Polygon_soup& soup, const Exact_point& eye, const std::vector<Exact_point>& rays) {
  const Scene scene(soup);
  const oracle::Flats flats = oracle::flats_of(scene);
  const std::vector<Half_space> field = sides_of(rays, eye);
  const Exact_view view(scene, eye, field_of(rays));
  const Piece_boxes boxes(scene);
  const auto surface = visible_surface(view, boxes, field_of_view(view));
  for (const Drawn_edge& drawn : hidden_lines(view, surface, 1)) {
    const Exact_point a = scene.position(drawn.edge.p), b = scene.position(drawn.edge.q);
    Intervals found;
    for (const Line_part& part : drawn.parts) {
      if (part.hidden_by != Line_part::nothing) continue;
      if (!found.empty() && found.back().second == part.from) found.back().second = part.to;
      else found.push_back({part.from, part.to});
    }
    EXPECT_EQ(found, within(oracle::visible_on_edge(flats, eye, a, b), field, a, b))
        << "points " << drawn.edge.p << " and " << drawn.edge.q;
  }
  EXPECT_EQ(segments(visible_crossings(view, surface, boxes, 1)), crossings_seen(flats, eye, field));
}

TEST(Lines_in_a_field, are_those_of_brute_force_on_its_rim_too) {
  for (std::uint64_t seed = 1; seed <= test_scenes::sample(std::uint64_t{60}) && !HasFailure(); ++seed) {
    const view_scenes::Case given = on_a_small_lattice(seed);
    SCOPED_TRACE(given.name);
    for (std::size_t axis = 0; axis < 3; ++axis)
      expect_lines_of_the_field(given.soup, given.eye,
                                rays_around(axis, given.eye[axis] > 0 ? -1 : 1, 1 + static_cast<long>(seed % 2)));
  }
}

TEST(Lines_in_a_field, in_its_side_are_hidden_by_what_touches_it_from_outside) {
  // A board that stands outside of the field, on its side x = y, before an edge in that side: from each of its corners.
  Points board{{3, 3, -2}, {5, 3, -2}, {5, 3, 2}, {3, 3, 2}};
  const Points sail{{6, 6, -1}, {6, 6, 1}, {0, 8, 0}};
  const std::vector<Exact_point> rays = rays_around(1, 1, 1);
  for (std::size_t first = 0; first < board.size(); ++first) {
    SCOPED_TRACE(first);
    const Polygon_soup soup = view_scenes::soup_of({board, sail});
    expect_lines_of_the_field(soup, {0, 0, 0}, rays);
    const Scene scene(soup);
    const Exact_view view(scene, {0, 0, 0}, field_of(rays));
    const auto surface = visible_surface(view, Piece_boxes(scene), field_of_view(view));
    std::size_t hidden = 0;
    for (const Drawn_edge& drawn : hidden_lines(view, surface, 1))
      if (scene.position(drawn.edge.p)[0] == 6 && scene.position(drawn.edge.q)[0] == 6) {
        ASSERT_EQ(drawn.parts.size(), 1u);
        EXPECT_EQ(drawn.parts[0].hidden_by, 0u);
        ++hidden;
      }
    EXPECT_EQ(hidden, 1u);
    std::rotate(board.begin(), board.begin() + 1, board.end());
  }
}

}  // namespace
}  // namespace sightline::see_test
