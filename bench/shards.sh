#!/usr/bin/env bash
# What dividing a level among shards costs: processor time of all of them and of what puts them together, against one run.
# Usage: bench/shards.sh [--certificates] SIGHTLINE SHARDS LEVEL...
set -euo pipefail
proofs=0
if [ "${1:-}" = --certificates ]; then
  proofs=1
  shift
fi
if [ $# -lt 3 ]; then
  sed -n '2,3s/^# //p' "$0" >&2
  exit 2
fi
program=$1 shards=$2
shift 2
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
TIMEFORMAT='%U %S'

# seconds COMMAND...: of processor time.
seconds() { { time "$@" >/dev/null; } 2>&1 | tail -n 1 | awk '{print $1 + $2}'; }

printf '%-32s %8s %10s %12s %8s %10s\n' level one "$shards shards" merged more identical
for level in "$@"; do
  whole=() shared=()
  if [ $proofs = 1 ]; then whole=(--certificates "$folder/whole") shared=(--certificates "$folder/shared"); fi
  one=$(seconds "$program" pvs "$level" --threads 1 --out "$folder/one.pvs" "${whole[@]}")
  for ((k = 0; k < shards; ++k)); do
    seconds "$program" pvs "$level" --threads 1 --shard "$k/$shards" --out "$folder/part$k.pvs" "${shared[@]}"
  done >"$folder/seconds"
  parts=$(awk '{sum += $1} END {print sum}' "$folder/seconds")
  merged=$(seconds "$program" merge "$folder"/part*.pvs --out "$folder/all.pvs" "${shared[@]}")
  same=$(cmp -s "$folder/one.pvs" "$folder/all.pvs" && echo yes || echo NO)
  if [ $proofs = 1 ]; then
    diff -rq "$folder/whole" "$folder/shared" >/dev/null || same=NO
    rm -rf "$folder/whole" "$folder/shared"
  fi
  printf '%-32s %8.2f %10.2f %12.2f %7.1f%% %10s\n' "$(basename "$level")" "$one" "$parts" "$merged" \
    "$(awk "BEGIN {print 100 * ($parts + $merged - $one) / $one}")" "$same"
  rm -f "$folder"/part*.pvs
done
