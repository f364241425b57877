#include "common.h"

#include <sightline/algorithms/verify/keys_once.h>
#include <sightline/harness/generate/transform.h>
#include <sightline/io/input.h>
#include <sightline/io/number_lines.h>
#include <sightline/io/read.h>
#include <sightline/kernel/predicates.h>
#include <sightline/kernel/sign.h>

#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iostream>

namespace sightline::app {

/// By name; text and binary PLY say themselves which they are.
static constexpr std::array<std::pair<const char*, Format>, 9> format_names{{{"obj", Format::obj},
                                                                             {"off", Format::off},
                                                                             {"qoff", Format::qoff},
                                                                             {"ply", Format::ply},
                                                                             {"stl", Format::stl},
                                                                             {"map", Format::map},
                                                                             {"bsp", Format::bsp},
                                                                             {"glb", Format::glb},
                                                                             {"gltf", Format::gltf}}};

void Scene_format::add_to(Command of) {
  command = of;
  std::vector<std::string> names;
  for (const auto& [one, format] : format_names) names.emplace_back(one);
  of.add_option("--format", name, "of standard input, where its content does not show it, as of qoff and gltf")
      .check(one_of(names));
}

Polygon_soup Scene_format::read(const std::string& file, const Read_options& options) const {
  if (!name.empty() && !command->reads_standard_input())
    throw Usage_error("--format is of standard input, and the endings of files say theirs: leave it out");
  const Waiting waiting("reading the scene");
  if (file != "-") return read_scene(file, options);
  const std::string bytes = read_input(file), called = input_path(file).string();
  std::optional<Format> format = format_of_content({called, bytes});
  for (const auto& [one, known] : format_names)
    if (name == one) format = known;
  if (!format) throw std::runtime_error(called + ": its content shows no format; say which with --format");
  if (format == Format::map || format == Format::bsp) *level = bytes;
  try {
    return read_scene(bytes, *format, called, options);
  } catch (const Input_error& error) {
    const auto as =
        std::find_if(format_names.begin(), format_names.end(), [&](const auto& one) { return one.second == *format; });
    throw std::runtime_error(
        fmt::format("{} (read as {}; --format says {})", error.what(), as->first, name.empty() ? "otherwise" : "so"));
  }
}

Option add_json_option(Command command, std::string& file, const std::string& what) {
  return command.add_option("--json", file, fmt::format("write {} as JSON to this file, - for standard output", what))
      .writes_file();
}

void Common::add_to(Command of) {
  command = of;
  of.add_option("SCENE", scene,
                "a scene: .obj .off .ply .stl .gltf .glb .qoff .map .bsp; - for standard input, whose content or "
                "--format shows "
                "what it is")
      .required()
      .reads_file();
  format.add_to(of);
  add_json_option(of, json);
  of.add_option("--coordinates", coordinates,
                "what decimals of SCENE mean: exact (0.1 is 1/10) or double (rounded first, as in other programs); "
                "those of options and other files are exact")
      .check(one_of({"exact", "double"}))
      .show_default();
  of.add_flag("--flip", flip,
              "turn the scene round: all corners backwards, so that backs become fronts. For files whose faces run "
              "clockwise as seen from their front; `verify` takes it too, for what was made with it");
  of.add_option("--threads", threads, "threads; 0: one for each processor. The output does not depend on it")
      .check(range(0, 1024))
      .show_default();
  of.add_option("--seed", seed, "of random choices").check(whole_number()).show_default();
  of.add_option("--budget", budget, "seconds, from when SCENE is ready; 0: no limit. Exit code 4 where they run out")
      .check(not_negative() & finite_number())
      .show_default();
}

Report Common::within_budget(Report report) const {
  return [report = std::move(report), limit = Time_limit(budget)](std::size_t done, std::size_t all) {
    if (limit.is_over()) throw Out_of_budget(fmt::format("undecided: the budget of {} s ran out", limit.seconds()));
    if (report) report(done, all);
  };
}

Report Common::within_budget(Progress& bar) const {
  return within_budget([&bar](std::size_t done, std::size_t all) { bar(done, all); });
}

Polygon_soup Common::read() const {
  Read_options options;
  options.round_to_double = coordinates == "double";
  Polygon_soup soup = format.read(scene, options);
  if (command) command->check_outputs({});  // now that it is known what else was read
  return flip ? generate::faces_reversed(soup) : soup;
}

std::vector<Rational> parse_numbers(const std::string& text, const std::string& wanted) {
  try {
    return numbers_in(text, wanted);
  } catch (const std::invalid_argument& error) {
    throw Usage_error(error.what());
  }
}

Exact_point parse_point(const std::string& text, const std::string& option) {
  const std::string wanted = option + " wants three numbers X,Y,Z";
  const std::vector<Rational> numbers = parse_numbers(text, wanted);
  if (numbers.size() != 3) throw Usage_error(wanted + ", not " + sightline::quoted(text));
  return {numbers[0], numbers[1], numbers[2]};
}

Option add_eye_option(Command command, std::string& eye) {
  return command.add_option("--eye", eye, "the eye X,Y,Z: exact decimals or p/q; by default a place outside the scene")
      .check(not_empty());
}

Exact_point eye_of(const std::string& text, const Scene& scene) {
  if (!text.empty()) return parse_point(text, "--eye");
  if (scene.points().size() == 0) return {};
  const auto box = scene.box();
  Rational size = 1;
  Exact_point eye;
  for (std::size_t k = 0; k < 3; ++k) {
    const Rational side = box[1][k] - box[0][k];
    if (k == 0 || size < side) size = side;
    eye[k] = (box[0][k] + box[1][k]) / 2;
  }
  const bool is_flat = 5 * (box[1][2] - box[0][2]) < size;  // to be looked at from higher up
  const std::array<Rational, 3> away{Rational(-3, 5), Rational(-11, 10), is_flat ? Rational(3, 2) : Rational(7, 10)};
  for (std::size_t k = 0; k < 3; ++k) eye[k] += size * away[k];
  return eye;
}

Progress::Progress(std::string what) : what_(std::move(what)), terminal_(isatty(2) != 0 && !is_quiet()) {}
Progress::~Progress() { clear(); }
void Progress::clear() {
  if (shown_.exchange(-1) >= 0) std::cerr << "\r\033[K" << std::flush;
}
/// ", about 12 min left", if the rest takes as long as what is done; nothing before that says much.
static std::string time_left(double seconds, std::size_t done, std::size_t all) {
  if (seconds < 2 || done == 0 || done > all) return "";
  const double left = std::ceil(seconds * static_cast<double>(all - done) / static_cast<double>(done));
  if (left > 1e6) return ", days left";
  const auto n = static_cast<int>(left);
  return n < 100    ? fmt::format(", about {} s left", n)
         : n < 5400 ? fmt::format(", about {} min left", (n + 30) / 60)
                    : fmt::format(", about {} h left", (n + 1800) / 3600);
}

void Progress::operator()(std::size_t done, std::size_t all) {
  const double seconds = watch_.seconds();
  if (!terminal_ || seconds < 0.5) return;
  // Once a second, and where the share has grown: what was shown last, of both, in one number.
  constexpr int share = 128;
  const int second = static_cast<int>(std::min(seconds, 1e7));
  int before = shown_.load();
  // Fragments outnumber pieces, so the share can only be a guess below the end.
  int percent = all == 0 ? 0 : static_cast<int>(std::min<std::size_t>(99, 100 * done / all));
  if (before >= 0) {
    if (percent <= before % share && second <= before / share) return;
    percent = std::max(percent, before % share);
  }
  if (!shown_.compare_exchange_strong(before, second * share + percent)) return;
  std::cerr << fmt::format("\r{} [{:<40}] {:2}%{}\033[K", what_,
                           std::string(static_cast<std::size_t>(percent) * 40 / 100, '#'), percent,
                           time_left(seconds, done, all))
            << std::flush;
}

Waiting::Waiting(std::string what) {
  if (isatty(2) != 0 && !is_quiet()) line_ = std::thread([this, what = std::move(what)] { show(what); });
}
Waiting::~Waiting() {
  if (!line_.joinable()) return;
  {
    const std::scoped_lock lock(mutex_);
    has_ended_ = true;
  }
  ended_.notify_one();
  line_.join();
}
void Waiting::show(const std::string& what) {
  std::unique_lock lock(mutex_);
  int seconds = 0;
  while (!ended_.wait_for(lock, std::chrono::seconds(1), [this] { return has_ended_; }))
    std::cerr << fmt::format("\r{}, {} s\033[K", what, ++seconds) << std::flush;
  if (seconds > 0) std::cerr << "\r\033[K" << std::flush;
}

Scene scene_of(const Polygon_soup& soup) {
  const Waiting waiting("preparing the scene");
  return Scene(soup);
}

Json point_json(const Exact_point& p) { return {to_string(p[0]), to_string(p[1]), to_string(p[2])}; }

Json predicates_json(const Predicate_counts& counts) {
  Json json{{"total", counts.total()}};
  append_counters(json, counts);
  return json;
}

Json scene_json(const Scene& scene) {
  const Scene_counters& c = scene.counters();
  Json set_aside = Json::array();
  for (const Set_aside& entry : scene.set_aside()) set_aside.push_back({{"face", entry.face}, {"why", entry.why}});
  return {{"file", scene.file()},
          {"faces_read", c.faces_read},
          {"faces", c.faces},
          {"set_aside", std::move(set_aside)},
          {"bits", scene.bits()},
          {"arithmetic", std::string(name(scene.predicates().arithmetic()))},
          {"grid_bits", scene.points().bits()},
          {"pieces", c.pieces}};
}

bool write_json(const Common& common, const std::string& command, const Scene& scene, Json result, Json counters,
                Json seconds) {
  const bool taken = common.command->writes_standard_output();
  if (common.json.empty()) return taken;
  Json document;
  document["command"] = command;
  document["scene"] = scene_json(scene);
  if (common.flip) document["scene"]["flipped"] = true;
  document["result"] = std::move(result);
  document["counters"] = std::move(counters);
  document["seconds"] = std::move(seconds);
  write_file(common.json, document.dump(1, ' ', false, Json::error_handler_t::replace) + "\n");
  return taken;
}

std::string to_text(const Json& value, int indent) {
  return value.dump(indent, ' ', false, Json::error_handler_t::replace);  // names of files may be no UTF-8
}

nlohmann::json parse_json(const std::string& text, const std::string& name) {
  try {
    return json_with_keys_once(text);
  } catch (const std::invalid_argument& error) {
    throw Input_error::of_file(name, std::string(error.what()) + "; write the file again");
  } catch (const nlohmann::json::parse_error& error) {
    const std::size_t place = std::min(std::max<std::size_t>(error.byte, 1) - 1, text.size());
    Input{name, text}.fail(text.data() + place,
                           place == text.size()
                               ? "the JSON ends too early; write the file again, or fetch it again"
                               : "from here on it is no JSON; write the file again, or fetch it again");
  } catch (const nlohmann::json::exception& error) {  // a number beyond doubles
    const std::string_view what = error.what();
    throw Input_error::of_file(name, std::string(what.substr(what.find("] ") + 2)) + "; write the file again");
  }
}

void row(const std::string& name, const std::string& value) { std::cout << fmt::format("{:<22} {}\n", name, value); }

std::string digits_of(const Rational& value, int digits) {
  const double near = nearest_double(value);
  if (sgn(value) == 0 || std::isnormal(near)) return fmt::format("{:.{}g}", near, digits);
  const mpf_class wide(value, 128);
  mp_exp_t exponent = 0;
  std::string text = wide.get_str(exponent, 10, static_cast<std::size_t>(digits));
  const std::size_t first = text[0] == '-' ? 1 : 0;
  if (text.size() > first + 1) text.insert(first + 1, ".");
  return fmt::format("{}e{:+}", text, exponent - 1);
}

void scene_rows(const Scene& scene) {
  const Scene_counters& c = scene.counters();
  row("scene", scene.file());
  row("faces", fmt::format("{} of {} read, {} set aside, {} convex pieces", c.faces, c.faces_read,
                           scene.set_aside().size(), c.pieces));
}

}  // namespace sightline::app
