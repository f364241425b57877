// From the file to a verified order: every scene of the corpus, and every one of the collection under
// SIGHTLINE_SCENES_DIR in a format that we read. By default orders of up to 2000 fragments are verified, with
// SIGHTLINE_ALL_SCENES=1 those of up to 6000 (half an hour).

#include "program.h"

#include <sightline/kernel/number.h>

#include <array>
#include <cstdlib>
#include <iostream>
#include <optional>

namespace program {

using sightline::Rational;
using Point = std::array<Rational, 3>;

static Point point_of(const Json& p) {
  Point q;
  for (std::size_t k = 0; k < 3; ++k) q[k] = sightline::rational_from_string(p[k].get<std::string>());
  return q;
}
static std::string text_of(const Point& p) {
  return sightline::to_string(p[0]) + "," + sightline::to_string(p[1]) + "," + sightline::to_string(p[2]);
}
static bool all_scenes() {
  const char* value = std::getenv("SIGHTLINE_ALL_SCENES");
  return value != nullptr && std::string_view(value) == "1";
}

struct Scene_file {
  fs::path file, under;  // a file, and the folder that its name is told from
};
static void PrintTo(const Scene_file& scene, std::ostream* to) {
  *to << fs::relative(scene.file, scene.under).string();
}
static std::string name_of(const testing::TestParamInfo<Scene_file>& info) {
  std::string name = fs::relative(info.param.file, info.param.under).string();
  for (char& c : name)
    if (std::isalnum(static_cast<unsigned char>(c)) == 0) c = '_';
  return name;
}
static std::vector<Scene_file> scenes_under(const fs::path& folder, const fs::path& under) {
  std::vector<Scene_file> all;
  for (const fs::path& file : scenes_in(folder)) all.push_back({file, under});
  return all;
}
static std::vector<Scene_file> good_scenes_of_the_corpus() {
  std::vector<Scene_file> all = scenes_under(corpus / "general", corpus);
  for (const Scene_file& scene : scenes_under(corpus / "robust", corpus)) all.push_back(scene);
  return all;
}
static std::vector<Scene_file> collected_scenes() {
  const fs::path folder(SIGHTLINE_SCENES_DIR);
  return folder.empty() ? std::vector<Scene_file>{} : scenes_under(folder, folder);
}

class Scenes : public Program, public testing::WithParamInterface<Scene_file> {
 protected:
  const std::string scene = GetParam().file.string();
  const std::string certificate() const { return path("certificate.json").string(); }
  Limits limits = {all_scenes() ? 500.0 : 60.0, 6144};
  bool is_painted_ = true;

  /// Orders the scene from an eye, and looks at its picture.
  Outcome ordered(const std::string& eye, const std::vector<std::string>& more = {}) {
    const fs::path picture = path("a.svg");
    std::vector<std::string> words{"order", scene, "--eye", eye, "--certificate", certificate(), "--threads", "2"};
    words.insert(words.end(), more.begin(), more.end());
    if (is_painted_) words.insert(words.end(), {"--svg", picture.string()});
    std::error_code ignored;
    fs::remove(picture, ignored);
    Outcome r = run(words, limits);
    EXPECT_EQ(r.code, done) << r;
    if (!is_painted_) return r;
    const std::string svg = read_file(picture);
    EXPECT_NE(svg.find("</svg>"), std::string::npos) << r;
    for (const char* no_number : {"nan", "inf", "NaN"}) EXPECT_EQ(svg.find(no_number), std::string::npos) << r;
    return r;
  }
  /// How many fragments an order has, and the corners of the one that is behind a third of them.
  struct Ordered {
    std::size_t fragments;
    Json corners;
  };
  /// Orders the scene from an eye; nothing where it failed. Of megabytes of JSON it reads what it needs.
  std::optional<Ordered> order(const std::string& eye) {
    const Outcome r = ordered(eye, {"--json", "-"});
    const std::size_t end = r.out.rfind("\"counters\"");
    if (r.code != done || end == std::string::npos) return std::nullopt;
    const std::string key = "\"vertices\": ";
    std::vector<std::size_t> corners;
    for (std::size_t at = r.out.find(key); at < end; at = r.out.find(key, at)) corners.push_back(at += key.size());
    const Json counters = Json::parse('{' + r.out.substr(end))["counters"];
    EXPECT_EQ(corners.size(), counters["fragments"].get<std::size_t>());
    EXPECT_EQ(counters["degenerate"], 0);
    if (corners.empty()) return std::nullopt;
    const std::size_t one = corners[corners.size() / 3];
    return Ordered{corners.size(), Json::parse(r.out.substr(one, r.out.find('}', one) - one))};
  }
  /// Orders it without reading more of the answer than how many fragments there are; nothing where it failed.
  std::optional<std::size_t> count_of_order(const std::string& eye) {
    const Outcome r = ordered(eye);
    const std::size_t row = r.out.find("\norder ");
    if (r.code != done || row == std::string::npos) return std::nullopt;
    return std::stoul(r.out.substr(row + 7));
  }

