#include <sightline/io/text.h>

#include <sightline/kernel/quoted.h>

namespace sightline {

bool Text_reader::next_line() {
  if (in_line_) finish_line();
  for (; cursor_ != end_; finish_line()) {
    skip_blanks();
    if (!at_end_of_tokens()) return in_line_ = true;
  }
  return false;
}

std::string_view Text_reader::next_token() {
  skip_blanks();
  if (at_end_of_tokens()) return {token_end_, 0};
  const char* const begin = cursor_;
  while (cursor_ != end_ && !is_blank(*cursor_) && !is_line_end(*cursor_) && !at_continuation()) ++cursor_;
  token_end_ = cursor_;
  return {begin, static_cast<std::size_t>(cursor_ - begin)};
}

std::string_view Text_reader::next_token_of_any_line() {
  if (in_line_)
    if (const std::string_view token = next_token(); !token.empty()) return token;
  return next_line() ? next_token() : std::string_view(end_, 0);
}

void Text_reader::finish_line() {
  while (!next_token().empty()) {
  }
  while (cursor_ != end_ && !is_line_end(*cursor_)) ++cursor_;  // a comment
  skip_line_end();
  in_line_ = false;
}

bool Text_reader::at_continuation() const {
  if (!backslash_ || *cursor_ != '\\') return false;
  const char* p = cursor_ + 1;
  while (p != end_ && is_blank(*p)) ++p;
  return p != end_ && is_line_end(*p);
}

void Text_reader::skip_blanks() {
  for (;;) {
    while (cursor_ != end_ && is_blank(*cursor_)) ++cursor_;
    if (cursor_ == end_ || !at_continuation()) return;
    while (!is_line_end(*cursor_)) ++cursor_;
    skip_line_end();
  }
}

void Text_reader::skip_line_end() {
  if (cursor_ == end_) return;
  const bool carriage_return = *cursor_++ == '\r';
  if (carriage_return && cursor_ != end_ && *cursor_ == '\n') ++cursor_;
}

std::optional<std::int64_t> parse_integer(std::string_view token) {
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

std::size_t read_count(const Text_reader& text, std::string_view token, const std::string& what,
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
