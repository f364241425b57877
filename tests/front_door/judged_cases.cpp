// Cases that are judged, as the front door sees them.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/judge/case.h>
#include <sightline/sightline.h>

#include <gtest/gtest.h>

namespace {

using namespace sightline;

TEST(Cases, in_triangles_have_the_same_surface_and_look_the_same) {
  const auto surface = [](const Model& model) {
    double area = 0;
    for (const Part& part : model.parts()) area += part.area();
    return area;
  };
  const auto view = [](const Model& model, const Exact_point& eye) {
    double angle = 0;
    for (const Seen::Visible_part& part : see(model, eye).parts) angle += part.solid_angle(eye);
    return angle;
  };
  std::size_t fanned = 0;
  for (const char* name : {"boxes", "hinged", "leaves", "rooms"})
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      const generate::Family& family = generate::family(name);
      generate::Family_parameters parameters;
      parameters.seed = seed;
      parameters.size = family.small_size;
      judge::Case_options options;
      const judge::Case plain = judge::case_of(family, parameters, options);
      options.triangles = true;
      const judge::Case fans = judge::case_of(family, parameters, options);
      ASSERT_EQ(plain.not_asked + fans.not_asked, "") << name << ' ' << seed;
      for (Face_id f = 0; f < fans.soup.face_count(); ++f) EXPECT_LE(fans.soup.loop(f).size(), 3u);
      fanned += fans.soup.face_count() > plain.soup.face_count();
      const Model one(plain.soup), other(fans.soup);
      if (other.left_out().empty()) {  // a triangle may be a double of another face's
        EXPECT_NEAR(surface(one), surface(other), 1e-9 * surface(one)) << name << ' ' << seed;
      }
      EXPECT_NEAR(view(one, plain.query.eye), view(other, fans.query.eye), 1e-9) << name << ' ' << seed;
    }
  EXPECT_GT(fanned, 0u);
}

}  // namespace
