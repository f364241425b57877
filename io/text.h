#pragma once
// Lines and tokens: what all text formats share.

#include <sightline/io/input.h>

#include <cstdint>

namespace sightline {

/// Cuts text into lines of tokens. Blanks are space, tab, vertical tab and form feed; a line ends with \n, \r\n or \r
/// (mixed as you like); a byte order mark at the beginning is passed over. A token that begins with '#' is a comment up
/// to the end of the line where the format has comments ("1.#INF" is a token, not a 1). Cost: one pass, no copies;
/// views point into the input.
class Text_reader {
 public:
  enum class Comments : bool { none, hash };
  enum class Continuation : bool {
    none,
    backslash
  };  ///< a backslash at the end of a line joins the next line to it, as a blank would

  explicit Text_reader(const Input& input, Comments comments, Continuation continuation = Continuation::none)
      : input_(input),
        cursor_(input.bytes.data()),
        end_(cursor_ + input.bytes.size()),
        token_end_(cursor_),
        hash_(comments == Comments::hash),
        backslash_(continuation == Continuation::backslash) {
    if (input.bytes.starts_with(byte_order_mark)) cursor_ += byte_order_mark.size();
  }

  /// Goes to the next line that holds a token; false at the end of the text.
  bool next_line() {
    if (in_line_) finish_line();
    for (; cursor_ != end_; finish_line()) {
      skip_blanks();
      if (!at_end_of_tokens()) return in_line_ = true;
    }
    return false;
  }

  /// The next token of the line; at its end an empty one, which points behind the last.
  std::string_view next_token() {
    skip_blanks();
    if (at_end_of_tokens()) return {token_end_, 0};
    const char* const begin = cursor_;
    while (cursor_ != end_ && !is_blank(*cursor_) && !is_line_end(*cursor_) && !at_continuation()) ++cursor_;
    token_end_ = cursor_;
    return {begin, static_cast<std::size_t>(cursor_ - begin)};
  }

  /// The next token of this or of a later line; an empty one at the end of the text.
  std::string_view next_token_of_any_line() {
    if (in_line_)
      if (const std::string_view token = next_token(); !token.empty()) return token;
    return next_line() ? next_token() : std::string_view(end_, 0);
  }

  /// Leaves the line behind, with its end.
  void finish_line() {
    while (!next_token().empty()) {
    }
    while (cursor_ != end_ && !is_line_end(*cursor_)) ++cursor_;  // a comment
    skip_line_end();
    in_line_ = false;
  }

  /// How many bytes have not been looked at.
  std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - cursor_); }
  const char* cursor() const { return cursor_; }

  [[noreturn]] void fail(std::string_view token, const std::string& message) const {
    input_.fail(token.data(), message);
  }
  [[noreturn]] void fail_at_end(const std::string& message) const { input_.fail(end_, message); }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  static bool is_line_end(char c) { return c == '\n' || c == '\r'; }

  bool at_end_of_tokens() const { return cursor_ == end_ || is_line_end(*cursor_) || (hash_ && *cursor_ == '#'); }

  /// Whether the cursor is at a backslash with nothing but blanks between it and a line end.
  bool at_continuation() const {
    if (!backslash_ || *cursor_ != '\\') return false;
    const char* p = cursor_ + 1;
    while (p != end_ && is_blank(*p)) ++p;
    return p != end_ && is_line_end(*p);
  }

  void skip_blanks() {
    for (;;) {
      while (cursor_ != end_ && is_blank(*cursor_)) ++cursor_;
      if (cursor_ == end_ || !at_continuation()) return;
      while (!is_line_end(*cursor_)) ++cursor_;
      skip_line_end();
    }
  }

  void skip_line_end() {
    if (cursor_ == end_) return;
    const bool carriage_return = *cursor_++ == '\r';
    if (carriage_return && cursor_ != end_ && *cursor_ == '\n') ++cursor_;
  }

  const Input& input_;
  const char* cursor_;
  const char* end_;
  const char* token_end_;  // of the token given out last
  bool hash_, backslash_;
  bool in_line_ = false;
};

/// The integer that a token is, |n| held at 10^18 where it is larger; nothing if the token is no integer ([+-] and
/// digits).
inline std::optional<std::int64_t> parse_integer(std::string_view token) {
  constexpr std::int64_t most = 1'000'000'000'000'000'000;
  const bool negative = token.starts_with('-');
  if (negative || token.starts_with('+')) token.remove_prefix(1);
  if (token.empty()) return std::nullopt;
  std::int64_t value = 0;
  for (const char c : token) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value < most / 10 ? 10 * value + (c - '0') : most;
  }
  return negative ? -value : value;
}

/// Reads a count of `what` (vertices, faces) that the text announces.
/// Throws where it is no count, or where that many, each at least `least_bytes` long, cannot be in the rest of the
/// text. So a reader may reserve memory for it.
inline std::size_t read_count(const Text_reader& text, std::string_view token, const std::string& what,
                              std::size_t least_bytes) {
  const std::optional<std::int64_t> count = parse_integer(token);
  if (!count || *count < 0)
    text.fail(token, (token.empty() ? "the number of " + what + " is missing"
                                    : quoted(token) + " is not a number of " + what) +
                         "; write a count such as 8");
  const std::size_t announced = static_cast<std::size_t>(*count);
  if (announced > text.bytes_left() / least_bytes)  // the last line may lack its end, but this one has one
    text.fail(token, std::to_string(announced) + " " + what + " are announced, but only " +
                         std::to_string(text.bytes_left()) +
                         " bytes follow; correct the count, or fetch the file again if it is cut off");
  return announced;
}

}  // namespace sightline
