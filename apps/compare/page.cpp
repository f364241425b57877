#include "page.h"

#include "../support/page.h"

#include <algorithm>
#include <iterator>

namespace sightline::app {

namespace {

/// "depth buffer, float, 256 pixels, 16 bits".
std::string asked_name(const Json& row) {
  std::string name = row["method"].get<std::string>() + ", " + row["kernel"].get<std::string>();
  for (const auto& [key, unit] : {std::pair("size", "pixels"), std::pair("bits", "bits"), std::pair("rays", "rays"),
                                  std::pair("samples", "squared rays a pixel")})
    if (row.contains(key)) name += ", " + to_text(row[key]) + " " + unit;
  return name;
}

/// Faces that are in one sorted list and not in the other.
Json packed_without(const std::vector<Face_id>& faces, const std::vector<Face_id>& others) {
  std::vector<std::uint32_t> left;
  std::set_difference(faces.begin(), faces.end(), others.begin(), others.end(), std::back_inserter(left));
  return packed(left);
}

Json method_json(const Json& row, const std::vector<Face_id>* visible) {
  Json method{{"name", asked_name(row)}, {"status", row["status"]}};
  for (const char* key : {"seconds", "peak_bytes", "errors"})
    if (row.contains(key)) method[key] = row[key];
  if (visible == nullptr || !row.contains("said")) return method;
  const auto said = row["said"].get<std::vector<Face_id>>();
  method["missing"] = packed_without(*visible, said);
  method["extra"] = packed_without(said, *visible);
  return method;
}

}  // namespace

void write_comparison(const Compare_arguments& arguments, const Scene& scene, Json& rows, const Exact_point* eye,
                      const std::vector<Face_id>* visible) {
  Page page("compare", scene);
  page.add_fact("question", arguments.command);
  page.add_fact("faces", fmt::format("{}", scene.counters().faces));
  if (eye != nullptr) {
    page.set_eye(*eye);
    page.add_fact("eye", Page::text(*eye));
  }
  if (visible != nullptr) {
    page.add_fact("visible", fmt::format("{} faces", visible->size()));
    page.add_group("visible", "seen");
    page.add_group("not visible", "hidden");
    page.add_group("visible, and missing", "source");
    page.add_group("not visible, and said to be", "open");
    page.more()["visible"] = packed(*visible);
  } else {
    page.add_group("faces", "one a face");
  }
  page.add_pieces(scene);
  Json methods = Json::array();
  for (Json& row : rows) {
    methods.push_back(method_json(row, visible));
    row.erase("said");
  }
  page.more()["methods"] = std::move(methods);
  page.write(arguments.html);
}

}  // namespace sightline::app
