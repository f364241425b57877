// The example of algorithms/solids/README.md, as it stands there.

#include <sightline/algorithms/solids/certificate.h>
#include <sightline/algorithms/solids/measure.h>
#include <sightline/algorithms/solids/set_operation.h>

#include <iostream>

/// Drills through a block, says what is left of it, and has that checked.
void drill(const std::vector<sightline::Polygon_soup>& block_and_drills, std::ostream& out) {
  using namespace sightline;
  const Operands operands(block_and_drills);
  if (!flaws(operands).empty()) throw std::invalid_argument("not all of them are closed");
  Set_options options;
  options.operation = Set_operation::subtract;
  options.keep_fragments = true;
  const Set_result left = set_operation(operands, options);
  std::size_t walls = 0;
  for (const Result_face& face : left.faces) walls += face.operand > 0;
  out << left.soup.face_count() << " faces, " << walls << " of them a drill's, around " << to_string(volume(left.soup));
  const Verdict verdict = verify_solids(block_and_drills, solid_certificate(operands, options, left), &left.soup);
  out << (verdict.accepted ? ": proved\n" : ": wrong\n");
}

#include "shapes.h"

#include <gtest/gtest.h>

#include <sstream>

TEST(Example, a_block_is_drilled) {
  using namespace test_solids;
  std::ostringstream out;
  drill({box({0, 0, 0}, {3, 3, 3}), box({1, 1, -1}, {2, 2, 4}), box({-1, 1, 1}, {4, 2, 2})}, out);
  EXPECT_EQ(out.str(), "20 faces, 14 of them a drill's, around 22: proved\n");
}
