// The examples of README.md and of sightline/README.md.

#include <sightline/sightline.h>

#include <gtest/gtest.h>

#include <iostream>
#include <sstream>

namespace {

/// Who sees what in a room: from a point, from a face, and in which order to paint it.
void look_around(const std::filesystem::path& file, std::ostream& out) {
  const auto room = sightline::Model::read(file);

  const auto seen = sightline::see(room, {1, 1, 2});
  double all_around = 0;
  for (const auto face : seen.visible) all_around += seen.solid_angle(face);
  out << seen.visible.size() << " faces fill " << all_around << " of 4 pi\n";

  const auto lit = sightline::weakly_visible(room, 0);
  out << lit.visible.size() << " faces are seen from face 0, " << lit.hidden.size()
      << " are not: " << (sightline::verify(room, lit.certificate()).accepted ? "proved" : "wrong") << '\n';

  const auto painted = sightline::order(room, {1, 1, 2});
  out << painted.parts.size() << " polygons, farthest first, the last of face " << painted.parts.back().face << '\n';
}

/// How the faces turn as a viewpoint moves, and which of them may hide which.
void walk_past(const sightline::Model& model, std::ostream& out) {
  auto tracker = sightline::track(model);
  for (const sightline::Exact_point& at : {sightline::Exact_point{3, 0, 0}, sightline::Exact_point{3, 2, 0}})
    out << tracker.move_to(at).size() << " faces turned, " << tracker.on_view().size() << " look here\n";

  const auto priority = sightline::priority_graph(model);
  out << priority.components.size() << " components, " << priority.cyclic << " of them cycles\n";
}

/// A search that is given up after a while.
bool ends_in_time(const sightline::Model& model, std::size_t faces) {
  struct Enough {};
  sightline::Asking asking;
  asking.threads = 1;
  asking.progress = [=](std::size_t done, std::size_t) {
    if (done >= faces) throw Enough();
  };
  try {
    weakly_visible(model, 0, asking);
    return true;
  } catch (const Enough&) {
    return false;
  }
}

TEST(Example, of_the_pages_prints_what_they_say) {
  const std::filesystem::path corpus = std::filesystem::path(SIGHTLINE_SOURCE_DIR) / "tests" / "corpus" / "general";
  std::ostringstream out;
  look_around(corpus / "two_rooms.off", out);
  EXPECT_EQ(out.str(),
            "85 faces fill 12.5664 of 4 pi\n"
            "65 faces are seen from face 0, 77 are not: proved\n"
            "145 polygons, farthest first, the last of face 16\n");
  out.str("");
  const auto cube = sightline::Model::read(corpus / "cube.off");
  walk_past(cube, out);
  EXPECT_EQ(out.str(),
            "1 faces turned, 1 look here\n"
            "1 faces turned, 2 look here\n"
            "6 components, 0 of them cycles\n");
  EXPECT_FALSE(ends_in_time(cube, 2));
  EXPECT_TRUE(ends_in_time(cube, 100));
}

}  // namespace
