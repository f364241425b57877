#include <sightline/harness/judge/protocol.h>

#include <sightline/algorithms/verify/keys_once.h>
#include <sightline/io/read.h>
#include <sightline/kernel/quoted.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <set>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace sightline::judge {

namespace protocol_detail {

[[noreturn]] inline void fail(const std::string& what) { throw std::invalid_argument(what); }

Json number_json(const Rational& value);

inline Json point_json(const Exact_point& p) { return {number_json(p[0]), number_json(p[1]), number_json(p[2])}; }

/// Collects an answer and says what is wrong with it.
class Answer_reader {
 public:
  Answer_reader(Question question, std::size_t faces, std::size_t rays)
      : question_(question), faces_(faces), rays_(rays) {}

  Answer from_json(const std::string& text);

  /// A face a line, or "abstained FACE", or "abstained all".
  Answer from_lines(std::string_view text);

 private:
  Face_id face(std::uint64_t number, const std::string& at) const;
  Face_id face(const nlohmann::json& value, const std::string& at) const;
  void take(const nlohmann::json& value, const std::string& at);
  void take_whole(Face_id id);
  void take_ray(const nlohmann::json& value, const std::string& at);
  void leave_open();
  Answer finished();
  Answer finished_rays();

  Question question_;
  std::size_t faces_, rays_;
  Answer answer_;
  bool abstains_from_all_ = false;
  std::set<Face_id> whole_, in_parts_;
};

Json number_json(const Rational& value) {
  const double near = nearest_double(value);
  if (std::isfinite(near) && exact(near) == value) return near;
  return to_string(value);
}

}  // namespace protocol_detail

Rational number_from_json(const nlohmann::json& value, const std::string& at) {
  if (value.is_number_unsigned()) return Rational(value.get<std::uint64_t>());
  if (value.is_number_integer()) return Rational(value.get<std::int64_t>());
  if (value.is_number() && std::isfinite(value.get<double>())) return exact(value.get<double>());
  if (!value.is_string()) protocol_detail::fail(at + " is no number; write 0.5, or \"1/3\" where it is no double");
  try {
    return rational_from_string(value.get_ref<const std::string&>());
  } catch (const std::invalid_argument& error) {
    protocol_detail::fail(at + ": " + error.what());
  }
}

Exact_point point_from_json(const nlohmann::json& value, const std::string& at) {
  if (!value.is_array() || value.size() != 3) protocol_detail::fail(at + " is no point; write [x, y, z]");
  return {number_from_json(value[0], at), number_from_json(value[1], at), number_from_json(value[2], at)};
}

std::vector<Exact_point> points_from_json(const nlohmann::json& value, const std::string& at) {
  if (!value.is_array()) protocol_detail::fail(at + " is no list of points; write [[x, y, z], ...]");
  std::vector<Exact_point> all;
  for (const nlohmann::json& p : value) all.push_back(point_from_json(p, at + '[' + std::to_string(all.size()) + ']'));
  return all;
}

