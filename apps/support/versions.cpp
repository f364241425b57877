#include "versions.h"

#include <CGAL/version.h>
#include <boost/version.hpp>
#include <fmt/format.h>
#include <gmp.h>
#include <mpfr.h>
#include <oneapi/tbb/version.h>

namespace sightline::app {

std::string program_version() { return SIGHTLINE_VERSION; }

std::string library_versions() {
  constexpr int cgal = CGAL_VERSION_NR, boost = BOOST_VERSION;  // 1MMmmbiiii; MMmmmbb
  return fmt::format("(CGAL {}.{}.{}, GMP {}, MPFR {}, oneTBB {}, Boost {}.{}.{})", cgal / 10000000 - 100,
                     cgal / 100000 % 100, cgal / 10000 % 10, gmp_version, mpfr_get_version(), TBB_runtime_version(),
                     boost / 100000, boost / 100 % 1000, boost % 100);
}

}  // namespace sightline::app
