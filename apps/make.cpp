// sightline make: the project's own scenes.

#include "common.h"

#include <sightline/algorithms/generate/scenes.h>
#include <sightline/io/write.h>

#include <iostream>

void add_make(CLI::App& app) {
  std::string kinds;
  for (const auto& kind : sightline::generate::kinds()) kinds += fmt::format("\n  {:<26} {} (size: {})", kind.name, kind.what, kind.size_means);
  CLI::App* command = app.add_subcommand("make", "Makes a scene of the project's own");
  command->footer("Kinds:" + kinds + "\nExample: sightline make rooms --size 4 --out rooms.off");
  struct Arguments {
    std::string kind, out;
    std::size_t size = 0;
    std::uint64_t seed = 1;
  };
  auto arguments = std::make_shared<Arguments>();
  command->add_option("KIND", arguments->kind, "which kind, see below")->required();
  command->add_option("--size", arguments->size, "how large; 0: the kind's own example size")->check(sightline::app::whole_number)->capture_default_str();
  command->add_option("--seed", arguments->seed, "of random choices")->check(sightline::app::whole_number)->capture_default_str();
  command->add_option("--out", arguments->out, "the file to write: .off .obj .ply .stl .qoff")->required();
  set_action(*command, [arguments] {
    std::size_t size = arguments->size;
    for (const auto& kind : sightline::generate::kinds())
      if (size == 0 && kind.name == arguments->kind) size = kind.example_size;
    try {
      sightline::write_scene(sightline::generate::make(arguments->kind, size, arguments->seed), arguments->out);
    } catch (const std::invalid_argument& error) {
      throw sightline::app::Usage_error(error.what());
    }
    return Exit::done;
  });
}
