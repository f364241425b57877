#pragma once
// The command line, over CLI11, which takes seconds to compile: options.cpp alone includes it.

#include <concepts>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
class Option;
class Validator;
}  // namespace CLI

namespace sightline::app {

struct Named_file;

/// What the program's exit code says.
enum class Exit : int {
  done = 0,
  disagreement = 1,  ///< a check failed, or methods disagree
  usage = 2,
  bad_input = 3,
  undecided = 4,  ///< the budget ran out
};

/// A usage error that no check of an option can see: exit code 2.
struct Usage_error : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// What an option asks of each of its values.
struct Check {
  std::shared_ptr<const CLI::Validator> validator;
};
/// Both are asked, and the message names all that is wrong; of an option's checks one after another, the first.
Check operator&(const Check& first, const Check& second);

Check one_of(const std::vector<std::string>& names);
Check range(int least, int most);
Check range(double least, double most);
Check positive();
Check not_negative();
Check folder();  ///< one that is there
Check not_empty();
/// What CLI11's own conversions leave out: they wrap -1 to 2^64 - 1, and let nan through every range.
Check whole_number();
Check finite_number();
/// Holds where `wrong` finds nothing to say of the text.
Check none_of(std::function<std::string(const std::string&)> wrong);

/// An option of a command, as a handle: copies are the same option. Each change returns the option.
class Option {
 public:
  explicit Option(CLI::Option& option) : option_(&option) {}

  Option required() const;
  /// The value is the name of a file to read, which help calls FILE, or to write, which it calls OUTPUT: not empty, and
  /// held to the other files of the command line before the command's action (check_files).
  Option reads_file() const;
  Option writes_file() const;
  Option writes_file(const std::string& wanted) const;  ///< with this ending, or none
  Option check(const Check& check) const;
  Option show_default() const;  ///< in the help: what its variable holds now
  Option delimiter(char between) const;
  Option expected(int least, int most) const;  ///< so many values
  Option needs(const Option& other) const;
  Option excludes(const Option& other) const;
  Option disable_flag_override() const;  ///< of a flag: no --flag=value

  bool given() const;  ///< once the command line is read

 private:
  CLI::Option* option_;
};

/// What the variable of an option may be.
template <class T>
concept Option_value = std::same_as<T, std::string> || std::same_as<T, int> || std::same_as<T, std::uint32_t> ||
    std::same_as<T, std::uint64_t> || std::same_as<T, double>;

/// An option as its help has it.
struct Option_words {
  std::string name;                  ///< with dashes, or an argument's without
  std::string value;                 ///< what help calls its value; empty: a flag
  std::vector<std::string> choices;  ///< of the value, where they are few
  std::string what;
  bool is_file = false;  ///< the value is the name of a file
};

/// A command as its help has it.
struct Command_words {
  std::string name, what, footer;
  std::vector<Option_words> options;  ///< in the order of help
};

/// Whether the command line has --quiet: bars are not shown.
bool is_quiet();

/// A command, or the program whose commands are added, as a handle: copies are the same command.
class Command {
 public:
  explicit Command(CLI::App& app) : app_(&app) {}

  Command add_command(std::string_view name, std::string_view description) const;
  /// A name without dashes is that of an argument. Pre: the variable lives until the action is done.
  template <Option_value T>
  Option add_option(std::string_view name, T& variable, std::string_view description) const;
  template <Option_value T>
  Option add_option(std::string_view name, std::vector<T>& variable, std::string_view description) const;
  Option add_flag(std::string_view name, bool& variable, std::string_view description) const;
  /// A name --flag{value} sets the variable to the value.
  Option add_flag(std::string_view name, std::string& variable, std::string_view description) const;
  void footer(std::string_view text) const;  ///< of its help
  Command_words words() const;
  std::vector<Command_words> commands() const;  ///< of a program, in the order in which they were added
  bool given(std::string_view option) const;    ///< once the command line is read
  bool writes_standard_output() const;          ///< once the command line is read: an output is "-"
  bool reads_standard_input() const;            ///< the same of what is read
  /// Holds outputs that no option names to the files of the command line and to each other, as check_files does. Once
  /// the command line is read. Errors: Usage_error.
  void check_outputs(const std::vector<Named_file>& more) const;

  /// Lets a command do its work after the whole command line is read; what `action` returns becomes the program's exit
  /// code. With --quiet, which it gets, what it prints is dropped, unless an output is "-". Pre: called once for a
  /// command.
  void set_action(std::function<Exit()> action) const;
  /// The same for a command whose answer is what it prints: it gets no --quiet.
  void set_printing_action(std::function<Exit()> action) const;

 private:
  CLI::App* app_;
};

/// A program of commands, of which a command line names one.
class Program {
 public:
  Program(std::string_view name, std::string_view description);
  Program(const Program&) = delete;
  ~Program();

  Command root() const { return Command(*app_); }
  void set_version(std::string_view version);  ///< what --version prints after the name
  /// Reads the command line and does what it asks for. Returns nothing where a command's action was done to its end,
  /// else the exit code: the action's, or that of what was printed, which is help, the version or a usage error.
  /// Throws what the action throws.
  std::optional<Exit> run(int argc, char** argv);

 private:
  std::string name_;
  std::unique_ptr<CLI::App> app_;
};

}  // namespace sightline::app
