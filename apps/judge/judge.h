#pragma once
// The command line of `sightline judge`.

#include "cases.h"
#include "court.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace sightline::app {

struct Judge_arguments {
  std::string program, query, contract, format = "off", json, html, keep, shard;
  Case_choice choice{{}, {"0", "1", "-1", "far"}, 0, {}, {}};
  std::size_t cases = 5;
  std::uint64_t seed = 1;
  double time = 10, budget = 20, reduce = 0;
  std::uint64_t memory = 1024;
  int threads = 0;
  bool two_sided = false, cycles = false, excuse_touching = false, resume = false,
       quiet = false;  // quiet: an output takes standard output

  Case_options case_options() const {
    return {static_cast<judge::Question>(place_of(query, judge::question_names)), two_sided, format != "qoff"};
  }
  Court_options court_options() const {
    return {program,
            format,
            static_cast<judge::Contract>(place_of(contract, judge::contract_names)),
            {time, memory << 20},
            {threads, budget, cycles, excuse_touching}};
  }
  template <std::size_t n>
  static std::size_t place_of(const std::string& name, const std::array<std::string_view, n>& names) {
    return static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin());
  }
};

/// The command that asks one case again, which `which` names.
std::string command_again(const Judge_arguments& arguments, const std::string& which);

}  // namespace sightline::app
