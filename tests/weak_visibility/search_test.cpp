// The search against truths by construction, brute force, the checker, and laws that need no oracle.

#include "parallel_planes.h"
#include "../sample.h"
#include "../soup.h"
#include "rays.h"
#include "scenes.h"

#include <sightline/algorithms/weak_visibility/certificate.h>
#include <sightline/algorithms/weak_visibility/weak.h>
#include <sightline/io/read.h>
#include <sightline/algorithms/weak_visibility/search/line_search.h>
#include <sightline/algorithms/weak_visibility/search/near_lines.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/soups.h>

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <memory>

namespace {

using namespace sightline;
using weak_scenes::Weak_scene;

struct Found {
  Weakly_visible answer;
  Weak_status of(Face_id face) const {
    if (std::binary_search(answer.visible.begin(), answer.visible.end(), face)) return Weak_status::visible;
    if (std::binary_search(answer.hidden.begin(), answer.hidden.end(), face)) return Weak_status::hidden;
    return Weak_status::undecided;
  }
};

/// The answer for a scene, and what the checker says of its certificate.
Found found_and_verified(const Polygon_soup& soup, const std::vector<std::vector<Exact_point>>& points,
                         const Weak_options& options, const std::string& name) {
  const Scene scene(soup);
  const Occluders occluders(scene);
  std::vector<Weak_source> sources;
  for (const std::vector<Exact_point>& polygon : points) sources.push_back(weak_source(occluders, polygon));
  Found found{weakly_visible(occluders, sources, options)};
  const Weakly_visible& answer = found.answer;
  EXPECT_EQ(answer.visible.size() + answer.hidden.size() + answer.undecided.size(), scene.counters().faces) << name;
  const Verdict verdict = verify_weak(soup, weak_certificate(scene, points, options.search.two_sided, answer));
  EXPECT_TRUE(verdict.accepted) << name << ": " << verdict.why;
  return found;
}

Weak_options small_search() {
  Weak_options options;
  options.search.cells = 2000;
  return options;
}

class Families : public testing::TestWithParam<std::size_t> {};

TEST_P(Families, have_the_answers_they_were_built_for_and_certificates) {
  const weak_scenes::Family& family = weak_scenes::families()[GetParam()];
  std::size_t decided = 0, undecided = 0;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(test_scenes::is_sanitized() ? 2 : 6); ++seed) {
    const Weak_scene scene = family.make(seed);
    const Found found = found_and_verified(scene.soup, {scene.source}, small_search(), scene.name);
    for (const Face_id target : scene.targets) {
      const Weak_status status = found.of(target);
      ++(status == Weak_status::undecided ? undecided : decided);
      if (status == Weak_status::undecided) continue;
      if (scene.truth) {
        EXPECT_EQ(status == Weak_status::visible, *scene.truth) << scene.name << ", face " << target;
      } else if (status == Weak_status::hidden) {
        EXPECT_FALSE(weak_oracle::find_sightline(scene, target, 100, seed)) << scene.name << ", face " << target;
      }
    }
  }
  EXPECT_GT(decided, 0u);
  // Three occluders that touch one line from three sides leave a double root, which multipliers of low degree do not
  // exclude: they are left to events. Of 150 seeds 15 of `shared_edges` are left open, of others fewer than one in
  // twenty; none of the first six, but of two more families one among the first eighteen.
  const bool leaves_some =
      weak_scenes::seeds(test_scenes::is_sanitized() ? 2 : 6) > 6 &&
      (family.name == "shared_edges" || family.name == "concurrent_edges" || family.name == "regulus");
  if (family.name != "tangent" && family.name != "tiny" && family.name != "nudged") {
    EXPECT_LE(undecided * (leaves_some ? 5 : 20), decided) << family.name;
  }
}
INSTANTIATE_TEST_SUITE_P(All, Families, testing::Range(std::size_t{0}, weak_scenes::families().size()),
                         [](const auto& of) { return weak_scenes::families()[of.param].name; });

// This is kept of each source and piece that it does not see, and a proof.
static_assert(sizeof(Weakly_visible::Pair) <= 13 * sizeof(void*));

