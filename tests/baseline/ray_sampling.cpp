// Random rays against what is proved: they never see more than there is to see, and miss what is narrow.

#include <sightline/algorithms/baseline/ray_sampling.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;

void add_square(Polygon_soup& soup, double x, double y, double z, double r, bool up) {
  std::vector<Point_id> loop;
  for (const auto& [dx, dy] : {std::pair(-r, -r), std::pair(r, -r), std::pair(r, r), std::pair(-r, r)})
    loop.push_back(soup.add_point(x + dx, y + dy, z));
  if (!up) std::reverse(loop.begin(), loop.end());
  soup.add_face(loop);
}
const std::vector<Exact_point> lamp{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};

TEST(Ray_sampling, sees_what_is_large_and_misses_what_is_behind_a_narrow_slit) {
  Polygon_soup soup;
  add_square(soup, -50 - 0.5e-7, 0, 4, 50, false);  // two wide sheets with a slit of 10^-7 between them
  add_square(soup, 50 + 0.5e-7, 0, 4, 50, false);
  add_square(soup, 0, 0, 8, 1, false);  // behind the slit
  add_square(soup, 0, 0, -2, 1, true);  // behind the source
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, lamp)};
  EXPECT_EQ(visible_by_sampling(occluders, sources, {20000, 1, false}), (std::vector<Face_id>{0, 1}));
  EXPECT_EQ(weakly_visible(occluders, sources).visible, (std::vector<Face_id>{0, 1, 2}));
}

TEST(Ray_sampling, takes_backs_only_where_both_sides_count) {
  Polygon_soup soup;
  add_square(soup, 0, 0, 4, 3, true);
  const Scene scene(soup);
  const Occluders occluders(scene);
  const std::vector<Weak_source> sources{weak_source(occluders, lamp)};
  EXPECT_TRUE(visible_by_sampling(occluders, sources, {1000, 1, false}).empty());
  EXPECT_EQ(visible_by_sampling(occluders, sources, {1000, 1, true}), (std::vector<Face_id>{0}));
}

TEST(Ray_sampling, sees_nothing_that_is_proved_hidden_in_a_pile_of_squares) {
  std::mt19937 dice(3);
  std::uniform_real_distribution<double> unit(-3, 3);
  std::size_t seen = 0, missed = 0;
  for (int round = 0; round < 8; ++round) {
    Polygon_soup soup;
    for (int k = 0; k < 30; ++k) add_square(soup, unit(dice), unit(dice), 1 + k * 0.25, 0.8, false);
    const Scene scene(soup);
    const Occluders occluders(scene);
    const std::vector<Weak_source> sources{weak_source(occluders, lamp)};
    const std::vector<Face_id> sampled = visible_by_sampling(occluders, sources, {2000, 7, false});
    const Weakly_visible proved = weakly_visible(occluders, sources);
    EXPECT_TRUE(proved.undecided.empty());
    for (const Face_id face : sampled)
      EXPECT_TRUE(std::binary_search(proved.visible.begin(), proved.visible.end(), face)) << face;
    seen += sampled.size();
    missed += proved.visible.size() - sampled.size();
  }
  EXPECT_GT(seen, 50u);
  EXPECT_GT(missed, 0u);
}

}  // namespace
