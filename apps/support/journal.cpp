#include "journal.h"

#include "versions.h"

#include <sightline/algorithms/verify/keys_once.h>
#include <sightline/io/binary.h>
#include <sightline/io/file.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

namespace sightline::app {

namespace fs = std::filesystem;

Json resumed_head(const std::string& command, Json asked) {
  return {{"sightline", program_version()}, {"command", command}, {"asked", std::move(asked)}};
}

/// A line as it is written: bytes that are no UTF-8 are replaced.
template <class Value>
static std::string written(const Value& line) {
  return line.dump(-1, ' ', false, Value::error_handler_t::replace);
}

/// A value for people, not too long.
static std::string shown(const nlohmann::json& value) {
  const std::string text = value.is_string() ? value.get<std::string>() : written(value);
  constexpr std::size_t most = 60;
  return text.empty() ? "nothing" : text.size() > most ? text.substr(0, most) + "..." : text;
}

void check_resumed(const std::string& file, const nlohmann::json& found, const Json& head) {
  const auto refuse = [&](const std::string& what) {
    throw std::runtime_error(file + ": " + what + "; end that as it was begun, or delete the file to begin anew");
  };
  const nlohmann::json wanted = nlohmann::json::parse(written(head));
  if (!found.is_object() || !found.contains("asked") || !found["asked"].is_object()) refuse("is no file of --resume");
  for (const char* key : {"command", "sightline"})
    if (found.value(key, nlohmann::json()) != wanted[key])
      refuse(fmt::format("was begun by {} {}, and this is {}", key == std::string("command") ? "command" : "version",
                         shown(found.value(key, nlohmann::json())), shown(wanted[key])));
  for (const auto& [option, value] : head["asked"].items())
    if (const nlohmann::json before = found["asked"].value(option, nlohmann::json()); before != wanted["asked"][option])
      refuse(fmt::format("was begun with another {}: {}, not {}", option, shown(before), shown(value)));
  if (found["asked"].size() != head["asked"].size()) refuse("was begun with other options");
}

std::string hash_of_bytes(std::string_view bytes) { return fmt::format("{:016x}", sum_of_bytes(bytes)); }

std::string content_hash(const std::string& file) { return hash_of_bytes(read_bytes(file)); }

Json hashes_of_words(const std::vector<std::string>& words) {
  Json hashes = Json::object();
  std::error_code not_there;
  const auto add = [&](const std::string& word, const fs::path& file) {
    if (!fs::is_regular_file(file, not_there)) return false;
    hashes[word] = content_hash(file.string());
    return true;
  };
  for (std::size_t k = 0; k < words.size(); ++k) {
    if (k > 0 || words[k].find('/') != std::string::npos) {
      add(words[k], words[k]);
      continue;
    }
    const char* const path = std::getenv("PATH");
    std::istringstream folders(path == nullptr ? "" : path);
    for (std::string folder; std::getline(folders, folder, ':');)
      if (add(words[k], fs::path(folder.empty() ? "." : folder) / words[k])) break;
  }
  return hashes;
}

std::string text_of_bytes(std::string_view bytes) {
  std::string text;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    if (byte < 0x80) {
      text += c;
    } else {
      text += static_cast<char>(0xc0 | (byte >> 6));
      text += static_cast<char>(0x80 | (byte & 0x3f));
    }
  }
  return text;
}

std::string bytes_of_text(std::string_view text) {
  std::string bytes;
  for (std::size_t k = 0; k < text.size(); ++k) {
    const auto first = static_cast<unsigned char>(text[k]);
    if (first < 0x80 || k + 1 == text.size()) bytes += text[k];
    else bytes += static_cast<char>((first << 6) | (static_cast<unsigned char>(text[++k]) & 0x3f));
  }
  return bytes;
}

std::vector<nlohmann::json> Journal::lines() {
  std::vector<nlohmann::json> lines;
  good_ = 0;
  if (!fs::exists(file_)) return lines;
  const std::string bytes = read_own_bytes(file_);
  bool is_first = true;
  for (std::size_t at = 0, end; (end = bytes.find('\n', at)) != std::string::npos; at = end + 1) {
    nlohmann::json line = nlohmann::json::value_t::discarded;
    try {
      line = json_with_keys_once(std::string_view(bytes).substr(at, end - at));
    } catch (const std::invalid_argument&) {  // none of ours
    } catch (const nlohmann::json::exception&) {
    }
    if (is_first) check_resumed(file_, line, head_);
    else if (line.is_discarded()) break;
    else lines.push_back(std::move(line));
    is_first = false;
    good_ = end + 1;
  }
  if (is_first && !written(head_).starts_with(bytes)) check_resumed(file_, nlohmann::json(), head_);  // somebody else's
  return lines;
}

void Journal::begin() {
  std::error_code not_there;
  fs::resize_file(file_, good_, not_there);  // without a line that is none
  out_.open(file_, std::ios::binary | std::ios::app);
  if (good_ == 0) write(head_);
  if (!out_) throw std::runtime_error(file_ + ": cannot be written; name another output, or leave out --resume");
}

void Journal::write(const Json& line) { out_ << written(line) << '\n' << std::flush; }

void Journal::add(const Json& line) {
  write(line);
  if (!out_) throw std::runtime_error(file_ + ": cannot be written; check that its disk is not full");
}

void Journal::remove() {
  out_.close();
  std::error_code ignored;
  fs::remove(file_, ignored);
}

}  // namespace sightline::app
