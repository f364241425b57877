#include "page.h"

#include "page_sources.h"

#include <sightline/harness/report/page.h>
#include <sightline/io/base64.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

namespace sightline::app {

// ---- Numbers in few bytes

namespace {

/// Each number in so many bytes, the lowest first.
std::string little_endian(const std::vector<std::uint32_t>& numbers, std::size_t bytes) {
  std::string text;
  text.reserve(bytes * numbers.size());
  for (const std::uint32_t n : numbers)
    for (std::size_t k = 0; k < bytes; ++k) text += static_cast<char>(n >> (8 * k) & 255);
  return text;
}

Json packed_as(const char* type, const std::string& bytes) { return {{"type", type}, {"base64", base64(bytes)}}; }

}  // namespace

Json packed(const std::vector<std::uint32_t>& numbers) {
  const std::uint32_t most = numbers.empty() ? 0 : *std::max_element(numbers.begin(), numbers.end());
  if (most < 1u << 8) return packed_as("u8", little_endian(numbers, 1));
  if (most < 1u << 16) return packed_as("u16", little_endian(numbers, 2));
  return packed_as("u32", little_endian(numbers, 4));
}

Json packed(const std::vector<float>& numbers) {
  std::vector<std::uint32_t> bits;
  bits.reserve(numbers.size());
  for (const float x : numbers) bits.push_back(std::bit_cast<std::uint32_t>(x));
  return packed_as("f32", little_endian(bits, 4));
}

Json packed(const std::vector<bool>& bits) {
  std::string bytes((bits.size() + 7) / 8, '\0');
  for (std::size_t i = 0; i < bits.size(); ++i)
    if (bits[i]) bytes[i / 8] = static_cast<char>(static_cast<unsigned char>(bytes[i / 8]) | 1u << i % 8);
  return packed_as("u8", bytes);
}

// ---- What doubles make of it

Json asked_of_doubles(const Time_limit& limit, const std::function<Json(const Report& report)>& ask) {
  Progress bar("what doubles make of it");
  try {
    return ask([&](std::size_t done, std::size_t all) {
      if (limit.is_over()) throw Out_of_budget("");
      bar(done, all);
    });
  } catch (const Out_of_budget&) {
    return doubles_left_out(fmt::format("the budget of {} s ran out", limit.seconds()));
  } catch (const std::domain_error&) {
    return doubles_left_out("coordinates are beyond them");
  }
}

Json doubles_left_out(const std::string& why) { return {{"left_out", why}}; }

// ---- What is put together

Page::Page(const std::string& command, const Scene& scene, std::size_t triangles)
    : command_(command), scene_(scene.file()), most_triangles_(triangles) {
  if (scene.points().size() == 0) return;
  const auto box = scene.box();
  Rational side = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    middle_[k] = (box[0][k] + box[1][k]) / 2;
    side = std::max(side, Rational(box[1][k] - box[0][k]));
  }
  if (side == 0) return;
  // A power of two, at least the longest side and less than four times it.
  const std::size_t above = bit_length(side.get_num()), below = bit_length(side.get_den());
  Integer power = 1;
  if (above + 1 > below) power <<= above + 1 - below;
  else power <<= below - above - 1;
  size_ = above + 1 > below ? Rational(power) : Rational(1, power);
}

std::array<double, 3> Page::near_place(const Exact_point& p, double farthest) const {
  Exact_point from_middle;
  std::array<double, 3> at{};
  Rational most = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    from_middle[k] = (p[k] - middle_[k]) / size_;
    at[k] = nearest_double(from_middle[k]);
  }
  if (std::all_of(at.begin(), at.end(), [&](double x) { return std::fabs(x) <= farthest; })) return at;
  for (const Rational& x : {from_middle[0], from_middle[1], from_middle[2]}) most = std::max(most, Rational(abs(x)));
  for (std::size_t k = 0; k < 3; ++k) at[k] = nearest_double(Rational(from_middle[k] * Rational(farthest) / most));
  return at;
}

void Page::append_place(std::vector<float>& to, const Exact_point& p) const {
  for (const double x : near_place(p, farthest_drawn)) to.push_back(static_cast<float>(x));
}

