// Certificates of visible surfaces: written as a stream they are what is held, hardly a ray is in the table twice, and
// the text is tight.

#include <sightline/algorithms/point_visibility/certificate.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/soups.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>
#include <stdexcept>

namespace sightline {
namespace {

struct Sight {
  explicit Sight(const Polygon_soup& soup, const Exact_point& eye)
      : scene(soup),
        view(scene, eye),
        surface(visible_surface(view, Piece_boxes(scene), Visible_options{.threads = 1})) {}
  Scene scene;
  Exact_view view;
  Visible_surface<Exact_view> surface;

  Visible_certificate certificate() const { return visible_certificate(view, surface, view.eye()); }
  std::string text(const std::function<void(std::size_t, std::size_t)>& progress = {}) const {
    std::ostringstream out;
    write_visible_certificate(out, view, surface, view.eye(), {}, progress);
    return out.str();
  }
  /// The first form: with the vertices of each part, and a ray to their mean.
  std::string written_out() const {
    Visible_certificate plain = certificate();
    std::size_t next = 0;
    for (const auto& part : surface.parts) {
      if (part.piece == surface.nothing) continue;
      Visible_certificate::Part& entry = plain.parts[next++];
      entry.rays.clear();
      entry.vertices = vertices(view, surface, part);
      entry.ray = {0, 0, 0};
      for (const Exact_point& p : entry.vertices)
        for (std::size_t k = 0; k < 3; ++k)
          entry.ray[k] += (p[k] - view.eye()[k]) / static_cast<long>(entry.vertices.size());
    }
    plain.rays.clear();
    return certificate_text(plain);
  }
};

Visible_certificate read(const std::string& text) {
  std::istringstream in(text);
  return std::get<Visible_certificate>(read_certificate(in));
}

TEST(Visible_certificates, are_the_same_as_a_stream_and_are_accepted_in_both_forms) {
  for (const Polygon_soup& soup :
       {generate::slivers(60, 3), generate::city(8, 2), generate::soup(60, 0.5, 4), Polygon_soup()}) {
    for (const Exact_point& eye : {Exact_point{2, 3, 5}, Exact_point{Rational(1, 2), Rational(1, 2), Rational(1, 3)}}) {
      const Sight sight(soup, eye);
      const Visible_certificate certificate = sight.certificate();
      EXPECT_TRUE(certificate_text(read(sight.text())) == certificate_text(certificate)) << soup.file;
      const std::set<Exact_point> different(certificate.rays.begin(), certificate.rays.end());
      EXPECT_LE(certificate.rays.size(), different.size() + different.size() / 20) << "few have two names";
      for (const std::string& text : {sight.text(), sight.written_out()}) {
        const Verdict verdict = verify_visible(soup, read(text));
        EXPECT_TRUE(verdict.accepted) << soup.file << ": " << verdict.why;
      }
    }
  }
}

TEST(Visible_certificates, of_slivers_take_a_quarter_of_what_vertices_take) {
  const Sight sight(generate::slivers(500, 1), {-1, -2, 3});
  EXPECT_GT(sight.surface.parts.size(), 1500u);
  EXPECT_LT(4 * sight.text().size(), sight.written_out().size());
}

TEST(Visible_certificates, are_given_up_where_time_is_over) {
  const Sight sight(generate::slivers(200, 1), {-1, -2, 3});
  std::size_t calls = 0;
  sight.text([&](std::size_t done, std::size_t all) {
    EXPECT_LE(done, all);
    ++calls;
  });
  EXPECT_GT(calls, 5u);
  for (std::size_t last = 1; last <= calls; ++last) {
    std::size_t left = last;
    EXPECT_THROW(sight.text([&](std::size_t, std::size_t) {
      if (--left == 0) throw std::runtime_error("over");
    }),
                 std::runtime_error);
  }
}

}  // namespace
}  // namespace sightline
