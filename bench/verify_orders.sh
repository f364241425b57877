#!/usr/bin/env bash
# Checking an order against making it and its certificate: seconds of wall time, the least of three runs each.
# Usage: bench/verify_orders.sh SIGHTLINE EYE SCENE...
set -euo pipefail
if [ $# -lt 3 ]; then
  sed -n '2,3s/^# //p' "$0" >&2
  exit 2
fi
program=$1 eye=$2
shift 2
certificate=$(mktemp)
trap 'rm -f "$certificate"' EXIT
TIMEFORMAT=%R

# least COMMAND...: seconds.
least() { for _ in 1 2 3; do { time "$@" >/dev/null; } 2>&1 | tail -n 1; done | sort -n | head -n 1; }

printf '%-40s %10s %10s %10s %8s\n' scene fragments order verify ratio
for scene in "$@"; do
  make=$(least "$program" order "$scene" --eye "$eye" --certificate "$certificate")
  check=$(least "$program" verify "$scene" "$certificate")
  fragments=$("$program" verify "$scene" "$certificate" | sed -nE 's/^accepted +([0-9]+) fragments.*/\1/p')
  printf '%-40s %10s %10s %10s %8s\n' "$(basename "$scene")" "$fragments" "$make" "$check" "$(awk "BEGIN {printf \"%.1f\", $check / $make}")"
done
