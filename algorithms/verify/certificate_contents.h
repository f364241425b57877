#pragma once
// What entries of certificates are, taken one at a time in any order. Internal to certificate_json.cpp.

#include <sightline/algorithms/verify/certificate_json.h>
#include <sightline/algorithms/verify/written_out.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <nlohmann/json_fwd.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sightline::certificate_json {

/// What is wrong, without its place in the text.
struct Fault {
  std::string message;
};

/// "fragments[3]"
std::string entry_name(const std::string& key, std::size_t number);

class At;

/// Where a number stands that names a point of a table.
struct Place {
  enum List : std::uint8_t { fragments, pieces, parts, field, empty, sources, hidden } list;
  std::size_t entry, corner;
};
/// A list of points that others name by their places in it, perhaps before it is read.
struct Table {
  const char* key;
  bool is_whole = false;
  std::vector<Exact_point> points = {};
  struct Late {
    std::uint32_t number;
    Place place;
  };
  std::vector<Late> late = {};

  /// Faults: there is no such number.
  void check(std::uint32_t number, const std::string& at) const;
};

/// Whether the value of a key is taken entry by entry, as a list; nothing where the key means nothing.
std::optional<bool> is_list(std::string_view key);

/// What certificates of all kinds have: of which kind this one is, is known once all of it is read.
class Contents {
 public:
  /// `read`: how much of the text was read, whenever it is looked at.
  explicit Contents(const std::size_t& read) : read_(read) {}

  /// Takes entry `number` of a list.
  void take(const std::string& key, std::size_t number, const nlohmann::json& entry);
  /// Takes a value that is no list.
  void take(const std::string& key, const nlohmann::json& value);
  /// What must be known of a list that has ended.
  void end(const std::string& key) {
    if (key == "points") points_.is_whole = true;
    if (key == "rays") rays_.is_whole = true;
  }
  /// Pre: the keys that there were, and what was wrong below them.
  Certificate finish(const std::vector<std::pair<std::string, std::optional<Certificate_error>>>& keys);

 private:
  std::vector<Exact_point> points(const nlohmann::json& value, const At& at, Table& table, Place::List list,
                                  std::size_t entry);
  template <class Part>
  Part part(const nlohmann::json& entry, const At& at, Place::List list, std::size_t number);
  void take_part(const nlohmann::json& entry, const At& at);
  void take_hidden(const nlohmann::json& entry, const At& at);
  void take_proof(const nlohmann::json& entry, const At& at);
  Exact_point& at(const Place& place);
  [[noreturn]] static void fail_as_too_much(const Table& table, const std::string& at);
  void put(const Table& table, std::uint32_t number, Exact_point& there, const Place& place);
  void put_late(Table& table);
  void check_graph() const;
  void check_parts();
  void check_weak() const;
  void check_along() const;

  const std::size_t& read_;
  Written_out written_out_;
  std::string format_;
  Table points_{"points"}, rays_{"rays"};
  Covering covering_;
  Exact_point eye_;
  bool on_view_ = false;
  Order_cuts cuts_;
  Graph_certificate graph_;
  Visible_certificate visible_;
  Weak_certificate weak_;
  Along_certificate along_;
  bool two_sided_ = false;
};

}  // namespace sightline::certificate_json
