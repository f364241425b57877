#pragma once
// The cases that are judged: a scene as programs get it, and a query about it.

#include <sightline/harness/generate/families.h>
#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <cstdint>
#include <string>
#include <vector>

namespace sightline::judge {

struct Case_options {
  Question question = Question::see;
  bool two_sided = false;
  bool doubles = true;     ///< coordinates are rounded to doubles, which any program reads
  bool triangles = false;  ///< faces are cut into triangles, each a face of its own; of polygons without area is none
};

/// A scene and a query about it, or why there is none.
struct Case {
  Polygon_soup soup;
  Query query;
  std::vector<Face_id> visible, hidden;  ///< what construction knows of a weak query, where it is as given
  bool as_given = true;                  ///< nothing was rounded, no face cut
  std::string not_asked;
};

/// A case of a family. Where weak visibility is asked and the family names no source, a face of the scene looks; where
/// set operations are, solids are made of its faces, generate::pair_of_solids(). The same arguments give the same case.
Case case_of(const generate::Family& family, const generate::Family_parameters& parameters,
             const Case_options& options);

/// A query about a scene.
Case case_of(const Polygon_soup& scene, const Query& query, const Case_options& options);

/// A case with what is asked about moved: the eye, the source, the rays' origins, or the second solid.
Case moved(const Case& made, const Exact_point& by, const Case_options& options);

/// A case of a scene of somebody's: an eye in or about its box, or a small square there that looks along an axis; of
/// set operations, the scene and generate::pair_of_copies().
Case case_of(const Polygon_soup& scene, std::uint64_t seed, const Case_options& options);

}  // namespace sightline::judge
