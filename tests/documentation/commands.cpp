// What pages say that the program prints is what it prints, and their pictures are what it draws. A page's commands are
// the lines `    $ COMMAND` (`    > REST` goes on), what they print is indented below them, lines left out at will.
// They run in order in a folder of the page's own, where tests/ is.

#ifdef SIGHTLINE_PROGRAM  // there is a program to ask

#include "../program/program.h"

#include <png.h>

#include <algorithm>
#include <map>
#include <regex>

namespace {

using program::Outcome;
namespace fs = std::filesystem;

const fs::path top = SIGHTLINE_SOURCE_DIR;

/// What is not run: the page, how the command begins, and why. What it prints, its page says with another one.
struct Not_run {
  std::string page, begin, why, like;
};
const std::vector<Not_run> not_run{
    {"harness/judge/README.md", "sightline judge ", "5 s of Python; tests/program/judge.cpp runs it", ""},
    {"README.md", "sightline judge ", "the same", "harness/judge/README.md"},
};

/// Pictures that no command on a page draws, and why.
const std::map<std::string, std::string> not_drawn{
    {"algorithms/levels/crack.svg",
     "of id_e1m7.geom.bsp, which is not ours; `compare` of it, a minute, says the command"},
    {"algorithms/priority/graph.svg", "drawn by hand"},
    {"apps/page/pages.png", "two browsers' windows"},
    {"harness/compare/weak.svg", "it plots seconds"},
    {"harness/report/report.svg", "half a minute, and it plots seconds"},
    {"python/window.png", "drawn by matplotlib, which is not everywhere"},
};

/// The files of one of these endings, by their names from the top on.
std::set<std::string> files_with(const std::set<std::string>& endings) {
  std::set<std::string> found;
  const auto add = [&](const fs::directory_entry& entry) {
    if (entry.is_regular_file() && endings.contains(entry.path().extension().string()))
      found.insert(entry.path().lexically_relative(top).generic_string());
  };
  for (const auto& entry : fs::directory_iterator(top)) add(entry);
  for (const char* layer : {"algorithms", "apps", "bench", "harness", "io", "kernel", "packaging", "proofs", "python",
                            "sightline", "tests"})
    for (const auto& entry : fs::recursive_directory_iterator(top / layer)) add(entry);
  return found;
}

struct Page_command {
  std::size_t line = 0;
  std::string text;
  std::vector<std::string> prints;
};

std::vector<Page_command> commands_of(const std::string& page) {
  std::vector<Page_command> found;
  std::istringstream text(program::read_file(top / page));
  bool is_below = false, is_fenced = false;
  std::size_t number = 0;
  for (std::string line; std::getline(text, line);) {
    ++number;
    if (line.starts_with("```")) is_fenced = !is_fenced;
    EXPECT_FALSE(line.starts_with("$ ")) << page << ':' << number
                                         << ": commands are indented by four, so that they run";
    if (!is_fenced && line.starts_with("    $ ")) {
      found.push_back({number, line.substr(6), {}});
      is_below = true;
    } else if (!line.starts_with("    ")) {
      is_below = false;
    } else if (is_below && line.starts_with("    > ") && found.back().prints.empty()) {
      found.back().text += '\n' + line.substr(6);
    } else if (is_below) {
      found.back().prints.push_back(line.substr(4));
    }
  }
  return found;
}

/// Lines without what differs from run to run: seconds and memory, also in columns that are called so. Blanks between
/// columns count for two.
std::vector<std::string> lasting(const std::vector<std::string>& lines) {
  static const std::regex column("\\s\\s+"), measured("[0-9][0-9.e+-]*(?= (s|ms|seconds|MB)\\b)"), number("[0-9.e+-]+");
  std::vector<std::string> result;
  std::set<std::size_t> of_one_run;  // columns
  for (const std::string& line : lines) {
    const std::size_t begin = std::min(line.find_first_not_of(' '), line.size());
    std::vector<std::string> columns(
        std::sregex_token_iterator(line.begin() + static_cast<std::ptrdiff_t>(begin), line.end(), column, -1),
        std::sregex_token_iterator());
    std::set<std::size_t> named;
    for (std::size_t i = 1; i < columns.size(); ++i)
      if (columns[i] == "seconds" || columns[i] == "peak MB") named.insert(i);
    if (!named.empty()) of_one_run = named;
    std::string& kept = result.emplace_back();
    for (std::size_t i = 0; i < columns.size(); ++i) {
      if (named.empty() && of_one_run.contains(i) && std::regex_match(columns[i], number)) columns[i] = "#";
      if (columns[0] == "seconds") columns[i] = std::regex_replace(columns[i], number, "#");
      kept += (i == 0 ? "" : "  ") + std::regex_replace(columns[i], measured, "#");
    }
  }
  return result;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

/// What of a page's lines is not among those printed, in their order; a line that ends in ` ...` may go on. Empty:
/// none.
std::string not_printed(const std::vector<std::string>& says, const std::vector<std::string>& prints) {
  const std::vector<std::string> wanted = lasting(says), printed = lasting(prints);
  std::size_t at = 0;
  for (std::size_t i = 0; i < wanted.size(); ++i) {
    const auto is_it = [&](const std::string& line) {
      return wanted[i].ends_with(" ...") ? line.starts_with(wanted[i].substr(0, wanted[i].size() - 3))
                                         : line == wanted[i];
    };
    while (at < printed.size() && !is_it(printed[at])) ++at;
    if (at++ >= printed.size()) return says[i];
  }
  return "";
}

/// Width, height and colours of a PNG, which packers pack differently.
std::vector<std::uint8_t> pixels_of(const std::string& png) {
  png_image image{};
  image.version = PNG_IMAGE_VERSION;
  if (png_image_begin_read_from_memory(&image, png.data(), png.size()) == 0) return {};
  image.format = PNG_FORMAT_RGBA;
  std::vector<std::uint8_t> pixels(PNG_IMAGE_SIZE(image));
  if (png_image_finish_read(&image, nullptr, pixels.data(), 0, nullptr) == 0) return {};
  for (const png_uint_32 size : {image.width, image.height})
    for (int bits = 0; bits < 32; bits += 8) pixels.push_back(static_cast<std::uint8_t>(size >> bits));
  return pixels;
}

bool is_same_picture(const fs::path& one, const fs::path& other) {
  const std::string a = program::read_file(one), b = program::read_file(other);
  if (one.extension() != ".png") return a == b;
  return a == b || (!pixels_of(a).empty() && pixels_of(a) == pixels_of(b));
}

class Commands : public program::Program {
 protected:
  /// A line for the shell, in a folder; `sightline` is the program.
  Outcome shell(const fs::path& folder, const std::string& line) {
    launcher_ = {"/bin/sh", "-c",
                 "export LC_ALL=C; cd '" + folder.string() + "' && sightline() { \"$0\" \"$@\"; } && " + line};
    return run({});
  }
};

TEST_F(Commands, of_pages_print_and_draw_what_stands_there) {
  if (program::sanitized) GTEST_SKIP() << "it is about pages' texts; other tests of the program are sanitized";
  const std::set<std::string> pictures = files_with({".svg", ".png"});
  std::set<std::string> drawn;
  std::vector<bool> is_there(not_run.size());
  for (const std::string& page : files_with({".md"})) {
    const std::vector<Page_command> commands = commands_of(page);
    if (commands.empty()) continue;
    std::string name = page;
    std::replace(name.begin(), name.end(), '/', '-');
    const fs::path folder = path(name), beside = fs::path(page).parent_path();
    std::set<std::string> own;  // its pictures, by their names as the page says them
    for (const std::string& picture : pictures) {
      const std::string from_page = fs::path(picture).lexically_relative(beside).generic_string();
      if (!from_page.starts_with("..")) own.insert(beside.empty() ? picture : from_page);
    }
    fs::create_directory(folder);
    for (const std::string& picture : own) fs::create_directories((folder / picture).parent_path());
    if (!fs::exists(folder / "tests")) fs::create_directory_symlink(top / "tests", folder / "tests");

    for (const Page_command& command : commands) {
      const std::string where = page + ':' + std::to_string(command.line) + ": " + command.text;
      const auto left_out = std::find_if(not_run.begin(), not_run.end(), [&](const Not_run& one) {
        return one.page == page && command.text.starts_with(one.begin);
      });
      if (left_out != not_run.end()) {
        is_there[static_cast<std::size_t>(left_out - not_run.begin())] = true;
        const std::string other = left_out->like.empty() ? "" : program::read_file(top / left_out->like);
        for (const std::string& line : command.prints)
          EXPECT_TRUE(left_out->like.empty() || other.find("    " + line + '\n') != std::string::npos)
              << where << "\n  prints, but not on " << left_out->like << ": " << line;
        continue;
      }
      const Outcome r = shell(folder, command.text);
      EXPECT_TRUE(r.code == program::done || r.code == program::disagreement) << where << '\n' << r;
      EXPECT_EQ(not_printed(command.prints, lines_of(r.out)), "") << where << "\n  does not print that, but\n" << r.out;
    }
    for (const std::string& picture : own) {
      if (!fs::is_regular_file(folder / picture)) continue;
      drawn.insert((beside / picture).generic_string());
      if (std::getenv("SIGHTLINE_RECORD") != nullptr)
        fs::copy_file(folder / picture, top / beside / picture, fs::copy_options::overwrite_existing);
      EXPECT_TRUE(is_same_picture(top / beside / picture, folder / picture))
          << (beside / picture) << " is another picture than the commands of " << page
          << " draw; SIGHTLINE_RECORD=1 puts theirs there";
    }
  }
  for (std::size_t i = 0; i < not_run.size(); ++i)
    EXPECT_TRUE(is_there[i]) << not_run[i].page << " has no command " << not_run[i].begin;
  for (const std::string& picture : pictures)
    EXPECT_NE(drawn.contains(picture), not_drawn.contains(picture))
        << picture << ": a page's commands draw it, or it is listed above with the reason why not";
  for (const auto& [picture, why] : not_drawn) EXPECT_TRUE(pictures.contains(picture)) << picture;
}

TEST_F(Commands, of_pages_have_options_that_there_are) {
  if (program::sanitized) GTEST_SKIP() << "it is about pages' texts; other tests of the program are sanitized";
  std::map<std::string, std::string> help;
  std::size_t options = 0;
  for (const std::string& page : files_with({".md"})) {
    if (page == "CHANGELOG.md") continue;  // of options that were
    bool is_fenced = false;
    for (const std::string& line : lines_of(program::read_file(top / page))) {
      if (line.starts_with("```")) is_fenced = !is_fenced;
      const std::string begin = "sightline ";
      for (std::size_t at = line.find(begin); at != std::string::npos; at = line.find(begin, at + 1)) {
        const bool is_code = is_fenced || line.starts_with("    ") ||
                             std::count(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(at), '`') % 2 != 0;
        if (!is_code || (at > 0 && (std::isalnum(line[at - 1]) != 0 || line[at - 1] == ':'))) continue;
        // To the end of the command, without what is quoted.
        std::string words;
        char quote = 0;
        for (std::size_t i = at + begin.size(); i < line.size(); ++i) {
          if (quote == 0 &&
              (std::string_view("`#|;&").find(line[i]) != std::string_view::npos || line.compare(i, 4, " -- ") == 0))
            break;
          if (line[i] == quote) quote = 0;
          else if (quote == 0 && (line[i] == '"' || line[i] == '\'')) quote = line[i];
          else if (quote == 0) words += line[i];
        }
        static const std::regex option("--[a-z][a-z0-9-]*");
        const std::string command = words.substr(0, words.find_first_not_of("abcdefghijklmnopqrstuvwxyz"));
        if (command.empty()) continue;
        for (std::sregex_iterator found(words.begin(), words.end(), option), none; found != none; ++found) {
          std::string& says = help[command];
          if (says.empty()) {
            const Outcome r = run({command, "--help"});
            EXPECT_EQ(r.code, program::done) << page << ": " << line << '\n' << r;
            says = r.out + ' ';
          }
          EXPECT_TRUE(std::regex_search(says, std::regex(found->str() + "[^a-z0-9-]")))
              << page << ": `sightline " << command << "` has no " << found->str() << ": " << line;
          ++options;
        }
      }
    }
  }
  EXPECT_GT(options, 100u);
}

}  // namespace

#endif
