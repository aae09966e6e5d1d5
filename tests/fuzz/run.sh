#!/usr/bin/env bash
# Every fuzz target under clang's fuzzer, in MINUTES for all of them together; as many at once as there are
# processors. What they find, and the corpora that they grow, stay in FOLDER; one finding ends its target.
#   run.sh PROGRAM MINUTES FOLDER
set -euo pipefail
program=$1 minutes=$2
tests=$(dirname "$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")")
folder=$(readlink -m "$3") at_once=$(nproc)
targets=("$tests"/fuzz/corpus/*)
seconds=$((minutes * 60 * at_once / ${#targets[@]} + 1))
export program tests folder seconds

one() { # TARGET
  local found="$folder/findings/$1" grown="$folder/corpus/$1" log="$folder/$1.log" runs
  mkdir -p "$found" "$grown"
  MCKIBBEN_FUZZ_TARGET=$1 "$program" -max_total_time="$seconds" -timeout=20 -rss_limit_mb=2048 -print_final_stats=1 \
    -artifact_prefix="$found/" "$grown" "$tests/fuzz/corpus/$1" "$tests/bad" > "$log" 2>&1 || true
  runs=$(sed -n 's/^stat::number_of_executed_units: *//p' "$log")
  echo "$1: ${runs:-no} runs, $(find "$found" -type f | wc -l) findings"
  [ -n "$runs" ] || { tail -n 3 "$log" >&2; exit 1; }
}
export -f one

echo "${#targets[@]} targets, $seconds s each, $at_once at once"
status=0
printf '%s\0' "${targets[@]##*/}" | xargs -0 -P "$at_once" -I '{}' bash -c 'one {}' || status=70 # one did not run
if [ -n "$(find "$folder/findings" -type f)" ]; then
  echo "findings in $folder/findings; what led to each is in $folder/TARGET.log" >&2
  exit 1
fi
exit "$status"
