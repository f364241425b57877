// Pictures: the camera, names of polygons, the canvas, and scenes that are turned round.

#include "program.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <regex>
#include <set>

namespace program {

class Pictures : public Program {
 protected:
  const std::string cube = (corpus / "general" / "cube.off").string(),  // [0, 1]^3
      rooms = (corpus / "general" / "two_rooms.off").string(), lamp = "1,1,29/10 1,2,29/10 2,2,29/10 2,1,29/10";

  struct Polygon {
    std::string id, fill, title;
    std::vector<std::array<double, 2>> points;
  };
  struct Picture {
    double width = 0, height = 0;
    std::string text;
    std::vector<Polygon> polygons;
    /// What the polygons span: least x, least y, most x, most y.
    std::array<double, 4> span() const {
      std::array<double, 4> span{1e9, 1e9, -1e9, -1e9};
      for (const Polygon& polygon : polygons)
        for (const auto& p : polygon.points)
          span = {std::min(span[0], p[0]), std::min(span[1], p[1]), std::max(span[2], p[0]), std::max(span[3], p[1])};
      return span;
    }
  };

  /// The picture that a command draws; its words without --svg.
  Picture drawn(std::vector<std::string> words) const {
    const std::string svg = path("drawn.svg").string();
    fs::remove(svg);
    words.insert(words.end(), {"--svg", svg});
    const Outcome r = run(words);
    EXPECT_EQ(r.code, done) << r;
    Picture picture;
    picture.text = read_file(svg);
    std::smatch size;
    if (std::regex_search(picture.text, size, std::regex("width=\"(\\d+)\" height=\"(\\d+)\""))) {
      picture.width = std::stod(size[1]);
      picture.height = std::stod(size[2]);
    }
    std::istringstream lines(picture.text);
    const std::regex form(
        "<polygon id=\"([^\"]*)\" points=\"([^\"]*)\" fill=\"([^\"]*)\".*<title>(.*)</title></polygon>");
    for (std::string line; std::getline(lines, line);) {
      if (!line.starts_with("<polygon")) continue;
      std::smatch parts;
      if (!std::regex_match(line, parts, form)) {
        ADD_FAILURE() << "no id or title: " << line;
        continue;
      }
      Polygon& polygon = picture.polygons.emplace_back(Polygon{parts[1], parts[3], parts[4], {}});
      std::istringstream points(parts[2]);
      char comma = 0;
      for (std::array<double, 2> p{}; points >> p[0] >> comma >> p[1];) polygon.points.push_back(p);
    }
    EXPECT_FALSE(picture.polygons.empty()) << r;
    return picture;
  }