namespace protocol_detail {

Answer Answer_reader::from_json(const std::string& text) {
  const nlohmann::json value = [&] {
    try {
      return json_with_keys_once(text);
    } catch (const nlohmann::json::exception&) {
      fail("begins with { but is not JSON");
    }
  }();
  check_integers(text);
  const std::string key = question_ == Question::order ? "order" : question_ == Question::trace ? "first" : "visible";
  const auto abstained = value.find("abstained");
  const bool from_all = abstained != value.end() && *abstained == "all";
  abstains_from_all_ = from_all;
  if (abstained != value.end() && !from_all) {
    if (question_ == Question::trace) fail("\"abstained\" is not \"all\"; write \"abstained\" in the place of a ray");
    if (!abstained->is_array()) fail("\"abstained\" is neither a list of faces nor \"all\"");
    for (std::size_t i = 0; i < abstained->size(); ++i)
      answer_.abstained.push_back(face((*abstained)[i], "abstained[" + std::to_string(i) + ']'));
  }
  if (const auto list = value.find(key); list != value.end()) {
    if (!list->is_array()) fail('"' + key + "\" is no list");
    if (from_all && question_ == Question::trace) fail("all rays are abstained from, and some are answered");
    for (std::size_t i = 0; i < list->size(); ++i) take((*list)[i], key + '[' + std::to_string(i) + ']');
  } else if (!from_all) {
    fail("has no \"" + key + "\": write {\"" + key + "\": [0, 4, 7]}");
  }
  return finished();
}

Answer Answer_reader::from_lines(std::string_view text) {
  for (std::size_t line = 1; !text.empty(); ++line) {
    std::string_view rest = text.substr(0, text.find('\n'));
    text.remove_prefix(std::min(text.size(), rest.size() + 1));
    const std::string at = "line " + std::to_string(line);
    const auto next_word = [&rest] {
      rest.remove_prefix(std::min(rest.size(), rest.find_first_not_of(" \t\r")));
      const std::string_view word = rest.substr(0, rest.find_first_of(" \t\r"));
      rest.remove_prefix(word.size());
      return word;
    };
    std::string_view word = next_word();
    if (word.empty()) continue;
    const bool abstains = word == "abstained", of_rays = question_ == Question::trace;
    if (abstains) word = next_word();
    if (!next_word().empty()) fail(at + " holds more than one face; write one a line");
    if (abstains && of_rays && word.empty()) {
      leave_open();
      continue;
    }
    if (abstains && of_rays && word != "all")
      fail(at + ": " + quoted(word) + " after `abstained`; write `abstained` in the line of a ray, or `abstained all`");
    if (abstains && word == "all") {
      abstains_from_all_ = true;
      continue;
    }
    if (of_rays && word == "none") {
      answer_.first.emplace_back();
      continue;
    }
    std::uint64_t number = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    if (error != std::errc() || end != word.data() + word.size())
      fail(at + ": " + quoted(word) + " is no face; write its number, from 0" + (of_rays ? ", or none" : ""));
    const Face_id id = face(number, at);
    if (abstains) answer_.abstained.push_back(id);
    else take_whole(id);
  }
  return finished();
}

Face_id Answer_reader::face(std::uint64_t number, const std::string& at) const {
  if (number >= faces_)
    fail(at + " names face " + std::to_string(number) + "; the scene has faces 0 to " +
         std::to_string(static_cast<std::int64_t>(faces_) - 1));
  return static_cast<Face_id>(number);
}

Face_id Answer_reader::face(const nlohmann::json& value, const std::string& at) const {
  if (!value.is_number_unsigned()) fail(at + " is no face; write its number, from 0");
  return face(value.get<std::uint64_t>(), at);
}

void Answer_reader::take(const nlohmann::json& value, const std::string& at) {
  if (question_ == Question::trace) return take_ray(value, at);
  if (question_ != Question::order || !value.is_object()) return take_whole(face(value, at));
  if (!value.contains("face") || !value.contains("vertices"))
    fail(at + " is neither a face nor a part {\"face\": 0, \"vertices\": [[x, y, z], ...]}");
  Drawn_face part{face(value["face"], at + ".face"), points_from_json(value["vertices"], at + ".vertices")};
  if (part.part.size() < 3) fail(at + " has fewer than three vertices; give the corners of a convex part of the face");
  in_parts_.insert(part.face);
  answer_.order.push_back(std::move(part));
}

void Answer_reader::leave_open() {
  answer_.abstained.push_back(static_cast<Face_id>(answer_.first.size()));
  answer_.first.emplace_back();
}

void Answer_reader::take_ray(const nlohmann::json& value, const std::string& at) {
  if (value == "abstained") return leave_open();
  if (value.is_null()) answer_.first.emplace_back();
  else if (value.is_number_unsigned()) answer_.first.emplace_back(face(value, at));
  else fail(at + " is no face; write its number, from 0, or null, or \"abstained\"");
}

Answer Answer_reader::finished_rays() {
  const std::size_t said = answer_.first.size();
  if (abstains_from_all_) {
    if (said > 0) fail("all rays are abstained from, and some are answered");
    for (std::size_t ray = 0; ray < rays_; ++ray) leave_open();
  } else if (said != rays_) {
    fail("it is of " + std::to_string(said) + " rays, and " + std::to_string(rays_) +
         " are asked about; write a line for each: a face, none or abstained");
  }
  return std::move(answer_);
}

void Answer_reader::take_whole(Face_id id) {
  if (question_ == Question::trace) {
    answer_.first.emplace_back(id);
    return;
  }
  if (question_ != Question::order) {
    answer_.visible.push_back(id);
    return;
  }
  if (!whole_.insert(id).second) fail("face " + std::to_string(id) + " is in the order twice");
  answer_.order.push_back({id, {}});
}

Answer Answer_reader::finished() {
  if (question_ == Question::trace) return finished_rays();
  if (abstains_from_all_) {
    answer_.abstained.resize(faces_);
    std::iota(answer_.abstained.begin(), answer_.abstained.end(), Face_id{0});
  }
  for (const Face_id id : whole_)
    if (in_parts_.contains(id)) fail("face " + std::to_string(id) + " is in the order as a whole and in parts");
  for (std::vector<Face_id>* list : {&answer_.visible, &answer_.abstained}) {
    std::sort(list->begin(), list->end());
    list->erase(std::unique(list->begin(), list->end()), list->end());
  }
  const auto claimed = [&](Face_id id) {
    return std::binary_search(answer_.visible.begin(), answer_.visible.end(), id) || whole_.contains(id) ||
           in_parts_.contains(id);
  };
  for (const Face_id id : answer_.abstained)
    if (claimed(id)) fail("face " + std::to_string(id) + " is both answered and abstained from");
  return std::move(answer_);
}

/// A surface in OFF, of whose numbers each is a decimal or p/q; nothing where it is abstained from.
std::optional<Polygon_soup> surface_of(const std::string& text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\n");
  if (begin == std::string::npos) fail("it is empty; write OFF, of no result `OFF` and a line `0 0 0`");
  const std::string_view word = std::string_view(text).substr(begin, text.find_last_not_of(" \t\r\n") + 1 - begin);
  if (word == "abstained" || word == "abstained all") return std::nullopt;
  Read_options options;
  options.any_denominator = options.decimals_too = true;
  try {
    return read_scene(text, Format::qoff, "OFF", options);
  } catch (const Input_error& error) {
    fail(error.what());
  }
}

Set_operation operation_of(const nlohmann::json& name) {
  for (const Set_operation operation : set_operations)
    if (name == sightline::name(operation)) return operation;
  fail(
      "query: \"operation\" is neither \"union\" nor \"intersection\" nor \"difference\" nor "
      "\"symmetric-difference\"");
}

}  // namespace protocol_detail

