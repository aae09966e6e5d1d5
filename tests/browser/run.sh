#!/usr/bin/env bash
# Makes reports with the program and looks at them in Debian's Chromium.
#   run.sh PROGRAM FOLDER [live]    of reports, or of the live page; installs playwright-core (package-lock.json) and
#                                   works in FOLDER, never in the sources
set -euo pipefail
here=$(dirname "$(readlink -f "${BASH_SOURCE[0]}")")
program=$1 folder=$2

mkdir -p "$folder"
cp "$here"/package.json "$here"/package-lock.json "$here"/*.mjs "$folder"
cd "$folder"
cmp -s package-lock.json node_modules/.installed ||
  { npm ci --no-audit --no-fund --loglevel=error && cp package-lock.json node_modules/.installed; }

if [ "${3:-}" = live ]; then
  MCKIBBEN=$program node --test --test-reporter=spec live_test.mjs
  exit
fi
"$program" run "$here/short.yaml" --out "$folder/short" > /dev/null
mkdir -p measured
cp short/11.138kg_pid.csv measured/one.csv
cp short/23.406kg_pid.csv measured/two.csv
cat > measured/dataset.yaml << 'END'
schema: mckibben-dataset/1
rig: thesis
runs:
  - {id: one, file: one.csv, load: 11.138 kg}
  - {id: two, file: two.csv, load: 23.406 kg}
END
"$program" replay measured --out "$folder/replayed" > /dev/null
"$program" dataset "$here/campaign.yaml" --out "$folder/campaign" > /dev/null
"$program" replay campaign --out "$folder/gauged" > /dev/null
"$program" map "$here/../data/calibration.yaml" --ratios 6 --speeds 2 --out "$folder/map" > /dev/null
"$program" dataset "$here/leaky.yaml" --out "$folder/leaky" > /dev/null
"$program" diagnose leaky --out "$folder/diagnosis" > /dev/null
"$program" run "$here/../../scenarios/pair.yaml" --out "$folder/pair" > /dev/null
"$program" dataset "$here/joint.yaml" --out "$folder/joint" > /dev/null
"$program" dataset "$here/lever.yaml" --out "$folder/lever" > /dev/null
"$program" replay leaky --rig diagnosis/rig.yaml --out "$folder/mended" > /dev/null
node --test --test-reporter=spec report_test.mjs results_test.mjs look_test.mjs
