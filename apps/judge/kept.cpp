#include "kept.h"

#include <sightline/harness/judge/protocol.h>

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace sightline::app {

namespace {

/// Of any double, what JSON has no number for too.
std::string exactly(double value) { return fmt::format("{:a}", value); }
double number_of(const nlohmann::json& text) { return std::strtod(text.get<std::string>().c_str(), nullptr); }

Json optional_json(const std::optional<Face_id>& face) { return face ? Json(*face) : Json(); }
Json optional_json(const std::optional<int>& winding) { return winding ? Json(*winding) : Json(); }

}  // namespace

Json grade_json(const judge::Grade& grade) {
  Json rays = Json::array(), points = Json::array();
  for (const judge::Wrong_ray& wrong : grade.wrong_rays)
    rays.push_back({wrong.ray, optional_json(wrong.said), wrong.right, wrong.nothing});
  for (const judge::Wrong_point& wrong : grade.wrong_points)
    points.push_back(
        {point_json(wrong.at), point_json(wrong.on), wrong.face, wrong.inside, optional_json(wrong.winding)});
  return {{"wrong_visible", grade.wrong_visible},
          {"wrong_hidden", grade.wrong_hidden},
          {"abstained", grade.abstained},
          {"wrong_pairs", grade.wrong_pairs},
          {"wrong_rays", std::move(rays)},
          {"wrong_points", std::move(points)},
          {"volume_error", exactly(grade.volume_error)},
          {"area_error", exactly(grade.area_error)},
          {"judged", grade.judged}};
}

judge::Grade grade_from_json(const nlohmann::json& json) {
  judge::Grade grade;
  json.at("wrong_visible").get_to(grade.wrong_visible);
  json.at("wrong_hidden").get_to(grade.wrong_hidden);
  json.at("abstained").get_to(grade.abstained);
  json.at("wrong_pairs").get_to(grade.wrong_pairs);
  for (const nlohmann::json& ray : json.at("wrong_rays")) {
    judge::Wrong_ray& wrong = grade.wrong_rays.emplace_back();
    ray.at(0).get_to(wrong.ray);
    if (!ray.at(1).is_null()) wrong.said = ray.at(1).get<Face_id>();
    ray.at(2).get_to(wrong.right);
    ray.at(3).get_to(wrong.nothing);
  }
  for (const nlohmann::json& point : json.at("wrong_points")) {
    judge::Wrong_point& wrong = grade.wrong_points.emplace_back();
    wrong.at = judge::point_from_json(point.at(0), "at");
    wrong.on = judge::point_from_json(point.at(1), "on");
    point.at(2).get_to(wrong.face);
    point.at(3).get_to(wrong.inside);
    if (!point.at(4).is_null()) wrong.winding = point.at(4).get<int>();
  }
  grade.volume_error = number_of(json.at("volume_error"));
  grade.area_error = number_of(json.at("area_error"));
  json.at("judged").get_to(grade.judged);
  return grade;
}

namespace {

Json judged_json(const Judged& judged) {
  const judge::Kinds& k = judged.kinds;
  return {{"seed", judged.seed},
          {"faces", judged.faces},
          {"not_asked", judged.not_asked},
          {"mark", judge::mark_names.at(static_cast<std::size_t>(judged.mark))},
          {"breaks", judged.breaks},
          {"why", judged.why},
          {"grade", grade_json(judged.grade)},
          {"kinds", {k.concave_right, k.concave_wrong, k.convex_right, k.convex_wrong}},
          {"seconds", exactly(judged.seconds)},
          {"bytes", judged.bytes}};
}

Judged judged_from_json(const nlohmann::json& line) {
  Judged judged;
  line.at("seed").get_to(judged.seed);
  line.at("faces").get_to(judged.faces);
  line.at("not_asked").get_to(judged.not_asked);
  const auto mark = std::find(judge::mark_names.begin(), judge::mark_names.end(), line.at("mark").get<std::string>());
  if (mark == judge::mark_names.end()) throw std::invalid_argument("no mark");
  judged.mark = static_cast<judge::Mark>(mark - judge::mark_names.begin());
  line.at("breaks").get_to(judged.breaks);
  line.at("why").get_to(judged.why);
  judged.grade = grade_from_json(line.at("grade"));
  const nlohmann::json& k = line.at("kinds");
  judged.kinds = {k.at(0).get<std::size_t>(), k.at(1).get<std::size_t>(), k.at(2).get<std::size_t>(),
                  k.at(3).get<std::size_t>()};
  judged.seconds = number_of(line.at("seconds"));
  line.at("bytes").get_to(judged.bytes);
  return judged;
}

}  // namespace

Kept_cases::Kept_cases(std::string file, Json head) : journal_(std::move(file), std::move(head)) {
  for (const nlohmann::json& line : journal_.lines()) try {
      Kept_case kept{judged_from_json(line), {}, {}};
      if (!line.at("said").is_null()) kept.said = bytes_of_text(line.at("said").get<std::string>());
      for (const nlohmann::json& reading : line.at("readings"))
        kept.readings.push_back(static_cast<judge::Reading>(reading.get<int>()));
      cases_[line.at("case").get<std::size_t>()] = {line.at("of").get<std::string>(), std::move(kept)};
    } catch (const std::exception&) {
      continue;  // no line of ours: its case is asked again
    }
  journal_.begin();
}

const Kept_case* Kept_cases::find(std::size_t number, const std::string& of) const {
  const auto found = cases_.find(number);
  return found == cases_.end() || found->second.of != of ? nullptr : &found->second.kept;
}

void Kept_cases::add(std::size_t number, const std::string& of, const Kept_case& judged) {
  Json line{{"case", number}, {"of", of}};
  line.update(judged_json(judged.judged));
  line["said"] = judged.said ? Json(text_of_bytes(*judged.said)) : Json();
  line["readings"] = Json::array();
  for (const judge::Reading reading : judged.readings) line["readings"].push_back(static_cast<int>(reading));
  journal_.add(line);
}

}  // namespace sightline::app
