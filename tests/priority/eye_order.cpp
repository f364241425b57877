// Orders by the priority graph: accepted by the checker, whole where they can be, for eyes in general places and in bad
// ones.

#include "../sample.h"
#include "support.h"

#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/algorithms/priority/eye_order.h>
#include <sightline/algorithms/verify/order.h>
#include <sightline/io/read.h>

using namespace priority_test;

namespace {

using test_scenes::least;
using test_scenes::sample;

Order_certificate certificate_of(const Scene& scene, const Exact_traits& traits, const Exact_point& eye,
                                 const Eye_order<Exact_traits>& order, bool on_view) {
  Order_certificate certificate;
  certificate.eye = eye;
  certificate.on_view = on_view;
  std::set<Face_id> cut(scene.non_planar().begin(), scene.non_planar().end());
  for (const Piece& piece : scene.pieces())
    if (piece.number > 0) cut.insert(piece.face);
  for (const auto& polygon : order.polygons) {
    const Piece& piece = scene.pieces()[polygon.piece];
    Order_fragment& fragment = certificate.fragments.emplace_back();
    fragment.face = piece.face;
    fragment.piece = piece.number;
    for (const auto& corner : polygon) fragment.vertices.push_back(traits.position(*corner.vertex));
  }
  for (const Piece& piece : scene.pieces())
    if (cut.count(piece.face)) {
      Covering::Piece& part = certificate.pieces.emplace_back();
      part.face = piece.face;
      part.piece = piece.number;
      part.vertices = scene.corner_points(piece);
    }
  for (const Set_aside& entry : scene.set_aside()) certificate.set_aside.push_back({entry.face, entry.why});
  return certificate;
}

struct Ordered {
  Polygon_soup soup;
  Scene scene;
  Exact_traits traits;

  explicit Ordered(Polygon_soup given) : soup(std::move(given)), scene(soup), traits(scene) {}

