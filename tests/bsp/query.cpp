// Points and rays against the tree, compared with every face by itself, and with solids that are known.

#include "support.h"
#include "../sample.h"

#include <sightline/algorithms/bsp/query.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/shapes.h>
#include <sightline/harness/generate/soups.h>
#include <sightline/kernel/scene/closed.h>

using namespace bsp_test;

namespace {

// ---- Brute force: rationals, no tree

/// Whether a convex polygon (counterclockwise around any normal) holds a point; closed.
bool holds(const Points& polygon, const Exact_point& p) {
  const Exact_point n = normal_of(polygon);
  if (dot(n, minus(p, polygon[0])) != 0) return false;
  for (std::size_t i = 0; i < polygon.size(); ++i)
    if (dot(n, cross(minus(polygon[(i + 1) % polygon.size()], polygon[i]), minus(p, polygon[i]))) < 0) return false;
  return true;
}

/// The least t >= 0 at which the ray is in a convex polygon.
std::optional<Rational> first_in(const Points& polygon, const Exact_ray& ray) {
  const Exact_point n = normal_of(polygon);
  const Rational slope = dot(n, ray.direction), height = dot(n, minus(polygon[0], ray.origin));
  if (slope != 0) {
    const Rational t = height / slope;
    return t >= 0 && holds(polygon, along(ray.origin, t, ray.direction)) ? std::optional(t) : std::nullopt;
  }
  if (height != 0) return std::nullopt;
  // In the plane: it enters at the origin, at a corner, or across an edge. Try all of them, take the least that is
  // held.
  std::vector<Rational> candidates{0};
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Exact_point &a = polygon[i], e = minus(polygon[(i + 1) % polygon.size()], a);
    const Exact_point across = cross(n, e);
    const Rational d = dot(across, ray.direction);
    if (d != 0) candidates.push_back(dot(across, minus(a, ray.origin)) / d);
    else candidates.push_back(dot(minus(a, ray.origin), ray.direction) / dot(ray.direction, ray.direction));
  }
  std::sort(candidates.begin(), candidates.end());
  for (const Rational& t : candidates)
    if (t >= 0 && holds(polygon, along(ray.origin, t, ray.direction))) return t;
  return std::nullopt;
}

struct Everything {
  std::vector<std::pair<Face_id, Points>> pieces;
  std::vector<std::tuple<Face_id, std::uint32_t, Points>> fragments;
  explicit Everything(const Built& built) {
    for (const Piece& piece : built.scene.pieces()) pieces.emplace_back(piece.face, built.scene.corner_points(piece));
    for (const Drawn& f : built.tree.fragments)
      fragments.emplace_back(built.traits.face(f.polygon.piece), f.number, built.corners(f.polygon));
  }
  std::vector<Face_id> faces_at(const Exact_point& p) const {
    std::set<Face_id> faces;
    for (const auto& [face, polygon] : pieces)
      if (holds(polygon, p)) faces.insert(face);
    return {faces.begin(), faces.end()};
  }
  /// Time and face from the pieces alone; the number is the lowest of that face's fragments that hold the point.
  std::optional<Ray_hit> first_hit(const Exact_ray& ray) const {
    std::optional<Ray_hit> best;
    for (const auto& [face, polygon] : pieces)
      if (const auto t = first_in(polygon, ray); t && (!best || *t < best->t || (*t == best->t && face < best->face)))
        best = Ray_hit{*t, face, 0};
    if (!best) return best;
    const Exact_point p = along(ray.origin, best->t, ray.direction);
    best->number = ~0u;
    for (const auto& [face, number, polygon] : fragments)
      if (face == best->face && holds(polygon, p)) best->number = std::min(best->number, number);
    return best;
  }
};

testing::AssertionResult same(const std::optional<Ray_hit>& a, const std::optional<Ray_hit>& b) {
  const auto text = [](const std::optional<Ray_hit>& h) {
    return h ? "t " + to_string(h->t) + " face " + std::to_string(h->face) + " number " + std::to_string(h->number)
             : std::string("nothing");
  };
  if (text(a) == text(b)) return testing::AssertionSuccess();
  return testing::AssertionFailure() << text(a) << " instead of " << text(b);
}

