// The search in doubles: right where faces are far apart or overlap well, wrong where they are 10^-12 apart.

#include <sightline/algorithms/baseline/doubles_search.h>
#include <sightline/harness/compare/weak_errors.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;

/// A target at z = 2 that looks down, seen from [-1, 1]^2 at z = 0, past two plates at z = 1 whose edges are so far
/// apart, or overlap.
Weak_status past_two_plates(double gap, double across = 0) {
  Polygon_soup soup;
  const auto add = [&](double x0, double x1, double z0, double z1, bool up) {  // z0 at x0, z1 at x1
    const Point_id a = soup.add_point(x0, -3.0, z0), b = soup.add_point(x1, -3.0, z1), c = soup.add_point(x1, 3.0, z1),
                   d = soup.add_point(x0, 3.0, z0);
    if (up) soup.add_face({a, b, c, d});
    else soup.add_face({d, c, b, a});
  };
  add(-1, 1, 2, 2, false);
  add(-4, 0, 1, 1 + across, true);
  add(gap, 4, 1, 1, true);
  const Scene scene(soup);
  const Occluders occluders(scene);
  const Weak_faces found = visible_by_doubles(
      occluders, {weak_source(occluders, std::vector<Exact_point>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})});
  return std::binary_search(found.visible.begin(), found.visible.end(), 0u) ? Weak_status::visible
         : std::binary_search(found.hidden.begin(), found.hidden.end(), 0u) ? Weak_status::hidden
                                                                            : Weak_status::undecided;
}

TEST(Doubles_search, is_right_where_there_is_room_and_believes_what_is_below_its_tolerance) {
  EXPECT_EQ(past_two_plates(0.01), Weak_status::visible);
  EXPECT_EQ(past_two_plates(0), Weak_status::hidden);
  EXPECT_EQ(past_two_plates(-0.01), Weak_status::hidden);
  EXPECT_EQ(past_two_plates(1e-12), Weak_status::hidden);        // wrong: it is visible
  EXPECT_EQ(past_two_plates(-0.01, 0.5), Weak_status::visible);  // one above the other: lines pass between them
}

TEST(Doubles_search, sees_in_piles_of_random_squares_what_the_exact_search_sees) {
  std::mt19937 dice(3);
  std::uniform_real_distribution<double> unit(-1.5, 1.5);
  std::size_t visible = 0, hidden = 0, undecided = 0;
  for (int round = 0; round < 6; ++round) {
    Polygon_soup soup;
    for (int k = 0; k < 30; ++k) {
      const double x = unit(dice), y = unit(dice), z = 1 + k * 0.25, tilt = unit(dice) / 30;
      soup.add_face({soup.add_point(x - 0.8, y + 0.8, z), soup.add_point(x + 0.8, y + 0.8, z + tilt),
                     soup.add_point(x + 0.8, y - 0.8, z + tilt), soup.add_point(x - 0.8, y - 0.8, z)});
    }
    const Scene scene(soup);
    const Occluders occluders(scene);
    const std::vector<Weak_source> sources{
        weak_source(occluders, std::vector<Exact_point>{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}})};
    const Weak_faces doubles = visible_by_doubles(occluders, sources), exact = weakly_visible(occluders, sources);
    const Weak_errors errors = weak_errors(exact, doubles);
    EXPECT_EQ(errors.wrongly_visible + errors.wrongly_hidden, 0u) << round;
    visible += exact.visible.size();
    hidden += exact.hidden.size();
    undecided += errors.undecided;
  }
  EXPECT_GT(visible, 30u);
  EXPECT_GT(hidden, 10u);
  EXPECT_LT(undecided, 30u);
}

TEST(Doubles_search, counts_backs_only_where_both_sides_count_and_the_same_at_any_number_of_threads) {
  Polygon_soup soup;
  for (const bool up : {true, false}) {
    const double z = up ? 1 : 2;
    const Point_id a = soup.add_point(-1.0, -1.0, z), b = soup.add_point(1.0, -1.0, z), c = soup.add_point(1.0, 1.0, z),
                   d = soup.add_point(-1.0, 1.0, z);
    if (up) soup.add_face({a, b, c, d});
    else soup.add_face({d, c, b, a});
  }
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{
      weak_source(occluders, std::vector<Exact_point>{{-3, -3, 0}, {3, -3, 0}, {3, 3, 0}, {-3, 3, 0}})};
  Doubles_search_options options;
  EXPECT_EQ(visible_by_doubles(occluders, sources, options).visible, (std::vector<Face_id>{1}));  // past the first
  options.two_sided = true;
  for (const int threads : {1, 2, 5}) {
    options.threads = threads;
    EXPECT_EQ(visible_by_doubles(occluders, sources, options).visible, (std::vector<Face_id>{0, 1}));
  }
}

}  // namespace