  /// The counters of an order of both sides that the checker must accept, as it must those of on-view faces, and of
  /// trees that were cut.
  Eye_order_counters check(const Exact_point& eye) const {
    const auto order = [&](bool two_sided, bool split) {
      const Priority_tree<Exact_traits> tree = build_priority_tree(traits, {two_sided, split, {}});
      const Eye_order<Exact_traits> found = back_to_front(traits, tree, eye);
      const Verdict verdict = verify_order(soup, certificate_of(scene, traits, eye, found, !two_sided));
      EXPECT_TRUE(verdict.accepted) << verdict.why << (two_sided ? ", both sides" : ", on-view")
                                    << (split ? ", cut" : "");
      const Eye_order_counters& c = found.counters;
      EXPECT_EQ(c.fragments, found.polygons.size());
      if (!split) {
        EXPECT_EQ(c.off_view + c.edge_on + c.fragments - c.splits - (two_sided ? c.edge_on / 2 : 0),
                  tree.counters.polygons);
      }
      EXPECT_TRUE(c.cycles > 0 || c.splits == 0);
      EXPECT_TRUE(!split || c.searched == 0);
      if (two_sided && !split) {
        EXPECT_EQ(c.fragments, traits.piece_count() + c.splits);
      }
      return c;
    };
    order(false, true);
    order(true, true);
    const Eye_order_counters on_view = order(false, false), all = order(true, false);
    EXPECT_EQ(2 * on_view.edge_on, all.edge_on);
    EXPECT_GE(all.in_cycles, on_view.in_cycles);
    return all;
  }
  bool whole(const Eye_order_counters& c) const { return c.fragments == traits.piece_count(); }
};

TEST(Eye_order, of_disjoint_bodies_draws_every_face_whole) {
  for (const char* kind : {"city", "city_rotated", "convex_sphere", "stacked"}) {
    const Ordered given(generate::make(kind, test_scenes::is_sanitized() ? 20 : 60, 1));
    const auto box = given.scene.box();
    for (long k = 0; k < (test_scenes::is_sanitized() ? 2 : 6); ++k) {
      Exact_point eye;
      for (std::size_t a = 0; a < 3; ++a)
        eye[a] = box[0][a] + (box[1][a] - box[0][a]) * ratio(3 * k + 7 * static_cast<long>(a) - 8, 7) + ratio(1, 1009);
      const Eye_order_counters c = given.check(eye);
      EXPECT_TRUE(given.whole(c)) << kind << ' ' << k;
    }
  }
}

TEST(Eye_order, of_bars_in_a_cycle_cuts_them_and_nothing_else) {
  // A ring of three as seen from above, and a square far below that is drawn whole.
  Polygon_soup soup = soup_of({{at(0, 0, 0), at(6, 0, 2), at(6, 1, 2), at(0, 1, 0)},
                               {at(5, 0, 0), at(6, 0, 0), at(3, 6, 2), at(2, 6, 2)},
                               {at(4, 6, 0), at(3, 6, 0), at(0, 0, 2), at(1, 0, 2)},
                               rectangle(-9, 9, -9, 9, -5)});
  const Ordered given(std::move(soup));
  const Eye_order_counters above = given.check(at(ratio(5, 2), 2, 30));
  EXPECT_EQ(above.cycles, 1u);
  EXPECT_EQ(above.in_cycles, 3u);
  EXPECT_GE(above.fragments, 5u);
  EXPECT_EQ(given.check(at(-40, 2, ratio(1, 3))).cycles, 0u);
}

TEST(Eye_order, of_faces_that_cross_cuts_them) {
  const Ordered given(soup_of({rectangle(-1, 1, -1, 1, 0), {at(0, -1, -1), at(0, 1, -1), at(0, 1, 1), at(0, -1, 1)}}));
  const Eye_order_counters c = given.check(at(3, ratio(1, 5), 2));
  EXPECT_EQ(c.cycles, 1u);
  EXPECT_EQ(c.fragments, 3u);
  EXPECT_EQ(given.check(at(0, 0, 5)).cycles, 0u) << "one is edge-on";
}

TEST(Eye_order, is_accepted_for_degenerate_scenes_from_any_eye) {
  std::size_t cycles = 0, edge_on = 0, cut = 0, whole = 0;
  for (std::uint64_t k = 0; k < sample(300u); ++k) {
    const Ordered given(degenerate_soup(k));
    if (given.scene.pieces().empty()) continue;
    // In a face's plane, at a corner, in general place.
    const Piece& piece = given.scene.pieces()[k % given.scene.pieces().size()];
    const Exact_point a = given.scene.position(given.scene.corners(piece)[0].point),
                      b = given.scene.position(given.scene.corners(piece)[1].point);
    Exact_point in_plane, outside;
    for (std::size_t i = 0; i < 3; ++i) {
      in_plane[i] = 3 * b[i] - 2 * a[i];
      outside[i] = a[i] + (b[i] - a[(i + 1) % 3]) * ratio(7, 3) + ratio(static_cast<long>(k % 5), 11);
    }
    for (const Exact_point& eye : {a, in_plane, outside}) {
      const Eye_order_counters c = given.check(eye);
      cycles += c.cycles;
      edge_on += c.edge_on;
      cut += c.splits;
      whole += given.whole(c);
    }
  }
  EXPECT_GT(cycles, least(50u));
  EXPECT_GT(edge_on, least(500u));
  EXPECT_GT(cut, least(50u));
  EXPECT_GT(whole, least(300u));
}

TEST(Eye_order, of_generated_scenes_never_cuts_more_than_a_bsp_tree_does) {
  for (const auto& [kind, size] : {std::pair{"soup", 120},
                                   {"rooms", 1},
                                   {"lattice", 3},
                                   {"menger_sponge_merged", 1},
                                   {"terrain", 100},
                                   {"crossing", 8}}) {
    const Ordered given(generate::make(kind, static_cast<std::size_t>(size), 3));
    const auto box = given.scene.box();
    const Exact_point eye{box[1][0] + ratio(1, 3), box[0][1] - ratio(1, 7), box[1][2] + ratio(5, 9)};
    const Eye_order_counters c = given.check(eye);
    const auto tree = build_bsp(given.traits);
    EXPECT_LE(c.fragments, tree.counters.fragments) << kind;
  }
}

TEST(Eye_order, of_faces_of_many_corners_is_accepted_from_both_sides) {
  // Corners on a parabola, 201 of each, in tilted planes; turned round they keep their edges.
  std::size_t whole = 0;
  for (long trial = 0; trial < (test_scenes::is_sanitized() ? 1 : 3); ++trial) {
    std::vector<Points> faces;
    for (long f = 0; f < 4; ++f) {
      const long tilt_x = (trial * 3 + f * 5) % 7 - 3, tilt_y = (trial + f * 2) % 5 - 2,
                 shift = (trial * f * 11) % 40 - 20;
      Points corners;
      for (long k = -100; k <= 100; ++k)
        corners.push_back(at(k + shift, ratio(k * k, 50) - 100,
                             f * 300 + ratio((k + shift) * tilt_x, 9) + ratio(k * k * tilt_y, 450)));
      faces.push_back(f % 2 ? reversed(corners) : corners);
    }
    const Ordered given(soup_of(faces));
    for (const Exact_point& eye : {at(10, 3, 9000), at(-40, 7, -7000), at(300, 20, 460)}) {
      const Eye_order_counters c = given.check(eye);
      whole += c.cycles == 0;
    }
  }
  EXPECT_GT(whole, 0u);
}

/// Eyes in and around the scene: in general place, in the plane of a face, at a corner, in turn.
Exact_point random_eye(const Scene& scene, Random& random, std::uint64_t k) {
  const auto box = scene.box();
  const Piece& piece = scene.pieces()[random.below(scene.pieces().size())];
  const Exact_point a = scene.position(scene.corners(piece)[0].point),
                    b = scene.position(scene.corners(piece)[1].point);
  if (k % 5 == 1) return along(a, 2, minus(b, a));
  if (k % 5 == 2) return a;
  Exact_point eye;
  for (std::size_t axis = 0; axis < 3; ++axis)
    eye[axis] =
        box[0][axis] + (box[1][axis] - box[0][axis]) * ratio(static_cast<long>(random.between(-1000, 3000)), 2003);
  return eye;
}

/// Orders of the on-view faces from many eyes by one tree: all accepted. Returns how many there were.
std::size_t accepted_from_random_eyes(const Ordered& given, std::uint64_t count, std::uint64_t seed) {
  const Priority_tree<Exact_traits> tree = build_priority_tree(given.traits);
  Random random(seed);
  std::size_t accepted = 0;
  for (std::uint64_t k = 0; k < count; ++k) {
    const Exact_point eye = random_eye(given.scene, random, k);
    const Verdict verdict = verify_order(
        given.soup, certificate_of(given.scene, given.traits, eye, back_to_front(given.traits, tree, eye), true));
    EXPECT_TRUE(verdict.accepted) << "eye " << k << ": " << verdict.why;
    accepted += verdict.accepted;
  }
  return accepted;
}

TEST(Eye_order, from_a_hundred_random_eyes_is_accepted) {
  for (const auto& [kind, size] : {std::pair{"city", 20},
                                   {"city_rotated", 20},
                                   {"soup", 60},
                                   {"lattice", 3},
                                   {"menger_sponge_merged", 1},
                                   {"terrain", 72},
                                   {"crossing", 8},
                                   {"bars", 7},
                                   {"convex_sphere", 60},
                                   {"stacked", 20}}) {
    SCOPED_TRACE(kind);
    EXPECT_EQ(
        accepted_from_random_eyes(Ordered(generate::make(kind, static_cast<std::size_t>(size), 3)), sample(100u), 1),
        sample(100u));
  }
}

TEST(Eye_order, of_real_scenes_is_accepted_and_cutting_for_all_eyes_makes_fewer_parts_than_a_bsp_tree) {
  const std::filesystem::path folder = SIGHTLINE_SCENES_DIR;
  if (folder.empty()) GTEST_SKIP() << "the collection of real scenes is not here";
  for (const char* file : {"a_interior/cornell_box.obj", "a_interior/lq_start.world.qoff", "b_classic/cg_joint.off",
                           "c_convex/cg_P.off"}) {
    SCOPED_TRACE(file);
    const Ordered given(read_scene(folder / file));
    EXPECT_EQ(accepted_from_random_eyes(given, test_scenes::sample(10), 7), test_scenes::sample(10u));
    EXPECT_LE(build_priority_tree(given.traits, {false, true, {}}).counters.polygons,
              build_bsp(given.traits).counters.fragments);
  }
}

TEST(Eye_order, of_every_real_scene_from_a_hundred_random_eyes_is_accepted) {
  const std::filesystem::path folder = SIGHTLINE_SCENES_DIR;
  if (folder.empty()) GTEST_SKIP() << "the collection of real scenes is not here";
  if (std::getenv("SIGHTLINE_LONG") == nullptr)
    GTEST_SKIP() << "takes most of an hour: set SIGHTLINE_LONG to a part of a file's name, or to nothing for all";
  std::size_t scenes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
    const std::string file = entry.path().string();
    if (!entry.is_regular_file() || file.find(std::getenv("SIGHTLINE_LONG")) == std::string::npos) continue;
    const std::set<std::string> known{".obj", ".off", ".ply", ".stl", ".qoff"};
    if (!known.contains(entry.path().extension().string())) continue;
    const Ordered given(read_scene(file));
    if (given.scene.pieces().empty() || given.scene.pieces().size() > 20000) continue;
    SCOPED_TRACE(file);
    EXPECT_EQ(accepted_from_random_eyes(given, 100, 11), 100u);
    ++scenes;
  }
  EXPECT_GT(scenes, 0u);
}

TEST(Eye_order, of_nothing_is_nothing) { EXPECT_EQ(Ordered(Polygon_soup()).check(at(0, 0, 0)).fragments, 0u); }

}  // namespace
