#!/usr/bin/env bash
# What building costs: clones the repository into a new folder and times there what a user and a developer wait for.
# Usage: bench/build_times.sh FOLDER [demo|units|headers|touch|check|again]...   (all of them; each takes up to minutes, nothing else
# should run). Times are elapsed seconds, without a compiler cache; memory is the largest of one process, in KB.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
folder=${1:?a folder that does not exist yet, or a clone to go on with}
shift
steps=("$@")
if [ ${#steps[@]} = 0 ]; then steps=(demo units headers touch check again); fi
if [ ! -d "$folder" ]; then git clone -q "$here" "$folder"; fi
cd "$folder"
if [ -d "$here/../shared" ] && [ ! -e ../shared ]; then ln -s "$here/../shared" ../shared; fi  # scenes for the tests
export CCACHE_DISABLE=1

# timed WHAT COMMAND...: one line of the table.
timed() {
  local what=$1 status=0
  shift
  /usr/bin/time -o times.txt -f "%e s, %U s of processor time, %M KB" "$@" >output.txt 2>&1 || status=$?
  printf '%-60s %s%s\n' "$what" "$(tail -n 1 times.txt)" "$([ "$status" = 0 ] || echo " (exit code $status)")"
}

compile=(g++ -std=c++20 -O2 -frounding-math -ffp-contract=off "-I$PWD/build/demo/include")

demo() {
  rm -rf build/demo
  timed "./demo" ./demo
}
units() {  # and headers: after demo
  cat >unit.cpp <<'END'
#include <sightline/sightline.h>
int main(int, char** arguments) {
  const sightline::Model model = sightline::Model::read(arguments[1]);
  const auto painted = sightline::order(model, {0, 0, 9});
  const auto seen = sightline::weakly_visible(model, 0);
  return painted.parts.empty() || seen.visible.empty();
}
END
  timed "a unit with sightline.h: a scene, an order, weak visibility" "${compile[@]}" -c unit.cpp -o unit.o
  timed "a unit with a kernel of its own" "${compile[@]}" -c tests/package/outside/own_kernel.cpp -o unit.o
}
headers() {
  local header
  for header in $(find kernel algorithms io harness sightline -name '*.h' | sort); do
    header=${header/#sightline\//}
    echo "#include <sightline/$header>" >unit.cpp
    timed "  #include <sightline/$header>" "${compile[@]}" -fsyntax-only unit.cpp
  done
}
touch_predicates() {
  cmake --preset dev -DSIGHTLINE_TESTS=OFF >output.txt
  cmake --build --preset dev --target sightline >output.txt
  touch kernel/predicates.h
  timed "kernel/predicates.h touched, then sightline built (preset dev)" cmake --build --preset dev --target sightline
}
check_again() {
  echo "// touched" >>tests/io/off.cpp
  timed "./check again, one test file touched" ./check
  git checkout -q tests/io/off.cpp
}

for step in "${steps[@]}"; do
  case $step in
    demo | units | headers) "$step" ;;
    touch) touch_predicates ;;
    check) timed "./check" ./check ;;
    again) check_again ;;
    *) echo "no step '$step'" >&2; exit 2 ;;
  esac
done
