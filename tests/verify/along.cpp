// What an eye sees on its way: a hand-made certificate, forgeries of it, and moments against arithmetic of their own.

#include "scenes.h"

#include <sightline/algorithms/verify/along.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>

#include <cmath>
#include <functional>
#include <sstream>

namespace verify_along_test {
namespace {

using namespace verify_test;
using along_check::Moments;
using Side = Along_certificate::Side;
using Range = Along_certificate::Range;
constexpr Side::Kind edge = Side::Kind::edge;

/// A wall across the x axis that looks to lower x, and a smaller one behind it. The eye goes from (0, 0, 0) to
/// (0, 4, 0) and sees past the first wall's edge y = 2 more and more of the second one, from t = 3/4 on.
struct Walls {
  Polygon_soup soup;
  Along_certificate certificate;

  Walls() {
    add(2, 2);
    add(4, 1);
    certificate.from = at(0, 0, 0);
    certificate.to = at(0, 4, 0);
    certificate.moments = {rational(0), rational(ratio(3, 4)), rational(1)};
    certificate.faces = {{0, {{0, 0}, {0, 2}, {2, 2}}}, {1, {{1, 2}, {2, 2}}}};
    for (const Range& range : {Range{0, 0}, Range{0, 2}, Range{2, 2}})
      certificate.proofs.push_back(
          {0, false, range, {{edge, 0, 3, 1}, {edge, 0, 2, 1}, {edge, 0, 1, 1}, {edge, 0, 0, 1}}, {}});
    // Inside of three edges of the second wall, outside of one of the first.
    for (const Range& range : {Range{1, 2}, Range{2, 2}})
      certificate.proofs.push_back(
          {1, false, range, {{edge, 1, 3, 1}, {edge, 1, 2, 1}, {edge, 1, 1, 1}, {edge, 0, 2, -1}}, {}});
    certificate.proofs.push_back({1, false, {0, 1}, {}, {{false, {}, 0}}});
  }
  static Path_moment rational(const Rational& t) { return {{}, t, t}; }
  void add(long x, long half) { add({at(x, -half, -half), at(x, -half, half), at(x, half, half), at(x, half, -half)}); }
  void add(const Points& loop) {
    std::vector<Point_id> ids;
    for (const Exact_point& p : loop) ids.push_back(soup.add_point(p[0], p[1], p[2]));
    certificate.fragments.push_back({soup.add_face(ids), 0, loop});
  }
  Along_certificate::Proof& hidden() { return certificate.proofs.back(); }
};

void refused(const std::string& words, const std::function<void(Walls&)>& change) {
  Walls walls;
  change(walls);
  const Verdict verdict = verify_along(walls.soup, walls.certificate);
  EXPECT_FALSE(verdict.accepted) << words;
  EXPECT_NE(verdict.why.find(words), std::string::npos) << verdict.why;
}

TEST(Verify_along, a_wall_behind_a_wall_appears_at_three_quarters_of_the_way) {
  const Walls walls;
  const Verdict verdict = verify_along(walls.soup, walls.certificate);
  EXPECT_TRUE(verdict.accepted) << verdict.why;
  EXPECT_NE(verdict.why.find("2 faces visible at some time on the way from (0, 0, 0) to (0, 4, 0), 0 at none"),
            std::string::npos)
      << verdict.why;
  std::istringstream in(certificate_text(walls.certificate));
  const Certificate read = read_certificate(in);
  EXPECT_EQ(certificate_text(std::get<Along_certificate>(read)), certificate_text(walls.certificate));
  EXPECT_TRUE(verify_along(walls.soup, std::get<Along_certificate>(read)).accepted);
}

TEST(Verify_along, both_sides_need_no_proof_of_a_side_that_is_never_looked_at) {
  Walls walls;
  walls.certificate.two_sided = true;
  EXPECT_TRUE(verify_along(walls.soup, walls.certificate).accepted);
}

/// A part of the way, and a screen between the walls whose edge y = 0 cuts the second one all along.
struct Screened : Walls {
  Screened() {
    const Points screen{at(3, 0, -9), at(3, 0, 9), at(ratio(7, 2), 9, 9), at(ratio(7, 2), 9, -9)};
    std::vector<Point_id> ids;
    for (const Exact_point& p : screen) ids.push_back(soup.add_point(p[0], p[1], p[2]));
    certificate.fragments.push_back({soup.add_face(ids), 0, screen});
    certificate.to = at(0, ratio(1, 25), 0);
    certificate.faces.pop_back();
  }
  /// Why it is rejected with this proof that the second wall is hidden.
  std::string why(const std::vector<Along_certificate::Node>& tree) {
    hidden().range = {0, 2};
    hidden().tree = tree;
    certificate.proofs.erase(certificate.proofs.begin() + 3, certificate.proofs.end() - 1);
    return verify_along(soup, certificate).why;
  }
};

TEST(Verify_along, a_tree_is_of_cuts_with_both_parts_hidden) {
  using Node = Along_certificate::Node;
  const Node cut{true, {edge, 2, 0, 1}, 0}, by_wall{false, {}, 0}, by_screen{false, {}, 2};
  const std::string accepted_so_far = "face 2 is neither said to be seen nor shown not to be";
  const auto expect = [](const std::string& words, const std::vector<Node>& tree) {
    const std::string why = Screened().why(tree);
    EXPECT_NE(why.find(words), std::string::npos) << why;
  };
  expect(accepted_so_far, {by_wall});
  expect(accepted_so_far, {cut, by_wall, by_wall});
  expect(accepted_so_far, {cut, by_screen, by_wall});
  expect("a leaf that fragment 2 does not cover", {cut, by_wall, by_screen});
  expect("a leaf that fragment 2 does not cover", {by_screen});
  expect("ends before its last leaf", {cut, by_wall});
  expect("has nodes after its last leaf", {cut, by_wall, by_wall, by_wall});
  expect("has a cut with all of its cone on one side", {cut, cut, by_wall, by_wall, by_wall});
  const Node turned{true, {edge, 2, 0, -1}, 0};
  expect(accepted_so_far, {turned, by_wall, by_screen});
  expect("does not cover", {turned, by_screen, by_wall});
}

TEST(Verify_along, a_cut_passes_no_ray_of_its_cone_within_the_range) {
  // A wall in front hides all of it. Past the screen's edge an eye at y = 3 sees the edge y = -1 of the second wall.
  const auto why = [](long until) {
    Screened walls;
    Along_certificate& certificate = walls.certificate;
    certificate.to = at(0, until, 0);
    walls.add(1, 99);
    std::swap(certificate.fragments[0], certificate.fragments[3]);
    certificate.faces[0].face = 3;
    certificate.proofs.insert(certificate.proofs.begin(), {3, false, {0, 2}, {}, {{false, {}, 0}}});
    return walls.why({{true, {edge, 2, 0, 1}, 0}, {false, {}, 0}, {false, {}, 0}});
  };
  const std::string passes = "proof 3 has a cut that passes a ray of its cone within the range";
  EXPECT_NE(why(3).find("face 2 is neither said to be seen"), std::string::npos) << why(3);
  EXPECT_NE(why(4).find(passes), std::string::npos) << why(4);
}

TEST(Verify_along, a_leaf_is_before_the_fragment_also_where_planes_cross) {
  // A slanted wall, through the plane of the one at x = 4, covers it as the eye sees it: from behind, or from before
  // it.
  const auto why = [](long end) {
    Walls walls;
    walls.soup = {};
    walls.certificate = {};
    walls.add(4, 1);
    const Points slanted{at(1, -9, -99), at(1, -9, 99), at(9, end, 99), at(9, end, -99)};
    std::vector<Point_id> ids;
    for (const Exact_point& p : slanted) ids.push_back(walls.soup.add_point(p[0], p[1], p[2]));
    walls.certificate.fragments.push_back({walls.soup.add_face(ids), 0, slanted});
    walls.certificate.from = at(0, 0, 0);
    walls.certificate.to = at(0, -40, 0);  // later it passes the slanted plane
    walls.certificate.moments = {Walls::rational(0), Walls::rational(ratio(1, 40)), Walls::rational(1)};
    walls.certificate.proofs.push_back({0, false, {0, 1}, {}, {{false, {}, 1}}});
    return verify_along(walls.soup, walls.certificate).why;
  };
  EXPECT_NE(why(9).find("proof 0 has a leaf that fragment 1 is not in front of"), std::string::npos) << why(9);
  EXPECT_NE(why(99).find("face 0 is neither said to be seen nor shown not to be after moment 1"), std::string::npos)
      << why(99);
}

TEST(Verify_along, what_is_not_so_is_refused) {
  const auto claim_more = [](Walls& w) { w.certificate.faces[1].seen[0].low = 0; };
  refused("face 1 is not shown to be seen after moment 0", claim_more);
  refused("face 1 is neither said to be seen nor shown not to be after moment 1",
          [](Walls& w) { w.certificate.faces[1].seen.erase(w.certificate.faces[1].seen.begin()); });
  refused("face 1 is not shown to be seen at moment 1", [](Walls& w) {
    w.certificate.faces[1].seen.push_back({1, 1});
  });
  refused("face 1 is said to be seen twice at once", [](Walls& w) { w.certificate.faces[1].seen.push_back({2, 2}); });
  refused("face 0 is neither said to be seen nor shown",
          [](Walls& w) { w.certificate.faces.erase(w.certificate.faces.begin()); });
  refused("face 1 is listed twice", [](Walls& w) { w.certificate.faces.push_back({1, {}}); });
  refused("faces name face 7, which is not drawn", [](Walls& w) { w.certificate.faces.push_back({7, {}}); });
  refused("the path has no length", [](Walls& w) { w.certificate.to = w.certificate.from; });
  const Rational halves(Integer(0), Integer(2));  // not in lowest terms
  refused("the path is not in canonical numbers", [&](Walls& w) { w.certificate.from[0] = halves; });
  refused("the path is not in canonical numbers", [&](Walls& w) { w.certificate.to[0] = halves; });
}

TEST(Verify_along, proofs_hold_where_nothing_changes_and_no_farther) {
  // Seen until a moment before the event, and hidden a moment beyond it.
  refused("has sides that are not those of a cone in their order", [](Walls& w) {
    w.certificate.faces[1].seen[0].low = 0;
    for (auto& proof : w.certificate.proofs)
      if (proof.fragment == 1 && proof.range.low == 1) proof.range.low = 0;
  });
  refused("has a leaf that fragment 0 does not cover", [](Walls& w) {
    w.certificate.faces[1].seen.clear();
    w.hidden().range = {0, 2};
  });
  refused("does not cover", [](Walls& w) { w.certificate.moments[1] = Walls::rational(ratio(3, 4) + tiny(60)); });
  refused("has sides that are not those of a cone in their order",
          [](Walls& w) { w.certificate.moments[1] = Walls::rational(ratio(3, 4) - tiny(60)); });
}

TEST(Verify_along, cones_and_leaves_that_are_none) {
  refused("is not within its fragment", [](Walls& w) { w.certificate.proofs[3].cone = w.certificate.proofs[0].cone; });
  refused("has sides that are not those",
          [](Walls& w) { std::swap(w.certificate.proofs[0].cone[0], w.certificate.proofs[0].cone[1]); });
  refused("less than three sides", [](Walls& w) { w.certificate.proofs[0].cone.resize(2); });
  refused("fragment 0 is not shown to be beside", [](Walls& w) {  // all of the second wall
    w.certificate.proofs[4].cone.back() = {edge, 1, 0, 1};
  });
  refused("fragment 1 does not hide", [](Walls& w) { w.hidden().tree[0].blocked = 1; });
  refused("has a cut with all of its cone on one side", [](Walls& w) {
    w.hidden().tree = {{true, {edge, 0, 3, 1}, 0}, {false, {}, 0}, {false, {}, 0}};
  });
  refused("its plane holds the path", [](Walls& w) {
    w.add({at(3, -9, 0), at(ratio(7, 2), -9, 0), at(ratio(7, 2), 9, 0), at(3, 9, 0)});
    w.hidden().tree[0].blocked = 2;
  });
  refused("fragment 2 is not shown to be beside", [](Walls& w) {  // the eye passes its plane
    w.add({at(1, 1, -1), at(1, 1, 1), at(ratio(3, 2), 1, 1), at(ratio(3, 2), 1, -1)});
    std::swap(w.certificate.proofs[0], w.certificate.proofs[1]);
  });
  refused("has not either a cone or a tree", [](Walls& w) { w.hidden().tree.clear(); });
  refused("names fragment 2, which there is not", [](Walls& w) { w.hidden().tree[0].blocked = 2; });
  refused("names a corner that fragment 0 has not", [](Walls& w) { w.certificate.proofs[0].cone[0].corner = 4; });
  refused("has a range that is none of the moments", [](Walls& w) { w.hidden().range = {1, 0}; });
  refused("is about a fragment that the eye is not in front of",
          [](Walls& w) { w.hidden().from_behind = w.certificate.two_sided = true; });
  refused("is of a back", [](Walls& w) { w.hidden().from_behind = true; });
}

TEST(Verify_along, moments_that_are_none) {
  const auto with_moment = [](const Path_moment& moment) {
    return [moment](Walls& w) { w.certificate.moments[1] = moment; };
  };
  const auto no_root = "is not between two fractions at which a quadratic has opposite signs";
  refused(no_root, with_moment({{1, 0, 1}, 0, 1}));
  refused(no_root, with_moment({{-1, 2, 0}, ratio(1, 4), ratio(3, 4)}));            // linear
  refused(no_root, with_moment({{3, -16, 16}, ratio(1, 8), ratio(7, 8)}));          // two roots
  refused(no_root, with_moment({{ratio(-1, 2), 0, 1}, ratio(3, 4), ratio(1, 2)}));  // ends exchanged
  // What a fraction is said with, too, would be read otherwise by who reads the quadratic alone.
  const auto both = "moment 1 is a fraction, and has a quadratic, too";
  refused(both, with_moment({{ratio(-9, 10), 0, 1}, ratio(1, 2), ratio(1, 2)}));
  refused(both, with_moment({{-1, 2, 0}, ratio(1, 2), ratio(1, 2)}));
  refused(both, with_moment({{1, 0, 0}, ratio(1, 2), ratio(1, 2)}));
  const Rational halves(Integer(2), Integer(4));  // not in lowest terms
  const auto not_canonical = "moment 1 is not in canonical numbers";
  refused(not_canonical, with_moment({{}, halves, ratio(1, 2)}));
  refused(not_canonical, with_moment({{}, ratio(1, 2), halves}));
  refused(not_canonical, with_moment({{Rational(-halves), 0, 1}, ratio(1, 2), ratio(3, 4)}));
  refused("moment 1 is not told to be after the one before it", with_moment({{ratio(-1, 2), 0, 1}, 0, ratio(3, 4)}));
  refused("moment 2 is not told to be after", with_moment(Walls::rational(2)));
  refused("the moments do not go from 0 to 1",
          [](Walls& w) { w.certificate.moments[0] = Walls::rational(ratio(1, 8)); });
  refused("the moments do not go from 0 to 1", [](Walls& w) { w.certificate.moments.pop_back(); });
  refused("the moments do not go from 0 to 1", [](Walls& w) { w.certificate.moments = {}; });
}

/// Held to long doubles where these tell, and to roots that are put together where they do not.
TEST(Verify_along_moments, signs_at_roots_and_between_them) {
  Dice dice(4);
  std::size_t zeros = 0, changes = 0;
  for (int k = 0; k < 4000; ++k) {
    // sqrt(d / 100) for d that is no square, between two fractions.
    long d = roll(dice, 1, 99);
    while (std::sqrt(static_cast<double>(d)) == std::floor(std::sqrt(static_cast<double>(d)))) d = roll(dice, 1, 99);
    const double root = std::sqrt(static_cast<double>(d)) / 10;
    const Path_moment moment{{ratio(-d, 100), 0, 1},
                             ratio(std::lround(std::floor(root * 256)), 256),
                             ratio(std::lround(std::floor(root * 256)) + 1, 256)};
    const std::vector<Path_moment> list{Walls::rational(0), moment, Walls::rational(1)};
    const Moments moments(list);
    along_check::Polynomial f{roll(dice, -9, 9), roll(dice, -9, 9), roll(dice, -9, 9)};
    if (k % 5 == 0) {  // a multiple of the root's own quadratic
      const long factor = roll(dice, -3, 3);
      f = {Integer(-d * factor), Integer(0), Integer(100 * factor)};
    }
    const auto value = [&](double t) { return f[0].get_d() + t * (f[1].get_d() + t * f[2].get_d()); };
    const double at_root = value(root);
    const int sign = std::fabs(at_root) < 1e-9 ? 0 : at_root > 0 ? 1 : -1;
    EXPECT_EQ(moments.sign_at(1, f), sign) << f[0] << ' ' << f[1] << ' ' << f[2] << " at " << root;
    zeros += sign == 0;
    EXPECT_EQ(moments.sign(1, 1, f), sign);
    EXPECT_EQ(moments.compare(1, ratio(1, 2)), root > 0.5 ? 1 : -1);
    // Between the root and 1: samples never contradict, and where a sign is told it is theirs.
    bool negative = false, positive = false;
    for (int s = 1; s < 200; ++s) {
      const double x = value(root + (1 - root) * s / 200);
      negative |= x < -1e-9;
      positive |= x > 1e-9;
    }
    const std::optional<int> between = moments.sign(1, 2, f);
    EXPECT_EQ(moments.never_negative(1, 2, f) && negative, false);
    changes += !between;
    EXPECT_EQ(between.value_or(0), !between ? 0 : positive ? 1 : negative ? -1 : 0);
    EXPECT_FALSE(negative && positive && between);
  }
  EXPECT_GT(zeros, 500U);
  EXPECT_GT(changes, 200U);
}

TEST(Verify_along_moments, a_double_root_between_is_no_sign_but_never_negative) {
  const std::vector<Path_moment> list{Walls::rational(0), Walls::rational(1)};
  const Moments moments(list);
  const along_check::Polynomial touching{1, -4, 4}, at_the_end{0, 0, 4}, apart{2, -4, 4};
  EXPECT_TRUE(moments.never_negative(0, 1, touching));
  EXPECT_EQ(moments.sign(0, 1, touching), std::nullopt);
  EXPECT_EQ(moments.sign(0, 1, at_the_end), 1);
  EXPECT_EQ(moments.sign_at(0, at_the_end), 0);
  EXPECT_EQ(moments.sign(0, 1, apart), 1);
  EXPECT_EQ(moments.sign(0, 1, {0, 1, -1}), 1);
  EXPECT_FALSE(moments.never_negative(0, 1, {0, -1, 1}));
  EXPECT_EQ(moments.sign(0, 1, {1, -2, 1}), 1);  // the root is the last moment
}

/// The root of 1/2, told apart by fractions far from it.
TEST(Verify_along_moments, are_compared_with_fractions_between_theirs) {
  const std::vector<Path_moment> list{Walls::rational(0), {{-1, 0, 2}, ratio(1, 8), ratio(7, 8)}, Walls::rational(1)};
  const Moments moments(list);
  EXPECT_EQ(moments.compare(1, ratio(1, 2)), 1);
  EXPECT_EQ(moments.compare(1, ratio(3, 4)), -1);
  EXPECT_EQ(moments.sign_at(1, {-3, 5, 0}), 1);
  EXPECT_EQ(moments.sign_at(1, {-4, 5, 0}), -1);
}

}  // namespace
}  // namespace verify_along_test
