// sightline compare: the same question to several kernels and methods, each in a process of its own: time, memory,
// error.

#include "compare.h"

#include "../support/limited_process.h"

#include <poll.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>

namespace sightline::app {

static void limit_addresses(std::uint64_t bytes) {
  const auto most = static_cast<rlim_t>(process_memory("self", "VmSize") + bytes);
  const rlimit limit{most, most};
  setrlimit(RLIMIT_AS, &limit);
}

Json ask_apart(const Contestant& contestant, double seconds, std::uint64_t bytes) {
  const auto named = [&](const Json& row) {
    Json all = contestant.name;
    all.update(row);
    return all;
  };
  int ends[2];
  if (pipe(ends) != 0) throw std::runtime_error("no pipe to be had");
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error("no process to be had");
  if (child == 0) {
    end_with_parent(parent);
    close(ends[0]);
    if (bytes > 0) limit_addresses(bytes);
    std::string text;
    try {
      text = to_text(contestant.judge());
    } catch (const std::exception& error) {
      text = to_text(Json{{"status", std::string("error: ") + error.what()}});
    }
    for (std::size_t written = 0; written < text.size();) {
      const ssize_t n = write(ends[1], text.data() + written, text.size() - written);
      if (n <= 0) break;
      written += static_cast<std::size_t>(n);
    }
    _exit(0);
  }
  close(ends[1]);
  const Stopwatch watch;
  std::string text, status = "crashed";
  for (;;) {
    pollfd waiting{ends[0], POLLIN, 0};
    const int left = seconds > 0 ? static_cast<int>(std::clamp(1000 * (seconds - watch.seconds()), 0.0, 1e9)) : -1;
    if (poll(&waiting, 1, left) == 0) {
      kill(child, SIGKILL);
      status = "timed out";
      break;
    }
    char buffer[4096];
    const ssize_t n = read(ends[0], buffer, sizeof buffer);
    if (n <= 0) break;
    text.append(buffer, static_cast<std::size_t>(n));
  }
  close(ends[0]);
  int how = 0;
  waitpid(child, &how, 0);
  if (status != "timed out") {
    if (Json row = Json::parse(text, nullptr, false); !row.is_discarded()) return named(row);
    if (WIFSIGNALED(how)) status += fmt::format(" (signal {})", WTERMSIG(how));
    if (WIFEXITED(how) && WEXITSTATUS(how) == static_cast<int>(Exit::undecided)) status = "out of memory";
  }
  return named({{"status", status}});
}

bool claims_to_be_exact(const Json& row) {
  return row["kernel"] == "exact" || row["kernel"] == "epeck" || row["kernel"] == "gmpq";
}

Exit ask(const Trial& trial, double budget, Json& rows) {
  bool disagree = false, undecided = false;
  Progress progress("comparing");
  for (const Contestant& contestant : trial.contestants) {
    progress(rows.size(), trial.contestants.size());
    rows.push_back(ask_apart(contestant, budget));
    const Json& r = rows.back();
    if (!claims_to_be_exact(r)) continue;
    const std::string& status = r["status"].get_ref<const std::string&>();
    if (status == "timed out" || status == "out of memory") undecided = true;
    else if (status.starts_with("left out")) continue;
    else if (status != "done" || !trial.right(r)) disagree = true;
  }
  return disagree ? Exit::disagreement : undecided ? Exit::undecided : Exit::done;
}

/// An option that not all questions take.
struct Own_option {
  const char* name;
  std::vector<std::string> questions;
};
static const std::vector<Own_option> own_options{{"--eye", {"order", "see", "render"}},
                                                 {"--kernels", {"order", "bsp", "see", "weak", "render"}},
                                                 {"--max-fragments", {"order"}},
                                                 {"--sizes", {"see"}},
                                                 {"--bits", {"see", "render"}},
                                                 {"--samples", {"render"}},
                                                 {"--near", {"see"}},
                                                 {"--far", {"see"}},
                                                 {"--from-face", {"weak"}},
                                                 {"--from", {"weak"}},
                                                 {"--from-volume", {"weak"}},
                                                 {"--from-faces", {"weak"}},
                                                 {"--two-sided", {"weak"}},
                                                 {"--rays", {"weak", "pvs"}},
                                                 {"--cells", {"weak"}},
                                                 {"--event-edges", {"weak"}},
                                                 {"--random", {"trace"}},
                                                 {"--ray-file", {"trace"}},
                                                 {"--svg", {"weak", "render"}},
                                                 {"--sightlines", {"pvs"}},
                                                 {"--colours", {"render"}},
                                                 {"--alpha", {"render"}},
                                                 {"--look", {"render"}},
                                                 {"--up", {"render"}},
                                                 {"--field", {"render"}},
                                                 {"--shade", {"render"}},
                                                 {"--size", {"weak", "render"}},
                                                 {"--background", {"weak", "render"}}};

/// Errors: Usage_error for an option that would be passed over.
static void check_options(const Command& command, const std::string& question) {
  for (const Own_option& option : own_options)
    if (command.given(option.name) &&
        std::find(option.questions.begin(), option.questions.end(), question) == option.questions.end())
      throw Usage_error(fmt::format("{0} is of compare {1}; leave it out of compare {2}", option.name,
                                    fmt::join(option.questions, ", "), question));
  for (const char* option : {"--size", "--background"})
    if (question == "weak" && command.given(option) && !command.given("--svg")) throw no_picture_for(option);
}

void add_compare(Command program) {
  const Command command = program.add_command(
      "compare", "The same question to several kernels and methods: seconds, memory, and errors against exact");
  auto a = std::make_shared<Compare_arguments>();
  a->common.add_to(command);
  command.add_option("COMMAND", a->command, "the question")
      .check(one_of({"order", "bsp", "see", "weak", "render", "trace", "pvs"}))
      .show_default();
  command.add_option("--eye", a->eye, "the eye X,Y,Z, for order, see and render; by default a place outside the scene")
      .check(not_empty());
  const Option kernels =
      command
          .add_option("--kernels", a->kernels,
                      "which kernels, with commas; see asks all but epick, weak exact and double, render exact, "
                      "double and float")
          .delimiter(',')
          .check(one_of(kernel_names))
          .show_default();
  command.add_option("--max-fragments", a->max_fragments, "order: compare all pairs up to this many fragments")
      .check(whole_number())
      .show_default();
  command.add_option("--sizes", a->sizes, "see: depth buffers of so many pixels along each side of a cube, with commas")
      .delimiter(',')
      .check(whole_number())
      .check(range(1, 16384))
      .show_default();
  command.add_option("--bits", a->bits, "see, render: bits of their depths, with commas; 32: floats")
      .delimiter(',')
      .check(whole_number())
      .check(range(1, 32))
      .show_default();
  command.add_option("--samples", a->samples, "render: n x n rays a pixel of Embree, against exact means, with commas")
      .delimiter(',')
      .check(whole_number())
      .check(range(2, 64))
      .show_default();
  command
      .add_option("--near", a->near,
                  "see: their near plane; by default from the scene's box, at least 1/4096 of the far one")
      .check(finite_number())
      .check(positive());
  command.add_option("--far", a->far, "see: their far plane; by default from the scene's box")
      .check(finite_number())
      .check(positive());
  a->sources.add_to(command, "weak: ");
  command.add_option("--rays", a->rays, "weak, pvs: numbers of random rays from each source or cell, with commas")
      .delimiter(',')
      .check(whole_number())
      .show_default();
  command
      .add_option("--cells", a->weak.cells,
                  "weak: how many cells a search may take before its face is undecided; 0: as many as it takes")
      .check(whole_number())
      .show_default();
  command
      .add_option("--event-edges", a->weak.event_edges,
                  "weak: faces that lines leave open go to events where so many edges are near at most; events alone "
                  "are asked where no pair has more")
      .check(whole_number())
      .show_default();
  const Option random =
      command
          .add_option(
              "--random", a->random,
              "trace: so many rays of each kind: anywhere, to corners, to edges, along faces, from faces, from afar")
          .check(whole_number() & range(1, 10'000'000))
          .show_default();
  command.add_option("--ray-file", a->ray_file, "trace: instead, a file with X,Y,Z,DX,DY,DZ a line")
      .reads_file()
      .excludes(random);
  command.add_option("--svg", a->svg, "weak, render: plot the seconds and the errors").writes_file(".svg");
  command
      .add_option("--html", a->html,
                  "write a page to look at: what each took and has wrong; of see and weak, in which faces")
      .writes_file(".html");
  command
      .add_option(
          "--sightlines", a->sightlines,
          "pvs: of each pair that a compiled level's own table hides wrongly write a certificate, which `verify` "
          "accepts, to this folder")
      .check(not_empty());
  a->tints.add_to(command);
  a->view.add_to(command, "of what is drawn for render by default 512x512; of the plot 860x560");
  command.footer(
      "order, bsp. sides wrong: of the exact kernel's own queries, those that the kernel answers differently (asked of "
      "inexact kernels).\n"
      "pairs wrong: overlapping fragments drawn in the wrong order; beyond rounding: by more than 2^-20 of the "
      "distance.\n"
      "see. Areas are shares of the sphere of directions. wrong area: another face is shown than the exact one, or "
      "none; tied: another one of its plane that is there too;\n"
      "wrongly visible, wrongly hidden: faces, against the exact list; missing: visible faces that are shown nowhere, "
      "with the largest area of one;\n"
      "gaps, overlaps: directions with no part, and with two. Example: sightline compare town.off see --sizes 512,2048 "
      "--bits 24\n"
      "weak. Faces that a method says are visible and are not, are hidden and are not, or leaves open, against lines "
      "and events together; of conservative, wrongly visible are those that it has too many.\n"
      "Example: sightline compare rooms.off weak --from \"1,1,2 1,2,2 2,2,2 2,1,2\" --rays 100,10000 --svg weak.svg\n"
      "render. Of the pixels whose centres are no ties: wrong: those that show another face than an exact ray meets "
      "first; missing: faces that are shown nowhere, with the most pixels of one.\n"
      "Of means over pixels: off: by more than half a step of 255. exact: of up to 256 pixels, most of them where "
      "something ends, against areas in rationals by no code of its own; missing: faces that are at centres. Rays: of "
      "all pixels, against exact; missing: faces with an area that no ray meets, with the largest in pixels.\n"
      "Example: sightline compare town.off render --size 1024x1024\n"
      "trace. Of a million rays: missed: no face is said to be met where one is; invented: one is where none is; wrong "
      "face: another than those that are met first. Embree has corners and rays in floats, and no faces edge-on.\n"
      "Example: sightline compare town.off trace --random 10000\n"
      "pvs. Pairs of a cell and a face that a method hides wrongly, or has too many; the file's table: of a compiled "
      "level, whose cells lie within its leaves; each pair that it hides is shown by an exact sightline.\n"
      "Sizes, of at most 200 pairs at random: of what is hidden wrongly what is seen of the face from where a "
      "sightline "
      "starts, the cell's middle where that sees it; of what is too many the face as it would look from the cell's "
      "middle. In pixels of 1024 across 90 degrees, as they are in the middle; --json lists the largest that the "
      "file's table hides, with a command that draws each.\n"
      "Example: sightline compare level.bsp pvs --rays 1000,10000\n"
      "A folder of scenes, in shards, with one row a scene and method: sightline report FOLDER --questions see --shard "
      "0/8 --json part0.json; report --merge puts the parts together.\n"
      "--budget is for each kernel or method, and anew for its sizes, and for the truth: what that leaves undecided is "
      "not judged, exit code 4. Threads: 1 unless given. Exit code 1: one that "
      "claims to be exact was "
      "not.");
  command.set_action([a, kernels, command] {
    check_options(command, a->command);
    a->kernels_given = kernels.given();
    a->says = !a->html.empty() && (a->command == "see" || a->command == "weak");
    if (a->command == "render") return compare_images(*a);
    if (a->command == "pvs") return compare_cells(*a);
    if (a->command == "trace") return compare_rays(*a);
    return a->command == "weak" ? compare_weak(*a) : a->command == "see" ? compare_visible(*a) : compare_orders(*a);
  });
}

}  // namespace sightline::app
