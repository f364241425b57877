// sightline completion: scripts that complete command lines, and the manual page, from the options as --help has them.

#include "support/common.h"

#include <iostream>

namespace sightline::app {

namespace {

/// Text with each of some characters behind a backslash.
std::string with_backslashes(const std::string& text, std::string_view special) {
  std::string all;
  for (const char c : text) {
    if (special.find(c) != std::string_view::npos) all += '\\';
    all += c == '\n' ? ' ' : c;
  }
  return all;
}
/// Text within single quotes of a shell.
std::string inside_quotes(const std::string& text) {
  std::string inside;
  for (const char c : text) inside += c == '\'' ? std::string("'\\''") : std::string(1, c == '\n' ? ' ' : c);
  return inside;
}
bool is_dashed(const Option_words& option) { return option.name.starts_with("-"); }

template <class List>
std::string joined(const List& list, const std::string& between) {
  std::string text;
  for (const auto& word : list) text += (text.empty() ? "" : between) + std::string(word);
  return text;
}

// ---- bash

std::string bash_script(const std::vector<Command_words>& commands) {
  std::string names, values, words;
  for (const Command_words& command : commands) {
    names += command.name + ' ';
    std::vector<std::string> options, files, others, choices;
    bool takes_files = false;
    for (const Option_words& option : command.options) {
      const std::string pattern = '"' + command.name + ' ' + option.name + '"';
      if (!is_dashed(option)) {
        choices.insert(choices.end(), option.choices.begin(), option.choices.end());
        takes_files |= option.choices.empty();
        continue;
      }
      options.push_back(option.name);
      if (option.value.empty()) continue;
      if (!option.choices.empty())
        values += fmt::format("    {}) mapfile -t COMPREPLY < <(compgen -W '{}' -- \"$current\"); return ;;\n", pattern,
                              joined(option.choices, " "));
      else (option.is_file ? files : others).push_back(pattern);
    }
    if (!files.empty())
      values += fmt::format("    {}) mapfile -t COMPREPLY < <(compgen -f -- \"$current\"); return ;;\n",
                            joined(files, " | "));
    if (!others.empty()) values += fmt::format("    {}) return ;;\n", joined(others, " | "));
    words += fmt::format("    {}) options='{}' choices='{}' files={} ;;\n", command.name, joined(options, " "),
                         joined(choices, " "), takes_files ? "-f" : "");
  }
  return "# bash completion for sightline: source it, or put it where bash-completion looks.\n"
         "_sightline() {\n"
         "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]} command= options= choices= "
         "files= i\n"
         "  COMPREPLY=()\n"
         "  if [[ $current == '=' ]]; then current=\n"
         "  elif [[ $previous == '=' ]]; then previous=${COMP_WORDS[COMP_CWORD - 2]}; fi\n"
         "  for ((i = 1; i < COMP_CWORD; ++i)); do\n"
         "    if [[ ${COMP_WORDS[i]} != -* ]]; then command=${COMP_WORDS[i]}; break; fi\n"
         "  done\n"
         "  case \"$command $previous\" in\n" +
         values +
         "  esac\n"
         "  case $command in\n"
         "    '') COMPREPLY=($(compgen -W '" +
         names + "--help --version' -- \"$current\")); return ;;\n" + words +
         "  esac\n"
         "  if [[ $current == -* ]]; then mapfile -t COMPREPLY < <(compgen -W \"$options\" -- \"$current\")\n"
         "  else mapfile -t COMPREPLY < <(compgen $files -W \"$choices\" -- \"$current\"); fi\n"
         "}\n"
         "complete -o filenames -F _sightline sightline\n";
}

// ---- zsh

std::string zsh_script(const std::vector<Command_words>& commands) {
  std::string names, cases;
  for (const Command_words& command : commands) {
    names += fmt::format("    '{}:{}'\n", command.name, inside_quotes(with_backslashes(command.what, ":\\")));
    cases += fmt::format("    {}) _arguments \\\n", command.name);
    for (const Option_words& option : command.options) {
      if (!is_dashed(option)) continue;
      const std::string what = inside_quotes(with_backslashes(option.what, "[]:\\"));
      const std::string action = !option.choices.empty() ? '(' + joined(option.choices, " ") + ')'
                                 : option.is_file        ? "_files"
                                                         : " ";
      cases += option.value.empty() ? fmt::format("      '{}[{}]' \\\n", option.name, what)
                                    : fmt::format("      '{}=[{}]:{}:{}' \\\n", option.name, what,
                                                  option.is_file ? "file" : "value", action);
    }
    std::vector<std::string> choices;
    for (const Option_words& option : command.options)
      if (!is_dashed(option)) choices.insert(choices.end(), option.choices.begin(), option.choices.end());
    if (!choices.empty()) cases += fmt::format("      '1:word:({})' \\\n", joined(choices, " "));
    cases += "      '*:file:_files' ;;\n";
  }
  return "#compdef sightline\n"
         "_sightline() {\n"
         "  local -a commands\n"
         "  commands=(\n" +
         names +
         "  )\n"
         "  if ((CURRENT == 2)); then _describe command commands; return; fi\n"
         "  local command=$words[2]\n"
         "  shift words\n"
         "  ((CURRENT--))\n"
         "  case $command in\n" +
         cases +
         "  esac\n"
         "}\n"
         "compdef _sightline sightline\n";
}

// ---- fish

std::string fish_script(const std::vector<Command_words>& commands) {
  const auto quoted = [](const std::string& text) { return '\'' + with_backslashes(text, "'\\") + '\''; };
  std::string script =
      "complete -c sightline -n __fish_use_subcommand -l help -d 'Print help'\n"
      "complete -c sightline -n __fish_use_subcommand -l version -d 'Print the version'\n";
  for (const Command_words& command : commands) {
    script += fmt::format("complete -c sightline -n __fish_use_subcommand -f -a {} -d {}\n", command.name,
                          quoted(command.what));
    const std::string of = fmt::format("complete -c sightline -n '__fish_seen_subcommand_from {}'", command.name);
    for (const Option_words& option : command.options) {
      const std::string choices = option.choices.empty() ? "" : " -a " + quoted(joined(option.choices, " "));
      if (!is_dashed(option)) {
        if (!choices.empty()) script += of + choices + '\n';
        continue;
      }
      script += of + (option.name.starts_with("--") ? " -l " + option.name.substr(2) : " -s " + option.name.substr(1)) +
                (option.value.empty() ? ""
                 : option.is_file     ? " -r -F"
                                      : " -x") +
                choices + " -d " + quoted(option.what) + '\n';
    }
  }
  return script;
}

// ---- The manual page

/// Text as roff prints it, line by line, without the end of the last.
std::string roff(const std::string& text) {
  std::string lines;
  bool begins = true;
  for (const char c : text) {
    if (begins && (c == '.' || c == '\'')) lines += "\\&";
    begins = c == '\n';
    if (c == '\\') lines += "\\e";
    else if (c == '-') lines += "\\-";
    else lines += c;
  }
  return lines;
}
std::string roff_as_it_stands(const std::string& text) {
  return text.empty() ? "" : ".PP\n.nf\n" + roff(text) + "\n.fi\n";
}

std::string manual_page(const Command_words& program, const std::vector<Command_words>& commands) {
  std::string page = ".TH SIGHTLINE 1\n.ad l\n.SH NAME\nsightline \\- " + roff(program.what) +
                     "\n.SH SYNOPSIS\n.B sightline\n.I COMMAND\n[\\fIOPTIONS\\fR]\n.SH COMMANDS\n";
  for (const Command_words& command : commands) {
    std::string arguments;
    for (const Option_words& option : command.options)
      if (!is_dashed(option)) arguments += " \\fI" + roff(option.name) + "\\fR";
    page += ".SS sightline " + command.name + arguments + '\n' + roff(command.what) + '\n';
    for (const Option_words& option : command.options) {
      const std::string value = is_dashed(option) && !option.value.empty() ? " \\fI" + roff(option.value) + "\\fR" : "";
      page += ".TP\n\\fB" + roff(option.name) + "\\fR" + value + '\n' + roff(option.what) + '\n';
    }
    page += roff_as_it_stands(command.footer);
  }
  return page + ".SH NOTES\n" + roff_as_it_stands(program.footer);
}

Exit run(Command program, const std::string& shell) {
  const std::vector<Command_words> commands = program.commands();
  std::cout << (shell == "bash"   ? bash_script(commands)
                : shell == "zsh"  ? zsh_script(commands)
                : shell == "fish" ? fish_script(commands)
                                  : manual_page(program.words(), commands));
  return Exit::done;
}

}  // namespace

void add_completion(Command program) {
  const Command command =
      program.add_command("completion", "A script that completes command lines in a shell, or the manual page");
  auto shell = std::make_shared<std::string>();
  command.add_option("SHELL", *shell, "bash, zsh or fish; man: the manual page")
      .required()
      .check(one_of({"bash", "zsh", "fish", "man"}));
  command.footer(
      "Examples: sightline completion bash > ~/.local/share/bash-completion/completions/sightline\n"
      "          sightline completion zsh > ~/.zfunc/_sightline\n"
      "          sightline completion fish > ~/.config/fish/completions/sightline.fish\n"
      "          sightline completion man > ~/.local/share/man/man1/sightline.1");
  command.set_printing_action([program, shell] { return run(program, *shell); });
}

}  // namespace sightline::app
