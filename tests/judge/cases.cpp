// Cases of families: whether they are as given, and who looks where nobody is named.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/judge/case.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <cstdint>

namespace {

using namespace sightline;

TEST(Cases, of_families_say_whether_they_are_as_given_and_who_looks) {
  judge::Case_options options;
  options.question = judge::Question::weak;
  std::size_t rounded = 0, given = 0, lent = 0;
  for (const generate::Family& family : generate::families()) {
    generate::Family_parameters parameters;
    parameters.size = family.small_size;
    parameters.offset = {Rational(1, 3), 0, 0};
    for (const std::uint64_t seed : {1, 2}) {
      if (seed == 2) parameters.offset = {0, 0, 0};
      parameters.seed = seed;
      const generate::Posed_scene posed = family.make(parameters);
      const judge::Case made = judge::case_of(family, parameters, options);
      if (!made.not_asked.empty()) continue;
      bool same = made.soup.face_count() == posed.soup.face_count() &&
                  made.soup.point_count() == posed.soup.point_count() &&
                  (posed.source.empty() || made.query.source == posed.source);
      for (Point_id p = 0; p < posed.soup.point_count() && same; ++p) same = made.soup.point(p) == posed.soup.point(p);
      EXPECT_EQ(made.as_given, same) << family.name;
      ++(same ? given : rounded);
      EXPECT_GE(made.query.source.size(), 3u) << family.name;
      lent += posed.source.empty();
    }
  }
  EXPECT_GT(rounded, 10u);
  EXPECT_GT(given, 10u);
  EXPECT_GT(lent, 10u);
}

TEST(Cases, of_which_a_face_was_cut_are_not_as_given_however_many_there_are) {
  // One without area goes, as another becomes two triangles.
  Polygon_soup soup;
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(2, 0), std::pair(2, 2), std::pair(0, 2), std::pair(5, 5),
                             std::pair(6, 6), std::pair(7, 7), std::pair(8, 8)})
    soup.add_point(Rational(x), Rational(y), Rational(0));
  soup.add_face({0, 1, 2, 3});
  soup.add_face({4, 5, 6, 7});
  judge::Query query;
  query.eye = {1, 1, 5};
  judge::Case_options options;
  EXPECT_TRUE(judge::case_of(soup, query, options).as_given);
  options.triangles = true;
  const judge::Case cut = judge::case_of(soup, query, options);
  EXPECT_EQ(cut.soup.face_count(), soup.face_count());
  EXPECT_FALSE(cut.as_given);
}

}  // namespace
