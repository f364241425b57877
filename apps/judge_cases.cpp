// Cases for judging: the scene as programs get it, and the query.

#include "judge_cases.h"

namespace sightline::app {

namespace {

/// A planar convex piece of the scene.
std::vector<Exact_point> a_piece(const Scene& scene, std::uint64_t seed) {
  std::vector<Exact_point> points;
  if (scene.pieces().empty()) return points;
  for (const Piece_corner& corner : scene.corners(scene.pieces()[seed % scene.pieces().size()])) points.push_back(scene.position(corner.point));
  return points;
}

/// As programs get it: rounded where that is wanted, and with planar faces.
void prepare(Judge_case& made, const Case_options& options) {
  if (options.doubles) {
    made.soup = judge::rounded_to_doubles(made.soup);
    made.query = judge::rounded_to_doubles(std::move(made.query));
  }
  made.soup = judge::with_planar_faces(made.soup);
}

/// Runs `make`; what cannot be made, or is beyond the range of doubles, is not asked.
template <class Make>
Judge_case attempted(Make make) {
  Judge_case made;
  try {
    make(made);
  } catch (const std::invalid_argument& error) {
    made.not_asked = error.what();
  } catch (const std::domain_error&) {
    made.not_asked = "coordinates are beyond the range of doubles";
  }
  return made;
}

bool same_coordinates(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.coordinates.size() != b.coordinates.size() || a.face_count() != b.face_count()) return false;
  for (std::size_t k = 0; k < a.coordinates.size(); ++k)
    if (a.coordinates[k] != b.coordinates[k]) return false;
  return true;
}

}  // namespace

Judge_case case_of(const generate::Family& family, const generate::Family_parameters& parameters, const Case_options& options) {
  return attempted([&](Judge_case& made) {
    generate::Posed_scene posed = family.make(parameters);
    made.soup = posed.soup;
    made.query = {options.question, posed.eye, posed.source, options.two_sided};
    prepare(made, options);
    if (options.question != judge::Question::weak) return;
    if (posed.source.empty()) made.query.source = a_piece(Scene(made.soup), parameters.seed);
    else if (!options.two_sided && made.query.source == posed.source && same_coordinates(made.soup, posed.soup)) made.visible = posed.visible, made.hidden = posed.hidden;
  });
}

Judge_case case_of(const Polygon_soup& scene, std::uint64_t seed, const Case_options& options) {
  return attempted([&](Judge_case& made) {
    made.soup = scene, made.query.question = options.question, made.query.two_sided = options.two_sided;
    if (scene.point_count() == 0) return;
    Exact_point low = scene.point(0), high = low;
    for (Point_id p = 0; p < scene.point_count(); ++p)
      for (std::size_t k = 0; k < 3; ++k) low[k] = std::min(low[k], scene.point(p)[k]), high[k] = std::max(high[k], scene.point(p)[k]);
    generate::Random random(seed);
    // A place in the box, or up to a quarter of its sides outside.
    Rational longest = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Rational side = high[k] - low[k];
      made.query.eye[k] = low[k] + side * Rational(static_cast<long>(random.between(-16, 80))) / 64;
      longest = std::max(longest, side);
    }
    // A square around it, counterclockwise as seen from a side of its axis.
    const std::size_t axis = random.below(3), x = (axis + 1) % 3, y = (axis + 2) % 3;
    const bool turned = random.chance(1, 2);
    const Rational half = longest / 32;
    for (const auto& [dx, dy] : {std::pair(-1, -1), std::pair(1, -1), std::pair(1, 1), std::pair(-1, 1)}) {
      Exact_point corner = made.query.eye;
      corner[x] += half * (turned ? dy : dx), corner[y] += half * (turned ? dx : dy);
      made.query.source.push_back(corner);
    }
    prepare(made, options);
  });
}

}  // namespace sightline::app
