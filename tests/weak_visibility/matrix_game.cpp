// Matrix games: values known by hand, and mixtures that prove them on random ones.

#include <sightline/algorithms/weak_visibility/search/matrix_game.h>

#include <gtest/gtest.h>

#include <random>

namespace {

using sightline::Rational;

template <class Number>
Number solved(sightline::Matrix_game<Number>& game, const std::vector<std::vector<Number>>& rows) {
  game.restart(rows[0].size());
  for (const std::vector<Number>& row : rows) std::copy(row.begin(), row.end(), game.add_row().begin());
  return game.solve();
}
Rational over(long p, unsigned long q) {
  Rational value(p, q);
  value.canonicalize();
  return value;
}

TEST(Matrix_game, has_the_values_of_textbooks) {
  sightline::Matrix_game<Rational> game;
  EXPECT_EQ(solved<Rational>(game, {{over(1, 2), over(-1, 4)}, {over(-1, 2), over(3, 4)}}), over(1, 8));
  EXPECT_EQ(game.column_weights()[0], over(1, 2));
  EXPECT_EQ(game.row_weights()[0], over(5, 8));
  EXPECT_EQ(solved<Rational>(game, {{0, 1, -1}, {-1, 0, 1}, {1, -1, 0}}), 0);  // stone, scissors, paper
  for (const Rational& w : game.column_weights()) EXPECT_EQ(w, over(1, 3));
  EXPECT_EQ(solved<Rational>(game, {{over(-1, 3), over(-1, 2)}}), over(-1, 3));
}

TEST(Matrix_game, of_doubles_agrees_with_that_of_rationals_and_both_prove_their_value) {
  std::mt19937 dice(5);
  for (int round = 0; round < 200; ++round) {
    const std::size_t rows = 1 + dice() % 6, columns = 1 + dice() % 6;
    std::vector<std::vector<Rational>> exact(rows, std::vector<Rational>(columns));
    std::vector<std::vector<double>> near(rows, std::vector<double>(columns));
    for (std::size_t k = 0; k < rows; ++k)
      for (std::size_t c = 0; c < columns; ++c) {
        exact[k][c] = over(static_cast<long>(dice() % 17) - 8, 8);
        near[k][c] = exact[k][c].get_d();
      }
    sightline::Matrix_game<Rational> game;
    sightline::Matrix_game<double> fast;
    const Rational value = solved(game, exact);
    EXPECT_NEAR(solved(fast, near), value.get_d(), 1e-12);
    Rational sum_x, sum_y;
    for (const Rational& x : game.column_weights()) {
      sum_x += x;
      EXPECT_GE(x, 0);
    }
    for (const Rational& y : game.row_weights()) {
      sum_y += y;
      EXPECT_GE(y, 0);
    }
    EXPECT_EQ(sum_x, 1);
    EXPECT_EQ(sum_y, 1);
    for (std::size_t k = 0; k < rows; ++k) {
      Rational sum;
      for (std::size_t c = 0; c < columns; ++c) sum += game.column_weights()[c] * exact[k][c];
      EXPECT_GE(sum, value);
    }
    for (std::size_t c = 0; c < columns; ++c) {
      Rational sum;
      for (std::size_t k = 0; k < rows; ++k) sum += game.row_weights()[k] * exact[k][c];
      EXPECT_LE(sum, value);
    }
    EXPECT_EQ(game.tight_rows().size(), game.tight_columns().size());
  }
}

TEST(Basis, has_its_value_to_hundreds_of_bits_and_exactly_where_that_may_be_zero) {
  // Of {{1, -1}, {-1, 1 + e}} it is e / (4 + e), with weights (2 + e, 2) / (4 + e).
  const auto solved_for = [](const Rational& e, std::vector<Rational>& weights) {
    const Rational a[2][2] = {{1, -1}, {-1, 1 + e}};
    Rational value;
    EXPECT_TRUE(sightline::solve_basis(
        {0, 1}, {0, 1}, [&](std::size_t row, std::size_t column) { return a[row][column]; }, weights, value));
    return value;
  };
  std::vector<Rational> weights;
  for (const unsigned bits : {1u, 100u, 200u, 300u, 1000u})
    for (const long sign : {1, -1}) {
      Rational e(sign);
      mpq_div_2exp(e.get_mpq_t(), e.get_mpq_t(), bits);
      const Rational truth = e / (4 + e), value = solved_for(e, weights), error = abs(Rational(value - truth));
      if (bits > 256) {
        EXPECT_EQ(value, truth) << bits;  // that small it may be zero
      }
      EXPECT_LT(error * (sightline::Integer(1) << 200), Rational(abs(truth))) << bits;
      EXPECT_LT(abs(Rational(weights[0] - (2 + e) / (4 + e))) * (sightline::Integer(1) << 400), 1) << bits;
    }
  EXPECT_EQ(solved_for(0, weights), 0);
  EXPECT_EQ(weights[0], over(1, 2));
  // A weight that is zero stays so, where others are rounded.
  const Rational wide[2][2] = {{over(1, 3), over(1, 3)}, {1, 0}};
  Rational value;
  ASSERT_TRUE(sightline::solve_basis(
      {0, 1}, {0, 1}, [&](std::size_t row, std::size_t column) { return wide[row][column]; }, weights, value));
  EXPECT_EQ(weights[1], 0);
  EXPECT_FALSE(sightline::solve_basis(
      {0, 1}, {0, 1}, [&](std::size_t, std::size_t) { return Rational(1); }, weights, value));
}

}  // namespace
