// CLI11, compiled once for all commands.

#include "options.h"

#include <CLI/CLI.hpp>

#include <iostream>
#include <utility>

namespace sightline::app {

// ---- Checks

static Check made(CLI::Validator validator) { return {std::make_shared<const CLI::Validator>(std::move(validator))}; }

Check operator&(const Check& first, const Check& second) { return made(*first.validator & *second.validator); }

Check one_of(const std::vector<std::string>& names) { return made(CLI::IsMember(names)); }
Check range(int least, int most) { return made(CLI::Range(least, most)); }
Check range(double least, double most) { return made(CLI::Range(least, most)); }
Check positive() { return made(CLI::PositiveNumber); }
Check not_negative() { return made(CLI::NonNegativeNumber); }
Check folder() { return made(CLI::ExistingDirectory); }
Check not_empty() {
  return made(
      {[](std::string& text) { return text.empty() ? "is empty; leave the option out, or give it a value" : ""; }, ""});
}
Check whole_number() {
  return made({[](std::string& text) {
                 return !text.empty() && text.size() < 20 && text.find_first_not_of("0123456789") == std::string::npos
                            ? ""
                            : '"' + text + "\" is not a whole number below 10^19";
               },
               ""});
}
Check finite_number() {
  return made({[](std::string& text) {
                 return text.find_first_of("nN") == std::string::npos ? "" : '"' + text + "\" is not a finite number";
               },
               ""});
}

// ---- Options

Option Option::required() const { return Option(*option_->required()); }
Option Option::check(const Check& check) const { return Option(*option_->check(*check.validator)); }
Option Option::show_default() const { return Option(*option_->capture_default_str()); }
Option Option::delimiter(char between) const { return Option(*option_->delimiter(between)); }
Option Option::expected(int least, int most) const { return Option(*option_->expected(least, most)); }
Option Option::needs(const Option& other) const { return Option(*option_->needs(other.option_)); }
Option Option::excludes(const Option& other) const { return Option(*option_->excludes(other.option_)); }
Option Option::disable_flag_override() const { return Option(*option_->disable_flag_override()); }
bool Option::given() const { return option_->count() > 0; }

// ---- Commands

Command Command::add_command(std::string_view name, std::string_view description) const {
  return Command(*app_->add_subcommand(std::string(name), std::string(description)));
}

template <Option_value T>
Option Command::add_option(std::string_view name, T& variable, std::string_view description) const {
  return Option(*app_->add_option(std::string(name), variable, std::string(description)));
}
template <Option_value T>
Option Command::add_option(std::string_view name, std::vector<T>& variable, std::string_view description) const {
  return Option(*app_->add_option(std::string(name), variable, std::string(description)));
}
template Option Command::add_option(std::string_view, std::string&, std::string_view) const;
template Option Command::add_option(std::string_view, int&, std::string_view) const;
template Option Command::add_option(std::string_view, std::uint32_t&, std::string_view) const;
template Option Command::add_option(std::string_view, std::uint64_t&, std::string_view) const;
template Option Command::add_option(std::string_view, double&, std::string_view) const;
template Option Command::add_option(std::string_view, std::vector<std::string>&, std::string_view) const;
template Option Command::add_option(std::string_view, std::vector<int>&, std::string_view) const;
template Option Command::add_option(std::string_view, std::vector<std::uint32_t>&, std::string_view) const;
template Option Command::add_option(std::string_view, std::vector<std::uint64_t>&, std::string_view) const;

Option Command::add_flag(std::string_view name, bool& variable, std::string_view description) const {
  return Option(*app_->add_flag(std::string(name), variable, std::string(description)));
}
Option Command::add_flag(std::string_view name, std::string& variable, std::string_view description) const {
  return Option(*app_->add_flag(std::string(name), variable, std::string(description)));
}
void Command::footer(std::string_view text) const { app_->footer(std::string(text)); }

void Command::set_action(std::function<Exit()> action) const {
  app_->callback([action = std::move(action)] {
    if (const Exit exit = action(); exit != Exit::done) throw CLI::RuntimeError(static_cast<int>(exit));
  });
}

// ---- The program

Program::Program(std::string_view name, std::string_view description)
    : name_(name), app_(std::make_unique<CLI::App>(std::string(description), name_)) {
  app_->require_subcommand(1);
  app_->failure_message(
      [this](const CLI::App* at, const CLI::Error& error) {  // one line, with the word that is no command
        return name_ + ": " + error.what() +
               (at->remaining().empty() ? "" : " ('" + at->remaining().front() + "' is none)") + "; --help says more\n";
      });
}
Program::~Program() = default;

void Program::set_version(std::string_view version) {
  app_->set_version_flag("--version", name_ + ' ' + std::string(version));
}

std::optional<Exit> Program::run(int argc, char** argv) {
  try {
    app_->parse(argc, argv);
  } catch (const CLI::RuntimeError& result) {  // an action's answer
    return static_cast<Exit>(result.get_exit_code());
  } catch (const CLI::ParseError& message) {  // also --help and --version, which are no errors
    return app_->exit(message, std::cout, std::cerr) == 0 ? Exit::done : Exit::usage;
  }
  return std::nullopt;
}

}  // namespace sightline::app