  /// Nothing is cropped, nor outside the margin but for outlines; and one of width and height is filled.
  void expect_filled(const Picture& picture) const {
    const auto [left, top, right, bottom] = picture.span();
    EXPECT_GE(left, 10);
    EXPECT_GE(top, 10);
    EXPECT_LE(right, picture.width - 10);
    EXPECT_LE(bottom, picture.height - 10);
    EXPECT_GE(std::max((right - left) / picture.width, (bottom - top) / picture.height), 0.8);
    EXPECT_NEAR((left + right) / 2, picture.width / 2, 0.02 * picture.width);
    EXPECT_NEAR((top + bottom) / 2, picture.height / 2, 0.02 * picture.height);
  }
  void expect_usage_error(const std::vector<std::string>& words, const std::string& mentions) const {
    const Outcome r = run(words);
    EXPECT_EQ(r.code, usage) << r;
    EXPECT_TRUE(r.one_line_of_error()) << r;
    EXPECT_NE(r.err.find(mentions), std::string::npos) << "no '" << mentions << "' in: " << r;
    EXPECT_EQ(r.out, "") << r;
  }
};

// ---- The camera

TEST_F(Pictures, are_filled_by_the_scene_from_any_eye_outside_it) {
  for (const std::string command : {"see", "order"}) {
    SCOPED_TRACE(command);
    expect_filled(drawn({command, cube}));
    for (const char* eye : {"5,-20,5.5", "1.2,-0.4,1.5", "1e6,2e6,3e6", "0.5,0.5,40", "-3,0.5,0.5"}) {
      SCOPED_TRACE(eye);
      expect_filled(drawn({command, cube, "--eye", eye}));
      expect_filled(drawn({command, cube, "--eye", eye, "--size", "300x900"}));
      expect_filled(drawn({command, cube, "--eye", eye, "--size", "900x300", "--up", "1,0,0"}));
    }
  }
}

TEST_F(Pictures, are_filled_by_a_flat_scene_far_from_the_origin) {
  const std::string flat =
      file("flat.off",
           "OFF\n5 2 0\n84000 447000 0\n84500 447000 0\n84500 447200 3\n84000 447200 0\n84200 447900 1\n"
           "3 0 1 2\n3 0 2 4\n");
  const Picture picture = drawn({"see", flat});
  expect_filled(picture);
  EXPECT_EQ(picture.polygons.size(), 2u);
}

TEST_F(Pictures, of_coordinates_from_tiny_to_huge_hold_numbers_alone) {
  const auto expect_numbers = [&](const std::vector<std::string>& words) {
    const std::string text = drawn(words).text;
    for (const char* none : {"nan", "inf"})
      EXPECT_EQ(text.find(none), std::string::npos) << testing::PrintToString(words) << " draws " << none;
  };
  const std::string scene = path("exponents.qoff").string(), huge = (corpus / "robust" / "huge.off").string();
  for (const char* seed : {"2", "3", "8"}) {
    ASSERT_EQ(run({"generate", "exponents", "--seed", seed, "--out", scene}).code, done);
    expect_numbers({"see", scene});
  }
  expect_numbers({"order", huge});
  expect_numbers({"see", huge, "--lines"});
  expect_numbers({"weak", huge, "--from-face", "0"});
  expect_numbers({"order", cube, "--eye", "1e400,0,0"});
  expect_filled(drawn({"order", huge}));
}

TEST_F(Pictures, are_the_same_at_any_scale_and_in_any_place) {
  const auto times_power = [](int x) {  // 2^600 of them
    std::string digits = std::to_string(x);
    for (int k = 0; k < 600; ++k) {
      int carried = 0;
      for (auto digit = digits.rbegin(); digit != digits.rend(); ++digit) {
        const int twice = 2 * (*digit - '0') + carried;
        *digit = static_cast<char>('0' + twice % 10);
        carried = twice / 10;
      }
      if (carried > 0) digits.insert(digits.begin(), '1');
    }
    return digits;
  };
  // Each number n of the scene as another one.
  const auto scene_of = [&](const auto& number) {
    std::string text = "OFF\n22 7 0\n";
    for (const char* corner :
         {"0 0 0", "8 0 0", "8 8 0", "0 8 0", "2 2 1", "6 3 1", "5 6 1", "2 5 1", "0 0 0", "8 0 0", "8 0 5",
          "0 0 5", "3 4 1", "4 4 1", "4 4 3", "4 4 3", "4 5 3", "3 5 3", "1 1 0", "1 2 0", "1 2 2", "1 1 2"}) {
      std::istringstream three(corner);
      for (int x; three >> x;) text += number(x) + " ";
      text += "\n";
    }
    return text + "4 0 1 2 3\n4 4 5 6 7\n4 7 6 5 4\n4 8 9 10 11\n3 12 13 14\n3 15 16 17\n4 18 19 20 21\n";
  };
  const auto drawn_of = [&](const std::string& command, const auto& number) {
    const std::string scene = file("scene.qoff", scene_of(number)), svg = path("drawn.svg").string();
    std::vector<std::string> words;
    std::istringstream given(command);
    for (std::string word; given >> word;) {
      std::string& all = words.emplace_back(word == "SCENE" ? scene : word);
      if (word.find(',') == std::string::npos) continue;
      all.clear();  // points, with numbers of one digit
      for (const char c : word) all += c == ';' ? " " : c == ',' ? "," : number(c - '0');
    }
    words.insert(words.end(), {"--svg", svg});
    fs::remove(svg);
    const Outcome r = run(words);
    EXPECT_EQ(r.code, done) << r;
    return read_file(svg);
  };
  // Their numbers, which are rounded; and what is between them.
  const auto parts_of = [](const std::string& text) {
    std::pair<std::vector<double>, std::string> parts;
    for (std::size_t at = 0; at < text.size();) {
      if (std::isdigit(static_cast<unsigned char>(text[at])) == 0) {
        parts.second += text[at++];
        continue;
      }
      std::size_t read = 0;
      parts.first.push_back(std::stod(text.substr(at, 20), &read));
      at += read;
    }
    return parts;
  };
  for (const char* command :
       {"see SCENE --eye 9,9,9", "see SCENE --eye 9,9,9 --lines", "order SCENE --eye 9,9,9",
        "shadow SCENE --light 3,3,9 --light 9,1,7 --eye 9,9,9", "weak SCENE --from 3,3,8;4,3,8;4,4,8",
        "weak SCENE --from 3,3,8;3,4,8;4,4,8 --partition 0 --beside-rays 2000"}) {
    SCOPED_TRACE(command);
    const std::string plain = drawn_of(command, [](int x) { return std::to_string(x); });
    const auto parts = parts_of(plain);
    EXPECT_GT(parts.first.size(), 50u);
    const auto expect_same = [&](const std::string& what, const auto& number) {
      SCOPED_TRACE(what);
      const auto others = parts_of(drawn_of(command, number));
      EXPECT_TRUE(others.second == parts.second);  // they are long
      ASSERT_EQ(others.first.size(), parts.first.size());
      for (std::size_t k = 0; k < others.first.size(); ++k)
        ASSERT_NEAR(others.first[k], parts.first[k], 0.02) << "number " << k;
    };
    expect_same("2^600", times_power);
    if (sanitized) continue;
    expect_same("2^-600", [&](int x) { return std::to_string(x) + "/" + times_power(1); });
    expect_same("far away", [](int x) { return std::to_string(1'000'000'000'000'000'000 + x); });
  }
}

TEST_F(Pictures, keep_what_is_given_of_direction_and_field) {
  const std::vector<std::string> eye{"see", cube, "--eye", "0.5,-10,0.5"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), eye.begin(), eye.end());
    return drawn(more);
  };
  const auto by_field = with({"--field", "60"}).span();  // a face of size 1 at a distance of 10
  EXPECT_NEAR(by_field[2] - by_field[0], 960 / (2 * 10 * std::tan(M_PI / 6)), 0.1);
  const Picture aside = with({"--look", "1,10,0"});  // one half is empty, and nothing is cropped
  EXPECT_EQ(aside.width, 960);
  EXPECT_GE(aside.span()[0], 10);
  EXPECT_LT(aside.span()[2], 960 / 2 + 5);
}

