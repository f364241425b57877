// CLI11, compiled once for all commands.

#include "options.h"

#include "files.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iostream>
#include <optional>
#include <sstream>
#include <streambuf>
#include <utility>

namespace sightline::app {

// ---- Checks

static Check made(CLI::Validator validator) { return {std::make_shared<const CLI::Validator>(std::move(validator))}; }

Check operator&(const Check& first, const Check& second) { return made(*first.validator & *second.validator); }

Check one_of(const std::vector<std::string>& names) { return made(CLI::IsMember(names)); }
template <class Number>
static Check range_of(Number least, Number most, const std::string& type, const std::string& wanted) {
  return made({[least, most, wanted](std::string& text) {
                 Number value = 0;
                 const bool good = CLI::detail::lexical_cast(text, value) && value >= least && value <= most;  // no NaN
                 return good ? "" : fmt::format("\"{}\" is not {} from {} to {}", text, wanted, least, most);
               },
               fmt::format("{} in [{} - {}]", type, least, most)});
}
Check range(int least, int most) { return range_of(least, most, "INT", "a whole number"); }
Check range(double least, double most) { return range_of(least, most, "FLOAT", "a number"); }
/// A check of a number, which help calls by a name.
static Check of_number(const std::string& name, const std::string& wanted, bool (*holds)(double)) {
  return made({[wanted, holds](std::string& text) {
                 double value = 0;
                 const bool good = CLI::detail::lexical_cast(text, value) &&
                                   (std::isnan(value) || (std::isfinite(value) && holds(value)));
                 return good ? "" : '"' + text + "\" is not " + wanted;
               },
               name});
}
Check positive() {
  return of_number("POSITIVE", "a number > 0", [](double x) { return x > 0; });
}
Check not_negative() {
  return of_number("NONNEGATIVE", "a number >= 0", [](double x) { return x >= 0; });
}
Check folder() { return made(CLI::ExistingDirectory); }
Check not_empty() {
  return made(
      {[](std::string& text) { return text.empty() ? "is empty; leave the option out, or give it a value" : ""; }, ""});
}
/// Of a file to write: its name has this ending, or none.
static Check ending(const std::string& wanted) {
  return made({[wanted](std::string& text) {
                 const std::string found = std::filesystem::path(text).extension().string();
                 return found.empty() || CLI::detail::to_lower(found) == wanted
                            ? ""
                            : '"' + text + "\" does not end with " + wanted + ", which is what it would hold";
               },
               ""});
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

Check none_of(std::function<std::string(const std::string&)> wrong) {
  return made({[wrong = std::move(wrong)](std::string& text) { return wrong(text); }, ""});
}

// ---- Options

Option Option::required() const { return Option(*option_->required()); }
/// What help calls the value of an option that names a file, and what such options are known by.
static constexpr const char *input_file = "FILE", *output_file = "OUTPUT";

Option Option::reads_file() const { return Option(*option_->type_name(input_file)).check(not_empty()); }
Option Option::writes_file() const { return Option(*option_->type_name(output_file)).check(not_empty()); }
Option Option::writes_file(const std::string& wanted) const { return writes_file().check(ending(wanted)); }
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

/// An option whose value, if it is a whole number, is a decimal one: what begins with 0 would be read as octal.
template <class T>
static Option with_numbers(CLI::Option& option) {
  if constexpr (std::is_integral_v<T>)
    option.check(CLI::Validator(
        [](std::string& text) {
          const std::size_t first = text.find_first_not_of("+-");
          const bool is_octal = first != std::string::npos && text[first] == '0' && first + 1 < text.size();
          return is_octal ? '"' + text + "\" begins with 0; write it without" : "";
        },
        ""));
  return Option(option);
}

template <Option_value T>
Option Command::add_option(std::string_view name, T& variable, std::string_view description) const {
  return with_numbers<T>(*app_->add_option(std::string(name), variable, std::string(description)));
}
template <Option_value T>
Option Command::add_option(std::string_view name, std::vector<T>& variable, std::string_view description) const {
  return with_numbers<T>(*app_->add_option(std::string(name), variable, std::string(description)));
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

/// The words between the braces of "TEXT:{exact,double}".
static std::vector<std::string> choices_of(const std::string& type) {
  std::vector<std::string> choices;
  const std::size_t begin = type.find('{'), end = type.find('}');
  if (begin == std::string::npos || end == std::string::npos) return choices;
  std::istringstream words(type.substr(begin + 1, end - begin - 1));
  for (std::string word; std::getline(words, word, ',');) choices.push_back(word);
  return choices;
}

Command_words Command::words() const {
  Command_words words{app_->get_name(), app_->get_description(), app_->get_footer(), {}};
  for (const CLI::Option* option : app_->get_options()) {
    const std::string type = option->get_items_expected_max() == 0 ? "" : option->get_type_name();
    words.options.push_back({option->get_name(), type, choices_of(type), option->get_description(),
                             type == input_file || type == output_file});
  }
  return words;
}

std::vector<Command_words> Command::commands() const {
  std::vector<Command_words> all;
  for (const CLI::App* app : app_->get_subcommands({})) {
    CLI::App* const own = app_->get_subcommand(app->get_name());
    all.push_back(Command(*own).words());
  }
  return all;
}

/// The files that a command line names by options of one kind.
static std::vector<Named_file> files_of(const CLI::App& app, std::string_view kind) {
  std::vector<Named_file> files;
  for (const CLI::Option* option : app.get_options())
    if (option->get_type_name() == kind)
      for (const std::string& name : option->results()) files.push_back({option->get_name(), name});
  return files;
}
/// Whether one of them is standard input or output.
static bool have_standard(const std::vector<Named_file>& files) {
  return std::any_of(files.begin(), files.end(), [](const Named_file& file) { return file.name == "-"; });
}
bool Command::given(std::string_view option) const { return app_->count(std::string(option)) > 0; }
bool Command::writes_standard_output() const { return have_standard(files_of(*app_, output_file)); }
bool Command::reads_standard_input() const { return have_standard(files_of(*app_, input_file)); }

void Command::check_outputs(const std::vector<Named_file>& more) const {
  check_files(files_of(*app_, input_file), files_of(*app_, output_file), more);
}

static bool quiet = false;
bool is_quiet() { return quiet; }

/// While it is there, what is written to std::cout goes nowhere.
class Silence {
 public:
  Silence() : before_(std::cout.rdbuf(&nowhere_)) {}
  ~Silence() { std::cout.rdbuf(before_); }
  Silence(const Silence&) = delete;
  Silence& operator=(const Silence&) = delete;

 private:
  struct Nowhere : std::streambuf {
    int overflow(int c) override { return traits_type::not_eof(c); }
    std::streamsize xsputn(const char*, std::streamsize count) override { return count; }
  };
  Nowhere nowhere_;
  std::streambuf* before_;
};

void Command::set_action(std::function<Exit()> action) const {
  app_->add_flag("--quiet", quiet, "print nothing but what goes wrong; files and exit codes are as ever");
  set_printing_action([command = *this, action = std::move(action)] {
    std::optional<Silence> silence;
    if (quiet && !command.writes_standard_output()) silence.emplace();
    return action();
  });
}

void Command::set_printing_action(std::function<Exit()> action) const {
  app_->callback([app = app_, action = std::move(action)] {
    const std::vector<Named_file> outputs = files_of(*app, output_file);
    check_files(files_of(*app, input_file), outputs);
    std::vector<std::string> named;  // one of them may be a folder that the command makes
    for (const CLI::Option* option : app->get_options())
      named.insert(named.end(), option->results().begin(), option->results().end());
    check_folders(outputs, named);
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