/// The leaf is one whose closed cell holds the point, by the planes on the way to it.
void expect_leaf(const Built& built, const Exact_point& p, const Bsp_leaf& leaf) {
  if (built.tree.nodes.empty()) {
    EXPECT_EQ(leaf, Bsp_leaf{});
    return;
  }
  bool touched = false;
  std::int32_t node = 0;
  while (true) {
    const Tree::Node& n = built.tree.nodes[static_cast<std::size_t>(node)];
    const std::array<Rational, 4> h = built.scene.file_coefficients(n.plane);
    const int side = sgn(Rational(h[0] * p[0] + h[1] * p[1] + h[2] * p[2] + h[3]));
    touched |= side == 0;
    const std::int32_t next = side >= 0 ? n.front : n.behind;
    if (next == Tree::leaf) {
      EXPECT_EQ(leaf, (Bsp_leaf{node, side >= 0, touched}));
      return;
    }
    node = next;
  }
}

Exact_ray random_ray(const Built& built, Random& random) {
  Exact_ray ray{random_eye(built, random), {}};
  const auto& pieces = built.scene.pieces();
  const Points c = pieces.empty() ? Points{at(0, 0, 0), at(1, 0, 0), at(0, 1, 0)}
                                  : built.scene.corner_points(pieces[random.below(pieces.size())]);
  switch (random.below(6)) {
    case 0: ray.direction = minus(c[0], ray.origin); break;                    // to a vertex
    case 1: ray.direction = minus(centroid({c[0], c[1]}), ray.origin); break;  // to an edge
    case 2: ray.direction = minus(c[1], c[0]); break;                          // along an edge's direction
    case 3:                                                                    // in a face's plane, from its own points
      ray.origin = along(c[0], ratio(random.between(-3, 3), 2), minus(c[2], c[0]));
      ray.direction = minus(c[random.below(c.size())], c[random.below(c.size())]);
      break;
    case 4:
      ray.direction = {0, 0, 0};
      ray.direction[random.below(3)] = random.chance(1, 2) ? 1 : ratio(-2, 3);
      break;
    default: ray.direction = lattice_point(random);
  }
  if (ray.direction == at(0, 0, 0)) ray.direction = at(0, 0, 1);
  return ray;
}

TEST(Query, agrees_with_every_face_by_itself_on_degenerate_scenes) {
  std::size_t on = 0, hits = 0, at_origin = 0, shared = 0;
  for (std::uint64_t seed = 0; seed < test_scenes::sample(1000u); ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    Random random(seed);
    const Built built(moved_somewhere(random_soup(random, 8), random));
    const Everything everything(built);
    for (int k = 0; k < 6; ++k) {
      const Exact_point p = random_eye(built, random);
      Predicate_counts counts;
      const std::vector<Face_id> faces = faces_at(built.traits, built.tree, p, counts);
      ASSERT_EQ(faces, everything.faces_at(p));
      on += !faces.empty();
      shared += faces.size() > 1;
      expect_leaf(built, p, find_leaf(built.traits, built.tree, p, counts));
      EXPECT_TRUE(counts.total() > 0 || built.tree.nodes.empty());

      const Exact_ray ray = random_ray(built, random);
      const auto hit = first_hit(built.traits, built.tree, ray);
      ASSERT_TRUE(same(hit, everything.first_hit(ray)));
      hits += hit.has_value();
      at_origin += hit && hit->t == 0;
    }
    if (testing::Test::HasFailure()) return;
  }
  EXPECT_GT(on, test_scenes::least(1500u));
  EXPECT_GT(shared, test_scenes::least(250u));
  EXPECT_GT(hits, test_scenes::least(2000u));
  EXPECT_GT(at_origin, test_scenes::least(500u));
}

TEST(Query, agrees_with_every_face_by_itself_on_generated_scenes) {
  for (const Polygon_soup& soup :
       {generate::lattice(2), generate::rooms(1, 1, 2), generate::crossing(9), generate::city(6, 2, true),
        generate::soup(60, 0.4, 2), generate::menger_sponge(1, true)}) {
    SCOPED_TRACE(soup.file);
    Random random(7);
    const Built built(soup);
    const Everything everything(built);
    for (int k = 0; k < 40; ++k) {
      const Exact_point p = random_eye(built, random);
      Predicate_counts counts;
      ASSERT_EQ(faces_at(built.traits, built.tree, p, counts), everything.faces_at(p));
      expect_leaf(built, p, find_leaf(built.traits, built.tree, p, counts));
      const Exact_ray ray = random_ray(built, random);
      ASSERT_TRUE(same(first_hit(built.traits, built.tree, ray), everything.first_hit(ray)));
    }
  }
}

