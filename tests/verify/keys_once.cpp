// JSON as checkers read it: what other readers take differently is refused, and lists of objects take no square.

#include <sightline/algorithms/verify/keys_once.h>
#include <sightline/kernel/time_limit.h>

#include <gtest/gtest.h>

#include <cstddef>
#include <stdexcept>
#include <string>

namespace sightline {
namespace {

using Json = nlohmann::json;

TEST(Keys_once, is_what_any_reader_of_json_says) {
  for (const char* text :
       {"null", " true ", "-3", "18446744073709551615", "18446744073709551616", "1.5e3", "\"a\\u00e9\"", "[]", "{}",
        "[1,[2,{\"a\":[{}]},3],{}]", R"({"a":{"b":1,"c":[{"b":2},{"b":3}]},"":null})"})
    EXPECT_EQ(json_with_keys_once(text), Json::parse(text)) << text;
  for (const std::string text :
       {"", "[1", "{\"a\":}", "[1] 2", "[1,]", "{\"a\" 1}", "\x7f", "\"\xff\"", "1e999", "nan"}) {
    std::string expected, found;
    try {
      ADD_FAILURE() << Json::parse(text);
    } catch (const Json::exception& error) {
      expected = error.what();
    }
    try {
      json_with_keys_once(text);
    } catch (const Json::exception& error) {
      found = error.what();
    }
    EXPECT_FALSE(expected.empty());
    EXPECT_EQ(found, expected);
  }
}

TEST(Keys_once, refuses_a_key_that_is_there_twice_and_what_is_too_deep) {
  for (const char* text : {R"({"a": 1, "a": 1})", R"([{"b": {"a": [], "c": 0, "a": []}}])", R"({"a": 1, "\u0061": 2})"})
    EXPECT_THROW(json_with_keys_once(text), std::invalid_argument) << text;
  const auto deep = [](std::size_t lists) { return std::string(lists, '[') + std::string(lists, ']'); };
  EXPECT_NO_THROW(json_with_keys_once(deep(200)));
  EXPECT_THROW(json_with_keys_once(deep(201)), std::invalid_argument);
  EXPECT_THROW(json_with_keys_once(std::string(1'000'000, '[')), std::invalid_argument);
}

TEST(Keys_once, reads_lists_of_objects_in_time_in_proportion) {
  const auto seconds_of = [](std::size_t objects) {
    std::string text = "[{}";
    for (std::size_t k = 1; k < objects; ++k) text += ",{}";
    const double start = processor_seconds();
    EXPECT_EQ(json_with_keys_once(text + ']').size(), objects);
    return processor_seconds() - start;
  };
  // Eight times as many: the square of it would take 64 times as long.
  EXPECT_LT(seconds_of(80000), 32 * seconds_of(10000) + 0.1);
}

}  // namespace
}  // namespace sightline