void Page::append_sides(std::vector<float>& to, const std::vector<Exact_point>& polygon) const {
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    append_place(to, polygon[i]);
    append_place(to, polygon[(i + 1) % polygon.size()]);
  }
}

Json Page::place(const Exact_point& p) const { return near_place(p, 1e30); }

std::string Page::text(const Exact_point& p) {
  return to_string(p[0]) + ", " + to_string(p[1]) + ", " + to_string(p[2]);
}

void Page::set_eye(const Exact_point& eye) { more_["eye"] = {{"place", place(eye)}, {"exact", text(eye)}}; }

std::vector<Exact_point> Page::clipped(std::vector<Exact_point> polygon) const {
  const Rational most = Rational(farthest_drawn) * size_;
  for (std::size_t k = 0; k < 3; ++k)
    for (const int side : {1, -1}) {
      const auto within = [&](const Exact_point& p) { return Rational(most - side * (p[k] - middle_[k])); };
      std::vector<Exact_point> kept;
      for (std::size_t i = 0; i < polygon.size(); ++i) {
        const Exact_point &p = polygon[i], &q = polygon[(i + 1) % polygon.size()];
        const Rational a = within(p), b = within(q);
        if (sgn(a) >= 0) kept.push_back(p);
        if (sgn(a) * sgn(b) >= 0) continue;
        kept.emplace_back();
        for (std::size_t l = 0; l < 3; ++l) kept.back()[l] = p[l] + (q[l] - p[l]) * a / (a - b);
      }
      polygon = std::move(kept);
    }
  return polygon;
}

std::vector<Exact_point> Page::brought_near(std::vector<Exact_point> polygon) const {
  Rational most = 0;
  for (const Exact_point& p : polygon)
    for (std::size_t k = 0; k < 3; ++k) most = std::max(most, Rational(abs(p[k] - middle_[k])));
  for (Exact_point& p : polygon)
    for (std::size_t k = 0; k < 3; ++k)
      p[k] = middle_[k] + (p[k] - middle_[k]) * size_ * Rational(farthest_drawn) / most;
  return polygon;
}

void Page::add_polygon(std::uint32_t face, const std::vector<Exact_point>& corners, std::uint32_t group) {
  const auto is_far = [&](const Exact_point& p) {
    for (std::size_t k = 0; k < 3; ++k)
      if (abs(p[k] - middle_[k]) > size_ * Rational(farthest_drawn)) return true;
    return false;
  };
  // What has a face is in the scene's box.
  if (face != no_face || std::none_of(corners.begin(), corners.end(), is_far))
    return add_polygon(face, corners, corners, group);
  const std::vector<Exact_point> within = clipped(corners);
  (within.size() < 3 ? is_brought_near_ : is_clipped_) = true;
  if (within.size() < 3) add_polygon(face, corners, brought_near(corners), group);
  else add_polygon(face, within, within, group);
}

/// The same, drawn elsewhere than its corners are.
void Page::add_polygon(std::uint32_t face, const std::vector<Exact_point>& corners,
                       const std::vector<Exact_point>& drawn, std::uint32_t group) {
  const std::uint32_t number = static_cast<std::uint32_t>(added_++);
  if (corners.size() < 3) return;
  // 1. Its corners.
  const std::size_t first = places_.size() / 3;
  kept_.push_back(
      {number, face, group, static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(corners.size()), 0});
  for (const Exact_point& p : drawn) append_place(places_, p);
  for (const Exact_point& p : corners) {
    if (!keeps_texts_) break;
    const auto [at, is_new] = texts_.try_emplace(text(p), static_cast<std::uint32_t>(texts_.size()));
    exact_.push_back(at->second);
    text_bytes_ += 3 + (is_new ? at->first.size() + 3 : 0);
  }
  const std::size_t most_text_bytes = std::min<std::size_t>(300000, 40 * most_triangles_);
  if (text_bytes_ > most_text_bytes) {
    keeps_texts_ = false;
    texts_.clear();
    exact_.clear();
  }
  // 2. Its area, by which it may have to go.
  const auto at = [&](std::size_t i, std::size_t k) { return static_cast<double>(places_[3 * (first + i) + k]); };
  std::array<double, 3> normal{};
  for (std::size_t i = 1; i + 1 < corners.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k) {
      const std::size_t l = (k + 1) % 3, m = (k + 2) % 3;
      normal[k] +=
          (at(i, l) - at(0, l)) * (at(i + 1, m) - at(0, m)) - (at(i, m) - at(0, m)) * (at(i + 1, l) - at(0, l));
    }
  kept_.back().area = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
  triangles_ += corners.size() - 2;
  if (triangles_ > 2 * most_triangles_) keep_the_largest(most_triangles_);
}