TEST(Query, an_empty_tree_holds_nothing) {
  const Built built{Polygon_soup()};
  Predicate_counts counts;
  EXPECT_EQ(find_leaf(built.traits, built.tree, at(0, 0, 0), counts), Bsp_leaf{});
  EXPECT_TRUE(faces_at(built.traits, built.tree, at(0, 0, 0), counts).empty());
  EXPECT_FALSE(first_hit(built.traits, built.tree, {at(0, 0, 0), at(1, 0, 0)}));
  EXPECT_TRUE(closure(built.scene).closed);
  EXPECT_EQ(locate_point(built.traits, built.tree, at(0, 0, 0), true, counts).location, Location::outside);
}

TEST(Query, a_ray_needs_a_direction) {
  const Built built(generate::grid(1));
  EXPECT_THROW(first_hit(built.traits, built.tree, {at(0, 0, 0), at(0, 0, 0)}), std::domain_error);
}

TEST(Query, rays_by_hand) {
  // Two unit squares side by side at z = 0 (faces 0, 1), one on edge above their common edge (2).
  const Built built(soup_of(
      {rectangle(0, 1, 0, 1, 0), rectangle(1, 2, 0, 1, 0), {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)}}));
  const auto hit = [&](const Exact_point& from, const Exact_point& d) {
    const auto found = first_hit(built.traits, built.tree, {from, d});
    return found ? to_string(found->t) + ":" + std::to_string(found->face) : std::string("-");
  };
  const Rational half = ratio(1, 2);
  EXPECT_EQ(hit(at(half, half, 3), at(0, 0, -2)), "3/2:0") << "t counts in lengths of the direction";
  EXPECT_EQ(hit(at(half, half, -3), at(0, 0, 1)), "3:0") << "from behind too";
  EXPECT_EQ(hit(at(half, half, 3), at(0, 0, 1)), "-") << "not backwards";
  EXPECT_EQ(hit(at(1, half, -1), at(0, 0, 1)), "1:0") << "a shared edge: the lowest face";
  EXPECT_EQ(hit(at(1, half, 3), at(0, 0, -1)), "2:2") << "in a face's plane: where it enters";
  EXPECT_EQ(hit(at(1, half, half), at(0, 0, -1)), "0:2") << "from inside a face: at once";
  EXPECT_EQ(hit(at(-1, half, 0), at(1, 0, 0)), "1:0");
  EXPECT_EQ(hit(at(3, half, 0), at(-1, 0, 0)), "1:1");
  EXPECT_EQ(hit(at(-1, 0, 0), at(1, 0, 0)), "1:0") << "along an edge";
  EXPECT_EQ(hit(at(2, 1, 0), at(1, 1, 1)), "0:1") << "from a vertex, away";
  EXPECT_EQ(hit(at(-1, 2, 0), at(1, -1, 0)), "1:0") << "in the plane, touching a vertex";
  EXPECT_EQ(hit(at(-1, 1, 1), at(1, 0, 0)), "2:2") << "touching an edge";
  EXPECT_EQ(hit(at(1, 0, 2), at(0, 0, -1)), "1:2") << "along an edge of the one on edge";
  EXPECT_EQ(hit(at(half, 1 + ratio(1, 1000000000), 3), at(0, 0, -1)), "-") << "just beside";
}