TEST_F(Pictures, from_within_look_at_the_middle_ninety_degrees_wide) {
  const Picture picture = drawn({"order", cube, "--eye", "0.5,1/8,0.5"});
  const auto [left, top, right, bottom] = picture.span();
  EXPECT_LT(left, 0);
  EXPECT_GT(right, picture.width);
  EXPECT_EQ(picture.width, 960);
  EXPECT_EQ(picture.height, 720);
}

// ---- Polygons have names

TEST_F(Pictures, name_each_polygon_once_with_its_face) {
  const std::string city = path("city.qoff").string(), closed = path("rooms.off").string();
  ASSERT_EQ(run({"generate", "city_rotated", "--size", "12", "--seed", "3", "--out", city}).code, done);
  for (const std::vector<std::string>& words : {std::vector<std::string>{"see", city},
                                                {"see", city, "--lines"},
                                                {"order", city},
                                                {"order", city, "--method", "graph"},
                                                {"weak", rooms, "--from", lamp},
                                                {"weak", rooms, "--from", lamp, "--eye", "1,-9,14"},
                                                {"cutset", city, "--orbit", "5"}}) {
    SCOPED_TRACE(testing::PrintToString(words));
    std::set<std::string> ids;
    std::size_t faces = 0;
    for (const Polygon& polygon : drawn(words).polygons) {
      EXPECT_TRUE(ids.insert(polygon.id).second) << polygon.id << " is there twice";
      std::smatch parts;
      if (polygon.title.starts_with("source")) continue;
      ASSERT_TRUE(std::regex_match(polygon.id, parts, std::regex("(?:frame-\\d+-)?face-(\\d+)-\\d+"))) << polygon.id;
      EXPECT_TRUE(polygon.title == "face " + parts[1].str() ||
                  polygon.title.starts_with("face " + parts[1].str() + ",") ||
                  polygon.title.starts_with("face " + parts[1].str() + ":"))
          << polygon.title;
      ++faces;
    }
    EXPECT_GT(faces, 10u);
  }
}

