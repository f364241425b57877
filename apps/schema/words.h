#pragma once
// JSON Schema in words: what a document is made of.

#include "../support/common.h"

#include <string>
#include <utility>
#include <vector>

namespace sightline::app::schema {

/// Keys with what each holds; one that ends with ? may be missing.
using Members = std::vector<std::pair<std::string, Json>>;

/// What is defined once, and named everywhere.
Json named(const std::string& name);
Json type(const std::string& name);
Json list_of(Json items);
Json tuple_of(Json items, int size);
Json any_of(std::vector<Json> all);
Json one_word_of(const std::vector<std::string>& words);
/// Others may come to be there.
Json object(const Members& members);

Json a_count();
Json a_face();
/// A number that doubles may not hold: null then.
Json a_double();

/// All of the one, then all of the other.
Members with(Members members, const Members& more);

}  // namespace sightline::app::schema