  /// Orders from three eyes: one in general position, one in a face's plane but outside the face, one at a vertex.
  /// Verifies orders of up to `verified` fragments, and says of others that they were not.
  void order_from_three_eyes_and_verify(std::size_t verified) {
    const Outcome i = run({"info", scene, "--json", "-"}, limits);
    ASSERT_EQ(i.code, done) << i;
    const Json d = i.json();
    ASSERT_GE(d["scene"]["faces"], 1) << "a scene of nothing tests nothing";
    const Point low = point_of(d["result"]["box"][0]), high = point_of(d["result"]["box"][1]);
    Point eye;
    const std::array<Rational, 3> at{Rational(37, 101), Rational(-61, 103), Rational(53, 107)};
    for (std::size_t k = 0; k < 3; ++k) eye[k] = low[k] + at[k] * (high[k] - low[k]) + Rational(1, 1009);
    const std::optional<Ordered> first = order(text_of(eye));
    ASSERT_TRUE(first);
    verify("a general eye", first->fragments, verified);

    const Json& face = first->corners;
    const Point a = point_of(face[0]), b = point_of(face[1]), c = point_of(face[2]);
    for (std::size_t k = 0; k < 3; ++k) eye[k] = a[k] + Rational(5, 2) * (b[k] - a[k]) - Rational(3, 2) * (c[k] - a[k]);
    const std::string in_plane = text_of(eye), at_vertex = text_of(a);
    for (const auto& [what, where] :
         {std::pair{"an eye in a face's plane", in_plane}, {"an eye at a vertex", at_vertex}}) {
      const std::optional<std::size_t> count = count_of_order(where);
      ASSERT_TRUE(count) << what;
      verify(what, *count, verified);
    }
  }

 private:
  void verify(const char* what, std::size_t fragments, std::size_t most) {
    if (fragments > most) {
      std::cout << "left out: verify of " << fragments << " fragments from " << what << " (up to " << most
                << " are verified)\n";
      return;
    }
    const Outcome r = run({"verify", scene, certificate()}, limits);
    EXPECT_EQ(r.code, done) << what << ": " << r;
  }
};

class Corpus : public Scenes {};
TEST_P(Corpus, is_ordered_from_three_eyes_painted_and_verified) { order_from_three_eyes_and_verify(2000); }

TEST_P(Corpus, is_ordered_painted_and_verified_with_coordinates_rounded_to_doubles) {
  if (GetParam().file.extension() == ".qoff") GTEST_SKIP() << "nothing new";
  for (const char* eye : {"0,0,0", "0.1,-0.2,0.3"}) {
    ASSERT_EQ(ordered(eye, {"--coordinates", "double"}).code, done);
    const Outcome v = run({"verify", scene, certificate(), "--coordinates", "double"});
    EXPECT_EQ(v.code, done) << v;
  }
}

TEST_P(Corpus, is_ordered_by_every_kernel_without_a_crash) {
  for (const char* kernel : {"epeck", "gmpq", "epick", "double", "float"}) {
    if (sanitized && std::string_view(kernel) != "gmpq" && std::string_view(kernel) != "float") continue;
    const Outcome r =
        run({"order", scene, "--eye", "0.7,-3.1,2", "--kernel", kernel, "--json", "-", "--certificate", certificate()});
    if (std::string_view(kernel) != "epeck" && std::string_view(kernel) != "gmpq") {
      EXPECT_TRUE(r.code == done || (r.code == bad_input && r.one_line_of_error()))
          << "an inexact kernel may refuse what is beyond its numbers: " << r;
    } else {
      EXPECT_EQ(r.code, done) << r;
      const Outcome v = run({"verify", scene, certificate()});
      EXPECT_EQ(v.code, done) << kernel << v;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(, Corpus, testing::ValuesIn(good_scenes_of_the_corpus()), name_of);

class Collected : public Scenes {};
TEST_P(Collected, is_ordered_from_three_eyes_and_verified) {
  const std::uintmax_t most_bytes = sanitized ? 8'000 : 200'000;
  if (!all_scenes() && fs::file_size(scene) > most_bytes)
    GTEST_SKIP() << "left out: " << fs::file_size(scene) << " bytes are more than " << most_bytes
                 << "; SIGHTLINE_ALL_SCENES=1 leaves no scene out";
  is_painted_ = false;
  order_from_three_eyes_and_verify(all_scenes() ? 6000 : sanitized ? 150 : 500);
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(Collected);
INSTANTIATE_TEST_SUITE_P(, Collected, testing::ValuesIn(collected_scenes()), name_of);

}  // namespace program