void Page::add_pieces(const Scene& scene, const std::function<std::uint32_t(std::uint32_t)>& group_of) {
  for (std::uint32_t i = 0; i < scene.pieces().size(); ++i) {
    const Piece& piece = scene.pieces()[i];
    add_polygon(piece.face, scene.corner_points(piece), group_of ? group_of(i) : 0);
  }
}

/// Polygons that have no more triangles than that, in their order: those without a face up to half of it, then those of
/// groups that come first up to three quarters, then all, each time the largest.
void Page::keep_the_largest(std::size_t triangles) {
  std::stable_sort(kept_.begin(), kept_.end(), [](const Polygon& a, const Polygon& b) { return a.area > b.area; });
  std::vector<bool> stays(kept_.size());
  triangles_ = 0;
  const auto take = [&](std::size_t most, const auto& is_wanted) {
    for (std::size_t i = 0; i < kept_.size(); ++i) {
      if (stays[i] || !is_wanted(kept_[i]) || triangles_ + kept_[i].size - 2 > most) continue;
      stays[i] = true;
      triangles_ += kept_[i].size - 2;
    }
  };
  take(triangles / 2, [](const Polygon& polygon) { return polygon.face == no_face; });
  take(triangles / 4 * 3, [&](const Polygon& polygon) { return first_groups_.contains(polygon.group); });
  take(triangles, [](const Polygon&) { return true; });
  std::size_t count = 0;
  for (std::size_t i = 0; i < kept_.size(); ++i)
    if (stays[i]) kept_[count++] = kept_[i];
  kept_.resize(count);
  std::sort(kept_.begin(), kept_.end(), [](const Polygon& a, const Polygon& b) { return a.number < b.number; });
  std::vector<float> places;
  std::vector<std::uint32_t> exact;
  for (Polygon& polygon : kept_) {
    const auto begin = static_cast<std::ptrdiff_t>(polygon.first), end = begin + polygon.size;
    polygon.first = static_cast<std::uint32_t>(places.size() / 3);
    places.insert(places.end(), places_.begin() + 3 * begin, places_.begin() + 3 * end);
    if (keeps_texts_) exact.insert(exact.end(), exact_.begin() + begin, exact_.begin() + end);
  }
  places_ = std::move(places);
  exact_ = std::move(exact);
}

// ---- What is written

Json Page::polygons_json() const {
  std::vector<std::uint32_t> sizes, faces, groups, numbers;
  for (const Polygon& polygon : kept_) {
    sizes.push_back(polygon.size);
    faces.push_back(polygon.face);
    groups.push_back(polygon.group);
    numbers.push_back(polygon.number);
  }
  Json json{{"count", kept_.size()}, {"of", added_}, {"sizes", packed(sizes)}, {"faces", packed(faces)}};
  if (groups_.size() > 1) json["groups"] = packed(groups);
  if (kept_.size() < added_) json["numbers"] = packed(numbers);
  // Floats take 16 bytes a corner as text, which is too much where triangles are many and share none.
  if (16 * (places_.size() / 3) <= 30 * triangles_ + 400000) {
    json["corners"] = packed(places_);
    return json;
  }
  // A source may be far away: its corners stay floats where they are few, so that steps are those of the scene.
  std::vector<float> with_face, others;
  for (const Polygon& polygon : kept_) {
    const auto begin = places_.begin() + 3 * static_cast<std::ptrdiff_t>(polygon.first);
    std::vector<float>& to = polygon.face == no_face ? others : with_face;
    to.insert(to.end(), begin, begin + 3 * static_cast<std::ptrdiff_t>(polygon.size));
  }
  const bool are_few = !others.empty() && 16 * (others.size() / 3) <= 400000;
  if (are_few) json["others"] = packed(others);
  const std::vector<float>& rounded = are_few ? with_face : places_;
  Json from = Json::array(), step = Json::array();
  std::vector<std::uint32_t> steps(rounded.size());
  for (std::size_t k = 0; k < 3; ++k) {
    double least = std::numeric_limits<double>::infinity(), most = -least;
    for (std::size_t i = k; i < rounded.size(); i += 3) {
      least = std::min<double>(least, rounded[i]);
      most = std::max<double>(most, rounded[i]);
    }
    const double width = most > least ? (most - least) / 65535 : 1;
    for (std::size_t i = k; i < rounded.size(); i += 3)
      steps[i] = static_cast<std::uint32_t>(std::lround((rounded[i] - least) / width));
    from.push_back(least);
    step.push_back(width);
  }
  json["corners"] = packed_as("u16", little_endian(steps, 2));
  json["from"] = std::move(from);
  json["step"] = std::move(step);
  return json;
}

