#include "words.h"

namespace sightline::app::schema {

Json named(const std::string& name) { return {{"$ref", "#/$defs/" + name}}; }
Json type(const std::string& name) { return {{"type", name}}; }
Json list_of(Json items) { return {{"type", "array"}, {"items", std::move(items)}}; }
Json tuple_of(Json items, int size) {
  return {{"type", "array"}, {"items", std::move(items)}, {"minItems", size}, {"maxItems", size}};
}
Json any_of(std::vector<Json> all) { return {{"anyOf", std::move(all)}}; }
Json one_word_of(const std::vector<std::string>& words) { return {{"enum", words}}; }

Json object(const Members& members) {
  Json properties = Json::object(), required = Json::array();
  for (const auto& [key, what] : members) {
    const bool optional = key.ends_with('?');
    const std::string name = optional ? key.substr(0, key.size() - 1) : key;
    properties[name] = what;
    if (!optional) required.push_back(name);
  }
  return {{"type", "object"}, {"properties", std::move(properties)}, {"required", std::move(required)}};
}

Json a_count() { return {{"type", "integer"}, {"minimum", 0}}; }
Json a_face() { return {{"type", "integer"}, {"minimum", 0}, {"description", "the place of a face, from 0"}}; }

Json a_double() {
  Json number = any_of({type("number"), type("null")});
  number["description"] = "null: beyond doubles, or floats";
  return number;
}

Members with(Members members, const Members& more) {
  members.insert(members.end(), more.begin(), more.end());
  return members;
}

}  // namespace sightline::app::schema
