// Reading. From top to bottom: the text as characters with their places; what entries of lists are; certificates, key
// by key; the events of the parser. certificate_writer.cpp writes.

#include <sightline/algorithms/verify/certificate_json.h>

#include <sightline/kernel/number.h>
#include <sightline/kernel/quoted.h>
#include <sightline/kernel/scene/polygon_soup.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <istream>
#include <iterator>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sightline {

Certificate_error::Certificate_error(std::size_t at_line, std::size_t at_column, const std::string& what, bool json)
    : std::invalid_argument(
          "certificate: " +
          (at_line == 0 ? "" : "line " + std::to_string(at_line) + ", column " + std::to_string(at_column) + ": ") +
          what),
      line(at_line),
      column(at_column),
      message(what),
      is_no_json(json) {}

namespace certificate_json {
namespace {

using Json = nlohmann::json;

// ---- The text

/// The characters of a stream, one after the other, and the place of the last one.
class Text {
 public:
  explicit Text(std::istream& in) : in_(in), buffer_(std::size_t{1} << 16) { fill(); }
  bool at_end() const { return next_ == end_; }
  char peek() const { return buffer_[next_]; }
  void step() {
    const char c = buffer_[next_++];
    if (before_ == '\n' || (before_ == '\r' && c != '\n')) ++line_, column_ = 0;
    if (++count_ > 3 || byte_order_mark[count_ - 1] != c) ++column_;
    before_ = c;
    if (next_ == end_) fill();
  }
  std::size_t count() const { return count_; }
  std::size_t line() const { return line_; }
  std::size_t column() const { return column_; }

 private:
  static constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  void fill() {
    in_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    next_ = 0;
    end_ = static_cast<std::size_t>(in_.gcount());
  }

  std::istream& in_;
  std::vector<char> buffer_;
  std::size_t next_ = 0, end_ = 0, count_ = 0, line_ = 1, column_ = 0;
  char before_ = 0;
};

/// What the parser takes for a range of characters.
class Character {
 public:
  using iterator_category = std::input_iterator_tag;
  using value_type = char;
  using difference_type = std::ptrdiff_t;
  using pointer = const char*;
  using reference = char;
  Character() = default;  // the end
  explicit Character(Text& text) : text_(&text) {}
  char operator*() const { return text_->peek(); }
  Character& operator++() {
    text_->step();
    return *this;
  }
  Character operator++(int) { return ++*this; }
  friend bool operator==(const Character& a, const Character& b) { return a.ends() == b.ends(); }

