// A report's rows, their sums, and parts together; the page and the picture.

#include <sightline/harness/report/page.h>
#include <sightline/harness/report/picture.h>
#include <sightline/harness/report/report.h>

#include <gtest/gtest.h>

#include <fstream>
#include <limits>
#include <string>
#include <vector>

namespace sightline::report {

namespace {

/// What two machines found out, as one page.
void publish(const sightline::report::Report& first, const sightline::report::Report& second, const char* file) {
  const sightline::report::Report report = sightline::report::merged({first, second});
  for (const sightline::report::Summary& s : sightline::report::summaries(report.rows))
    if (s.crashed > 0) std::ofstream("crashes.txt", std::ios::app) << s.who.method << '\n';
  std::ofstream(file) << sightline::report::report_page(report);
}

Row row(std::size_t unit, const std::string& method, const std::string& kernel, double seconds, double error,
        std::size_t wrong) {
  Row r;
  r.unit = unit;
  r.who = {"see", method, kernel};
  r.family = unit % 2 == 0 ? "boxes" : "hinged";
  r.distance = "+1 ulps";
  r.size = 20;
  r.seed = 1;
  r.cases = 4;
  r.wrong = wrong;
  r.faces = 20;
  r.seconds = seconds;
  r.worst_seconds = 2 * seconds;
  r.peak_bytes = 1000 + unit;
  r.error = error;
  r.worst_error = 2 * error;
  if (wrong > 0) r.smallest = Wrong_case{20 - unit, 3, error};
  return r;
}

Example example(const Row& of, const std::string& file) {
  Example e;
  e.who = of.who;
  e.family = of.family;
  e.distance = of.distance;
  e.size = of.size;
  e.seed = of.smallest->seed;
  e.file = file;
  e.again = "sightline compare " + file;
  return e;
}

/// Four units: a method that is right, and one that errs in units 1 and 2, in 2 with fewer faces.
Report whole() {
  Report report;
  report.asked = {{"seed", 1}};
  report.contents = {{"one.off", "a"}, {"two.off", "b"}};
  report.units = 4;
  report.questions = {{"see", "share of directions"}};
  for (std::size_t unit = 0; unit < 4; ++unit) {
    report.rows.push_back(row(unit, "partition", "exact", 0.001 * static_cast<double>(unit + 1), 0, 0));
    report.rows.push_back(row(unit, "partition", "double", 0.0005,
                              unit == 1   ? 0.25
                              : unit == 2 ? 0.5
                                          : 0,
                              unit == 1 || unit == 2 ? 1 : 0));
  }
  report.examples = {example(report.rows[5], "two.off")};
  report.not_asked = {{"beyond doubles", 3}};
  report.seconds = 7;
  return report;
}

/// The units that are `shard` modulo two.
Report half(std::uint32_t shard) {
  Report part = whole();
  part.shard = shard;
  part.shards = 2;
  std::erase_if(part.rows, [&](const Row& r) { return r.unit % 2 != shard; });
  part.examples = {shard == 0 ? example(part.rows[3], "two.off") : example(part.rows[1], "one.off")};
  part.not_asked = {{"beyond doubles", shard == 0 ? 2 : 1}};
  part.seconds = shard == 0 ? 3 : 4;
  return part;
}

TEST(Report, is_read_as_it_was_written) {
  const Json written = to_json(whole());
  const Report read = report_from_json(nlohmann::json::parse(written.dump()));
  EXPECT_EQ(nlohmann::json(to_json(read)), nlohmann::json(written));
  for (const Json& each : {Json(3), Json::object(), Json{{"command", "see"}}})
    EXPECT_THROW(report_from_json(nlohmann::json(each)), std::invalid_argument);
  for (const char* key : {"asked", "contents", "shard", "units", "open", "result", "seconds"}) {
    Json less = written;
    less.erase(key);
    EXPECT_THROW(report_from_json(nlohmann::json::parse(less.dump())), std::invalid_argument) << key;
  }
  for (const char* key : {"unit", "method", "cases", "seconds", "error", "smallest"}) {
    Json other = written;
    other["result"]["rows"][0][key] = Json::array();
    EXPECT_THROW(report_from_json(nlohmann::json::parse(other.dump())), std::exception) << key;
  }
}

TEST(Report, of_somebody_else_names_no_files_elsewhere_and_no_numbers_that_do_not_fit) {
  const Json written = to_json(half(1));
  const auto refused = [&](auto change) {
    Json other = written;
    change(other);
    EXPECT_THROW(report_from_json(nlohmann::json::parse(other.dump())), std::invalid_argument) << other.dump();
  };
  for (const char* file : {"../x.off", "/tmp/x.off", "a/b.off", ".off", "x.sh", "x.off.sh", "", "..", "x\n.off"})
    refused([&](Json& r) { r["result"]["examples"][0]["file"] = file; });
  refused([](Json& r) { r["shard"] = {4294967296u, 4294967297u}; });
  for (const Json& count : {Json(-1), Json(1.5), Json("x")})
    refused([&](Json& r) { r["result"]["not_asked"]["why"] = count; });
  refused([](Json& r) { r["result"]["not_asked"] = {1}; });
  for (const char* kind : {"wrong", "abstained", "crashed", "stopped"})
    refused([&](Json& r) { r["result"]["rows"][0][kind] = 5; });  // of 4
  refused([](Json& r) {
    for (const char* kind : {"wrong", "crashed"}) r["result"]["rows"][0][kind] = 3;
  });
  EXPECT_NO_THROW(report_from_json(nlohmann::json::parse(written.dump())));
}

TEST(Report, sums_up_the_rows_of_each_contender) {
  Report report = whole();
  report.rows[3].crashed = 1;
  report.rows[3].stopped = 1;  // of unit 1 in doubles: 2 of 4 ended
  const std::vector<Summary> sums = summaries(report.rows);
  ASSERT_EQ(sums.size(), 2u);
  EXPECT_EQ(sums[0].who, (Contender{"see", "partition", "exact"}));
  EXPECT_EQ(sums[0].rows, 4u);
  EXPECT_EQ(sums[0].cases, 16u);
  EXPECT_EQ(sums[0].wrong, 0u);
  EXPECT_DOUBLE_EQ(*sums[0].seconds, 0.003);
  EXPECT_DOUBLE_EQ(sums[0].worst_seconds, 0.008);
  EXPECT_EQ(sums[0].peak_bytes, 1003u);
  EXPECT_EQ(sums[1].wrong, 2u);
  EXPECT_EQ(sums[1].crashed, 1u);
  EXPECT_EQ(sums[1].stopped, 1u);
  EXPECT_DOUBLE_EQ(sums[1].error, (2 * 0.25 + 4 * 0.5) / 14);
  EXPECT_DOUBLE_EQ(sums[1].worst_error, 1);

  const std::vector<const Row*> smallest = smallest_wrong(report.rows);
  ASSERT_EQ(smallest.size(), 1u);
  EXPECT_EQ(smallest[0]->unit, 2u);
}

TEST(Report, of_all_shards_is_the_whole) {
  for (const std::vector<Report>& parts : {std::vector{half(0), half(1)}, std::vector{half(1), half(0)}})
    EXPECT_EQ(nlohmann::json(to_json(merged(parts))), nlohmann::json(to_json(whole())));
  EXPECT_EQ(nlohmann::json(to_json(merged({whole()}))), nlohmann::json(to_json(whole())));

  const auto refused = [](const std::vector<Report>& parts) -> std::string {
    try {
      merged(parts);
    } catch (const std::invalid_argument& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(refused({half(0)}).find("shard 1 of 2 is missing"), std::string::npos);
  EXPECT_NE(refused({half(0), half(1), half(1)}).find("shard 1 is there twice"), std::string::npos);
  EXPECT_NE(refused({half(0), whole()}).find("different reports"), std::string::npos);
  Report other = half(1);
  other.asked["seed"] = 2;
  EXPECT_NE(refused({half(0), other}).find("different reports"), std::string::npos);
  for (const nlohmann::json& contents :
       {nlohmann::json{{"one.off", "a"}, {"two.off", "c"}}, nlohmann::json{{"one.off", "a"}},
        nlohmann::json{{"one.off", "a"}, {"two.off", "b"}, {"three.off", "c"}}}) {
    Report changed = half(1);
    changed.contents = contents;
    const std::string file = contents.size() == 3 ? "three.off" : "two.off";
    EXPECT_NE(refused({half(0), changed}).find(file + " was another file for shard 1 than for shard 0"),
              std::string::npos);
  }
  Report unfinished = half(1);
  unfinished.open = 1;
  EXPECT_NE(refused({half(0), unfinished}).find("shard 1 was not finished"), std::string::npos);
}

/// What an element of a page holds, and what its script reads.
Json json_in(const std::string& page, const std::string& id) {
  const std::string begin = "<script id=\"" + id + "\" type=\"application/json\">";
  const std::size_t from = page.find(begin) + begin.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from), nullptr, false);
}
Json data_of(const std::string& page) { return json_in(page, "data"); }

TEST(Report_page, holds_all_rows_and_nothing_that_ends_its_data) {
  Report report = whole();
  report.rows[0].who.method = "</script><b>&";
  report.rows[0].seconds.reset();
  EXPECT_EQ(report_page(report).find("innerHTML"), std::string::npos)
      << "a picture of somebody else's may hold scripts";
  const Json data = data_of(report_page(report));
  ASSERT_FALSE(data.is_discarded());
  ASSERT_EQ(data["rows"].size(), 8u);
  EXPECT_EQ(data["contenders"].size(), 3u);
  EXPECT_EQ(data["contenders"][0]["method"], "</script><b>&");
  EXPECT_EQ(data["families"], (Json{"boxes", "hinged"}));
  EXPECT_EQ(data["rows"][0][11], Json());
  EXPECT_EQ(data["rows"][5][14], 0.5);
  EXPECT_EQ(data["examples"].size(), 1u);
  for (const char* outside : {"http://", "https://", "src="}) {
    std::string page = report_page(report);
    for (std::size_t at = page.find("http://www.w3.org/2000/svg"); at != std::string::npos;
         at = page.find("http://www.w3.org/2000/svg"))
      page.erase(at, 26);  // a name, not a place
    EXPECT_EQ(page.find(outside), std::string::npos) << outside;
  }
  publish(half(0), half(1), "/dev/null");
}

TEST(Report_page, of_the_largest_errors_is_one) {
  Report report = whole();
  constexpr double most = std::numeric_limits<double>::max();
  for (Row& r : report.rows) r.error = r.worst_error = most;
  for (const Summary& s : summaries(report.rows)) EXPECT_EQ(s.error, most);
  const Json data = data_of(report_page(report));
  ASSERT_FALSE(data.is_discarded());
  EXPECT_EQ(data["rows"][0][14], most);
  EXPECT_EQ(data["summaries"][1]["error"], most);
}

TEST(Report_page, opens_scenes_where_something_opens_them_as_many_as_there_is_room_for) {
  Report report = whole();
  report.examples.assign(6, report.examples[0]);
  report.examples[0].view = {{"notes", {std::string(400'000, 'x')}}};
  report.examples[1].view = {{"notes", {"</script>"}}};
  report.examples[2].view = nullptr;
  for (std::size_t k : {3, 4, 5})
    report.examples[k].view = {{"notes", {std::string(100'000, static_cast<char>('0' + k))}}};
  const std::string page = report_page(report, "<script>open them</script>\n");
  EXPECT_LT(page.size(), 400'000u);
  EXPECT_NE(page.find("<script>open them</script>\n</body>"), std::string::npos);
  const Json views = json_in(page, "views"), examples = json_in(page, "data")["examples"];
  ASSERT_EQ(views.size(), 6u);
  ASSERT_EQ(examples.size(), 6u);
  EXPECT_EQ(views[1]["notes"][0], "</script>");
  for (std::size_t k = 0; k < 6; ++k) {
    const bool is_there = k == 1 || k == 3 || k == 4;
    EXPECT_EQ(examples[k]["view"], is_there ? Json(k) : Json()) << k;
    EXPECT_EQ(views[k].is_null(), !is_there) << k;
  }
  const std::string without = report_page(report);
  EXPECT_EQ(without.find("id=\"views\""), std::string::npos);
  const Json data = json_in(without, "data");
  for (const Json& e : data["examples"]) EXPECT_TRUE(e["view"].is_null());

  // It goes through the document, and documents of before are read.
  nlohmann::json document = to_json(report);
  EXPECT_EQ(report_from_json(document).examples[1].view, report.examples[1].view);
  for (nlohmann::json& e : document["result"]["examples"]) e.erase("view");
  EXPECT_TRUE(report_from_json(document).examples[1].view.is_null());
}

TEST(Report_page, of_very_many_rows_is_below_3_MB_and_says_what_it_leaves_out) {
  Report report = whole();
  while (report.rows.size() < 65'000)
    report.rows.push_back(row(report.rows.size(), "m" + std::to_string(report.rows.size() % 70), "float",
                              1.23456e-5 * static_cast<double>(report.rows.size()), 0.123456, 0));
  const std::string page = report_page(report);
  EXPECT_LT(page.size(), 2'600'000u) << "scenes to turn around and what opens them take 400 kB";
  const Json data = data_of(page);
  EXPECT_LE(data["rows"].size(), 30'000u);
  EXPECT_GT(data["rows"].size(), 20'000u);
  EXPECT_NE(data["about"].get<std::string>().find("one row of 3"), std::string::npos);
}

TEST(Report_picture, has_a_mark_for_each_contender_and_size) {
  const auto count = [](const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  };
  Report report = whole();
  const std::string picture = report_picture(report);
  EXPECT_EQ(count(picture, "<polygon"), 4u) << "a mark and a key for each of two";
  report.rows[0].size = 50;
  EXPECT_EQ(count(report_picture(report), "<polygon"), 5u);
  report.rows[1].who.method = "<&>";
  EXPECT_EQ(report_picture(report).find("<&>"), std::string::npos);
  report.rows.clear();
  EXPECT_EQ(count(report_picture(report), "<polygon"), 0u);
}

}  // namespace

}  // namespace sightline::report