// ---- The canvas

TEST_F(Pictures, take_a_size_and_a_background) {
  for (const std::vector<std::string>& words : {std::vector<std::string>{"see", cube},
                                                {"order", cube},
                                                {"weak", rooms, "--from", lamp},
                                                {"cutset", cube, "--orbit", "6"}}) {
    SCOPED_TRACE(words[0]);
    std::vector<std::string> more = words;
    more.insert(more.end(), {"--size", "500x400", "--background", "#102030"});
    const Picture picture = drawn(more);
    EXPECT_EQ(picture.width, 500);
    EXPECT_EQ(picture.height, 400);
    EXPECT_NE(picture.text.find("<rect width=\"100%\" height=\"100%\" fill=\"#102030\"/>"), std::string::npos);
    // Words are light on what is dark.
    EXPECT_EQ(picture.text.find("<text") != std::string::npos,
              picture.text.find("fill=\"#f4f3ef\"") != std::string::npos);
  }
  for (const char* colour : {"none", "white", "#fff", "#A0b1C2"})
    EXPECT_NE(drawn({"see", cube, "--background", colour}).text.find(std::string("fill=\"") + colour + "\"/>"),
              std::string::npos);
  const std::string plot = path("plot.svg").string();
  ASSERT_EQ(run({"compare", cube, "weak", "--from", "0,0,3 0,1,3 1,1,3 1,0,3", "--rays", "10", "--svg", plot, "--size",
                 "700x400", "--background", "black"})
                .code,
            done);
  EXPECT_NE(read_file(plot).find("width=\"700\" height=\"400\""), std::string::npos);
}

TEST_F(Pictures, refuse_sizes_and_backgrounds_that_are_none) {
  const std::string none = path("none.off").string(), svg = path("a.svg").string();  // told before the scene is read
  for (const std::vector<std::string>& words : {std::vector<std::string>{"see", none},
                                                {"order", none},
                                                {"weak", none, "--from-face", "0"},
                                                {"cutset", none, "--orbit", "6"},
                                                {"compare", none, "weak", "--from-face", "0"}}) {
    std::vector<std::string> more = words;
    more.insert(more.end(), {"--svg", svg, "", ""});
    for (const char* size : {"0", "0x0", "15x100", "100x16385", "99999999999x10", "-5x10", "10", "x", "axb", "10x20x30",
                             "100 x 100", "1e2x1e2", ""}) {
      more[more.size() - 2] = "--size";
      more.back() = size;
      expect_usage_error(more, "wants WIDTHxHEIGHT from 16x16 to 16384x16384");
    }
    for (const char* colour : {"", "whit", "#12", "#12345", "#gggggg", "rgb(1,2,3)", "\"/><script>", "#fff\n"}) {
      more[more.size() - 2] = "--background";
      more.back() = colour;
      expect_usage_error(more, "is no colour");
    }
  }
  EXPECT_FALSE(fs::exists(svg));
}

// ---- What they show

