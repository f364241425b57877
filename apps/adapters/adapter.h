#pragma once
// What the adapters share: reading what `sightline judge` wrote, and writing what it reads.

#include <sightline/harness/judge/protocol.h>
#include <sightline/io/read.h>
#include <sightline/kernel/scene/scene.h>

#include <nlohmann/json.hpp>

#include <fstream>
#include <iostream>

namespace adapter {

using namespace sightline;

/// A command line SCENE QUERY ANSWER [MORE].
struct Task {
  Polygon_soup soup;
  Scene scene;
  judge::Query query;
  std::string answer;
  std::vector<std::string> more;
};

inline judge::Query read_query(const std::string& file) {
  std::ifstream in(file);
  return judge::query_from_json(nlohmann::json::parse(in));
}

inline void write_answer(const Task& task, const judge::Json& answer) {
  std::ofstream out(task.answer);
  out << answer.dump() << '\n';
  if (!out.flush()) throw std::runtime_error(task.answer + ": cannot be written");
}

/// The program: reads the task, answers it. Exit code 0 where it did, 1 where something failed, 2 for a wrong command
/// line or a query that it does not answer.
inline int main(int argc, char** argv, judge::Question question, void (*solve)(const Task&)) {
  if (argc < 4) {
    std::cerr << argv[0] << " SCENE QUERY ANSWER: an adapter for `sightline judge`\n";
    return 2;
  }
  try {
    const Polygon_soup soup = read_scene(std::filesystem::path(argv[1]));
    const Task task{soup, Scene(soup), read_query(argv[2]), argv[3], std::vector<std::string>(argv + 4, argv + argc)};
    if (task.query.question != question) {
      std::cerr << "answers queries of `" << judge::question_names[static_cast<std::size_t>(question)] << "` only\n";
      return 2;
    }
    solve(task);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return 1;
  }
}

}  // namespace adapter
