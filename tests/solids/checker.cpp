// The checker of set operations by itself: what two faces have in common, against clipping in rationals; sides in
// doubles, against rationals; certificates that are forged so that all but one step would accept them.

#include "shapes.h"

#include "../sample.h"

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/set_operation.h>
#include <sightline/algorithms/verify/solid_faces.h>
#include <sightline/algorithms/verify/solids.h>
#include <sightline/harness/generate/solids.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <random>
#include <set>

namespace {

using namespace sightline;
using namespace test_solids;
using certificate_check::Contact;
using certificate_check::Numbered_points;
using certificate_check::Solid_face;
using certificate_check::Solid_point;

using Triangle = std::array<Exact_point, 3>;

Rational dot(const Exact_point& a, const Exact_point& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Exact_point minus(const Exact_point& a, const Exact_point& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
Exact_point cross(const Exact_point& a, const Exact_point& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
Exact_point normal_of(const Triangle& t) { return cross(minus(t[1], t[0]), minus(t[2], t[0])); }

/// What has a form not negative, of the convex hull of points in a ring.
std::vector<Exact_point> clipped(const std::vector<Exact_point>& ring, const Exact_point& form,
                                 const Exact_point& from) {
  std::vector<Exact_point> left;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Exact_point &p = ring[k], &q = ring[(k + 1) % ring.size()];
    const Rational s = dot(form, minus(p, from)), t = dot(form, minus(q, from));
    if (s >= 0) left.push_back(p);
    if (sgn(s) * sgn(t) >= 0) continue;
    const Rational share = s / (s - t);
    left.push_back({p[0] + share * (q[0] - p[0]), p[1] + share * (q[1] - p[1]), p[2] + share * (q[2] - p[2])});
  }
  return left;
}

bool is_strictly_inside(const Triangle& t, const Exact_point& p) {
  for (std::size_t k = 0; k < 3; ++k)
    if (dot(cross(normal_of(t), minus(t[(k + 1) % 3], t[k])), minus(p, t[k])) <= 0) return false;
  return true;
}

/// By clipping one to the other.
struct Common {
  bool crossed = false;
  std::set<Exact_point> ends;
};
Common common_of(const Triangle& a, const Triangle& b) {
  const Exact_point n = normal_of(a);
  std::vector<Exact_point> ring(b.begin(), b.end());
  ring = clipped(clipped(ring, n, a[0]), minus({}, n), a[0]);
  for (std::size_t k = 0; k < 3; ++k) ring = clipped(ring, cross(n, minus(a[(k + 1) % 3], a[k])), a[k]);
  Common common{false, {ring.begin(), ring.end()}};
  if (common.ends.size() < 2) return common;
  Exact_point middle{};
  for (const Exact_point& p : common.ends)
    for (std::size_t k = 0; k < 3; ++k) middle[k] += p[k] / Rational(static_cast<unsigned long>(common.ends.size()));
  common.crossed = is_strictly_inside(a, middle) || is_strictly_inside(b, middle);
  return common;
}
bool is_edge(const Triangle& t, const std::set<Exact_point>& ends) {
  for (std::size_t k = 0; k < 3; ++k)
    if (ends == std::set<Exact_point>{t[k], t[(k + 1) % 3]}) return true;
  return false;
}

/// With planes known: of each corner, which of the faces' planes hold it.
Contact contact_of(const std::vector<Exact_point>& a, const std::vector<Exact_point>& b, bool with_planes = false) {
  Numbered_points points;
  std::array<std::vector<Numbered_points::Number>, 2> numbers;
  for (const Exact_point& p : a) numbers[0].push_back(points.add(p));
  for (const Exact_point& p : b) numbers[1].push_back(points.add(p));
  std::vector<Solid_point> near;
  for (Numbered_points::Number k = 0; k < points.size(); ++k) near.emplace_back(points[k]);
  std::array<Solid_face, 2> faces{Solid_face(numbers[0], near), Solid_face(numbers[1], near)};
  for (std::uint32_t k = 0; k < 2 && with_planes; ++k) {
    faces[k].plane_number = k == 1 && is_in_plane_of(faces[0], faces[1]) ? 0 : k;
    for (Solid_point& p : near)
      if (faces[k].side(p) == 0) p.planes.push_back(faces[k].plane_number);
  }
  return certificate_check::contact_of(faces[0], faces[1]);
}

TEST(Checker, what_faces_have_in_common_is_what_clipping_in_rationals_leaves) {
  std::mt19937 random(5);
  const Rational tiny(1, Integer(1) << 70), huge = Rational(Integer(1) << 600);
  std::map<std::string, int> cases;
  for (int k = 0; k < test_scenes::sample(6000); ++k) {
    std::array<Triangle, 2> t;
    for (Triangle& one : t)
      for (Exact_point& p : one)
        for (Rational& x : p) {
          x = static_cast<long>(random() % 3);
          if (k % 3 == 1 && random() % 4 == 0) x += tiny * static_cast<long>(random() % 3);
          if (k % 3 == 2) x *= k % 2 == 0 ? huge : Rational(1 / huge);
        }
    if (random() % 2 == 0) t[1][random() % 3] = t[0][random() % 3];
    if (random() % 3 == 0) t[1][random() % 3] = t[0][random() % 3];
    if (normal_of(t[0]) == Exact_point{} || normal_of(t[1]) == Exact_point{}) continue;
    const Common common = common_of(t[0], t[1]);
    const bool is_whole = common.ends.size() < 2 || (is_edge(t[0], common.ends) && is_edge(t[1], common.ends));
    const std::vector<Exact_point> one(t[0].begin(), t[0].end()), other(t[1].begin(), t[1].end());
    for (const Contact found : {contact_of(one, other), contact_of(other, one), contact_of(one, other, true)}) {
      ASSERT_EQ(found == Contact::crossed, common.crossed) << k;
      ASSERT_TRUE(found != Contact::little || is_whole) << k;
      ++cases[common.crossed ? "crossed" : !is_whole ? "edges" : found == Contact::little ? "little" : "not told"];
    }
  }
  EXPECT_GT(cases["crossed"], test_scenes::least(1500));
  EXPECT_GT(cases["edges"], test_scenes::least(100));
  EXPECT_GT(cases["little"], test_scenes::least(1500));
  EXPECT_LT(cases["not told"], cases["little"]);
}

TEST(Checker, edges_on_one_line_share_what_is_in_both) {
  // Upright and lying triangles with edges on the axis x: what they share is a point, or part of an edge.
  const auto lying = [](int from, int to) { return std::vector<Exact_point>{{from, 0, 0}, {to, 0, 0}, {from, 5, 0}}; };
  const auto upright = [](int from, int to) {
    return std::vector<Exact_point>{{to, 0, 0}, {from, 0, 0}, {from, 0, 5}};
  };
  for (int from = -4; from <= 4; ++from)
    for (int to = from + 1; to <= 5; ++to) {
      const int shared = std::min(to, 2) - std::max(from, 0);  // with that from 0 to 2
      const Contact expected = shared <= 0 || (from == 0 && to == 2) ? Contact::little : Contact::edges;
      for (const bool with_planes : {false, true}) {
        EXPECT_EQ(contact_of(lying(0, 2), upright(from, to), with_planes), expected) << from << ' ' << to;
        EXPECT_EQ(contact_of(upright(from, to), lying(0, 2), with_planes), expected) << from << ' ' << to;
      }
    }
}

TEST(Checker, stretches_of_one_line_that_touch_or_are_apart_are_little) {
  // Triangles that both pass the axis x, from a tip to the middle of an edge: one ends at 0, the other begins near it.
  const auto across = [](const Rational& tip, const Rational& middle, int y, int z) {
    return std::vector<Exact_point>{{tip, 0, 0}, {middle, y, z}, {middle, -y, -z}};
  };
  const std::vector<Exact_point> left = across(-2, 0, 0, 3);
  for (const auto& [y, z] : {std::pair{3, 0}, {1, 1}, {1, -4}, {7, 2}})
    for (const Rational& gap : {Rational(0), Rational(1, 3), Rational(-1, 3), Rational(1, Integer(1) << 90)}) {
      const std::vector<Exact_point> right = across(3 + gap, gap, y, z);
      for (const bool with_planes : {false, true}) {
        const Contact expected = gap < 0 ? Contact::crossed : Contact::little;
        EXPECT_EQ(contact_of(left, right, with_planes), expected) << y << ' ' << z << ' ' << gap;
        EXPECT_EQ(contact_of(right, left, with_planes), expected) << y << ' ' << z << ' ' << gap;
      }
    }
}

TEST(Checker, quotients_and_points_above_others_are_near_what_they_should_be) {
  using certificate_check::Near;
  std::mt19937_64 random(7);
  const auto number = [&] {
    return std::ldexp(static_cast<double>(random() >> 11) - 0x1p52, -50 + static_cast<int>(random() % 9));
  };
  int told = 0;
  for (int k = 0; k < test_scenes::sample(5000); ++k) {
    // 1. Of any two numbers near others.
    const double a = number(), b = number(), scale = std::ldexp(1, -static_cast<int>(random() % 60));
    const Rational da = exact(a * scale), db = exact(b * scale);
    const Near quotient = Near{a, std::fabs(a * scale)} / Near{b, std::fabs(b * scale)};
    for (const auto& [x, y] : {std::pair<Rational, Rational>{exact(a) + da, exact(b) - db},
                               {exact(a) - da, exact(b) + db},
                               {exact(a) - da, exact(b) - db}}) {
      if (!std::isfinite(quotient.error)) continue;
      ASSERT_LE(abs(Rational(x / y - exact(quotient.value))), exact(quotient.error)) << k;
      ++told;
    }
    // 2. Of a face, above or below a point.
    Numbered_points points;
    std::vector<Numbered_points::Number> numbers;
    std::vector<Solid_point> near;
    for (int i = 0; i < 3; ++i) {
      const Exact_point p{exact(number()) / 3, exact(number()) / 7, exact(number())};
      numbers.push_back(points.add(p));
      near.emplace_back(p);
    }
    const Solid_face face(numbers, near);
    if (!face.has_plane()) continue;
    certificate_check::Near_point p;
    Exact_point q;
    for (std::size_t c = 0; c < 3; ++c) {
      p[c] = {number(), 0};
      q[c] = exact(p[c].value);
    }
    const certificate_check::Near_point lifted = face.lifted(p);
    Rational height = face.plane[3];
    q[face.axis] = 0;
    for (std::size_t c = 0; c < 3; ++c) height += face.plane[c] * q[c];
    const Rational expected = -height / face.plane[face.axis];
    ASSERT_LE(abs(Rational(expected - exact(lifted[face.axis].value))), exact(lifted[face.axis].error)) << k;
    ASSERT_LT(lifted[face.axis].error, 0x1p-20) << k;
  }
  EXPECT_GT(told, test_scenes::least(5000));
  EXPECT_FALSE(std::isfinite((Near{1, 0} / Near{0, 0}).error));
  EXPECT_FALSE(std::isfinite((Near{1, 0} / Near{1, 1}).error));
  EXPECT_FALSE(std::isfinite((Near{1, 0} / Near{1, 0.75}).error)) << "no less than half of it is sure";
  EXPECT_FALSE(std::isfinite((Near{0x1p-100, 0} / Near{0x1p-501, 0}).error)) << "what underflow loses counts";
}

TEST(Checker, planes_and_heights_are_those_of_rationals_on_fine_and_wide_grids) {
  std::mt19937_64 random(13);
  const std::array<Rational, 5> steps{1, Rational(1, 3), Rational(1, 1 << 20), Rational(1, Integer(1) << 70),
                                      Rational(Integer(1) << 40)};
  // Corners are so far from each other, and from the origin: up to where machine numbers just suffice, and beyond.
  const std::array<Integer, 7> spans{
      4, 1 << 20, (1 << 30) - 1, 1 << 30, Integer(1) << 31, Integer(1) << 38, Integer(1) << 64};
  const std::array<Integer, 4> places{0, Integer(1) << 40, (Integer(1) << 62) - 7, Integer(1) << 66};
  std::set<std::size_t> on_a_line;
  for (int k = 0; k < test_scenes::sample(3000); ++k) {
    const Rational& step = steps[random() % steps.size()];
    const Integer &span = spans[random() % spans.size()], &place = places[random() % places.size()];
    const auto any = [&] {
      Exact_point p;
      for (Rational& x : p) {
        const auto share = static_cast<long>(random() % 5);  // often the whole span, or none of it
        x = step * Rational(place + (share < 4 ? Integer(span * share / 3) : Integer(random() % 1000)));
      }
      return p;
    };
    Triangle t{any(), any(), any()};
    if (random() % 4 == 0) t[random() % 3][random() % 3] += Rational(1, 7);  // of another denominator
    Numbered_points points;
    std::vector<Numbered_points::Number> numbers;
    std::vector<Solid_point> near;
    for (const Exact_point& p : t)
      if (numbers.push_back(points.add(p)); points.size() > near.size()) near.emplace_back(p);
    const Solid_face face(numbers, near);
    const Exact_point normal = normal_of(t);
    ASSERT_EQ(face.has_plane(), normal != Exact_point{}) << k;
    on_a_line.insert(face.has_plane());
    if (!face.has_plane()) continue;
    // 1. The plane, in lowest terms, its front where it should be.
    const Exact_point its{face.plane[0], face.plane[1], face.plane[2]};
    for (const Exact_point& p : t) ASSERT_EQ(dot(its, p) + face.plane[3], 0) << k;
    ASSERT_GT(dot(its, normal), 0) << k;
    ASSERT_EQ(gcd(gcd(face.plane[0], face.plane[1]), gcd(face.plane[2], face.plane[3])), 1) << k;
    // 2. How high a point is over it.
    const Exact_point p = any();
    const certificate_check::Near height = face.height(Solid_point(p).near);
    if (!std::isfinite(height.error)) continue;
    Rational farthest = 0;
    for (std::size_t c = 0; c < 3; ++c)
      for (const Exact_point& q : {t[0], t[1], t[2], p}) farthest = std::max(farthest, Rational(abs(q[c])));
    ASSERT_LE(abs(Rational(dot(normal, minus(p, t[0])) - exact(height.value))), exact(height.error)) << k;
    ASSERT_LE(exact(height.error) * (1L << 40), farthest * farthest * farthest) << k;
  }
  EXPECT_EQ(on_a_line.size(), 2u);
}

TEST(Checker, edges_that_go_on_beyond_a_straight_corner_are_more_than_a_whole_edge) {
  const std::vector<Exact_point> flat{{0, 0, 0}, {1, 0, 0}, {3, 0, 0}, {0, 3, 0}},
      upright{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {0, 0, 2}}, beside{{0, 0, 0}, {0, -2, 0}, {2, 0, 0}, {1, 0, 0}};
  for (const auto& other : {upright, beside}) {
    EXPECT_EQ(contact_of(flat, other), Contact::edges);
    EXPECT_EQ(contact_of(other, flat), Contact::edges);
  }
  EXPECT_EQ(contact_of(flat, {{0, 0, 0}, {1, 0, 0}, {0, 0, 1}}), Contact::little);
}

TEST(Checker, sides_and_turns_are_those_of_rationals_however_near_the_plane) {
  std::mt19937_64 random(6);
  const auto number = [&] { return static_cast<double>(random() >> 11) * 0x1p-53; };
  std::map<int, int> signs;
  for (int k = 0; k < test_scenes::sample(3000); ++k) {
    Numbered_points points;
    Triangle t;
    std::vector<Numbered_points::Number> numbers;
    for (Exact_point& p : t) {
      for (Rational& x : p) x = exact(number());
      numbers.push_back(points.add(p));
    }
    std::vector<Solid_point> near(points.size(), Solid_point(t[0]));
    for (std::size_t i = 0; i < 3; ++i) near[i] = Solid_point(t[i]);
    const Solid_face face(numbers, near);
    ASSERT_TRUE(face.has_plane());
    Exact_point p;
    const double s = number(), r = number();
    for (std::size_t i = 0; i < 3; ++i) {
      p[i] = t[0][i] + exact(s) * (t[1][i] - t[0][i]) + (k % 2 == 0 ? exact(r) * (t[2][i] - t[0][i]) : Rational(0));
      if (k % 3 == 0) p[i] = exact(p[i].get_d());
    }
    const int side = sgn(dot(normal_of(t), minus(p, t[0])));
    ASSERT_EQ(face.side(Solid_point(p)), side) << k;
    for (std::size_t axis = 0; axis < 3; ++axis)
      ASSERT_EQ(turn_along(near[0], near[1], Solid_point(p), axis), sgn(cross(minus(t[1], t[0]), minus(p, t[0]))[axis]))
          << k;
    ++signs[side];
  }
  for (const int sign : {-1, 0, 1}) EXPECT_GT(signs[sign], test_scenes::least(300)) << sign;
}

Polygon_soup tetrahedron(int x) {
  Polygon_soup soup;
  for (const Exact_point& p : {Exact_point{x, 0, 0}, {x + 1, 0, 0}, {x, 1, 0}, {x, 0, 1}})
    soup.add_point(p[0], p[1], p[2]);
  for (const std::array<Point_id, 3>& face : {std::array<Point_id, 3>{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}})
    soup.add_face(face);
  return soup;
}

/// Of each solid by itself, put together: nothing is cut where they cross.
Solid_certificate uncut(const std::vector<Polygon_soup>& solids) {
  Solid_certificate all{"union", "positive", static_cast<std::uint32_t>(solids.size()), {}, {}, {}};
  for (std::uint32_t k = 0; k < solids.size(); ++k) {
    Set_options options;
    options.keep_fragments = true;
    const Operands operands(std::vector{solids[k]});
    Solid_certificate one = solid_certificate(operands, options, set_operation(operands, options));
    for (auto& fragment : one.fragments) {
      for (auto& part : fragment.parts) part.operand = k;
      for (auto& number : fragment.front) number.first = k;
      all.fragments.push_back(fragment);
    }
  }
  return all;
}

TEST(Checker, refuses_what_all_but_one_of_its_steps_would_accept) {
  const Polygon_soup cube = box({0, 0, 0}, {2, 2, 2}), apart = box({3, 0, 0}, {4, 1, 1});
  const auto verdict = [](const std::vector<Polygon_soup>& solids, const Solid_certificate& claim) {
    return verify_solids(solids, claim);
  };
  EXPECT_TRUE(verdict({cube, apart}, uncut({cube, apart})).accepted);
  // 1. Fragments that cross, or overlap in one plane.
  for (const Polygon_soup& other : {box({1, 1, 1}, {3, 3, 3}), box({1, 1, 2}, {3, 3, 3}), box({-1, 1, 1}, {3, 3, 3}),
                                    box({0, 0, 0}, {2, 2, 2}), box({0, 0, -1}, {1, 1, 0})}) {
    const Verdict found = verdict({cube, other}, uncut({cube, other}));
    EXPECT_FALSE(found.accepted);
    EXPECT_TRUE(found.why.ends_with("cross or overlap")) << found.why;
  }
  // 2. Numbers that are wrong everywhere, and all that follows from them.
  Solid_certificate more = uncut({cube});
  for (auto& fragment : more.fragments) {
    fragment.front = {{0, 1}};
    fragment.fate = Solid_certificate::Fate::dropped;
  }
  EXPECT_EQ(verdict({cube}, more).why, "before fragment 0 the solids wind round otherwise than it says");
  // 3. A solid inside another is inside: numbers of one patch are not those of the other.
  const Polygon_soup inner = box({Rational(1, 2), Rational(1, 2), Rational(1, 2)}, {1, 1, 1});
  EXPECT_EQ(verdict({cube, inner}, uncut({cube, inner})).why,
            "before fragment 6 the solids wind round otherwise than it says");
  // 4. Fragments that are no part of any face, though all is closed: instead of the solid's, and besides.
  const Polygon_soup here = tetrahedron(0), there = tetrahedron(5);
  EXPECT_TRUE(verdict({here}, uncut({here})).accepted);
  EXPECT_FALSE(verdict({here}, uncut({there})).accepted);
  Solid_certificate both = uncut({there}), rest = uncut({here});
  both.fragments.insert(both.fragments.end(), rest.fragments.begin(), rest.fragments.end());
  EXPECT_FALSE(verdict({here}, both).accepted);
  // 5. Faces of one solid that cross each other: they are tiles of several faces.
  const Polygon_soup across = box({1, 1, 1}, {3, 3, 3});
  Polygon_soup crossed;
  for (const Polygon_soup* part : {&cube, &across})
    for (Point_id p = 0; p < 8; ++p) crossed.add_point(part->point(p)[0], part->point(p)[1], part->point(p)[2]);
  for (Face_id f = 0; f < 12; ++f) {
    std::vector<Point_id> loop(cube.loop(f % 6).begin(), cube.loop(f % 6).end());
    for (Point_id& p : loop) p += f < 6 ? 0 : 8;
    crossed.add_face(loop);
  }
  Solid_certificate as_one = uncut({cube, across});
  as_one.operands = 1;
  for (auto& fragment : as_one.fragments)
    for (auto& part : fragment.parts) part.face += 6 * std::exchange(part.operand, 0);
  EXPECT_TRUE(verdict({crossed}, as_one).why.ends_with("cross or overlap"));
  // 6. What is kept is not closed, and a result that is another one.
  Solid_certificate right = uncut({cube, apart});
  EXPECT_FALSE(verify_solids(std::vector{cube, apart}, right, &cube).accepted);
  EXPECT_FALSE(verify_solids(std::vector{cube}, uncut({cube}), &apart).accepted);
  Polygon_soup turned;
  for (Point_id p = 0; p < 8; ++p) turned.add_point(cube.point(p)[0], cube.point(p)[1], cube.point(p)[2]);
  for (Face_id f = 0; f < 6; ++f) {
    std::vector<Point_id> loop(cube.loop(f).begin(), cube.loop(f).end());
    if (f == 3) std::reverse(loop.begin(), loop.end());
    turned.add_face(loop);
  }
  EXPECT_TRUE(verify_solids(std::vector{cube}, uncut({cube}), &cube).accepted);
  EXPECT_FALSE(verify_solids(std::vector{cube}, uncut({cube}), &turned).accepted);
}

TEST(Checker, refuses_a_result_whose_faces_cross_themselves) {
  // Three prisms about an edge, in every second sector: their tops together have the boundary of one hexagon that goes
  // through itself where they meet.
  const std::array<std::array<int, 2>, 6> around{{{4, 0}, {2, 4}, {-2, 4}, {-4, 0}, {-2, -4}, {2, -4}}};
  Polygon_soup prisms, crossing;
  for (const std::size_t k : {0, 2, 4})
    generate::add_prism(prisms, {{0, 0, 0}, {around[k + 1][0], around[k + 1][1], 0}, {around[k][0], around[k][1], 0}},
                        {0, 0, 1});
  for (Point_id p = 0; p < prisms.point_count(); ++p)
    crossing.add_point(prisms.point(p)[0], prisms.point(p)[1], prisms.point(p)[2]);
  for (Face_id f = 0; f < prisms.face_count(); ++f)
    if (f % 5 != 1) crossing.add_face(prisms.loop(f));  // all but the tops
  std::vector<Point_id> loop;
  for (const std::size_t k : {0, 1, 4, 5, 2, 3}) loop.push_back(crossing.add_point(around[k][0], around[k][1], 1));
  crossing.add_face(loop);
  EXPECT_TRUE(verify_solids(std::vector{prisms}, uncut({prisms}), &prisms).accepted);
  EXPECT_EQ(verify_solids(std::vector{prisms}, uncut({prisms}), &crossing).why,
            "face 12 of the result crosses itself, or winds round some of it otherwise than once");
}

TEST(Checker, ends_where_others_touch_a_fragment_in_all_points_that_it_tries_first) {
  // Tips of tetrahedra on a triangle: at the points by which its winding numbers are asked for, whichever corner is its
  // first.
  const std::array<Exact_point, 3> top{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}};
  std::set<Exact_point> touched;
  for (std::size_t first = 0; first < 3; ++first)
    for (std::size_t attempt = 0; attempt < 11; ++attempt) {
      Exact_point sum = top[first];
      Rational weights = 1;
      for (const std::size_t k : {1u, 2u}) {
        const Rational weight = static_cast<long>(1 + (7 * k + 13 * attempt * k * k + 5 * attempt) % 11);
        for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * top[(first + k) % 3][c];
        weights += weight;
      }
      for (Rational& x : sum) x /= weights;
      touched.insert(sum);
    }
  ASSERT_EQ(touched.size(), 33u);
  const auto tetrahedron = [](Polygon_soup& soup, const std::array<Exact_point, 4>& corners) {
    const auto first = static_cast<Point_id>(soup.point_count());
    for (const Exact_point& p : corners) soup.add_point(p[0], p[1], p[2]);
    for (const auto& face : {std::array{1u, 2u, 3u}, {0u, 2u, 1u}, {0u, 3u, 2u}, {0u, 1u, 3u}})
      soup.add_face({first + face[0], first + face[1], first + face[2]});
  };
  std::vector<Polygon_soup> solids(2);
  tetrahedron(solids[0], {{{0, 0, -1}, top[0], top[1], top[2]}});
  const Rational e(1, 10000);
  for (const Exact_point& p : touched)
    tetrahedron(solids[1], {{p,
                             {Rational(p[0] + e), p[1], e},
                             {Rational(p[0] - e), Rational(p[1] + e), e},
                             {Rational(p[0] - e), Rational(p[1] - e), e}}});
  Set_options options;
  options.keep_fragments = true;
  const Operands operands(solids);
  const Set_result result = set_operation(operands, options);
  const Verdict verdict = verify_solids(solids, solid_certificate(operands, options, result), &result.soup);
  EXPECT_TRUE(verdict.accepted) << verdict.why;
}

TEST(Checker, takes_neighbours_for_one_patch_only_if_their_fronts_are_on_one_side) {
  // A cube, and one of its faces twice more: first turned round, so that its fragment's front looks inwards.
  Polygon_soup cube = box({0, 0, 0}, {2, 2, 2}), all;
  for (Point_id p = 0; p < 8; ++p) all.add_point(cube.point(p)[0], cube.point(p)[1], cube.point(p)[2]);
  const std::vector<Point_id> face(cube.loop(3).begin(), cube.loop(3).end());
  all.add_face(std::vector<Point_id>(face.rbegin(), face.rend()));
  for (Face_id f = 0; f < 6; ++f) all.add_face(cube.loop(f));
  all.add_face(face);
  const Solid_certificate claim = uncut({all});
  EXPECT_EQ(claim.fragments.size(), 6u);
  EXPECT_EQ(verify_solids(std::vector{all}, claim, &cube).why,
            "union of 1 solids (inside: positive): 6 of 6 fragments bound it, and are the result");
}

TEST(Checker, takes_holes_of_a_result_in_either_sense) {
  // A block, and a smaller one through it: its top and bottom have a hole.
  const std::vector<Polygon_soup> solids{box({0, 0, 0}, {4, 4, 2}), box({1, 1, -1}, {3, 3, 3})};
  Set_options options;
  options.operation = Set_operation::subtract;
  options.keep_fragments = true;
  const Operands operands(solids);
  const Set_result result = set_operation(operands, options);
  const Solid_certificate claim = solid_certificate(operands, options, result);
  for (const bool turned : {false, true}) {
    Polygon_soup told;
    std::size_t holes = 0;
    for (Point_id p = 0; p < result.soup.point_count(); ++p) {
      const Exact_point at = result.soup.point(p);
      told.add_point(at[0], at[1], at[2]);
    }
    for (Face_id f = 0; f < result.soup.face_count(); ++f) {
      told.add_face(result.soup.loop(f));
      for (std::size_t k = 1; k < result.soup.loop_count(f); ++k) {
        std::vector<Point_id> hole(result.soup.loop(f, k).begin(), result.soup.loop(f, k).end());
        if (turned) std::reverse(hole.begin(), hole.end());
        told.add_hole(hole);
        ++holes;
      }
    }
    EXPECT_EQ(holes, 2u);
    const Verdict verdict = verify_solids(solids, claim, &told);
    EXPECT_TRUE(verdict.accepted) << verdict.why;
  }
}

TEST(Checker, refuses_operands_that_name_points_which_they_do_not_have) {
  const Polygon_soup good = tetrahedron(0);
  std::vector<Polygon_soup> broken(1);
  for (Point_id p = 0; p < good.point_count(); ++p) {
    const Exact_point at = good.point(p);
    broken[0].add_point(at[0], at[1], at[2]);
  }
  for (Face_id f = 0; f < good.face_count(); ++f) {
    std::vector<Point_id> loop(good.loop(f).begin(), good.loop(f).end());
    if (f == 2) loop[1] = 0xFFFFFFF0u;
    broken[0].add_face(loop);
  }
  const Verdict found = verify_solids(broken, uncut({good}));
  EXPECT_FALSE(found.accepted);
  EXPECT_NE(found.why.find("names a point that it does not have"), std::string::npos) << found.why;
}

}  // namespace