TEST_F(Pictures, of_weak_in_a_room_are_from_behind_the_source_and_elsewhere_from_outside) {
  // A closed room with fronts inwards, and a post in it.
  const std::string room =
      file("room.off",
           "OFF\n8 6 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n0 0 3\n4 0 3\n4 4 3\n0 4 3\n4 0 1 2 3\n4 7 6 5 "
           "4\n4 4 5 1 0\n4 5 6 2 1\n4 6 7 3 2\n4 7 4 0 3\n");
  // At the wall y = 0 a window looks to y = 4: all walls but that one are before it.
  const Picture inside = drawn({"weak", room, "--from", "1,1/2,1 1,1/2,2 3,1/2,2 3,1/2,1"});
  std::map<std::string, int> titles;
  for (const Polygon& polygon : inside.polygons) ++titles[polygon.title];
  EXPECT_EQ(titles["source"], 1);
  EXPECT_EQ(titles.count("face 2: hidden"), 0u) << "the wall behind the source";
  for (const char* wall :
       {"face 0: visible", "face 1: visible", "face 3: visible", "face 4: visible", "face 5: visible"})
    EXPECT_EQ(titles[wall], 1) << wall;
  EXPECT_EQ(inside.polygons.back().title, "source");
  // The source is in the middle third, and the far wall inside the near ones.
  double x = 0;
  for (const auto& p : inside.polygons.back().points) x += p[0] / 4;
  EXPECT_NEAR(x, inside.width / 2, inside.width / 6);
  expect_filled(inside);

  // A face of the scene as the source cuts away what is behind it as well: here the wall, and a post outside.
  std::string with_post = read_file(room);
  with_post.replace(with_post.find("8 6 0"), 5, "11 7 0");
  with_post.insert(with_post.find("4 0 1 2 3"), "-1 -2 0\n1 -2 0\n0 -2 9\n");
  const Picture by_wall = drawn({"weak", file("post.off", with_post + "3 8 10 9\n"), "--from-face", "2"});
  EXPECT_EQ(by_wall.polygons.size(), 6u) << "five walls, and the source";
  for (const Polygon& polygon : by_wall.polygons) EXPECT_EQ(polygon.id.find("face-6-"), std::string::npos);
  expect_filled(by_wall);

  // Without a roof the lamp of the town is seen from outside, and the source is where the painter puts it.
  const std::string plate = file("plate.off", "OFF\n4 1 0\n-5 -5 0\n5 -5 0\n5 5 0\n-5 5 0\n4 0 1 2 3\n");
  const Picture outside = drawn({"weak", plate, "--from", "0,0,1 1,0,1 1,1,1 0,1,1"});  // looks up
  EXPECT_EQ(outside.polygons.size(), 2u);
  expect_filled(outside);
  // The eye that is given is the eye.
  EXPECT_NE(drawn({"weak", room, "--from", "1,1/2,1 1,1/2,2 3,1/2,2 3,1/2,1", "--eye", "-9,-9,9"}).text, inside.text);
}

TEST_F(Pictures, of_lines_dash_what_is_next_to_what_is_seen_and_leave_the_rest_faint) {
  const std::string house = path("house.off").string();
  ASSERT_EQ(run({"generate", "rooms", "--size", "3", "--out", house}).code, done);
  const auto count = [](const std::string& text, const std::string& what) {
    std::size_t found = 0;
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++found;
    return found;
  };
  const std::string text = drawn({"see", house, "--eye", "1,1,1.5", "--lines"}).text,
                    one = drawn({"see", cube, "--eye", "3,-4,5", "--lines"}).text;
  EXPECT_GT(count(text, "stroke=\"#00000018\""), 3 * count(text, "stroke-dasharray")) << "a house is mostly behind";
  EXPECT_GT(count(text, "stroke-dasharray"), 0u);
  EXPECT_GE(count(one, "stroke-dasharray"), 3u);  // three edges, a part for each face that hides them
  EXPECT_EQ(count(one, "stroke=\"#00000018\""), 0u);
}

TEST_F(Pictures, of_a_path_say_what_changes) {
  const std::string eyes = file("eyes.csv", "5,0.5,0.5\n5,5,0.5\n5,5,5\n-5,5,5\n");
  const Picture picture = drawn({"cutset", cube, "--path", eyes});
  for (const char* words :
       {"the first frame", "since 1: 1 became on-view, 0 off-view", "since 2: 1 became on-view, 0 off-view",
        "since 3: 1 became on-view, 1 off-view", "green: those that became on-view"})
    EXPECT_NE(picture.text.find(words), std::string::npos) << words;
  EXPECT_EQ(std::count_if(picture.polygons.begin(), picture.polygons.end(),
                          [](const Polygon& polygon) { return polygon.title.ends_with(", became on-view"); }),
            3);
}

