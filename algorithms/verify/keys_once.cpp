#include <sightline/algorithms/verify/keys_once.h>

#include <sightline/kernel/quoted.h>

#include <memory>
#include <stdexcept>
#include <string>
#include <unordered_set>
#include <vector>

namespace sightline {

nlohmann::json::parser_callback_t refuse_keys_twice() {
  using Event = nlohmann::json::parse_event_t;
  constexpr std::size_t most_said = 100;  // bytes of a key
  static constexpr int deepest = 200;     // copies and texts of what is deeper take the program's stack
  const auto open = std::make_shared<std::vector<std::unordered_set<std::string>>>();
  return [open](int depth, Event event, nlohmann::json& parsed) {
    if (depth > deepest) throw std::invalid_argument("is nested too deeply");
    if (event == Event::object_start) open->emplace_back();
    if (event == Event::object_end) open->pop_back();
    if (event == Event::key && !open->back().insert(parsed.get_ref<const std::string&>()).second)
      throw std::invalid_argument("the key \"" + printable(parsed.get<std::string>(), most_said, true) +
                                  "\" is there twice");
    return true;
  };
}

}  // namespace sightline
