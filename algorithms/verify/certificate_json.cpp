// The text as characters with their places; the events of the parser, put together to entries.

#include <sightline/algorithms/verify/certificate_json.h>

#include <sightline/algorithms/verify/certificate_contents.h>
#include <sightline/kernel/quoted.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstddef>
#include <istream>
#include <iterator>
#include <optional>
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
    ++count_;
    if (++next_ == end_) fill();
  }
  const std::size_t& count() const { return count_; }
  std::size_t line() {
    pass_to_next();
    return line_;
  }
  std::size_t column() {
    pass_to_next();
    return column_;
  }

 private:
  static constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  void fill() {
    pass_to_next();
    in_.read(buffer_.data(), static_cast<std::streamsize>(buffer_.size()));
    next_ = passed_ = 0;
    end_ = static_cast<std::size_t>(in_.gcount());
  }
  /// Counts lines and columns; not at each step, as this is the dearer half of it.
  void pass_to_next() {
    std::size_t count = count_ - (next_ - passed_);
    for (; passed_ < next_; ++passed_) {
      const char c = buffer_[passed_];
      if (before_ == '\n' || (before_ == '\r' && c != '\n')) {
        ++line_;
        column_ = 0;
      }
      if (++count > byte_order_mark.size() || byte_order_mark[count - 1] != c) ++column_;
      before_ = c;
    }
  }

  std::istream& in_;
  std::vector<char> buffer_;
  std::size_t next_ = 0, end_ = 0, count_ = 0, line_ = 1, column_ = 0;
  std::size_t passed_ = 0;  // of the buffer's characters, those that line and column know
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

// ---- The parser's events

/// Puts entries together, one at a time, and hands them over. What is wrong with one is kept, and the rest of its list
/// passed over: the key may mean nothing in a certificate of this kind.
class Events {
 public:
  explicit Events(Text& text) : text_(text), contents_(text.count()) {}
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
  static constexpr std::size_t most_said = 100;  // bytes of a key

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

  Text& text_;
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
  line_ = text_.line();
  column_ = text_.column();
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
  const auto [at, is_new] = into.emplace(member_, std::move(value));
  if (!is_new)
    throw Certificate_error(text_.line(), text_.column(),
                            (in_list_ ? entry_name(keys_.back().first, number_) : keys_.back().first) + ": the key \"" +
                                printable(member_, most_said, true) + "\" is there twice");
  return &*at;
}

bool Events::value(Json scalar) {
  if (depth_ == 0) throw Certificate_error(text_.line(), text_.column(), "top level: expected an object");
  if (passing_over_) return true;
  if (open_.empty()) {
    line_ = text_.line();
    column_ = text_.column();
  }
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
  if (open_.empty()) {
    line_ = text_.line();
    column_ = text_.column();
  }
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
