#pragma once
// What the commands share: reading a scene, exact points on the command line, JSON, tables, progress.

#include "command.h"
#include "files.h"

#include <sightline/io/format.h>
#include <sightline/kernel/counters.h>
#include <sightline/kernel/scene/scene.h>
#include <sightline/kernel/sign.h>
#include <sightline/kernel/time_limit.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <atomic>
#include <condition_variable>
#include <functional>
#include <memory>
#include <mutex>
#include <thread>

namespace sightline::app {

using Json = nlohmann::ordered_json;

/// How far work is, which it tells; what this throws ends it.
using Report = std::function<void(std::size_t done, std::size_t all)>;
class Progress;

/// A scene of a file, or of standard input, and what that is: option --format.
struct Scene_format {
  std::string name;  ///< empty: the content shows it
  std::optional<Command> command;
  /// What read() found on standard input where that is a level of Quake's: it cannot be read again.
  std::shared_ptr<std::string> level = std::make_shared<std::string>();

  void add_to(Command of);
  /// Errors: Input_error; std::runtime_error of standard input, which says what to do; Usage_error where it is said of
  /// no standard input.
  Polygon_soup read(const std::string& file, const Read_options& options = {}) const;
};

/// The options that every command on a scene has.
struct Common {
  std::string scene;
  Scene_format format;
  std::string json;  ///< a file, "-" for standard output, or empty
  std::string coordinates = "exact";
  bool flip = false;  ///< each loop of the scene backwards
  int threads = 0;
  std::uint64_t seed = 1;
  double budget = 0;  ///< seconds; 0: no limit

  std::optional<Command> command;  ///< whose options these are

  void add_to(Command of);
  Polygon_soup read() const;
  /// What work tells, which ends it by Out_of_budget once the seconds are over, from now on: with a bar, which outlives
  /// it.
  Report within_budget(Report report = {}) const;
  Report within_budget(Progress& bar) const;
};

/// Adds --json FILE; `what` says what of the command's is in it.
Option add_json_option(Command command, std::string& file, const std::string& what = "everything");

/// Numbers with commas between them, exact decimals or p/q. Errors: Usage_error that begins with `wanted`.
std::vector<Rational> parse_numbers(const std::string& text, const std::string& wanted);
/// "X,Y,Z" with exact decimals or p/q. Errors: Usage_error naming the option.
Exact_point parse_point(const std::string& text, const std::string& option);

/// Adds --eye X,Y,Z.
Option add_eye_option(Command command, std::string& eye);
/// The eye that --eye names, or, where it is empty, a place outside the scene's box from which all of it is seen.
Exact_point eye_of(const std::string& text, const Scene& scene);

/// A bar on standard error, if that is a terminal and the work lasts; nothing otherwise. Thread-safe.
class Progress {
 public:
  explicit Progress(std::string what);
  ~Progress();
  Progress(const Progress&) = delete;
  void operator()(std::size_t done, std::size_t all);
  void clear();  ///< takes the bar away, before what is printed next

 private:
  std::string what_;
  bool terminal_;
  Stopwatch watch_;
  std::atomic<int> shown_{-1};
};

/// A line on standard error, if that is a terminal, of how many seconds work goes on that does not tell how far it is:
/// from its second second on, until this ends.
class Waiting {
 public:
  explicit Waiting(std::string what);
  ~Waiting();
  Waiting(const Waiting&) = delete;

 private:
  void show(const std::string& what);

  std::mutex mutex_;
  std::condition_variable ended_;
  bool has_ended_ = false;
  std::thread line_;
};

/// The scene of a soup, which is waited for.
Scene scene_of(const Polygon_soup& soup);

/// So many seconds from now, and a bar that shows how many of them are over.
class Countdown {
 public:
  Countdown(std::string what, double seconds) : progress_(std::move(what)), limit_(seconds) {}
  bool over() {
    progress_(static_cast<std::size_t>(1000 * watch_.seconds()), static_cast<std::size_t>(1000 * limit_));
    return watch_.seconds() >= limit_;
  }
  double seconds() const { return watch_.seconds(); }  ///< since the beginning

 private:
  Progress progress_;
  Stopwatch watch_;
  double limit_;
};

/// The "scene" object of every command's JSON.
Json scene_json(const Scene& scene);
Json predicates_json(const Predicate_counts& counts);
/// Appends counters under their keys, as they are listed; those of a part among them.
template <Counters Type>
void append_counters(Json& to, const Type& counters) {
  Type::each([&](const std::string& key, auto member, auto...) {
    const auto& value = counters.*member;
    if constexpr (!Counters<std::remove_cvref_t<decltype(value)>>) {
      if (!key.empty()) to[key] = value;
    } else if constexpr (std::is_same_v<decltype(value), const Predicate_counts&>) {
      if (!key.empty()) to[key] = predicates_json(value);
    } else append_counters(to, value);
  });
}
template <Counters Type>
Json counters_json(const Type& counters) {
  Json json;
  append_counters(json, counters);
  return json;
}
Json point_json(const Exact_point& p);

/// Writes the JSON document of a command where --json asks for it. Returns whether standard output is taken, by it or
/// by another output.
bool write_json(const Common& common, const std::string& command, const Scene& scene, Json result, Json counters,
                Json seconds);
/// JSON as text and from text: here, since both take long to compile. `indent` below 0: one line. Errors: Input_error
/// with line and column; `name` is the file's.
std::string to_text(const Json& value, int indent = -1);
nlohmann::json parse_json(const std::string& text, const std::string& name);

/// A number for people, to so many digits; also where it is beyond what doubles hold.
std::string digits_of(const Rational& value, int digits);

/// One row of a table for people.
void row(const std::string& name, const std::string& value);
void scene_rows(const Scene& scene);

}  // namespace sightline::app
