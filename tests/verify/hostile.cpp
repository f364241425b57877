// Certificates that are wrong in every way: an answer in one line, never a crash.

#include "../sample.h"
#include "scenes.h"

#include <random>

namespace {

using test_scenes::sample;

using namespace verify_test;

const Points floor_of_four = rectangle(0, 4, 0, 4, 0), small_roof = rectangle(1, 2, 1, 2, 3);

Scene good() {
  Scene scene;
  scene.seen_from(at(1, 1, 10)).face(floor_of_four);
  scene.face(small_roof);
  scene.face({at(0, 0, 9), at(1, 0, 9), at(2, 0, 9)});
  scene.face(floor_of_four);
  const Points skew = {at(10, 0, 0), at(14, 0, 1), at(14, 4, 0), at(10, 4, 1)};
  scene.face(skew);
  scene.leave_out(2, "zero area").leave_out(3, "duplicate of 0");
  const Points first = {skew[0], skew[1], skew[2]}, second = {skew[0], skew[2], skew[3]};
  scene.cut(4, 0, first).cut(4, 1, second).draw(4, first, 0).draw(4, second, 1);
  return scene.draw(0, rectangle(0, 1, 0, 4, 0)).draw(0, rectangle(1, 4, 0, 4, 0)).draw(1, small_roof);
}

TEST(Hostile, indices_out_of_range) {
  expect_accepted(good());
  Scene scene = good();
  scene.certificate.fragments[1].face = 5;
  expect_rejected(scene, "fragment 1 names face 5");
  scene = good();
  scene.certificate.fragments[1].face = UINT32_MAX;
  expect_rejected(scene, "fragment 1 names face 4294967295");
  scene = good();
  scene.certificate.pieces[1].face = 5;
  expect_rejected(scene, "piece 1 names face 5");
  scene = good();
  scene.certificate.set_aside[0].face = 5;
  expect_rejected(scene, "set_aside names face 5");
  scene = good();
  scene.soup.add_face({0, 1, 1000});
  expect_rejected(scene, "the scene's face 5 names a point");
  const Verdict nothing = verify_order(Polygon_soup{}, Order_certificate{});
  EXPECT_TRUE(nothing.accepted) << nothing.why;
  Scene empty;
  expect_rejected(empty.draw(0, floor_of_four), "names face 0");
}

TEST(Hostile, numbers_that_are_not_canonical) {
  Rational doubled, infinite;
  mpz_set_si(mpq_numref(doubled.get_mpq_t()), 2);
  mpz_set_si(mpq_denref(doubled.get_mpq_t()), 2);
  mpz_set_si(mpq_numref(infinite.get_mpq_t()), 1);
  mpz_set_si(mpq_denref(infinite.get_mpq_t()), 0);
  for (const Rational& bad : {doubled, infinite}) {
    Scene scene = good();
    scene.certificate.eye[1] = bad;
    expect_rejected(scene, "the eye is not");
    scene = good();
    scene.certificate.fragments[4].vertices[2][2] = bad;
    expect_rejected(scene, "fragment 4 has a vertex that is not", {4});
    scene = good();
    scene.certificate.pieces[1].vertices[0][0] = bad;
    expect_rejected(scene, "piece 1 has a vertex that is not");
  }
}

TEST(Hostile, absurd_numbers) {
  const Rational huge = 1 / tiny(100000), small = tiny(100000);
  Scene scene = good();
  scene.certificate.eye[2] = huge;
  expect_accepted(scene);
  scene.certificate.eye[2] = -huge;
  EXPECT_FALSE(scene.verdict().accepted);
  for (const Rational& wrong : {huge, small}) {
    scene = good();
    scene.certificate.fragments[4].vertices[2][0] = wrong;
    EXPECT_FALSE(scene.verdict().accepted);
    scene.certificate.fragments[4].vertices[2][2] = wrong;
    expect_rejected(scene, "off the plane", {4});
  }
}

TEST(Hostile, many_straight_corners_cost_little) {
  Points many;
  for (int k = 0; k < 20000; ++k) many.push_back(at(1 + ratio(k, 20000), 1, 3));
  for (int k = 1; k < 4; ++k) many.push_back(small_roof[static_cast<std::size_t>(k)]);
  Scene scene;
  scene.seen_from(at(1, 1, 10));
  for (int k = 0; k < 2; ++k) scene.face(small_roof);
  expect_accepted(scene.draw(0, many).draw(1, many));
}

TEST(Hostile, the_eye_anywhere) {
  for (int x = -1; x <= 5; ++x)
    for (int y = -1; y <= 5; ++y)
      for (int z = -1; z <= 4; ++z) {
        Scene scene = good();
        scene.seen_from(at(x, y, z));
        const Verdict verdict = scene.verdict();  // never a crash; from above the small_roof always right
        EXPECT_TRUE(verdict.accepted || z < 3) << verdict.why;
      }
}

TEST(Hostile, random_damage_is_survived_and_hardly_ever_right) {
  std::mt19937 random(20261121);
  const auto below = [&](std::size_t n) { return static_cast<std::size_t>(random() % n); };
  for (int trial = 0; trial < sample(3000); ++trial) {
    SCOPED_TRACE(trial);
    Scene scene = good();
    auto& c = scene.certificate;
    bool harmless = true;  // nothing but an exchange of fragments was done
    for (std::size_t steps = 1 + below(3); steps > 0; --steps) {
      Order_fragment& fragment = c.fragments[below(c.fragments.size())];
      auto& vertices = fragment.vertices;
      const std::size_t kind = below(9);
      harmless = harmless && kind == 0;
      if (kind == 0) std::swap(c.fragments[below(c.fragments.size())], c.fragments[below(c.fragments.size())]);
      if (kind == 1 && !vertices.empty())
        vertices.erase(vertices.begin() + static_cast<std::ptrdiff_t>(below(vertices.size())));
      if (kind == 2 && !vertices.empty()) vertices.push_back(vertices[below(vertices.size())]);
      if (kind == 3 && !vertices.empty())
        vertices[below(vertices.size())][below(3)] += ratio(static_cast<long>(below(5)) - 2, 2);
      if (kind == 4) fragment.face = static_cast<Face_id>(below(6));
      if (kind == 5) fragment.piece = static_cast<std::uint32_t>(below(3));
      if (kind == 6) c.fragments.push_back(fragment);
      if (kind == 7) c.pieces[below(2)].vertices[below(3)][below(3)] += 1;
      if (kind == 8) c.set_aside[below(2)].face = static_cast<Face_id>(below(6));
    }
    const Verdict verdict = scene.verdict();
    EXPECT_EQ(verdict.why.find('\n'), std::string::npos);
    EXPECT_FALSE(verdict.why.empty());
    for (const std::size_t f : verdict.fragments) EXPECT_LT(f, c.fragments.size());
    EXPECT_TRUE(!harmless || verdict.accepted || verdict.why.find("is nearer") != std::string::npos) << verdict.why;
  }
}

}  // namespace
