#pragma once
// The cases that `sightline judge` asks about: families at several distances from their degeneracies, or scenes of a folder.

#include <sightline/algorithms/generate/families.h>
#include <sightline/algorithms/judge/truth.h>

#include <string>
#include <vector>

namespace sightline::app {

struct Case_options {
  judge::Question question = judge::Question::see;
  bool two_sided = false;
  bool doubles = true;  ///< coordinates are rounded to doubles, which any program reads
};

/// A scene and a query about it, or why there is none.
struct Judge_case {
  Polygon_soup soup;
  judge::Query query;
  std::vector<Face_id> visible, hidden;  ///< what construction knows of a weak query, where nothing was rounded
  std::string not_asked;
};

/// A case of a family. Where weak visibility is asked and the family names no source, a face of the scene looks. The same arguments give the same case.
Judge_case case_of(const generate::Family& family, const generate::Family_parameters& parameters, const Case_options& options);

/// A case of a scene of somebody's: an eye in or about its box, or a small square there that looks along an axis.
Judge_case case_of(const Polygon_soup& scene, std::uint64_t seed, const Case_options& options);

}  // namespace sightline::app
