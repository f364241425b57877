#include <sightline/algorithms/verify/keys_once.h>

#include <sightline/kernel/quoted.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace sightline {

namespace {

using Tree = nlohmann::json;

class Tree_builder final : public nlohmann::json_sax<Tree> {
 public:
  bool null() override { return put({}); }
  bool boolean(bool value) override { return put(value); }
  bool number_integer(number_integer_t value) override { return put(value); }
  bool number_unsigned(number_unsigned_t value) override { return put(value); }
  bool number_float(number_float_t value, const string_t&) override { return put(value); }
  bool string(string_t& value) override { return put(std::move(value)); }
  bool binary(binary_t& value) override { return put(std::move(value)); }
  bool start_object(std::size_t) override { return open(Tree::object()); }
  bool start_array(std::size_t) override { return open(Tree::array()); }
  bool end_object() override { return close(); }
  bool end_array() override { return close(); }
  bool key(string_t& name) override {
    constexpr std::size_t most_said = 100;  // bytes of a key
    const auto [member, is_new] = open_.back()->get_ref<Tree::object_t&>().try_emplace(name);
    if (!is_new) throw std::invalid_argument("the key \"" + printable(name, most_said, true) + "\" is there twice");
    next_ = &member->second;
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Tree::exception& error) override {
    if (const auto* const syntax = dynamic_cast<const Tree::parse_error*>(&error)) throw *syntax;
    throw dynamic_cast<const Tree::out_of_range&>(error);
  }

  Tree root;

 private:
  static constexpr std::size_t deepest = 200;  // copies and texts of what is deeper take the program's stack

  /// Into the list that is open, or to the key that was read last.
  Tree& added(Tree value) {
    if (open_.empty() || open_.back()->is_object()) return *next_ = std::move(value);
    return open_.back()->get_ref<Tree::array_t&>().emplace_back(std::move(value));
  }
  bool put(Tree value) {
    added(std::move(value));
    return true;
  }
  bool open(Tree empty) {
    if (open_.size() == deepest) throw std::invalid_argument("is nested too deeply");
    open_.push_back(&added(std::move(empty)));
    return true;
  }
  bool close() {
    open_.pop_back();
    return true;
  }

  std::vector<Tree*> open_;  // a list grows only while nothing in it is open
  Tree* next_ = &root;
};

}  // namespace

Tree json_with_keys_once(std::string_view text) {
  Tree_builder builder;
  Tree::sax_parse(text.begin(), text.end(), &builder);
  return std::move(builder.root);
}

}  // namespace sightline
