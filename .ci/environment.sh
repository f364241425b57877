# What `check` and `demo` share: the packages they need, and how a build folder is set up. Source it; it defines functions only.

# package | a header or command that shows it is there (used where there is no Debian 12) | what it is for
build_packages='
g++|g++|the C++20 compiler
cmake|cmake|the build
ninja-build|ninja|the build
libcgal-dev|CGAL/version.h|kernels to compare with, interval arithmetic
libgmp-dev|gmpxx.h|exact integers and rationals
libmpfr-dev|mpfr.h|rationals rounded to doubles; CGAL needs it
libboost-dev|boost/version.hpp|CGAL needs it
libtbb-dev|oneapi/tbb/version.h|threads
libopenmesh-dev|OpenMesh/Core/Mesh/PolyMesh_ArrayKernelT.hh|the face graph
libcli11-dev|CLI/CLI.hpp|the command line
libfmt-dev|fmt/format.h|tables and messages
libpng-dev|png.h|pictures
nlohmann-json3-dev|nlohmann/json.hpp|--json
'
test_packages='
clang|clang++|the Release build that is tested, as clang compiles tests in two thirds of the time; g++ has the sanitizers and all headers in one unit. Where it is missing g++ compiles all
libgtest-dev|gtest/gtest.h|tests
librapidcheck-dev|rapidcheck.h|tests of laws on random input
libembree-dev|embree3/rtcore.h|render --method rays, and an adapter of judge; their tests say that they are skipped where it is missing
libocct-modeling-algorithms-dev|opencascade/Standard_Version.hxx|an adapter of judge, OpenCASCADE, whose tests say that they are skipped where this or what follows is missing
libocct-modeling-data-dev|opencascade/TopAbs_ShapeEnum.hxx|an adapter of judge
clang-format-14|clang-format-14|a test that every file has the format of .clang-format; skipped where it is missing
libopenmpi-dev|mpi.h|mpirun sightline pvs, which shares its work among processes; its tests are skipped where this or what follows is missing
openmpi-bin|mpirun|mpirun sightline pvs
z3|z3|a second opinion on weak visibility; tests skip what needs it where it is missing
python3-dev|python3-config|the Python module; its tests are skipped where this or what follows is missing
pybind11-dev|pybind11-config|the Python module
python3-numpy|f2py3|the Python module
python3-pytest|pytest-3|tests of the Python module and of pages
chromium|chromium|tests of pages; they are skipped where this or what follows is missing
chromium-driver|chromedriver|tests of pages
python3-selenium|chromedriver|tests of pages
'

is_debian_12() { (. /etc/os-release 2>/dev/null && [ "$ID" = debian ] && [ "$VERSION_ID" = 12 ]); }

# Prints the lines of the package list on standard input whose package is not there.
missing_packages() {
  local package probe reason
  while IFS='|' read -r package probe reason; do
    if [ -z "$package" ]; then continue; fi
    if is_debian_12; then
      [ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" = installed ] && continue
    elif [[ "$probe" == *.h* ]]; then
      echo "#include <$probe>" | g++ -std=c++20 -E -x c++ - >/dev/null 2>&1 && continue
    else
      command -v "$probe" >/dev/null && continue
    fi
    echo "$package|$probe|$reason"
  done
}

# require_packages "$list": installs what is missing on Debian 12; elsewhere says what is missing and exits 2.
# With SIGHTLINE_SKIP_INSTALL=1 it says what is missing and goes on: the build may find it in a place of your own.
require_packages() {
  local missing package reason as_root=() names=()
  missing=$(missing_packages <<<"$1")
  if [ -z "$missing" ]; then return; fi
  while IFS='|' read -r package _ reason; do
    names+=("$package")
    echo "needs $package: $reason"
  done <<<"$missing"
  if [ -n "${SIGHTLINE_SKIP_INSTALL:-}" ]; then
    echo "not installed, as SIGHTLINE_SKIP_INSTALL is set"
    return
  fi
  if ! is_debian_12; then
    echo "This script installs packages on Debian 12 only; the names above are Debian's. Install them and call it again."
    exit 2
  fi
  if [ "$(id -u)" != 0 ]; then
    if ! command -v sudo >/dev/null; then
      echo "neither root nor sudo: as root, apt-get install --no-install-recommends ${names[*]}"
      exit 2
    fi
    as_root=(sudo)
  fi
  echo "installing ${#names[@]} packages with apt-get"
  "${as_root[@]}" apt-get update -qq
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qq -y --no-install-recommends "${names[@]}" >/dev/null
}

# As many compilers at once as there are processors, but 3 GiB of memory for each.
compile_jobs() {
  local processors memory
  processors=$(nproc)
  memory=$(awk '/MemAvailable/ {print int($2 / 3145728)}' /proc/meminfo)
  if [ "$memory" -lt "$processors" ]; then processors=$memory; fi
  if [ "$processors" -lt 1 ]; then processors=1; fi
  echo "$processors"
}

# build FOLDER "TARGETS" [CMAKE OPTIONS]: configures and builds, from nothing in the least time: many sources of the libraries and the
# program at once. Who changes them builds by a preset.
build() {
  local folder=$1 targets option
  read -ra targets <<<"$2"
  shift 2
  for option; do  # a folder of another compiler is begun anew
    if [[ $option == -DCMAKE_CXX_COMPILER=* ]] && [ -e "$folder/CMakeCache.txt" ] &&
       [ "$(sed -n 's/^CMAKE_CXX_COMPILER:[A-Z]*=//p' "$folder/CMakeCache.txt")" != "${option#*=}" ]; then
      rm -rf "$folder"
    fi
  done
  if ! cmake -S . -B "$folder" -G Ninja -DCMAKE_UNITY_BUILD=ON -DCMAKE_UNITY_BUILD_BATCH_SIZE=20 "$@" >"$folder.log" 2>&1; then
    cat "$folder.log"
    return 1
  fi
  cmake --build "$folder" --target "${targets[@]}" --parallel "$(compile_jobs)"
}