 private:
  bool ends() const { return text_ == nullptr || text_->at_end(); }
  Text* text_ = nullptr;
};

// ---- Parts of entries

/// What is wrong, without its place in the text.
struct Fault {
  std::string message;
};
[[noreturn]] void fail(const std::string& place, const std::string& what) { throw Fault{place + ": " + what}; }

const Json& member(const Json& object, const char* key, const std::string& place) {
  if (!object.is_object()) fail(place, "expected an object");
  const auto found = object.find(key);
  if (found == object.end()) fail(place, std::string("no \"") + key + '"');
  return *found;
}

const Json& array(const Json& value, const std::string& place) {
  if (!value.is_array()) fail(place, "expected an array");
  return value;
}
std::uint32_t number32(const Json& value, const std::string& place) {
  if (!value.is_number_unsigned() || value.get<std::uint64_t>() > UINT32_MAX)
    fail(place, "expected an integer from 0 to 4294967295");
  return value.get<std::uint32_t>();
}

Rational exact_number(const Json& value, const std::string& place) {
  if (!value.is_string()) fail(place, "expected exact numbers as strings \"p\" or \"p/q\"");
  try {
    return rational_from_string(value.get_ref<const std::string&>());
  } catch (const std::invalid_argument& error) {
    fail(place, error.what());
  }
}

template <std::size_t n>
std::array<Rational, n> exact_numbers(const Json& value, const std::string& place) {
  if (array(value, place).size() != n) fail(place, std::string("expected ") + (n == 3 ? "three" : "four") + " numbers");
  std::array<Rational, n> result;
  for (std::size_t k = 0; k < n; ++k) result[k] = exact_number(value[k], place);
  return result;
}
Exact_point point(const Json& value, const std::string& place) { return exact_numbers<3>(value, place); }

bool truth(const Json& value, const std::string& at) {
  if (!value.is_boolean()) fail(at, "expected true or false");
  return value.get<bool>();
}

std::string entry_name(const std::string& key, std::size_t number) { return key + '[' + std::to_string(number) + ']'; }

/// The kinds of nodes, by the words that they begin with.
constexpr std::array<std::pair<const char*, Weak_certificate::Node::Kind>, 6> node_words{
    {{"line", Weak_certificate::Node::Kind::line},
     {"cut source", Weak_certificate::Node::Kind::cut_source},
     {"cut target", Weak_certificate::Node::Kind::cut_target},
     {"blocked", Weak_certificate::Node::Kind::blocked},
     {"empty", Weak_certificate::Node::Kind::empty},
     {"away", Weak_certificate::Node::Kind::away}}};

/// [line, factor] or [line, factor, {"source": form, "target": form}].
Weak_certificate::Term term(const Json& value, const std::string& at) {
  if (array(value, at).size() != 2 && value.size() != 3) fail(at, "expected [line, factor] or [line, factor, forms]");
  Weak_certificate::Term result;
  result.line = number32(value[0], at + "[0]");
  result.factor = exact_number(value[1], at + "[1]");
  if (value.size() == 2) return result;
  if (!value[2].is_object()) fail(at + "[2]", "expected an object");
  if (value[2].contains("source")) result.source = exact_numbers<4>(value[2]["source"], at + "[2].source");
  if (value[2].contains("target")) result.target = exact_numbers<4>(value[2]["target"], at + "[2].target");
  return result;
}

/// [word], or [word, what it is about].
Weak_certificate::Node node(const Json& value, const std::string& at) {
  using Kind = Weak_certificate::Node::Kind;
  if (array(value, at).empty() || !value[0].is_string()) fail(at, "expected an array that begins with a word");
  const auto found = std::find_if(node_words.begin(), node_words.end(), [&](const auto& known) {
    return value[0].get_ref<const std::string&>() == known.first;
  });
  if (found == node_words.end())
    fail(at + "[0]", "expected \"line\", \"cut source\", \"cut target\", \"blocked\", \"empty\" or \"away\"");
  Weak_certificate::Node result;
  result.kind = found->second;
  const std::size_t size = result.kind == Kind::away ? 1 : 2;
  if (value.size() != size) fail(at, "expected " + std::to_string(size) + (size == 1 ? " entry" : " entries"));
  if (result.kind == Kind::line || result.kind == Kind::blocked) result.index = number32(value[1], at + "[1]");
  if (result.kind == Kind::cut_source || result.kind == Kind::cut_target)
    result.plane = exact_numbers<4>(value[1], at + "[1]");
  if (result.kind == Kind::empty)
    for (const Json& entry : array(value[1], at + "[1]"))
      result.terms.push_back(term(entry, entry_name(at + "[1]", result.terms.size())));
  return result;
}

// ---- Tables

/// Where a number stands that names a point of a table.
struct Place {
  enum List : std::uint8_t { fragments, pieces, parts, field, empty, sources } list;
  std::size_t entry, corner;
};
std::string name_of(const Place& place) {
  static constexpr const char* keys[] = {"fragments", "pieces", "parts", "field", "empty", "sources"};
  const std::string entry = place.list == Place::field ? "field" : entry_name(keys[place.list], place.entry);
  return entry_name(entry + (place.list <= Place::parts ? ".vertices" : ""), place.corner);
}

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

  void check(std::uint32_t number, const std::string& at) const {
    if (number < points.size()) return;
    const std::string table = std::string(1, '"') + key + '"';
    fail(at, is_whole ? "expected a number below " + std::to_string(points.size()) + ", the size of " + table
                      : std::string("is a number, but there is no table ") + table);
  }
};

// ---- Certificates

/// Whether the value of a key is taken entry by entry, as a list; nothing where the key means nothing.
std::optional<bool> is_list(std::string_view key) {
  for (const std::string_view known : {"format", "eye", "on_view", "field", "two_sided"})
    if (key == known) return false;
  for (const std::string_view known : {"points", "fragments", "pieces", "set_aside", "sizes", "arcs", "rays", "parts",
                                       "empty", "sources", "visible", "lines", "hidden", "undecided"})
    if (key == known) return true;
  return std::nullopt;
}

/// What certificates of all kinds have: of which kind this one is, is known once all of it is read.
class Contents {
 public:
  explicit Contents(const Text& text) : text_(text) {}

