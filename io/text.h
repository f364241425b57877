#pragma once
// Lines and tokens: what all text formats share.

#include <sightline/io/input.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

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

  explicit Text_reader(Input&&, Comments, Continuation = Continuation::none) = delete;
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
  bool next_line();

  /// The next token of the line; at its end an empty one, which points behind the last.
  std::string_view next_token();

  /// The next token of this or of a later line; an empty one at the end of the text.
  std::string_view next_token_of_any_line();

  /// Leaves the line behind, with its end.
  void finish_line();

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
  bool at_continuation() const;

  void skip_blanks();

  void skip_line_end();

  const Input& input_;
  const char* cursor_;
  const char* end_;
  const char* token_end_;  // of the token given out last
  bool hash_, backslash_;
  bool in_line_ = false;
};

/// The integer that a token is, |n| held at 10^18 where it is larger; nothing if the token is no integer ([+-] and
/// digits).
std::optional<std::int64_t> parse_integer(std::string_view token);

/// Reads a count of `what` (vertices, faces) that the text announces.
/// Throws where it is no count, or where that many, each at least `least_bytes` long, cannot be in the rest of the
/// text. So a reader may reserve memory for it.
std::size_t read_count(const Text_reader& text, std::string_view token, const std::string& what,
                       std::size_t least_bytes);

}  // namespace sightline
