#pragma once
// All targets by name. A target is a function of bytes that throws where something is wrong; whatever the bytes are, it
// returns soon.

#include "active_subranges.h"
#include "arcs.h"
#include "bsp_queries.h"
#include "cell_proofs.h"
#include "certificate.h"
#include "certificate_forms.h"
#include "conics.h"
#include "contacts.h"
#include "cover.h"
#include "cutset.h"
#include "decimal.h"
#include "decisions.h"
#include "drawings.h"
#include "event_cells.h"
#include "eye_numbers.h"
#include "faces.h"
#include "fixed_integer.h"
#include "forged.h"
#include "grid.h"
#include "judged.h"
#include "kept_files.h"
#include "light_work.h"
#include "limits.h"
#include "measures.h"
#include "mutate.h"
#include "one_edge.h"
#include "only_nonsense.h"
#include "other_readers.h"
#include "pairs.h"
#include "pictures.h"
#include "planar_parts.h"
#include "quadratic_roots.h"
#include "rare_files.h"
#include "ray_numbers.h"
#include "readers.h"
#include "refusals.h"
#include "scene_laws.h"
#include "separations.h"
#include "side.h"
#include "single_parts.h"
#include "small_certificates.h"
#include "small_levels.h"
#include "small_promises.h"
#include "small_solids.h"
#include "subject_laws.h"
#include "sure_doubles.h"
#include "text_numbers.h"
#include "tree_options.h"
#include "volumes.h"
#include "weak_claims.h"
#include "weak_parts.h"
#include "written.h"

#include <filesystem>
#include <fstream>
#include <iterator>

namespace fuzz {

struct Target {
  const char* name;
  void (*run)(std::string_view bytes);
  std::vector<std::string> seeds;  ///< endings, or folders, of the files of the corpus that it begins with; none: it
                                   ///< begins with random bytes
};

inline const std::vector<Target>& targets() {
  static const std::vector<Target> all{{"read_obj", read_obj, {".obj"}},
                                       {"read_off", read_off, {".off", ".qoff"}},
                                       {"read_qoff", read_qoff, {".qoff", ".off"}},
                                       {"read_ply", read_ply, {".ply"}},
                                       {"read_stl", read_stl, {".stl"}},
                                       {"read_map", read_map, {".map"}},
                                       {"read_bsp", read_bsp, {".bsp"}},
                                       {"read_glb", read_glb, {".glb"}},
                                       {"read_gltf", read_gltf, {".gltf"}},
                                       {"read_table", read_table, {".pvs"}},
                                       {"decimal", decimal, {".off", ".qoff", ".obj"}},
                                       {"read_certificate", read_certificate, {"certificates/", "forms/"}},
                                       {"read_solid_certificate", read_solid_certificate, {"solid_proofs/"}},
                                       {"query", query, {"queries/"}},
                                       {"answer", answer, {"answers/"}},
                                       {"number_lines", number_lines, {"paths/"}},
                                       {"certificate", certificate, {"certificates/"}},
                                       {"forged", forged, {}},
                                       {"only_nonsense", only_nonsense, {}},
                                       {"fixed_integer", fixed_integer, {}},
                                       {"side", side, {}},
                                       {"grid", grid, {}},
                                       {"quadratic_roots", quadratic_roots, {}},
                                       {"active_subranges", active_subranges, {}},
                                       {"event_cells", event_cells, {}},
                                       {"pairs", pairs, {}},
                                       {"faces", faces, {}},
                                       {"weak_claims", weak_claims, {}},
                                       {"scene_laws", scene_laws, {}},
                                       {"weak_laws", weak_laws, {}},
                                       {"level_laws", level_laws, {}},
                                       {"image_laws", image_laws, {}},
                                       {"solid_laws", solid_laws, {}},
                                       {"view_laws", view_laws, {}},
                                       {"separations", separations, {}},
                                       {"decisions", decisions, {}},
                                       {"refusals", refusals, {}},
                                       {"single_parts", single_parts, {}},
                                       {"weak_parts", weak_parts, {}},
                                       {"sure_doubles", sure_doubles, {}},
                                       {"eye_numbers", eye_numbers, {}},
                                       {"ray_numbers", ray_numbers, {}},
                                       {"small_promises", small_promises, {}},
                                       {"small_solids", small_solids, {}},
                                       {"small_certificates", small_certificates, {}},
                                       {"small_levels", small_levels, {}},
                                       {"rare_files", rare_files, {}},
                                       {"kept_files", kept_files, {}},
                                       {"one_edge", one_edge, {}},
                                       {"cell_proofs", cell_proofs, {}},
                                       {"light_work", light_work, {}},
                                       {"measures", measures, {}},
                                       {"judged", judged, {}},
                                       {"limits", limits, {}},
                                       {"certificate_forms", certificate_forms, {}},
                                       {"volumes", volumes, {}},
                                       {"conics", conics, {}},
                                       {"contacts", contacts, {}},
                                       {"arcs", arcs, {}},
                                       {"planar_parts", planar_parts, {}},
                                       {"cutset", cutset, {}},
                                       {"bsp_queries", bsp_queries, {}},
                                       {"tree_options", tree_options, {}},
                                       {"text_numbers", text_numbers, {}},
                                       {"cover", cover, {}},
                                       {"written", written, {}},
                                       {"pictures", pictures, {}},
                                       {"drawings", drawings, {}}};
  return all;
}

struct Seed {
  std::string file, bytes;
};

/// The files of the corpus that a target begins with, by name.
inline std::vector<Seed> seeds_of(const Target& target) {
  std::vector<Seed> seeds;
  const std::filesystem::path corpus = std::filesystem::path(SIGHTLINE_SOURCE_DIR) / "tests" / "corpus";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(corpus)) {
    const std::filesystem::path& file = entry.path();
    const std::string name = file.lexically_relative(corpus).string();
    const auto is_meant = [&](const std::string& seed) {
      return seed.ends_with('/') ? name.starts_with(seed) : file.extension() == seed;
    };
    if (std::none_of(target.seeds.begin(), target.seeds.end(), is_meant)) continue;
    std::ifstream in(file, std::ios::binary);
    seeds.push_back({file.string(), std::string(std::istreambuf_iterator<char>(in), {})});
  }
  std::sort(seeds.begin(), seeds.end(), [](const Seed& a, const Seed& b) { return a.file < b.file; });
  return seeds;
}

/// An input near a seed, or random bytes where there is none. Certificates stay JSON three times out of four.
inline std::string input_near(const std::vector<Seed>& seeds, Mutator& mutator) {
  if (seeds.empty()) return mutator.random_bytes(300);
  const Seed& seed = seeds[mutator.below(seeds.size())];
  const nlohmann::json value = seed.file.ends_with(".json") && mutator.below(4) != 0
                                   ? nlohmann::json::parse(seed.bytes, nullptr, false)
                                   : nlohmann::json();
  if (value.is_structured()) return mutator.damaged(value).dump();
  return mutator.damaged(seed.bytes);
}

}  // namespace fuzz
