#include <sightline/harness/laws/query_json.h>

#include <sightline/harness/judge/protocol.h>
#include <sightline/kernel/number.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline::harness {

nlohmann::ordered_json query_json(const generate::Posed_scene& scene, std::uint64_t seed) {
  const auto point_json = [](const Exact_point& p) -> nlohmann::ordered_json {
    return {sightline::to_string(p[0]), sightline::to_string(p[1]), sightline::to_string(p[2])};
  };
  nlohmann::ordered_json source = nlohmann::ordered_json::array();
  for (const Exact_point& p : scene.source) source.push_back(point_json(p));
  nlohmann::ordered_json query{{"format", "sightline query 1"},
                               {"name", scene.name},
                               {"seed", seed},
                               {"distance", generate::name_of(scene.distance)},
                               {"eye", point_json(scene.eye)},
                               {"source", std::move(source)},
                               {"visible", scene.visible},
                               {"hidden", scene.hidden}};
  if (scene.first > 0) query["first"] = scene.first;
  return query;
}

Posed_query query_from_json(const nlohmann::json& value, std::size_t faces) {
  const auto fail = [](const std::string& what) { throw std::invalid_argument("query: " + what); };
  const auto member = [&](const char* key) -> const nlohmann::json* {
    const auto found = value.find(key);
    return found == value.end() ? nullptr : &*found;
  };
  const auto list_of_faces = [&](const char* key) {
    std::vector<Face_id> list;
    const nlohmann::json* const given = member(key);
    if (given == nullptr) return list;
    if (!given->is_array()) fail(std::string("\"") + key + "\" is no list of faces");
    for (const nlohmann::json& face : *given) {
      if (!face.is_number_unsigned() || face.get<std::uint64_t>() >= faces)
        fail(std::string("\"") + key + "\" names a face that is not one of the scene's " + std::to_string(faces));
      list.push_back(face.get<Face_id>());
    }
    return list;
  };
  if (!value.is_object()) fail("expected an object");
  if (const nlohmann::json* const format = member("format"); format == nullptr || *format != "sightline query 1")
    fail("\"format\" is not \"sightline query 1\"");
  Posed_query query;
  if (const nlohmann::json* const name = member("name")) {
    if (!name->is_string()) fail("\"name\" is no string");
    query.scene.name = name->get<std::string>();
  }
  if (const nlohmann::json* const seed = member("seed")) {
    if (!seed->is_number_unsigned()) fail("\"seed\" is no whole number");
    query.seed = seed->get<std::uint64_t>();
  }
  if (const nlohmann::json* const distance = member("distance")) {
    const auto known = std::find_if(generate::distances.begin(), generate::distances.end(),
                                    [&](generate::Distance d) { return *distance == generate::name_of(d); });
    if (known == generate::distances.end()) fail("\"distance\" is neither \"exact\" nor \"beside\" nor \"far\"");
    query.scene.distance = *known;
  }
  const nlohmann::json* const eye = member("eye");
  if (eye == nullptr) fail("no \"eye\"");
  query.scene.eye = judge::point_from_json(*eye, "query: eye");
  if (const nlohmann::json* const source = member("source"))
    query.scene.source = judge::points_from_json(*source, "query: source");
  if (const nlohmann::json* const first = member("first")) {
    if (!first->is_number_unsigned() || first->get<std::uint64_t>() > faces)
      fail("\"first\" is not how many of the scene's " + std::to_string(faces) + " faces are the first solid's");
    query.scene.first = first->get<std::size_t>();
  }
  query.scene.visible = list_of_faces("visible");
  query.scene.hidden = list_of_faces("hidden");
  return query;
}

}  // namespace sightline::harness
