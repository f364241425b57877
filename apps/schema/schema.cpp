// sightline schema: what --json writes, as JSON Schema.

#include "results.h"

#include <iostream>

namespace sightline::app {

namespace schema {

Json definitions() {
  const Json count = a_count(), face = a_face();
  return {{"exact", {{"type", "string"}, {"pattern", "^-?[0-9]+(/[0-9]+)?$"}, {"description", "p or p/q, reduced"}}},
          {"point", tuple_of(named("exact"), 3)},
          {"faces", list_of(face)},
          {"piece",
           {{"type", "array"},
            {"items", count},
            {"minItems", 2},
            {"maxItems", 2},
            {"description", "[face, which of its convex pieces]"}}},
          {"scene", object({{"file", type("string")},
                            {"faces_read", count},
                            {"faces", count},
                            {"set_aside", list_of(object({{"face", face}, {"why", type("string")}}))},
                            {"bits", count},
                            {"arithmetic", type("string")},
                            {"grid_bits", count},
                            {"pieces", count},
                            {"flipped?", type("boolean")}})},
          {"operands",
           object({{"operands", list_of(object({{"file", type("string")}, {"faces_read", count}}))},
                   {"set_aside", list_of(object({{"operand", count}, {"face", face}, {"why", type("string")}}))},
                   {"non_planar", list_of(tuple_of(count, 2))},
                   {"grid_bits", count},
                   {"arithmetic", type("string")}})},
          {"rounding", object({{"moved", count},
                               {"farthest", a_double()},
                               {"not_planar", list_of(face)},
                               {"turned", list_of(face)},
                               {"collapsed", list_of(face)},
                               {"crossing", list_of(tuple_of(face, 2))},
                               {"misplaced", list_of(face)},
                               {"rounds", count},
                               {"vanished", list_of(named("point"))},
                               {"added", list_of(named("point"))},
                               {"coarser", count},
                               {"sound", type("boolean")}})},
          {"hit", object({{"face", face},
                          {"side", one_word_of({"front", "back", "along"})},
                          {"t", named("exact")},
                          {"until?", named("exact")},
                          {"point", named("point")},
                          {"faces?", named("faces")}})}};
}

Exit run(const std::string& command) {
  Json schema{{"$schema", "https://json-schema.org/draft/2020-12/schema"},
              {"title", "sightline " + command + " --json"},
              {"$defs", definitions()}};
  const Members members = documents().at(command)();
  schema.update(
      object(with(members, {{"command", Json{{"const", command}}},
                            {"seconds", Json{{"type", "object"}, {"additionalProperties", type("number")}}}})));
  std::cout << to_text(schema, 1) << '\n';
  return Exit::done;
}

}  // namespace schema

void add_schema(Command program) {
  const Command command = program.add_command("schema", "What --json of a command writes, as JSON Schema");
  auto name = std::make_shared<std::string>();
  std::vector<std::string> commands;
  for (const auto& [of, members] : schema::documents()) commands.push_back(of);
  command.add_option("COMMAND", *name, "the command").required().check(one_of(commands));
  command.footer(
      "Keys may be added in later versions; these stay.\n"
      "Example: sightline schema see > see.schema.json");
  command.set_printing_action([name] { return schema::run(*name); });
}

}  // namespace sightline::app
