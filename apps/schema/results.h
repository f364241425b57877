#pragma once
// What --json of each command holds.

#include "words.h"

#include <map>
#include <string>

namespace sightline::app::schema {

/// By command, of all that write JSON: what makes the members of its document, but for the command and its seconds.
/// They are functions, because their words are dear, and every start of the program names the commands.
const std::map<std::string, Members (*)()>& documents();

}  // namespace sightline::app::schema