TEST_F(Pictures, of_methods_have_their_colours_in_each_plot) {
  const auto colours = [&](const std::string& scene, const std::vector<std::string>& more) {
    const std::string svg = path("plot.svg").string();
    std::vector<std::string> words{"compare", scene, "weak", "--rays", "10", "--svg", svg};
    words.insert(words.end(), more.begin(), more.end());
    EXPECT_EQ(run(words).code, done);
    std::map<std::string, std::string> found;
    std::istringstream lines(read_file(svg));
    std::string colour;
    for (std::string line; std::getline(lines, line);) {
      std::smatch parts;
      if (std::regex_search(line, parts, std::regex("stroke=\"([^\"]*)\""))) colour = parts[1];
      if (std::regex_search(line, parts, std::regex(">([a-z]+)</text>"))) found[parts[1]] = colour;
    }
    return found;
  };
  const std::string above = "0,0,3 0,1,3 1,1,3 1,0,3";
  const auto all = colours(cube, {"--from", above}), few = colours(cube, {"--from", above, "--kernels", "double"});
  for (const char* method : {"doubles", "sample"}) {
    ASSERT_TRUE(all.contains(method) && few.contains(method)) << method;
    EXPECT_EQ(all.at(method), few.at(method)) << method;
  }
  EXPECT_TRUE(all.contains("lines") && !few.contains("lines"));
}

// ---- Scenes that are turned round

class Turned : public Pictures {
 protected:
  /// The faces of a scene, each backwards.
  std::string turned(const std::string& name, const std::string& scene) const {
    std::istringstream in(read_file(scene));
    std::string text, line;
    for (std::size_t k = 0, faces = 0, points = 0; std::getline(in, line); ++k) {
      std::istringstream words(line);
      if (k == 1) words >> points >> faces;
      if (k >= 2 + points && k < 2 + points + faces) {
        std::size_t size = 0, corner = 0;
        words >> size;
        std::string loop;
        while (words >> corner) loop = " " + std::to_string(corner) + loop;
        line = std::to_string(size) + loop;
      }
      text += line + "\n";
    }
    return file(name, text);
  }
  const std::string box =
      "OFF\n8 6 0\n0 0 0\n4 0 0\n4 4 0\n0 4 0\n0 0 3\n4 0 3\n4 4 3\n0 4 3\n4 3 2 1 0\n4 4 5 6 7\n4 0 1 5 4\n4 1 2 6 "
      "5\n4 2 "
      "3 7 6\n4 3 0 4 7\n";
};

TEST_F(Turned, round_a_scene_answers_as_the_scene_that_is_written_backwards) {
  const std::string scene = file("box.off", box), back = turned("back.off", scene), to = path("c.json").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"see", "", "--eye", "1,1,1"},
                                                {"order", "", "--eye", "1,1,1"},
                                                {"weak", "", "--from", "1,1,1 2,1,1 2,2,1 1,2,1"},
                                                {"graph", ""},
                                                {"cutset", "", "--orbit", "4", "--faces"}}) {
    SCOPED_TRACE(words[0]);
    const auto result = [&](const std::string& of, std::vector<std::string> more) {
      std::vector<std::string> all = words;
      all[1] = of;
      more.insert(more.end(), {"--json", "-"});
      all.insert(all.end(), more.begin(), more.end());
      const Outcome r = run(all);
      EXPECT_EQ(r.code, done) << r;
      Json d = r.json();
      EXPECT_EQ(d["scene"].contains("flipped"), std::count(more.begin(), more.end(), "--flip") == 1) << r;
      return d["result"];
    };
    EXPECT_EQ(result(scene, {"--flip"}), result(back, {}));
    EXPECT_EQ(result(back, {"--flip"}), result(scene, {}));
  }
}

TEST_F(Turned, round_takes_certificates_of_the_same_turn_alone) {
  const std::string scene = file("box.off", box), to = path("c.json").string();
  for (const std::vector<std::string>& words : {std::vector<std::string>{"see", scene, "--eye", "1,1,1"},
                                                {"weak", scene, "--from", "1,1,1 2,1,1 2,2,1 1,2,1"}}) {
    std::vector<std::string> turned = words;
    turned.insert(turned.end(), {"--flip", "--certificate", to});
    ASSERT_EQ(run(turned).code, done);
    EXPECT_EQ(run({"verify", scene, to, "--flip"}).code, done) << words[0];
    EXPECT_EQ(run({"verify", scene, to}).code, disagreement) << words[0];
  }
}

