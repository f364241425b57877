#pragma once
// The bytes of a file, and the one way to complain about them.

#include <sightline/kernel/quoted.h>

#include <cstddef>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

namespace sightline {

/// What is wrong with a file, and where. what() is one line: `FILE:LINE:COLUMN: message; what to do` in text,
/// `FILE: byte OFFSET: message; what to do` in binary data, and `FILE: message; what to do` where no place is to blame.
class Input_error : public std::runtime_error {
 public:
  /// Line and column count from 1; a column is a byte of its line (a tab is one, a byte order mark is none).
  static Input_error in_text(const std::string& file, std::size_t line, std::size_t column, const std::string& message);
  static Input_error in_binary(const std::string& file, std::size_t byte, const std::string& message) {
    return {file, 0, 0, byte, ": byte " + std::to_string(byte) + ": " + message};
  }
  static Input_error of_file(const std::string& file, const std::string& message) {
    return {file, 0, 0, std::nullopt, ": " + message};
  }

  std::string file;
  std::size_t line, column;         ///< 0 where the error is not in text
  std::optional<std::size_t> byte;  ///< from 0, where the error is in binary data

 private:
  Input_error(const std::string& file_, std::size_t line_, std::size_t column_, std::optional<std::size_t> byte_,
              const std::string& rest)
      : std::runtime_error(printable(file_, file_.size(), false) + rest),
        file(file_),
        line(line_),
        column(column_),
        byte(byte_) {}
};

inline constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";  // UTF-8

/// A file's name and its bytes, which somebody else keeps alive.
struct Input {
  std::string name;
  std::string_view bytes;

  /// Throws the Input_error of a place in text. A line ends with \n, \r\n or \r.
  /// Pre: place points into bytes or to their end. Cost: one pass over what is before it.
  [[noreturn]] void fail(const char* place, const std::string& message) const;

  /// Throws the Input_error of a place in binary data.
  [[noreturn]] void fail_at_byte(std::size_t offset, const std::string& message) const {
    throw Input_error::in_binary(name, offset, message);
  }
};

}  // namespace sightline