TEST(Weak_visibility, counts_a_pair_as_facing_away_once_though_a_plane_cuts_it) {
  // A square that looks up, and one across its plane that looks away from it, or to it.
  const auto at = [](long x, long y, long z) { return Exact_point{Rational(x), Rational(y), Rational(z)}; };
  const std::vector<Exact_point> lamp{at(0, 0, 0), at(1, 0, 0), at(1, 1, 0), at(0, 1, 0)};
  std::vector<Exact_point> wall{at(5, 0, -1), at(5, 1, -1), at(5, 1, 1), at(5, 0, 1)};
  for (const bool looks_here : {false, true}) {
    if (looks_here) std::reverse(wall.begin(), wall.end());
    const Found found = found_and_verified(test_scenes::soup_of({wall}), {lamp}, small_search(), "a wall");
    EXPECT_EQ(found.answer.counters.targets, 1u);
    EXPECT_EQ(found.answer.counters.away, looks_here ? 0u : 1u);
    EXPECT_EQ(found.answer.visible.size(), looks_here ? 1u : 0u);
  }
}

TEST(Weak_visibility, of_boxes_in_which_doubles_end_with_a_wrong_basis_is_proved) {
  for (const std::uint64_t seed :
       {41, 44}) {  // the sums of what that basis says are positive for some pairs of corners
    const Weak_scene scene = weak_scenes::families()[15].make(seed);
    ASSERT_EQ(scene.name, "boxes " + std::to_string(seed));
    EXPECT_TRUE(found_and_verified(scene.soup, {scene.source}, small_search(), scene.name).answer.undecided.empty());
  }
}

TEST(Parallel_planes, have_the_answers_of_exact_polytopes_closed_and_reopened_by_a_part_in_two_to_the_forty) {
  std::size_t visible = 0, hidden = 0;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(60); ++seed) {
    const Weak_scene scene = weak_oracle::parallel_planes_scene(seed);
    const Found found = found_and_verified(scene.soup, {scene.source}, small_search(), scene.name);
    for (const Face_id target : scene.targets) {
      EXPECT_EQ(found.of(target), *scene.truth ? Weak_status::visible : Weak_status::hidden) << scene.name;
      ++(*scene.truth ? visible : hidden);
    }
  }
  EXPECT_GT(visible, 10u);
  EXPECT_GT(hidden, 10u);
}

TEST(Weak_visibility, of_a_city_from_its_ground_takes_a_few_lines_for_each_wall) {
  // Most lines from so large a source miss what stands upon it, and everything is near its shafts.
  for (const bool rotated : {false, true}) {
    const std::size_t boxes = 100;
    const Polygon_soup city = generate::city(boxes, 1, rotated);
    const auto ground = static_cast<Face_id>(5 * boxes);
    std::vector<Exact_point> points;
    for (const Point_id p : city.loop(ground)) points.push_back(city.point(p));
    const Found found = found_and_verified(city, {points}, {}, "city");
    EXPECT_EQ(found.answer.visible.size(), 4 * boxes);
    EXPECT_EQ(found.answer.counters.by_rays, 4 * boxes);
    EXPECT_EQ(found.answer.counters.occluders, 0u) << "no shaft is asked for what is near it";
    EXPECT_EQ(found.answer.counters.cells, 0u);
  }
}

TEST(Near_lines, go_from_inside_to_inside_in_front_of_both_planes) {
  std::size_t asked = 0, nearer = 0;
  for (std::uint64_t seed = 0; seed < 60; ++seed) {
    const Scene scene(generate::soup(12, 0.3, seed));
    const Occluders occluders(scene);
    const auto pieces = static_cast<std::uint32_t>(scene.pieces().size());
    for (std::uint32_t s = 0; s < pieces; ++s)
      for (std::uint32_t t = 0; t < pieces; ++t) {
        const Near_polygon source = occluders.polygon(s), target = occluders.polygon(t);
        const Near_plane &of_source = occluders.plane(s), &of_target = occluders.plane(t);
        if (side(of_source, target) != 1 || side(of_target, source) != 1) continue;
        const auto distance = [](const Triple& p, const Triple& q) {
          return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
        };
        const std::vector<Line_weights> lines = near_lines(source, of_source, target, of_target);
        EXPECT_EQ(lines.size(), 4u);
        const Line_weights middle = Line_weights::middle(
            Line_domain(std::make_shared<Near_polygon>(source), std::make_shared<Near_polygon>(target)));
        const double far = distance(weighted_mean(source, middle.source), weighted_mean(target, middle.target));
        double least = far;
        for (const Line_weights& line : lines) {
          for (const std::vector<double>* weights : {&line.source, &line.target}) {
            double sum = 0;
            for (const double w : *weights) {
              EXPECT_GT(w, 0);
              sum += w;
            }
            EXPECT_NEAR(sum, 1, 1e-12);
          }
          const Triple p = weighted_mean(source, line.source), q = weighted_mean(target, line.target);
          EXPECT_GT(likely_value(of_source.near, q), 0);
          EXPECT_GT(likely_value(of_target.near, p), 0);
          least = std::min(least, distance(p, q));
          ++asked;
        }
        nearer += least < 0.8 * far;
      }
  }
  EXPECT_GT(asked, 400u);
  EXPECT_GT(nearer, asked / 8) << "a line of each pair is nearer than that of middles, as a rule";
}

