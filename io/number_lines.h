#pragma once
// Lists of numbers, one a line: viewpoints, motions, what is likely to be seen.

#include <sightline/io/input.h>
#include <sightline/kernel/number.h>

#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace sightline {

/// Numbers with commas between them, decimals or p/q. Errors: std::invalid_argument, one line that begins with
/// `wanted`. Exact: yes.
std::vector<Rational> numbers_in(std::string_view text, const std::string& wanted);

namespace detail {

/// Whether a first line is one of names, such as X,Y,Z: it begins with a letter, and not with what some programs write
/// for a number.
bool is_header(std::string_view line);

}  // namespace detail

/// Gives the numbers of each line of a text to take(), which returns false where they are not what is wanted. Blanks
/// beside commas are passed over, as are a first line of names, empty lines, and what follows a #. Errors: Input_error
/// at the line, or where a comma is missing. Exact: yes. Cost: one pass.
void read_number_lines(const Input& input, const std::string& wanted,
                       const std::function<bool(const std::vector<Rational>&)>& take);

}  // namespace sightline