Json Page::data() {
  if (triangles_ > most_triangles_) keep_the_largest(most_triangles_);
  const bool is_thinned = kept_.size() < added_;
  if (is_thinned)
    add_note(fmt::format("thinned: of {} polygons {} are drawn: sources, what is marked, and the largest", added_,
                         kept_.size()));
  const auto is_point = [](const Polygon& polygon) { return polygon.area == 0; };
  if (const auto points = std::count_if(kept_.begin(), kept_.end(), is_point); points > 0)
    add_note(fmt::format("{} of the polygons {} too small beside the scene to be drawn", points,
                         points == 1 ? "is" : "are"));
  if (is_brought_near_)
    add_note("a source that is beyond a million sizes of the scene is drawn nearer, in the same direction");
  if (is_clipped_) add_note("a source that leads beyond a million sizes of the scene is drawn as far as that");
  if (!keeps_texts_) add_note("coordinates are rounded: those of so many corners would take too much of a page");

  Json data{{"format", "sightline page 1"},
            {"command", command_},
            {"scene", scene_},
            {"facts", facts_},
            {"notes", notes_},
            {"frame",
             {{"middle", {nearest_double(middle_[0]), nearest_double(middle_[1]), nearest_double(middle_[2])}},
              {"size", nearest_double(size_)}}},
            {"groups", Json::array()},
            {"polygons", polygons_json()}};
  for (const auto& [name, role] : groups_) data["groups"].push_back({{"name", name}, {"role", role}});
  if (keeps_texts_) {
    std::vector<std::string> texts(texts_.size());
    for (const auto& [text, place] : texts_) texts[place] = text;
    data["polygons"]["exact"] = {{"texts", texts}, {"corners", packed(exact_)}};
  }
  for (auto& [key, value] : more_.items()) data[key] = std::move(value);
  return data;
}

namespace {

constexpr std::string_view data_mark = "<!--data-->";

/// The text of pages, with this in the place of data.
std::string page_around(std::string_view data) {
  std::string text;
  text.reserve(page_text.size() + page_style.size() + page_script.size() + data.size());
  for (std::size_t i = 0; i < page_text.size();) {
    const auto put = [&](std::string_view mark, std::string_view what) {
      if (!page_text.substr(i).starts_with(mark)) return false;
      text += what;
      i += mark.size();
      return true;
    };
    if (page_text[i] == '<' &&
        (put("<!--style-->", page_style) || put("<!--script-->", page_script) || put(data_mark, data)))
      continue;
    text += page_text[i++];
  }
  return text;
}

}  // namespace

std::string scenes_within() {
  return fmt::format(
      "<style>\n{}</style>\n<script type=\"application/json\" id=\"viewer\">{}</script>\n<script>\n'use "
      "strict';\n(function "
      "() {{\n{}}}());\n</script>\n",
      turn_style, report::in_element(page_around(data_mark)), turn_script);
}

void Page::write(const std::string& file) { write_file(file, page_around(report::in_element(data()))); }

}  // namespace sightline::app