Json to_json(const Query& query) {
  Json value{{"query", question_names[static_cast<std::size_t>(query.question)]}};
  if (query.question == Question::trace) {
    value["rays"] = Json::array();
    for (const Exact_ray& ray : query.rays)
      value["rays"].push_back({{"origin", protocol_detail::point_json(ray.origin)},
                               {"direction", protocol_detail::point_json(ray.direction)}});
    return value;
  }
  if (query.question == Question::boolean) {
    value["operation"] = name(query.operation);
    value["first"] = query.first;
    return value;
  }
  if (query.question == Question::weak) {
    value["source"] = Json::array();
    for (const Exact_point& p : query.source) value["source"].push_back(protocol_detail::point_json(p));
  } else {
    value["eye"] = protocol_detail::point_json(query.eye);
  }
  value["two_sided"] = query.two_sided;
  return value;
}

Query query_from_json(const nlohmann::json& value) {
  const auto member = [&](const char* key) -> const nlohmann::json& {
    const auto found = value.is_object() ? value.find(key) : value.end();
    if (found == value.end()) protocol_detail::fail(std::string("query: no \"") + key + '"');
    return *found;
  };
  Query query;
  const nlohmann::json& name = member("query");
  const auto known = std::find_if(question_names.begin(), question_names.end(),
                                  [&](std::string_view question) { return name == question; });
  if (known == question_names.end())
    protocol_detail::fail(
        "query: \"query\" is neither \"order\" nor \"see\" nor \"weak\" nor \"trace\" nor \"boolean\"");
  query.question = static_cast<Question>(known - question_names.begin());
  if (query.question == Question::trace) {
    const nlohmann::json& rays = member("rays");
    if (!rays.is_array()) protocol_detail::fail("rays is no list of rays");
    for (const nlohmann::json& ray : rays) {
      const std::string at = "rays[" + std::to_string(query.rays.size()) + ']';
      if (!ray.is_object() || !ray.contains("origin") || !ray.contains("direction"))
        protocol_detail::fail(at + " is no ray; write {\"origin\": [x, y, z], \"direction\": [x, y, z]}");
      query.rays.push_back(
          {point_from_json(ray["origin"], at + ".origin"), point_from_json(ray["direction"], at + ".direction")});
    }
    return query;
  }
  if (query.question == Question::boolean) {
    query.operation = protocol_detail::operation_of(member("operation"));
    if (!member("first").is_number_unsigned()) protocol_detail::fail("query: \"first\" is no number of faces");
    query.first = member("first").get<std::size_t>();
    return query;
  }
  if (query.question == Question::weak) query.source = points_from_json(member("source"), "source");
  else query.eye = point_from_json(member("eye"), "eye");
  if (!member("two_sided").is_boolean()) protocol_detail::fail("query: \"two_sided\" is neither true nor false");
  query.two_sided = member("two_sided").get<bool>();
  return query;
}

void check_integers(const std::string& text) {
  struct Integers final : nlohmann::json_sax<nlohmann::json> {
    bool number_float(double, const std::string& digits) override {
      if (digits.find_first_of(".eE") == std::string::npos)
        protocol_detail::fail("the integer " + printable(digits, 40, false) +
                              " is beyond 64 bits; write it as a string, between quotes");
      return true;
    }
    bool null() override { return true; }
    bool boolean(bool) override { return true; }
    bool number_integer(std::int64_t) override { return true; }
    bool number_unsigned(std::uint64_t) override { return true; }
    bool string(std::string&) override { return true; }
    bool binary(binary_t&) override { return true; }
    bool start_object(std::size_t) override { return true; }
    bool end_object() override { return true; }
    bool key(std::string&) override { return true; }
    bool start_array(std::size_t) override { return true; }
    bool end_array() override { return true; }
    bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception&) override { return false; }
  } integers;
  nlohmann::json::sax_parse(text, &integers);
}

Answer read_answer(const std::string& text, Question question, std::size_t faces, std::size_t rays) {
  if (question == Question::boolean) {
    Answer answer;
    answer.surface = protocol_detail::surface_of(text);
    return answer;
  }
  protocol_detail::Answer_reader reader(question, faces, rays);
  const std::size_t first = text.find_first_not_of(" \t\r\n");
  return first != std::string::npos && text[first] == '{' ? reader.from_json(text) : reader.from_lines(text);
}

}  // namespace sightline::judge
