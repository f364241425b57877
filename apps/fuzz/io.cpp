// The subject `io` of sightline fuzz.

#include "fuzz.h"

#include <sightline/io/input.h>
#include <sightline/io/read.h>
#include <sightline/io/write.h>
#include <sightline/io/exact_text.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

namespace sightline::app {

namespace {

/// What differs between two soups, or nothing: the points of each loop of each face, in order.
std::string difference(const Polygon_soup& a, const Polygon_soup& b) {
  if (a.face_count() != b.face_count())
    return std::to_string(b.face_count()) + " faces, not " + std::to_string(a.face_count());
  for (Face_id f = 0; f < a.face_count(); ++f) {
    if (a.loop_count(f) != b.loop_count(f)) return harness::face_name(f) + " has another number of loops";
    for (std::size_t k = 0; k < a.loop_count(f); ++k) {
      const auto own = a.loop(f, k), other = b.loop(f, k);
      if (own.size() != other.size()) return harness::face_name(f) + " has another number of corners";
      for (std::size_t c = 0; c < own.size(); ++c)
        if (a.point(own[c]) != b.point(other[c]))
          return harness::face_name(f) + ", corner " + std::to_string(c) + ": another point";
    }
  }
  return {};
}

harness::Outcome round_trip(const Polygon_soup& soup, Format format) {
  std::stringstream stream;
  try {
    write_scene(soup, stream, format);
  } catch (const Not_representable&) {
    return harness::Outcome::not_applicable();
  }
  const std::string what = difference(soup, read_scene(stream.str(), format, "round trip"));
  return what.empty() ? harness::Outcome{} : harness::Outcome::failed(what);
}

/// A file of text as others write it, with what readers pass over: numbers behind points and faces, attributes of
/// corners, blanks, other line ends; as many faces. Pre: `text` as write_scene writes it.
std::string dressed(const std::string& text, Format format, generate::Random& random) {
  static constexpr const char* numbers[] = {"0", "1.5", "-2e3", "nan", "-nan", "inf", "+inf", "-1.#IND"};
  static constexpr const char* kinds[] = {"", "ST", "C", "N", "STC", "STN", "CN", "STCN"};
  static constexpr const char* attributes[] = {"", "/7", "//7", "/7/-7", "/7/"};
  const std::string kind = kinds[random.below(8)], attribute = attributes[random.below(5)];
  const std::string end = random.chance(1, 2) ? "\n" : "\r\n", blank = random.chance(1, 2) ? " " : " \t ";
  std::istringstream lines(text);
  std::string result;
  std::size_t number = 0, points = 0;
  bool in_header = true;
  for (std::string line; std::getline(lines, line); ++number) {
    std::istringstream words(line);
    std::string head, word;
    words >> head;
    std::size_t more = 0;
    if (format == Format::off) {
      if (number == 0) head = kind + head;
      if (number == 1) points = static_cast<std::size_t>(std::stoul(head));
      if (number > 1) more = random.below(number < points + 2 && !kind.empty() ? 10 : 5);
    } else if (format == Format::obj) {
      more = head == "v" && random.chance(1, 2) ? 3 : 0;  // a colour
    }
    result += (in_header ? "" : blank) + head;
    while (words >> word) {
      if (format == Format::obj && head == "f") word += attribute;
      if (format == Format::ply && in_header && word == "vertex_indices" && random.chance(1, 2)) word = "vertex_index";
      if (format == Format::obj && head[0] != '#' && random.chance(1, 8))
        result += blank + "\\" + blank + end;  // the line goes on
      result += (in_header && format == Format::ply ? " " : blank) + word;
    }
    for (; more > 0; --more) result += blank + numbers[random.below(8)];
    result += end;
    if (format != Format::ply || head == "end_header") in_header = false;
  }
  return result;
}

harness::Outcome as_others_write(const Polygon_soup& soup, Format format, generate::Random& random) {
  std::stringstream stream;
  try {
    write_scene(soup, stream, format);
  } catch (const Not_representable&) {
    return harness::Outcome::not_applicable();
  }
  const std::string text = dressed(stream.str(), format, random);
  try {
    const std::string what = difference(soup, read_scene(text, format, "dressed"));
    return what.empty() ? harness::Outcome{} : harness::Outcome::failed(what);
  } catch (const Input_error& error) {
    return harness::Outcome::failed(std::string("is not read: ") + error.what());
  }
}

/// A text with one wrong word, and where that is.
struct Marred {
  std::string text;
  std::size_t line = 0, column = 0;  // from 1
};

/// One number of a point or of a face becomes none, or names a point that is not there. Pre: `text` as write_scene
/// writes it, of so many points; there is one.
Marred marred(const std::string& text, Format format, std::size_t points, generate::Random& random) {
  // The last two stand for a point and what else a corner of an .obj has.
  static constexpr const char* none[] = {"q", "1.2.3", "1e", "--1", "+-2", ".", "1/0", "1//2"};
  // 1. The lines that may be it, each with the number of words before its first number.
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  if (lines[0][0] == '#' && random.chance(1, 2)) lines.erase(lines.begin());
  std::vector<std::size_t> chosen;
  bool is_data = format != Format::ply;
  for (std::size_t k = 0; k < lines.size(); ++k) {
    if (format == Format::obj ? lines[k][0] != '#' : is_data && k > 1) chosen.push_back(k);
    is_data = is_data || lines[k] == "end_header";
  }
  const std::size_t place = chosen[random.below(chosen.size())];
  const bool is_face = format == Format::obj ? lines[place][0] == 'f' : place >= chosen[0] + points;
  // 2. One of its words.
  std::vector<std::pair<std::size_t, std::size_t>> words;  // begin, end
  std::string& line = lines[place];
  for (std::size_t at = 0; at < line.size();) {
    const std::size_t end = std::min(line.find(' ', at), line.size());
    words.push_back({at, end});
    at = end + 1;
  }
  const std::size_t first = format == Format::obj ? 1 : 0, which = first + random.below(words.size() - first);
  const bool names_a_point = is_face && which > 0;
  const auto [begin, end] = words[which];
  std::string word = none[random.below(names_a_point ? 6 : 8)];
  if (names_a_point && random.chance(1, 2)) {
    const std::size_t beyond = format == Format::obj ? points + 1 : points;
    word = random.chance(1, 2) ? std::to_string(beyond) : format == Format::obj ? "0" : "-1";
  }
  line.replace(begin, end - begin, word);
  Marred result{{}, place + 1, begin + 1};
  // 3. With any end of lines, and perhaps a byte order mark.
  static constexpr const char* ends[] = {"\n", "\r\n", "\r"};
  const std::string end_of_line = ends[random.below(3)];
  if (random.chance(1, 4)) result.text = byte_order_mark;
  for (const std::string& l : lines) result.text += l + end_of_line;
  return result;
}

harness::Outcome refused_with_its_place(const Polygon_soup& soup, Format format, generate::Random& random) {
  if (soup.point_count() == 0) return harness::Outcome::not_applicable();
  std::stringstream stream;
  try {
    write_scene(soup, stream, format);
  } catch (const Not_representable&) {
    return harness::Outcome::not_applicable();
  }
  const std::string text = stream.str();
  const std::size_t points = read_scene(text, format, "as it was").point_count();
  const Marred wrong = marred(text, format, points, random);
  try {
    read_scene(wrong.text, format, "marred");
  } catch (const Input_error& error) {
    if (error.line == wrong.line && error.column == wrong.column) return {};
    return harness::Outcome::failed("line " + std::to_string(wrong.line) + ", column " + std::to_string(wrong.column) +
                                    " is wrong, and told is " + error.what());
  }
  return harness::Outcome::failed("line " + std::to_string(wrong.line) + ", column " + std::to_string(wrong.column) +
                                  " is wrong, and is read");
}

/// Nothing is asked of faces: formats are compared with the scene itself.
harness::Answer nothing(const generate::Posed_scene& posed) {
  harness::Answer answer;
  answer.labels.assign(posed.soup.face_count(), harness::Answer::none);
  return answer;
}

}  // namespace

harness::Subject io_subject() {
  harness::Subject subject;
  subject.name = "io";
  subject.what = "scenes written and read again in every format";
  subject.answer = nothing;
  const auto add = [&](const char* name, Format format) {
    subject.checks.push_back({name, std::string("the same scene from ") + name,
                              [format](const generate::Posed_scene& posed, const harness::Answer&, generate::Random&) {
                                return round_trip(posed.soup, format);
                              }});
  };
  add("qoff", Format::qoff);
  add("off", Format::off);
  add("obj", Format::obj);
  add("ply", Format::ply);
  add("binary ply", Format::ply_binary);
  add("stl", Format::stl);
  const auto add_dressed = [&](const char* name, Format format) {
    subject.checks.push_back(
        {name, "the same scene with what readers pass over",
         [format](const generate::Posed_scene& posed, const harness::Answer&, generate::Random& random) {
           return as_others_write(posed.soup, format, random);
         }});
  };
  add_dressed("dressed off", Format::off);
  add_dressed("dressed obj", Format::obj);
  add_dressed("dressed ply", Format::ply);
  const auto add_marred = [&](const char* name, Format format) {
    subject.checks.push_back(
        {name, "refused where a number is none, or names no point, with its line and column",
         [format](const generate::Posed_scene& posed, const harness::Answer&, generate::Random& random) {
           return refused_with_its_place(posed.soup, format, random);
         }});
  };
  add_marred("marred qoff", Format::qoff);
  add_marred("marred off", Format::off);
  add_marred("marred obj", Format::obj);
  add_marred("marred ply", Format::ply);
  return subject;
}

}  // namespace sightline::app