TEST(Query, points_by_hand) {
  const Built built(soup_of({rectangle(0, 1, 0, 1, 0),
                             rectangle(1, 2, 0, 1, 0),
                             {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)},
                             reversed(rectangle(0, 2, 0, 1, 0))}));
  Predicate_counts counts;
  using Ids = std::vector<Face_id>;
  const auto faces = [&](const Rational& x, const Rational& y, const Rational& z) {
    return faces_at(built.traits, built.tree, at(x, y, z), counts);
  };
  EXPECT_EQ(faces(1, ratio(1, 2), 0), (Ids{0, 1, 2, 3}));
  EXPECT_EQ(faces(ratio(1, 2), ratio(1, 2), 0), (Ids{0, 3}));
  EXPECT_EQ(faces(2, 1, 0), (Ids{1, 3}));
  EXPECT_EQ(faces(1, 1, 1), (Ids{2}));
  EXPECT_EQ(faces(1, ratio(1, 2), ratio(3, 2)), Ids{});
  EXPECT_EQ(faces(3, 0, 0), Ids{});
}

// ---- Solids

/// The boundary of a box, fronts outwards, or inwards.
std::vector<Points> box(long low, long high, bool inwards = false) {
  std::vector<Points> faces;
  for (std::size_t axis = 0; axis < 3; ++axis)
    for (const long end : {low, high}) {
      Points face;
      for (const auto& [a, b] :
           {std::pair(low, low), std::pair(high, low), std::pair(high, high), std::pair(low, high)}) {
        Exact_point p;
        p[axis] = end;
        p[(axis + 1) % 3] = a;
        p[(axis + 2) % 3] = b;
        face.push_back(p);
      }
      faces.push_back((end == high) != inwards ? face : reversed(face));
    }
  return faces;
}
std::vector<Points> both(std::vector<Points> a, const std::vector<Points>& b) {
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

/// Asks for every point of a lattice of quarters around [0, size]^3.
template <class Truth>
void expect_locations(const Built& built, long size, long step, Truth truth) {
  ASSERT_TRUE(closure(built.scene).closed);
  for (long x = -4; x <= 4 * size + 4; x += step)
    for (long y = -4; y <= 4 * size + 4; y += step)
      for (long z = -4; z <= 4 * size + 4; z += step) {
        Predicate_counts counts;
        const Exact_point p = at(ratio(x, 4), ratio(y, 4), ratio(z, 4));
        const Point_location found = locate_point(built.traits, built.tree, p, true, counts);
        ASSERT_EQ(found.location, truth(p)) << p[0] << ' ' << p[1] << ' ' << p[2];
        ASSERT_EQ(found.location == Location::on, !found.faces.empty());
      }
}
Location in_box(const Exact_point& p, long low, long high) {
  bool inside = true;
  for (const Rational& x : p) {
    if (x < low || x > high) return Location::outside;
    inside &= x > low && x < high;
  }
  return inside ? Location::inside : Location::on;
}

TEST(Query, a_cube_has_an_inside_whichever_way_its_faces_look) {
  for (const bool inwards : {false, true})
    expect_locations(Built(soup_of(box(0, 2, inwards))), 2, 1, [](const Exact_point& p) { return in_box(p, 0, 2); });
}

TEST(Query, of_two_nested_cubes_the_inner_one_is_a_hole_if_it_is_turned_inside_out) {
  expect_locations(Built(soup_of(both(box(0, 4), box(1, 3, true)))), 4, 2, [](const Exact_point& p) {
    const Location outer = in_box(p, 0, 4), inner = in_box(p, 1, 3);
    return inner == Location::inside ? Location::outside : inner == Location::on ? Location::on : outer;
  });
  // And solid if it is not: its winding number is then two.
  expect_locations(Built(soup_of(both(box(0, 4), box(1, 3)))), 4, 2, [](const Exact_point& p) {
    return in_box(p, 1, 3) == Location::on ? Location::on : in_box(p, 0, 4);
  });
}

TEST(Query, two_cubes_that_interpenetrate_are_one_solid) {
  std::vector<Points> second = box(1, 3);
  expect_locations(Built(soup_of(both(box(0, 2), second))), 3, 2, [](const Exact_point& p) {
    const Location a = in_box(p, 0, 2), b = in_box(p, 1, 3);
    if (a == Location::on || b == Location::on) return Location::on;
    return a == Location::inside || b == Location::inside ? Location::inside : Location::outside;
  });
}

TEST(Query, two_cubes_that_share_a_wall_in_opposite_senses_are_one_solid_with_a_wall_in_it) {
  std::vector<Points> second = box(0, 2);
  for (Points& face : second)
    for (Exact_point& p : face) p[0] += 2;
  expect_locations(Built(soup_of(both(box(0, 2), second))), 4, 2, [](const Exact_point& p) {
    const Location a = in_box(p, 0, 2), b = in_box(at(p[0] - 2, p[1], p[2]), 0, 2);
    if (a == Location::on || b == Location::on) return Location::on;
    return a == Location::inside || b == Location::inside ? Location::inside : Location::outside;
  });
}

TEST(Query, a_menger_sponge_has_its_holes) {
  for (const bool merged : {false, true})
    expect_locations(Built(generate::menger_sponge(1, merged)), 3, merged ? 3 : 2, [](const Exact_point& p) {
      // Of the up to eight cells that touch the point: all full, none, or some.
      bool some = false, all = true;
      for (int corner = 0; corner < 8; ++corner) {
        int middle = 0;
        bool cell = true;
        for (std::size_t k = 0; k < 3; ++k) {
          const Rational shifted = p[k] + ((corner >> k & 1) != 0 ? ratio(1, 100) : ratio(-1, 100));
          cell &= shifted > 0 && shifted < 3;
          middle += shifted > 1 && shifted < 2;
        }
        cell &= middle < 2;
        some |= cell;
        all &= cell;
      }
      return all ? Location::inside : some ? Location::on : Location::outside;
    });
}

TEST(Query, a_point_is_in_a_convex_body_iff_it_is_behind_all_its_faces) {
  const Built built(generate::convex_sphere(60));
  ASSERT_TRUE(closure(built.scene).closed);
  Random random(1);
  std::array<int, 3> seen{};
  for (int k = 0; k < 300; ++k) {
    Exact_point p = random_eye(built, random);
    if (k % 3 == 0) p = centroid({p, at(0, 0, 0), at(0, 0, 0), at(0, 0, 0)});
    bool inside = true, outside = false;
    for (const Piece& piece : built.scene.pieces()) {
      const Points corners = built.scene.corner_points(piece);
      const Rational side = dot(normal_of(corners), minus(p, corners[0]));
      inside &= side < 0;
      outside |= side > 0;
    }
    Predicate_counts counts;
    const Location found = locate_point(built.traits, built.tree, p, true, counts).location;
    ASSERT_EQ(found, outside ? Location::outside : inside ? Location::inside : Location::on);
    ++seen[static_cast<std::size_t>(found)];
  }
  for (const int count : seen) EXPECT_GT(count, 20);
}

TEST(Query, inside_and_outside_alternate_along_a_ray_through_a_house) {
  const Built built(generate::rooms(1, 1, 3));
  ASSERT_TRUE(closure(built.scene).closed);
  const Everything everything(built);
  const auto [low, high] = built.scene.box();
  Predicate_counts counts;
  Random random(3);
  for (int k = 0; k < 5; ++k) {
    // From outside through the whole: between consecutive faces that it meets, the number met so far says where it is.
    Exact_ray ray{along(low, -1, at(1, 2, 3)), {}};
    for (std::size_t i = 0; i < 3; ++i)
      ray.direction[i] =
          (high[i] - low[i]) * ratio(random.between(100, 900), 1009) + ratio(1, 7919) + static_cast<long>(i + 1);
    std::vector<Rational> met{0};
    for (const auto& [face, polygon] : everything.pieces)
      if (const auto t = first_in(polygon, ray)) met.push_back(*t);
    std::sort(met.begin(), met.end());
    if (std::adjacent_find(met.begin(), met.end()) != met.end()) continue;  // through an edge
    ASSERT_EQ(met.size() % 2, 1u);
    for (std::size_t i = 0; i < met.size(); ++i) {
      const Rational t = i + 1 < met.size() ? Rational((met[i] + met[i + 1]) / 2) : Rational(met[i] + 1);
      EXPECT_EQ(locate_point(built.traits, built.tree, along(ray.origin, t, ray.direction), true, counts).location,
                i % 2 == 1 ? Location::inside : Location::outside);
    }
  }
}

TEST(Query, a_point_whose_first_rays_meet_edges_is_located_all_the_same) {
  // A tetrahedron about the origin with an edge e f whose middle the first ray meets.
  const Exact_point d = at(1000003, 7919, 104729 + 1), half = at(3000000, 500, -7000000);
  const Exact_point e = along(d, 1, half), f = along(d, -1, half), g = at(-5000000, 9000000, 100000),
                    h = at(-5000000, -9000000, -100000);
  std::vector<Points> faces{{e, f, g}, {f, e, h}, {e, g, h}, {f, h, g}};
  const Exact_point n = cross(minus(f, e), minus(g, e));
  if (dot(n, minus(h, e)) > 0)
    for (Points& face : faces) face = reversed(face);
  const Built built(soup_of(faces));
  ASSERT_TRUE(closure(built.scene).closed);
  const std::vector<int> once = times_given(built.scene);
  ASSERT_FALSE(bsp_detail::winding_along(built.traits, built.tree, {at(0, 0, 0), d}, once)) << "the ray meets an edge";
  Predicate_counts counts;
  EXPECT_EQ(locate_point(built.traits, built.tree, at(0, 0, 0), true, counts).location, Location::inside);
  EXPECT_EQ(bsp_detail::winding_along(built.traits, built.tree, {at(0, 0, 0), at(1000003, 2 * 7919, 104729 + 4)}, once),
            std::optional<int>(1))
      << "fronts outwards: winding number one";
}

TEST(Query, a_scene_that_is_not_closed_has_no_inside) {
  std::vector<Points> faces = box(0, 2);
  Predicate_counts counts;
  {
    std::vector<Points> missing = faces;
    missing.pop_back();
    const Built built(soup_of(missing));
    EXPECT_FALSE(closure(built.scene).closed);
    EXPECT_EQ(locate_point(built.traits, built.tree, at(1, 1, 1), false, counts).location, Location::undefined);
    EXPECT_EQ(locate_point(built.traits, built.tree, at(0, 1, 1), false, counts).location, Location::on);
  }
  {
    std::vector<Points> turned = faces;
    turned[2] = reversed(turned[2]);
    EXPECT_FALSE(closure(Scene(soup_of(turned))).closed);
  }
  {
    std::vector<Points> moved = faces;
    moved[2][0][0] += ratio(1, 1000000);
    EXPECT_FALSE(closure(Scene(soup_of(moved))).closed);
  }
  {
    std::vector<Points> flap = both(faces, {rectangle(5, 6, 5, 6, 5)});
    EXPECT_FALSE(closure(Scene(soup_of(flap))).closed);
    flap.push_back(reversed(flap.back()));  // a sheet of two sides, of no thickness
    EXPECT_TRUE(closure(Scene(soup_of(flap))).closed);
  }
}

TEST(Query, t_junctions_and_lines_are_no_gaps) {
  // One wall in three parts that meet in T-junctions.
  std::vector<Points> faces = box(0, 2);
  const auto top = std::find_if(faces.begin(), faces.end(), [](const Points& f) {
    return std::all_of(f.begin(), f.end(), [](const Exact_point& p) { return p[2] == 2; });
  });
  ASSERT_NE(top, faces.end());
  *top = rectangle(0, 1, 0, 2, 2);
  faces.push_back(rectangle(1, 2, 0, ratio(1, 3), 2));
  faces.push_back(rectangle(1, 2, ratio(1, 3), 2, 2));
  const Scene whole(soup_of(faces));
  EXPECT_TRUE(closure(whole).closed);
  EXPECT_EQ(closure(whole).lines, 12u + 2u) << "edges on one line are one line";
  faces.back() = rectangle(1, 2, ratio(2, 3), 2, 2);
  EXPECT_FALSE(closure(Scene(soup_of(faces))).closed) << "a slit";
  faces.back() = rectangle(1, 2, ratio(1, 4), 2, 2);
  EXPECT_FALSE(closure(Scene(soup_of(faces))).closed) << "an overlap";
}

TEST(Query, every_closed_generator_is_closed_and_the_open_ones_are_not) {
  const std::set<std::string_view> closed{"convex_sphere", "menger_sponge", "menger_sponge_merged", "rooms"};
  for (const generate::Kind& kind : generate::kinds()) {
    const Scene scene(kind.make(kind.name.starts_with("menger") ? 1 : kind.name == "rooms" ? 2 : 6, 1));
    EXPECT_EQ(closure(scene).closed, closed.count(kind.name) == 1) << kind.name;
  }
}

}  // namespace