TEST(Weak_visibility, of_two_faces_is_mutual) {
  std::size_t visible = 0, hidden = 0;
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(12); ++seed) {
    const Weak_scene scene = weak_scenes::families()[seed % weak_scenes::families().size()].make(seed);
    const Scene model(scene.soup);
    const Occluders occluders(model);
    const auto ask = [&](std::uint32_t from, std::uint32_t to) {
      Weak_counters counters;
      const Weak_source source = weak_source(occluders, from);
      return Line_search(occluders, source.polygon, source.plane, occluders.polygon(to), to, small_search().search)
          .run(counters)
          .status;
    };
    for (std::uint32_t a = 0; a < model.pieces().size(); ++a)
      for (std::uint32_t b = a + 1; b < model.pieces().size(); ++b) {
        const Weak_status there = ask(a, b), back = ask(b, a);
        if (there == Weak_status::undecided || back == Weak_status::undecided) continue;
        EXPECT_EQ(there, back) << scene.name << ": pieces " << a << " and " << b;
        ++(there == Weak_status::visible ? visible : hidden);
      }
  }
  EXPECT_GT(visible, 5u);
  EXPECT_GT(hidden, 5u);
}

TEST(Weak_visibility, grows_with_the_source_and_is_the_union_over_its_parts) {
  for (std::uint64_t seed = 0; seed < weak_scenes::seeds(10); ++seed) {
    const Weak_scene scene = weak_scenes::families()[(seed * 7) % weak_scenes::families().size()].make(seed);
    const std::vector<Exact_point>& s = scene.source;
    std::vector<Exact_point> first{s[0], s[1], s[2]}, rest{s[0]};
    for (std::size_t i = 2; i < s.size(); ++i) rest.push_back(s[i]);
    if (rest.size() < 3) continue;
    const Found whole = found_and_verified(scene.soup, {s}, small_search(), scene.name),
                parts = found_and_verified(scene.soup, {first, rest}, small_search(), scene.name + " in parts");
    for (const Face_id target : scene.targets) {
      const Weak_status a = whole.of(target), b = parts.of(target);
      if (a == Weak_status::undecided || b == Weak_status::undecided) continue;
      EXPECT_EQ(a, b) << scene.name << ", face " << target;
    }
  }
}

TEST(Weak_visibility, is_the_same_at_any_number_of_threads) {
  const Weak_scene scene = weak_scenes::families().back().make(3);
  Weak_options options = small_search();
  options.threads = 1;
  const Found one = found_and_verified(scene.soup, {scene.source}, options, scene.name);
  options.threads = 4;
  const Found four = found_and_verified(scene.soup, {scene.source}, options, scene.name);
  EXPECT_EQ(one.answer.visible, four.answer.visible);
  EXPECT_EQ(one.answer.hidden, four.answer.hidden);
  EXPECT_EQ(one.answer.counters.cells, four.answer.counters.cells);
  ASSERT_EQ(one.answer.pairs.size(), four.answer.pairs.size());
  for (std::size_t k = 0; k < one.answer.pairs.size(); ++k)
    EXPECT_EQ(one.answer.pairs[k].answer.proof.size(), four.answer.pairs[k].answer.proof.size());
}

/// A square of side 2 r around (x, y) at a height, looking up or down.
std::vector<Exact_point> square(long x, long y, long z, long r, bool up) {
  std::vector<Exact_point> points{{x - r, y - r, z}, {x + r, y - r, z}, {x + r, y + r, z}, {x - r, y + r, z}};
  if (!up) std::reverse(points.begin(), points.end());
  return points;
}
void add(Polygon_soup& soup, const std::vector<Exact_point>& polygon) {
  std::vector<Point_id> loop;
  for (const Exact_point& p : polygon) loop.push_back(soup.add_point(p[0], p[1], p[2]));
  soup.add_face(loop);
}

TEST(Weak_visibility, of_a_back_counts_where_both_sides_do) {
  Polygon_soup soup;
  add(soup, square(0, 0, 4, 1, true));
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 0, 1, true)}, {}, "one side").of(0), Weak_status::hidden);
  Weak_options options;
  options.search.two_sided = true;
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 0, 1, true)}, options, "both sides").of(0), Weak_status::visible);
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 0, 1, false)}, options, "from behind the source").of(0),
            Weak_status::hidden);
}

