// Real scenes: every file that the readers know is read, and has the faces that the folder's README.md says.

#include "../sample.h"
#include "soup_text.h"

#include <sightline/io/write.h>

#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>

namespace sightline::test {
namespace {

namespace fs = std::filesystem;

/// The folder of scenes: $SIGHTLINE_SCENES, or what the build says, or nothing.
fs::path scenes_folder() {
  if (const char* folder = std::getenv("SIGHTLINE_SCENES")) return folder;
#ifdef SIGHTLINE_SCENES_DIR
  return SIGHTLINE_SCENES_DIR;
#else
  return {};
#endif
}

/// File name → number of vertices and of faces, from the rows `| file | KB | V | F | ...` of README.md.
std::map<std::string, std::array<std::size_t, 2>> announced_counts(const fs::path& folder) {
  std::map<std::string, std::array<std::size_t, 2>> counts;
  std::ifstream readme(folder / "README.md");
  for (std::string line; std::getline(readme, line);) {
    std::istringstream cells(line);
    std::string bar, file, kilobytes, vertices, faces;
    std::getline(cells, bar, '|');
    std::getline(cells, file, '|');
    std::getline(cells, kilobytes, '|');
    std::getline(cells, vertices, '|');
    std::getline(cells, faces, '|');
    std::istringstream(file) >> file;
    std::array<std::size_t, 2> row{};
    if (std::istringstream(vertices) >> row[0] && std::istringstream(faces) >> row[1]) counts[file] = row;
  }
  return counts;
}

TEST(Real_scenes, are_read_with_the_counts_that_their_table_says) {
  const fs::path folder = scenes_folder();
  if (folder.empty() || !fs::is_directory(folder))
    GTEST_SKIP() << "no folder of scenes; name one in the environment variable SIGHTLINE_SCENES";
  const auto counts = announced_counts(folder);
  std::size_t read = 0, compared = 0;
  for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
    if (!entry.is_regular_file() || !format_of_ending(entry.path())) continue;
    if (test_scenes::is_sanitized() && entry.file_size() > 200'000) continue;
    SCOPED_TRACE(entry.path().string());
    try {
      const Polygon_soup soup = read_scene(entry.path());
      ++read;
      if (const auto row = counts.find(fs::relative(entry.path(), folder).generic_string()); row != counts.end()) {
        if (format_of_ending(entry.path()) == Format::map) {  // of which the table counts doors and triggers, too
          EXPECT_LE(soup.point_count(), row->second[0]);
          EXPECT_LE(soup.face_count(), row->second[1]);
          EXPECT_GT(soup.face_count(), 0u);
        } else {
          EXPECT_EQ(soup.point_count(), row->second[0]);
          EXPECT_EQ(soup.face_count(), row->second[1]);
        }
        ++compared;
      }
      std::stringstream bytes;
      write_scene(soup, bytes, Format::qoff);
      EXPECT_EQ(text_of(read_scene(bytes.str(), Format::qoff, "again")), text_of(soup));
    } catch (const Input_error& error) {
      ADD_FAILURE() << error.what();
    }
  }
  EXPECT_GT(read, 0u) << "no scene in " << folder;
  RecordProperty("scenes_read", static_cast<int>(read));
  RecordProperty("scenes_compared", static_cast<int>(compared));
  std::cout << read << " scenes read, " << compared << " compared with the table\n";
}

}  // namespace
}  // namespace sightline::test