  /// Takes entry `number` of a list.
  void take(const std::string& key, std::size_t number, const Json& entry);
  /// Takes a value that is no list.
  void take(const std::string& key, const Json& value);
  /// What must be known of a list that has ended.
  void end(const std::string& key) {
    if (key == "points") points_.is_whole = true;
    if (key == "rays") rays_.is_whole = true;
  }
  /// Pre: the keys that there were, and what was wrong below them.
  Certificate finish(const std::vector<std::pair<std::string, std::optional<Certificate_error>>>& keys);

 private:
  std::vector<Exact_point> points(const Json& value, const std::string& at, Table& table, Place::List list,
                                  std::size_t entry);
  template <class Part>
  Part part(const Json& entry, const std::string& at, Place::List list, std::size_t number);
  void take_part(const Json& entry, const std::string& at);
  void take_hidden(const Json& entry, const std::string& at);
  Exact_point& at(const Place& place);
  void put(const Table& table, std::uint32_t number, Exact_point& there, const Place& place);
  void put_late(Table& table);
  void check_graph() const;
  void check_parts() const;
  void check_weak() const;

  const Text& text_;
  std::size_t written_out_ = 0;
  std::string format_;
  Table points_{"points"}, rays_{"rays"};
  Covering covering_;
  Exact_point eye_;
  bool on_view_ = false;
  Graph_certificate graph_;
  Visible_certificate visible_;
  Weak_certificate weak_;
};

Exact_point& Contents::at(const Place& place) {
  switch (place.list) {
    case Place::fragments: return covering_.fragments[place.entry].vertices[place.corner];
    case Place::pieces: return covering_.pieces[place.entry].vertices[place.corner];
    case Place::parts: return visible_.parts[place.entry].vertices[place.corner];
    case Place::field: return visible_.field[place.corner];
    case Place::empty: return visible_.empty[place.entry][place.corner];
    default: return weak_.sources[place.entry][place.corner];
  }
}

/// Few numbers must not become much memory: of large points that are named often.
void Contents::put(const Table& table, std::uint32_t number, Exact_point& there, const Place& place) {
  const Exact_point& point = table.points[number];
  for (const Rational& x : point) written_out_ += (bit_length(x.get_num()) + bit_length(x.get_den())) / 8 + 16;
  if (written_out_ > std::max(std::size_t{1} << 28, 64 * text_.count()))
    fail(name_of(place), std::string("points of \"") + table.key +
                             "\" are named so often that they take more than 64 times the file, and 256 MiB; write "
                             "them out");
  there = point;
}
void Contents::put_late(Table& table) {
  for (const auto& [number, place] : table.late) {
    table.check(number, name_of(place));
    put(table, number, at(place), place);
  }
  table.late = {};
}

std::vector<Exact_point> Contents::points(const Json& value, const std::string& place, Table& table, Place::List list,
                                          std::size_t entry) {
  std::vector<Exact_point> result(array(value, place).size());
  for (std::size_t k = 0; k < result.size(); ++k) {
    if (!value[k].is_number()) {
      result[k] = point(value[k], entry_name(place, k));
      continue;
    }
    const std::uint32_t number = number32(value[k], entry_name(place, k));
    if (!table.is_whole) {
      table.late.push_back({number, {list, entry, k}});
      continue;
    }
    table.check(number, entry_name(place, k));
    put(table, number, result[k], {list, entry, k});
  }
  return result;
}

/// {face, piece, vertices}: a fragment or a piece.
template <class Part>
Part Contents::part(const Json& entry, const std::string& at, Place::List list, std::size_t number) {
  return {number32(member(entry, "face", at), at + ".face"), number32(member(entry, "piece", at), at + ".piece"),
          points(member(entry, "vertices", at), at + ".vertices", points_, list, number)};
}

/// {fragment, vertices, ray} or {fragment, rays}.
void Contents::take_part(const Json& entry, const std::string& at) {
  Visible_certificate::Part part;
  part.fragment = number32(member(entry, "fragment", at), at + ".fragment");
  if (entry.contains("rays")) {
    const std::string place = at + ".rays";
    for (const Json& number : array(entry["rays"], place))
      part.rays.push_back(number32(number, entry_name(place, part.rays.size())));
    if (part.rays.size() < 3) fail(place, "expected three or more numbers");
    if (entry.contains("vertices") || entry.contains("ray"))
      fail(at, "expected either \"rays\", or \"vertices\" and \"ray\"");
  } else {
    part.vertices =
        points(member(entry, "vertices", at), at + ".vertices", points_, Place::parts, visible_.parts.size());
    part.ray = point(member(entry, "ray", at), at + ".ray");
  }
  visible_.parts.push_back(std::move(part));
}

/// {fragment, source, proof}.
void Contents::take_hidden(const Json& entry, const std::string& at) {
  Weak_certificate::Hidden hidden;
  hidden.fragment = number32(member(entry, "fragment", at), at + ".fragment");
  hidden.source = number32(member(entry, "source", at), at + ".source");
  for (const Json& step : array(member(entry, "proof", at), at + ".proof"))
    hidden.proof.push_back(node(step, entry_name(at + ".proof", hidden.proof.size())));
  weak_.hidden.push_back(std::move(hidden));
}

void Contents::take(const std::string& key, std::size_t number, const Json& entry) {
  const std::string at = entry_name(key, number);
  const auto numbers = [&](std::size_t count, const char* wanted) {
    if (array(entry, at).size() != count) fail(at, wanted);
    std::vector<std::uint32_t> result;
    for (const Json& value : entry) result.push_back(number32(value, at));
    return result;
  };
  if (key == "points") points_.points.push_back(point(entry, at));
  else if (key == "rays") rays_.points.push_back(point(entry, at));
  else if (key == "fragments") covering_.fragments.push_back(part<Order_fragment>(entry, at, Place::fragments, number));
  else if (key == "pieces") covering_.pieces.push_back(part<Covering::Piece>(entry, at, Place::pieces, number));
  else if (key == "set_aside") {
    const Json& why = member(entry, "why", at);
    if (!why.is_string()) fail(at + ".why", "expected a string");
    covering_.set_aside.push_back({number32(member(entry, "face", at), at + ".face"), why.get<std::string>()});
  } else if (key == "sizes") graph_.sizes.push_back(number32(entry, at));
  else if (key == "arcs") {
    const auto arc = numbers(4, "expected [from, to, corner of from, corner of to]");
    graph_.arcs.push_back({arc[0], arc[1], arc[2], arc[3]});
  } else if (key == "parts") take_part(entry, at);
  else if (key == "empty") visible_.empty.push_back(points(entry, at, rays_, Place::empty, number));
  else if (key == "sources") weak_.sources.push_back(points(entry, at, points_, Place::sources, number));
  else if (key == "visible") {
    weak_.visible.push_back({number32(member(entry, "fragment", at), at + ".fragment"),
                             number32(member(entry, "source", at), at + ".source"),
                             point(member(entry, "from", at), at + ".from"),
                             point(member(entry, "to", at), at + ".to")});
  } else if (key == "lines") {
    const auto line = numbers(2, "expected [fragment, corner]");
    weak_.lines.push_back({line[0], line[1]});
  } else if (key == "hidden") take_hidden(entry, at);
  else weak_.undecided.push_back(number32(entry, at));
}

void Contents::take(const std::string& key, const Json& value) {
  if (key == "format") format_ = value.is_string() ? value.get<std::string>() : "";
  else if (key == "eye") eye_ = point(value, key);
  else if (key == "on_view") on_view_ = truth(value, key);
  else if (key == "two_sided") weak_.two_sided = truth(value, key);
  else visible_.field = points(value, key, rays_, Place::field, 0);
}

// ---- What refers to what

void check_below(std::size_t number, std::size_t below, const std::string& at) {
  if (number >= below) fail(at, "expected a number below " + std::to_string(below));
}

void Contents::check_graph() const {
  const std::vector<Order_fragment>& fragments = covering_.fragments;
  for (std::size_t k = 0; k < graph_.arcs.size(); ++k) {
    const Graph_certificate::Arc& arc = graph_.arcs[k];
    const std::string at = entry_name("arcs", k);
    check_below(arc.from, fragments.size(), at), check_below(arc.to, fragments.size(), at);
    check_below(arc.corner_from, fragments[arc.from].vertices.size(), at);
    check_below(arc.corner_to, fragments[arc.to].vertices.size(), at);
  }
}

void Contents::check_parts() const {
  for (std::size_t k = 0; k < visible_.parts.size(); ++k) {
    const Visible_certificate::Part& part = visible_.parts[k];
    if (part.fragment >= covering_.fragments.size())
      check_below(part.fragment, covering_.fragments.size(), entry_name("parts", k) + ".fragment");
    for (std::size_t i = 0; i < part.rays.size(); ++i)
      if (part.rays[i] >= rays_.points.size())
        rays_.check(part.rays[i], entry_name(entry_name("parts", k) + ".rays", i));
  }
}

void Contents::check_weak() const {
  const std::size_t fragments = covering_.fragments.size(), sources = weak_.sources.size(), lines = weak_.lines.size();
  for (std::size_t k = 0; k < lines; ++k) {
    const Weak_certificate::Edge& line = weak_.lines[k];
    check_below(line.fragment, fragments, entry_name("lines", k));
    check_below(line.corner, covering_.fragments[line.fragment].vertices.size(), entry_name("lines", k));
  }
  for (std::size_t k = 0; k < weak_.visible.size(); ++k) {
    check_below(weak_.visible[k].fragment, fragments, entry_name("visible", k) + ".fragment");
    check_below(weak_.visible[k].source, sources, entry_name("visible", k) + ".source");
  }
  for (std::size_t k = 0; k < weak_.hidden.size(); ++k) {
    const Weak_certificate::Hidden& hidden = weak_.hidden[k];
    const std::string at = entry_name("hidden", k);
    check_below(hidden.fragment, fragments, at + ".fragment");
    check_below(hidden.source, sources, at + ".source");
    for (std::size_t i = 0; i < hidden.proof.size(); ++i) {
      using Kind = Weak_certificate::Node::Kind;
      const Weak_certificate::Node& node = hidden.proof[i];
      const auto place = [&] { return entry_name(at + ".proof", i) + "[1]"; };
      if (node.kind == Kind::line && node.index >= lines) check_below(node.index, lines, place());
      if (node.kind == Kind::blocked && node.index >= fragments) check_below(node.index, fragments, place());
      for (std::size_t t = 0; t < node.terms.size(); ++t)
        if (node.terms[t].line >= lines) check_below(node.terms[t].line, lines, entry_name(place(), t) + "[0]");
    }
  }
}

struct Kind {
  std::string_view name;
  std::vector<std::string_view> needed, optional;
};
const std::array<Kind, 4>& kinds() {
  static const std::array<Kind, 4> all{
      {{"order", {"eye"}, {"on_view"}},
       {"graph", {"sizes", "arcs"}, {}},
       {"see", {"eye", "parts", "empty"}, {"field", "rays"}},
       {"weak", {"sources", "lines", "visible", "hidden"}, {"two_sided", "undecided"}}}};
  return all;
}

Certificate Contents::finish(const std::vector<std::pair<std::string, std::optional<Certificate_error>>>& keys) {
  // 1. Its kind.
  const auto has = [&](std::string_view key) {
    return std::any_of(keys.begin(), keys.end(), [&](const auto& known) { return known.first == key; });
  };
  if (!has("format")) fail("top level", "no \"format\"");
  const auto kind = std::find_if(kinds().begin(), kinds().end(), [&](const Kind& known) {
    const std::string begin = "sightline " + std::string(known.name) + ' ';
    return format_ == begin + '1' || format_ == begin + '2';
  });
  if (kind == kinds().end())
    fail("format", "expected \"sightline order 2\", or graph, see or weak in its place, or 1 in that of 2");

  // 2. Nothing is wrong below the keys that it has, and none is missing.
  std::vector<std::string_view> needed = {"fragments"}, known = {"points", "pieces", "set_aside"};
  needed.insert(needed.begin(), kind->needed.begin(), kind->needed.end());
  known.insert(known.end(), kind->optional.begin(), kind->optional.end());
  known.insert(known.end(), needed.begin(), needed.end());
  for (const auto& [key, fault] : keys)
    if (fault && std::find(known.begin(), known.end(), key) != known.end()) throw *fault;
  for (const std::string_view key : needed)
    if (!has(key)) fail("top level", "no \"" + std::string(key) + '"');

  // 3. What refers to something refers to what there is.
  const auto of_this_kind = [&](Table& table) {
    std::erase_if(table.late, [&](const Table::Late& late) {
      const std::string name = name_of(late.place);
      return std::find(known.begin(), known.end(), std::string_view(name).substr(0, name.find('['))) == known.end();
    });
  };
  of_this_kind(points_), of_this_kind(rays_);
  put_late(points_), put_late(rays_);
  if (kind->name == "graph") check_graph();
  if (kind->name == "see") check_parts();
  if (kind->name == "weak") check_weak();

  // 4. The certificate.
  const auto with_covering = [&](auto&& certificate) -> Certificate {
    static_cast<Covering&>(certificate) = std::move(covering_);
    return std::move(certificate);
  };
  if (kind->name == "graph") return with_covering(std::move(graph_));
  if (kind->name == "weak") return with_covering(std::move(weak_));
  if (kind->name == "see") {
    visible_.eye = std::move(eye_);
    visible_.rays = std::move(rays_.points);
    return with_covering(std::move(visible_));
  }
  Order_certificate order;
  order.eye = std::move(eye_);
  order.on_view = on_view_;
  return with_covering(std::move(order));
}

// ---- The parser's events

/// Puts entries together, one at a time, and hands them over. What is wrong with one is kept, and the rest of its list
/// passed over: the key may mean nothing in a certificate of this kind.
class Events {
 public:
  explicit Events(const Text& text) : text_(text), contents_(text) {}
  using number_integer_t = Json::number_integer_t;
  using number_unsigned_t = Json::number_unsigned_t;
  using number_float_t = Json::number_float_t;
  using string_t = Json::string_t;
  using binary_t = Json::binary_t;

