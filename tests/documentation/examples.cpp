// The examples of the documentation pages of kernel, io, generate, baseline, compare and verify; those of other pages
// are beside their tests.

// ---- kernel/README.md

#include <sightline/kernel/traits/exact_traits.h>

#include <iostream>

void test_a_face(std::ostream& out) {
  sightline::Polygon_soup soup;  // or read_scene() of io/read.h
  const auto p = soup.add_point(0.0, 0.0, 0.0), q = soup.add_point(1.0, 0.0, 0.0), r = soup.add_point(0.0, 1.0, 0.0);
  soup.add_face({p, q, r});
  const sightline::Scene scene(soup);  // common grid, interned planes, convex pieces
  const sightline::Exact_traits traits(scene);
  sightline::Predicate_counts counts;
  const auto eye = traits.eye({sightline::Rational(1, 3), sightline::Rational(1, 3), 1});
  if (traits.side(eye, traits.supporting_plane(0), counts) == CGAL::POSITIVE) out << "the face is on-view\n";
}

// ---- io/README.md

#include <sightline/io/read.h>
#include <sightline/io/write.h>

#include <iostream>

void convert(const std::filesystem::path& from, const std::filesystem::path& to, std::ostream& out) {
  const sightline::Polygon_soup soup = sightline::read_scene(from);
  out << soup.point(0)[0] << '\n';  // 1/10 where the file begins with "v 0.1 ..."
  sightline::write_scene(soup, to);
}

// ---- harness/generate/README.md

#include <sightline/harness/generate/buildings.h>
#include <sightline/harness/generate/scenes.h>
#include <sightline/harness/generate/transform.h>

namespace generate = sightline::generate;

/// A town elsewhere, turned by a rational rotation, its faces in another order: every answer must be the same as for
/// make("city_rotated", boxes, seed).
sightline::Polygon_soup town_elsewhere(std::size_t boxes, std::uint64_t seed) {
  const sightline::Polygon_soup town = generate::city(boxes, seed, /* rotated */ true);
  const sightline::Polygon_soup other =
      generate::rotated(generate::translated(town, {sightline::Rational(1, 3), 0, 0}), generate::rotation(3, 1, -2, 1));
  return generate::faces_permuted(other, seed);
}

// ---- algorithms/baseline/README.md

#include <sightline/algorithms/baseline/depth_buffer.h>

#include <iostream>

/// How many pixels of 6 x 512 x 512 each piece of a scene gets, with depths of 24 bits.
void count_pixels(const sightline::Scene& scene, const sightline::Exact_point& eye, std::ostream& out) {
  sightline::Depth_buffer_options options;
  options.size = 512;
  options.bits = 24;
  const sightline::Depth_buffer buffer = sightline::depth_buffer(scene, eye, options);
  for (std::uint32_t piece = 0; piece < scene.pieces().size(); ++piece)
    out << "face " << scene.pieces()[piece].face << ": "
        << std::count(buffer.pieces.begin(), buffer.pieces.end(), piece) << " pixels\n";
}

// ---- harness/compare/README.md

#include <sightline/harness/compare/order_errors.h>

#include <iostream>

/// fragments: back to front, as some method drew them; vertices as the exact numbers that its doubles are.
void judge(const sightline::Scene& scene, const sightline::Exact_point& eye,
           const std::vector<sightline::Order_fragment>& fragments, std::ostream& out) {
  const sightline::Order_errors errors =
      sightline::order_errors(scene, eye, fragments, /* compare all pairs of at most */ 3000);
  out << errors.wrong_beyond_rounding << " pairs in the wrong order, " << errors.lost << " of the area lost\n";
}

#include <sightline/algorithms/point_visibility/boxes.h>
#include <sightline/algorithms/point_visibility/visible.h>
#include <sightline/harness/compare/visible_errors.h>

/// How much of the sphere around an eye a depth buffer of 6 x 256 x 256 pixels gets wrong, and doubles do.
void judge_views(const sightline::Scene& scene, const sightline::Exact_point& eye, std::ostream& out) {
  const sightline::Piece_boxes boxes(scene);
  const sightline::Exact_view view(scene, eye);
  sightline::Visible_reference exact(view, visible_surface(view, boxes));

  const sightline::Visible_errors pixels = exact.errors(depth_buffer(scene, eye, {256, 24, 0, 0}));
  const sightline::Number_view<double> doubles(scene, eye);
  const sightline::Visible_errors parts = exact.errors(doubles, visible_surface(doubles, boxes));
  out << "pixels: " << pixels.wrong << " wrong, " << pixels.missing << " faces missing; doubles: " << parts.wrong
      << " wrong\n";
}

// ---- algorithms/verify/README.md

#include <sightline/algorithms/verify/certificate_json.h>  // or order.h, without JSON

