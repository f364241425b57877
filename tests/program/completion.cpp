// Completion scripts, tried in the shells that are there, and the manual page: held to what --help says.

#include "program.h"

#include <optional>
#include <regex>
#include <set>

namespace program {

class Completion : public Program {
 protected:
  /// The options that the help of a command lists.
  std::set<std::string> options_in_help(const std::string& command) {
    std::set<std::string> options;
    static const std::regex option("(?:^|\n) +(?:-[a-z],)?(--[a-z][a-z-]*)");
    const std::string help = run({command, "--help"}).out;
    for (std::sregex_iterator at(help.begin(), help.end(), option), end; at != end; ++at) options.insert((*at)[1]);
    return options;
  }

  std::set<std::string> commands_in_help() {
    const std::string help = run({"--help"}).out;
    std::set<std::string> names;
    std::istringstream lines(help.substr(help.find("Subcommands:")));
    std::string line;
    std::getline(lines, line);
    static const std::regex command("  ([a-z]+)( .*)?");
    for (std::smatch match; std::getline(lines, line) && line.starts_with("  ");)
      if (std::regex_match(line, match, command)) names.insert(match[1]);
    return names;
  }

  /// What a shell prints; nothing where there is no such shell.
  std::optional<std::string> said_by(const std::string& shell, const std::string& text) {
    if (std::system(("command -v " + shell + " >/dev/null 2>&1").c_str()) != 0) return std::nullopt;
    const std::string script = file("try." + shell, text), said = path("said").string();
    EXPECT_EQ(std::system((shell + " '" + script + "' >'" + said + "' 2>&1").c_str()), 0) << read_file(said);
    return read_file(said);
  }

  /// What bash offers for the last of some words.
  std::set<std::string> offered(const std::vector<std::string>& words) {
    std::string array;
    for (const std::string& word : words) array += " '" + word + "'";
    const std::string script = run({"completion", "bash"}).out + "\ncd '" + path("").string() + "'\nCOMP_WORDS=(" +
                               array + ")\nCOMP_CWORD=" + std::to_string(words.size() - 1) +
                               "\n_sightline\nprintf '%s\\n' \"${COMPREPLY[@]}\"\n";
    const std::optional<std::string> said = said_by("bash", script);
    std::set<std::string> all;
    std::istringstream lines(said.value_or(""));
    for (std::string line; std::getline(lines, line);)
      if (!line.empty()) all.insert(line);
    return all;
  }
};

TEST_F(Completion, of_bash_offers_commands_options_values_and_files) {
  if (!said_by("bash", "")) GTEST_SKIP() << "no bash here";
  const std::set<std::string> names = commands_in_help();
  EXPECT_GT(names.size(), 12u);
  std::set<std::string> at_first = names;
  at_first.insert({"--help", "--version"});
  EXPECT_EQ(offered({"sightline", ""}), at_first);
  EXPECT_EQ(offered({"sightline", "we"}), std::set<std::string>{"weak"});
  for (const std::string command : {"see", "weak", "judge", "boolean", "completion"})
    EXPECT_EQ(offered({"sightline", command, "--"}), options_in_help(command)) << command;
  const std::set<std::string> kernels{"epeck"};
  EXPECT_EQ(offered({"sightline", "see", "a.off", "--kernel", "ep"}), kernels);
  EXPECT_EQ(offered({"sightline", "see", "a.off", "--kernel", "=", "ep"}), kernels);
  EXPECT_EQ(offered({"sightline", "see", "a.off", "--kernel", "="}).size(), 5u);
  EXPECT_TRUE(offered({"sightline", "see", "a.off", "--eye", ""}).empty());
  file("scene one.off", "");
  EXPECT_EQ(offered({"sightline", "see", "sce"}), std::set<std::string>{"scene one.off"});
  EXPECT_EQ(offered({"sightline", "schema", "s"}), (std::set<std::string>{"see", "shadow"}))
      << "no files: it takes none";
  file("out.svg", "");
  EXPECT_EQ(offered({"sightline", "see", "a.off", "--svg", "out."}), std::set<std::string>{"out.svg"});
  EXPECT_EQ(offered({"sightline", "boolean", "uni"}), std::set<std::string>{"union"});
}

TEST_F(Completion, of_other_shells_is_their_syntax_and_has_every_option) {
  for (const std::string shell : {"zsh", "fish"}) {
    const Outcome r = run({"completion", shell});
    ASSERT_EQ(r.code, done) << r;
    for (const std::string& command : commands_in_help()) {
      EXPECT_NE(r.out.find(shell == "zsh" ? "    " + command + ")" : "seen_subcommand_from " + command + "'"),
                std::string::npos)
          << command;
      for (const std::string& option : options_in_help(command))
        EXPECT_NE(r.out.find(shell == "zsh" ? "'" + option : " -l " + option.substr(2)), std::string::npos) << option;
    }
    // Only defined, not called: `complete` and `compdef` are there in shells at a terminal.
    const std::string head = shell == "zsh" ? "compdef() { }\n" : "";
    said_by(shell, head + r.out);
  }
}

TEST_F(Completion, the_manual_page_has_every_option_and_no_flaw_that_groff_sees) {
  const Outcome r = run({"completion", "man"});
  ASSERT_EQ(r.code, done) << r;
  const std::string file_name = file("sightline.1", r.out), said = path("said").string();
  for (const std::string& command : commands_in_help()) {
    const std::size_t section = r.out.find(".SS sightline " + command);
    ASSERT_NE(section, std::string::npos) << command;
    const std::string text = r.out.substr(section, r.out.find(".S", section + 3) - section);
    for (std::string option : options_in_help(command)) {
      for (std::size_t at = 0; (at = option.find('-', at)) != std::string::npos; at += 2) option.insert(at, "\\");
      EXPECT_NE(text.find(".TP\n\\fB" + option + "\\fR"), std::string::npos) << command << ' ' << option;
    }
  }
  if (std::system("command -v groff >/dev/null 2>&1") != 0) return;
  EXPECT_EQ(std::system(("groff -man -ww -z '" + file_name + "' >'" + said + "' 2>&1").c_str()), 0);
  EXPECT_EQ(read_file(said), "");
}

TEST_F(Completion, of_an_unknown_shell_is_a_usage_error) {
  const Outcome r = run({"completion", "csh"});
  EXPECT_EQ(r.code, usage) << r;
  EXPECT_NE(r.err.find("bash"), std::string::npos) << r;
}

}  // namespace program