  bool null() { return value(nullptr); }
  bool boolean(bool truth) { return value(truth); }
  bool number_integer(number_integer_t number) { return value(number); }
  bool number_unsigned(number_unsigned_t number) { return value(number); }
  bool number_float(number_float_t number, const string_t&) { return value(number); }
  bool string(string_t& text) { return value(std::move(text)); }
  bool binary(binary_t&) { return false; }
  bool start_object(std::size_t) { return open(Json::object()); }
  bool start_array(std::size_t) { return open(Json::array()); }
  bool end_object() { return close(); }
  bool end_array() { return close(); }
  bool key(string_t& name);
  bool parse_error(std::size_t, const std::string&, const nlohmann::detail::exception& error);

  Certificate finish() {
    try {
      return contents_.finish(keys_);
    } catch (const Fault& fault) {
      throw Certificate_error(0, 0, fault.message);
    }
  }

 private:
  /// Lists in lists, and objects, within an entry: one more than there are in "hidden".
  static constexpr std::size_t deepest = 8;

  bool value(Json scalar);
  bool open(Json empty);
  bool close();
  /// Adds it to what is open; the place where it is then.
  Json* add(Json value);
  void hand_over();
  void keep(const std::string& message) {
    keys_.back().second.emplace(line_, column_, message);
    passing_over_ = true;
  }