#include <nlohmann/json.hpp>

#include <fstream>
#include <iostream>

bool check(const sightline::Polygon_soup& scene, const char* file) {
  std::ifstream in(file);
  const sightline::Order_certificate certificate = sightline::read_order_certificate(in);
  const sightline::Verdict verdict = sightline::verify_order(scene, certificate);
  std::cout << (verdict.accepted ? "accepted: " : "rejected: ") << verdict.why << '\n';
  return verdict.accepted;
}

// ---- What they do

#include <gtest/gtest.h>

#include <sightline/algorithms/verify/certificate_writer.h>
#include <sightline/kernel/scene/scene.h>

namespace {

using namespace sightline;

/// Two unit squares, the second over the first.
Polygon_soup two_squares() {
  Polygon_soup soup;
  for (const double z : {0.0, 1.0}) {
    const auto p = soup.add_point(0.1, 0.0, z), q = soup.add_point(1.0, 0.0, z), r = soup.add_point(1.0, 1.0, z),
               s = soup.add_point(0.0, 1.0, z);
    soup.add_face({p, q, r, s});
  }
  return soup;
}
std::vector<Order_fragment> whole_faces(const Scene& scene, const std::vector<Face_id>& order) {
  std::vector<Order_fragment> fragments;
  for (const Face_id face : order) {
    Order_fragment& fragment = fragments.emplace_back();
    fragment.face = face;
    fragment.piece = 0;
    fragment.vertices = scene.corner_points(scene.pieces()[face]);
  }
  return fragments;
}

TEST(Examples, of_the_kernel) {
  std::ostringstream out;
  test_a_face(out);
  EXPECT_EQ(out.str(), "the face is on-view\n");
}

TEST(Examples, of_reading_and_writing) {
  const std::filesystem::path folder =
      std::filesystem::temp_directory_path() / ("sightline-examples-" + std::to_string(std::random_device()()));
  std::filesystem::create_directory(folder);
  std::ofstream(folder / "a.obj") << "v 0.1 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ostringstream out;
  convert(folder / "a.obj", folder / "a.qoff", out);
  EXPECT_EQ(out.str(), "1/10\n");
  EXPECT_EQ(read_scene(folder / "a.qoff").face_count(), 1u);
  std::filesystem::remove_all(folder);
}

TEST(Examples, of_generated_scenes) {
  const Scene here(generate::make("city_rotated", 5, 7)), elsewhere(town_elsewhere(5, 7));
  EXPECT_EQ(here.pieces().size(), elsewhere.pieces().size());
  EXPECT_EQ(here.pieces().size(), 26u);
}

TEST(Examples, of_errors_of_orders_and_their_check) {
  const Polygon_soup soup = two_squares();
  const Scene scene(soup);
  const Exact_point eye{Rational(1, 2), Rational(1, 2), 5};
  std::ostringstream out;
  judge(scene, eye, whole_faces(scene, {0, 1}), out);
  judge(scene, eye, whole_faces(scene, {1, 0}), out);
  EXPECT_EQ(out.str(),
            "0 pairs in the wrong order, 0 of the area lost\n1 pairs in the wrong order, 0 of the area lost\n");

  const std::filesystem::path file = std::filesystem::temp_directory_path() /
                                     ("sightline-examples-" + std::to_string(std::random_device()()) + ".json");
  for (const bool right : {true, false}) {
    Order_certificate certificate;
    certificate.eye = eye;
    certificate.fragments = whole_faces(scene, right ? std::vector<Face_id>{0, 1} : std::vector<Face_id>{1, 0});
    std::ofstream(file) << certificate_text(certificate);
    testing::internal::CaptureStdout();
    EXPECT_EQ(check(soup, file.c_str()), right);
    EXPECT_EQ(testing::internal::GetCapturedStdout().starts_with(right ? "accepted" : "rejected"), true);
  }
  std::filesystem::remove(file);
}

TEST(Examples, of_depth_buffers_and_their_errors) {
  // From above, the second square hides the first.
  const Scene scene(two_squares());
  const Exact_point eye{Rational(1, 2), Rational(1, 2), 2};
  std::ostringstream pixels, errors;
  count_pixels(scene, eye, pixels);
  judge_views(scene, eye, errors);
  // At distance 1, a unit is 256 pixels, and the area of a face, 19/20, is 62259.2.
  EXPECT_EQ(pixels.str(), "face 0: 0 pixels\nface 1: 62260 pixels\n");
  EXPECT_TRUE(errors.str().starts_with("pixels: 0.000")) << errors.str();
  EXPECT_TRUE(errors.str().ends_with("wrong, 0 faces missing; doubles: 0 wrong\n")) << errors.str();
}

}  // namespace