TEST_F(Turned, round_is_the_scene_and_not_a_volume_that_looks) {
  const std::string scene = file("box.off", box),
                    lamp_box =
                        file("lamp.off",
                             "OFF\n8 6 0\n1 1 1\n2 1 1\n2 2 1\n1 2 1\n1 1 2\n2 1 2\n2 2 2\n1 2 2\n4 3 2 1 0\n4 4 5 "
                             "6 7\n4 0 1 5 4\n4 1 2 6 5\n4 2 3 7 6\n4 3 0 4 7\n");
  const Outcome r = run({"weak", scene, "--flip", "--from-volume", lamp_box, "--json", "-"});
  ASSERT_EQ(r.code, done) << r;
  EXPECT_EQ(r.json()["result"]["visible"].size(), 6u);
}

TEST_F(Turned, round_or_not_info_says_where_fronts_look) {
  const std::string scene = file("box.off", box);
  const Json solid = run({"info", scene, "--json", "-"}).json()["result"]["fronts"],
             room = run({"info", scene, "--flip", "--json", "-"}).json()["result"]["fronts"];
  EXPECT_EQ(solid["outwards"], 1.0);
  EXPECT_EQ(solid["inwards"], 0.0);
  EXPECT_EQ(room["outwards"], 0.0);
  EXPECT_EQ(room["inwards"], 1.0);
  EXPECT_NE(run({"info", scene}).out.find("looks from outside"), std::string::npos);
  EXPECT_NE(run({"info", scene, "--flip"}).out.find("looks from within"), std::string::npos);
  // One face turned of six is no scene that is turned; a plate encloses nothing.
  std::string one = box;
  one.replace(one.find("4 3 2 1 0"), 9, "4 0 1 2 3");
  for (const std::string& other :
       {file("one.off", one), file("plate.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")}) {
    const Outcome r = run({"info", other});
    EXPECT_NE(r.out.find("fronts"), std::string::npos) << r;
    EXPECT_EQ(r.out.find("--flip"), std::string::npos) << r;
  }
  EXPECT_EQ(run({"info", file("empty.off", "OFF\n0 0 0\n"), "--json", "-"}).json()["result"].contains("fronts"), false);
}

TEST_F(Turned, round_or_not_see_says_where_nearly_all_shows_its_back) {
  const std::string scene = file("box.off", box), note = "turned round?";
  EXPECT_NE(run({"see", scene, "--eye", "1,1,1"}).out.find(note), std::string::npos);
  EXPECT_EQ(run({"see", scene, "--eye", "9,9,9"}).out.find(note), std::string::npos);
  EXPECT_EQ(run({"see", scene, "--eye", "1,1,1", "--flip"}).out.find(note), std::string::npos);
  EXPECT_NE(run({"see", scene, "--eye", "1,1,1", "--two-sided"}).out.find("6 of the 6 faces"), std::string::npos);
  const Json seen = run({"see", scene, "--eye", "1,1,1", "--json", "-"}).json()["result"];
  EXPECT_EQ(seen["visible"].size(), 0u);
  EXPECT_EQ(seen["from_behind"], Json({0, 1, 2, 3, 4, 5}));
}

TEST_F(Pictures, are_shaded_unless_they_are_not_to_be) {
  // Of a cube three faces are seen, each by its own hue; what --shade changes is how light they are.
  const std::vector<std::string> words{"order", cube, "--eye", "3,-4,5"};
  const auto fills = [&](const std::string& shade) {
    std::vector<std::string> more = words;
    more.insert(more.end(), {"--shade", shade});
    std::map<std::string, std::string> by_id;
    for (const Polygon& polygon : drawn(more).polygons) by_id[polygon.id] = polygon.fill;
    return by_id;
  };
  const auto lit = fills("lambert"), plain = fills("none");
  ASSERT_EQ(lit.size(), plain.size());
  const auto lights = [](const std::map<std::string, std::string>& all) {
    std::set<std::string> different;
    for (const auto& [id, fill] : all) different.insert(fill.substr(fill.rfind(',')));
    return different.size();
  };
  EXPECT_EQ(lights(plain), 2u);  // fronts, and backs
  EXPECT_EQ(lights(lit), 6u);
}

}  // namespace program
