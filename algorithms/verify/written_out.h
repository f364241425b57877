#pragma once
// How much memory points take that a certificate names by numbers: few numbers must not become much, of points with
// many digits that are named often.

#include <sightline/kernel/scene/polygon_soup.h>

#include <algorithm>
#include <cstddef>

namespace sightline {

class Written_out {
 public:
  static constexpr const char* what_is_too_much =
      "named so often that they take more than 64 times the file, and 256 MiB";

  /// Counts a point once more; false: that is too much for a text of which so many bytes were read.
  bool add(const Exact_point& p, std::size_t read) {
    constexpr std::size_t bytes_of_fraction = 64;  // beside its digits
    for (const Rational& x : p) bytes_ += (bit_length(x.get_num()) + bit_length(x.get_den())) / 8 + bytes_of_fraction;
    return bytes_ <= std::max(std::size_t{1} << 28, 64 * read);
  }

 private:
  std::size_t bytes_ = 0;
};

}  // namespace sightline
