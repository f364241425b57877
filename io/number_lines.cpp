#include <sightline/io/number_lines.h>

#include <sightline/io/decimal.h>
#include <sightline/io/text.h>
#include <sightline/kernel/quoted.h>

#include <algorithm>
#include <cstddef>
#include <exception>
#include <stdexcept>
#include <utility>

namespace sightline {

namespace {

/// What is between two commas, in the text that was asked.
struct No_number : std::invalid_argument {
  No_number(const std::string& message, std::string_view token_) : std::invalid_argument(message), token(token_) {}
  std::string_view token;
};

}  // namespace

std::vector<Rational> numbers_in(std::string_view text, const std::string& wanted) {
  std::vector<Rational> numbers;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const std::string_view token = text.substr(begin, end - begin);
    try {
      if (token.find('/') != std::string_view::npos) {
        numbers.push_back(rational_from_string(token));
      } else {
        const Input input{wanted, token};
        const Text_reader reader(input, Text_reader::Comments::hash);
        numbers.push_back(value_of(parse_decimal(reader, input.bytes)));
      }
    } catch (const std::exception& error) {
      const bool is_far = std::string_view(error.what()).find("exponent out of range") != std::string_view::npos;
      throw No_number(wanted + " (decimals or p/q" +
                          (is_far ? ", exponents within +-" + std::to_string(largest_decimal_exponent) : "") + "); " +
                          quoted(token) + " is none",
                      token);
    }
    begin = end + 1;
  }
  return numbers;
}

namespace detail {

bool is_header(std::string_view line) {
  // Names of columns only: a slip of the pen among numbers is none.
  for (std::size_t at = 0; at != std::string_view::npos && at < line.size();) {
    const std::size_t sign = line.find_first_not_of("+-.", at);
    if (sign != std::string_view::npos && line[sign] >= '0' && line[sign] <= '9') return false;
    const std::size_t comma = line.find(',', at);
    at = comma == std::string_view::npos ? comma : comma + 1;
  }
  std::string begin(line.substr(0, 3));
  for (char& c : begin) c = static_cast<char>(c >= 'A' && c <= 'Z' ? c + 32 : c);
  return begin[0] >= 'a' && begin[0] <= 'z' && begin != "nan" && begin != "inf";
}

}  // namespace detail

void read_number_lines(const Input& input, const std::string& wanted,
                       const std::function<bool(const std::vector<Rational>&)>& take) {
  Text_reader reader(input, Text_reader::Comments::hash);
  bool any = false, first = true;
  while (reader.next_line()) {
    const std::string_view begin = reader.next_token();
    std::string line(begin);
    std::string_view apart;  // the first token that no comma joins to what is before it
    for (std::string_view token = reader.next_token(); !token.empty(); token = reader.next_token()) {
      if (apart.empty() && line.back() != ',' && token.front() != ',') apart = token;
      line += token;
    }
    if (std::exchange(first, false) && detail::is_header(line)) continue;
    if (!apart.empty())
      reader.fail(apart, "expected a comma before " + sightline::quoted(apart) + "; a line wants " + wanted);
    std::vector<Rational> numbers;
    try {
      numbers = numbers_in(line, "a line wants " + wanted);
    } catch (const No_number& error) {  // which is in `line`: without blanks that is as long as what it was read from
      const auto at = static_cast<std::size_t>(error.token.data() - line.data());
      reader.fail(line.size() == begin.size() ? begin.substr(at, error.token.size()) : begin, error.what());
    }
    if (!take(numbers)) reader.fail(begin, "expected " + wanted + ", found " + sightline::quoted(line));
    any = true;
  }
  if (!any) throw Input_error::of_file(input.name, "has no line; write " + wanted + " a line");
}

}  // namespace sightline