  const Text& text_;
  Contents contents_;
  std::vector<std::pair<std::string, std::optional<Certificate_error>>> keys_;
  std::size_t depth_ = 0;              // of what is open
  bool passing_over_ = false;          // what is below the last key
  bool in_list_ = false;               // of entries, below the last key
  std::size_t number_ = 0;             // of the entry
  std::size_t line_ = 0, column_ = 0;  // where it begins, or, of a value that is neither list nor object, ends
  Json entry_;
  std::vector<Json*> open_;  // in the entry
  std::string member_;       // of the innermost object
};

bool Events::key(string_t& name) {
  if (depth_ > 1) {
    member_ = std::move(name);
    return true;
  }
  const std::optional<bool> list = is_list(name);
  const bool twice = std::any_of(keys_.begin(), keys_.end(), [&](const auto& known) { return known.first == name; });
  passing_over_ = !list;
  if (!list) return true;
  keys_.emplace_back(std::move(name), std::nullopt);
  line_ = text_.line(), column_ = text_.column();
  if (twice) throw Certificate_error(line_, column_, keys_.back().first + ": is there twice");
  return true;
}

Json* Events::add(Json value) {
  if (open_.empty()) {
    entry_ = std::move(value);
    return &entry_;
  }
  Json& into = *open_.back();
  if (into.is_array()) return &into.emplace_back(std::move(value));
  return &(into[member_] = std::move(value));
}

bool Events::value(Json scalar) {
  if (depth_ == 0) throw Certificate_error(text_.line(), text_.column(), "top level: expected an object");
  if (passing_over_) return true;
  if (open_.empty()) line_ = text_.line(), column_ = text_.column();
  if (depth_ == 1 && *is_list(keys_.back().first)) keep(keys_.back().first + ": expected an array");
  else {
    add(std::move(scalar));
    if (open_.empty()) hand_over();
  }
  return true;
}

bool Events::open(Json empty) {
  ++depth_;
  if (depth_ == 1) {
    if (!empty.is_object()) throw Certificate_error(text_.line(), text_.column(), "top level: expected an object");
    return true;
  }
  if (passing_over_) return true;
  if (open_.empty()) line_ = text_.line(), column_ = text_.column();
  if (depth_ == 2 && *is_list(keys_.back().first)) {
    if (!empty.is_array()) keep(keys_.back().first + ": expected an array");
    in_list_ = empty.is_array();
    number_ = 0;
  } else if (open_.size() == deepest) {
    keep((in_list_ ? entry_name(keys_.back().first, number_) : keys_.back().first) + ": is nested too deeply");
  } else {
    open_.push_back(add(std::move(empty)));
  }
  return true;
}

bool Events::close() {
  --depth_;
  if (!passing_over_) {
    if (!open_.empty()) {
      open_.pop_back();
      if (open_.empty()) hand_over();
    } else if (in_list_) {
      contents_.end(keys_.back().first);
    }
  }
  if (depth_ <= 1) {
    in_list_ = passing_over_ = false;
    open_.clear();
  }
  return true;
}

void Events::hand_over() {
  try {
    if (in_list_) contents_.take(keys_.back().first, number_++, entry_);
    else contents_.take(keys_.back().first, entry_);
  } catch (const Fault& fault) {
    keep(fault.message);
  }
}

bool Events::parse_error(std::size_t byte, const std::string&, const nlohmann::detail::exception& error) {
  const std::string_view what = error.what();
  if (dynamic_cast<const Json::out_of_range*>(&error) != nullptr)
    throw Certificate_error(text_.line(), text_.column(), printable(what.substr(what.find("] ") + 2), 200, true), true);
  const bool ended = byte > text_.count();
  throw Certificate_error(text_.line(), text_.column() + (ended ? 1 : 0),
                          ended ? "the JSON ends too early" : "from here on it is no JSON", true);
}

}  // namespace
}  // namespace certificate_json

Certificate read_certificate(std::istream& in) {
  certificate_json::Text text(in);
  certificate_json::Events events(text);
  nlohmann::json::sax_parse(certificate_json::Character(text), certificate_json::Character(), &events);
  return events.finish();
}

Order_certificate read_order_certificate(std::istream& in) {
  Certificate certificate = read_certificate(in);
  if (auto* const order = std::get_if<Order_certificate>(&certificate)) return std::move(*order);
  throw Certificate_error(0, 0, "format: expected \"sightline order 2\", or 1");
}

}  // namespace sightline
