#include "query.h"

#include <charconv>
#include <fstream>

namespace sightline::app {

namespace {

const char* name_of(generate::Distance distance) {
  return distance == generate::Distance::exact ? "exact" : distance == generate::Distance::beside ? "beside" : "far";
}

Exact_point point_of(const Json& list) {
  if (!list.is_array() || list.size() != 3) throw std::invalid_argument("a point is a list of three numbers, not " + list.dump());
  Exact_point p;
  for (std::size_t k = 0; k < 3; ++k) {
    if (!list[k].is_string()) throw std::invalid_argument("numbers are strings, \"p\" or \"p/q\", not " + list[k].dump());
    p[k] = rational_from_string(list[k].get<std::string>());
  }
  return p;
}

}  // namespace

Json query_json(const generate::Posed_scene& scene, std::uint64_t seed) {
  Json source = Json::array();
  for (const Exact_point& p : scene.source) source.push_back(point_json(p));
  return {{"format", "sightline query 1"}, {"name", scene.name}, {"seed", seed}, {"distance", name_of(scene.distance)}, {"eye", point_json(scene.eye)}, {"source", std::move(source)},
          {"visible", scene.visible}, {"hidden", scene.hidden}};
}

Query read_query(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) throw std::runtime_error(path + ": cannot be read; check the name");
  try {
    const Json document = Json::parse(in);
    if (!document.is_object() || document.value("format", "") != "sightline query 1") throw std::invalid_argument("\"format\" is not \"sightline query 1\"");
    Query query;
    query.scene.name = document.value("name", path);
    query.seed = document.value("seed", std::uint64_t{1});
    query.scene.eye = point_of(document.at("eye"));
    for (const Json& p : document.value("source", Json::array())) query.scene.source.push_back(point_of(p));
    query.scene.visible = document.value("visible", std::vector<Face_id>());
    query.scene.hidden = document.value("hidden", std::vector<Face_id>());
    return query;
  } catch (const std::exception& error) {
    throw std::runtime_error(path + ": " + error.what());
  }
}

Rational parse_scale(const std::string& text, const std::string& option) {
  const std::string wanted = option + " wants a number > 0, or 2^K with K from -1100 to 1100";
  if (text.starts_with("2^")) {
    int power = 0;
    const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), power);
    if (error != std::errc() || end != text.data() + text.size() || power < -1100 || power > 1100) throw Usage_error(wanted + ", not '" + text + "'");
    return generate::power_of_two(power);
  }
  const std::vector<Rational> numbers = parse_numbers(text, wanted);
  if (numbers.size() != 1 || sgn(numbers[0]) <= 0) throw Usage_error(wanted + ", not '" + text + "'");
  return numbers[0];
}

}  // namespace sightline::app