TEST(Weak_visibility, is_undecided_and_never_a_guess_where_the_search_may_take_one_cell_only) {
  Polygon_soup soup;
  add(soup, square(0, 0, 4, 2, false));
  add(soup, square(-2, 0, 2, 2, true));  // two that touch, and hide the target together
  add(soup, square(2, 0, 2, 2, true));
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 0, 1, true)}, {}, "hidden by two").of(0), Weak_status::hidden);
  Weak_options options;
  options.search.cells = 1;
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 0, 1, true)}, options, "one cell").of(0), Weak_status::undecided);
  options.search.rays = 0;  // one cell is enough, and needed, where nothing is between
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 3, 1, true)}, options, "above them, one cell").of(0),
            Weak_status::visible);
  options.search.cells = 0;
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 3, 1, true)}, options, "above them, no cell").of(0),
            Weak_status::undecided);
  options.search.cells = 1000;
  std::size_t asked = 0;
  options.search.out_of_time = [&] {
    ++asked;
    return true;
  };
  options.threads = 1;
  EXPECT_EQ(found_and_verified(soup, {square(0, 0, 0, 1, true)}, options, "no time").of(0), Weak_status::undecided);
  EXPECT_EQ(asked, 4u) << "once before boxes of faces, once a face, and nothing is begun";
}

TEST(Weak_source, that_is_no_convex_polygon_is_refused_with_advice) {
  Polygon_soup soup;
  add(soup, square(0, 0, 4, 1, false));
  const Scene scene(soup);
  const Occluders occluders(scene);
  const auto refused = [&](const std::vector<Exact_point>& points) -> std::string {
    try {
      weak_source(occluders, points);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "accepted";
  };
  using Points = std::vector<Exact_point>;
  EXPECT_NE(refused(Points{{0, 0, 0}, {1, 0, 0}}).find("fewer than three"), std::string::npos);
  EXPECT_NE(refused(Points{{0, 0, 0}, {1, 0, 0}, {1, 0, 0}, {0, 0, 0}}).find("fewer than three"), std::string::npos);
  EXPECT_NE(refused(Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}).find("no area"), std::string::npos);
  EXPECT_NE(refused(Points{{0, 0, 0}, {1, 0, 0}, {1, 1, 1}, {0, 1, 0}}).find("not planar"), std::string::npos);
  EXPECT_NE(refused(Points{{0, 0, 0}, {4, 0, 0}, {1, 1, 0}, {0, 4, 0}}).find("not convex"), std::string::npos);
  EXPECT_NE(refused(Points{{0, 3, 0}, {-2, -3, 0}, {3, 1, 0}, {-3, 1, 0}, {2, -3, 0}}).find("not convex"),
            std::string::npos);  // a star
  EXPECT_EQ(refused(Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 2, 0}}), "accepted");
  const Weak_source source =
      weak_source(occluders, Points{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {2, 2, 0}, {0, 2, 0}});
  EXPECT_EQ(source.polygon.size(), 4u);
  EXPECT_EQ(side(source.plane, occluders.polygon(0)[0]), 1);  // it looks up
}

TEST(Rooms, of_others_are_decided_from_faces_of_theirs_with_certificates) {
  const std::filesystem::path folder = SIGHTLINE_SCENES_DIR;
  if (folder.empty() || !std::filesystem::exists(folder / "a_interior")) GTEST_SKIP() << "no real scenes here";
  for (const auto& [file, faces] :
       {std::pair("lq_slope.world.qoff", std::vector<Face_id>{10, 300}),
        std::pair("fd1_E1M1.qoff", std::vector<Face_id>{500}), std::pair("cornell_box.obj", std::vector<Face_id>{0})}) {
    if (test_scenes::is_sanitized() && faces.size() > 1) continue;  // the larger one
    const Polygon_soup soup = read_scene((folder / "a_interior" / file).string());
    const Scene scene(soup);
    for (const Face_id face : faces) {
      std::vector<std::vector<Exact_point>> points;
      for (const Piece& piece : scene.pieces()) {
        if (piece.face != face) continue;
        points.push_back(scene.corner_points(piece));
      }
      const Found found = found_and_verified(soup, points, {}, std::string(file) + " " + std::to_string(face));
      EXPECT_TRUE(found.answer.undecided.empty()) << file << " " << face;
      EXPECT_FALSE(found.answer.visible.empty()) << file << " " << face;
      EXPECT_EQ(found.of(face), Weak_status::hidden) << "a source does not see itself";
    }
  }
}

}  // namespace
