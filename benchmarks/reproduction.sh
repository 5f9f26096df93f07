#!/bin/sh
# Prints docs/reproduction.md from the results of the studies:  benchmarks/reproduction.sh >docs/reproduction.md
set -eu
root=$(CDPATH='' cd -- "$(dirname "$0")/.." && pwd)
results=$root/benchmarks/results/studies

cat <<'END'
# Published results, reproduced

Made by `benchmarks/reproduction.sh` from the results under `benchmarks/results/studies`, which `galet study NAME` makes again
(`benchmarks/run.sh studies`). Each study compares with published numbers: *yes*: within the stated uncertainty; *yes (2 errors)*:
only within two standard errors of ours; *NO*: neither. Where the source states no uncertainty, `findings.csv` says what stands for
it. The size that was run stands in each head; a quick size is a first look. Scenes (`scenes/*.toml`) run alone with `galet run`.

END
if ! ls "$results"/*/report.txt >/dev/null 2>&1; then echo "No results are here yet."; fi
# In the order of the chapter.
for name in flow-law flow-kappa flow-friction flow-restitution inclined-plane annular-shear cohesive-flow compression triaxial critical-state consolidation regimes; do
  folder=$results/$name
  [ -f "$folder/report.txt" ] || continue
  title=$(sed -n '1s/^[^:]*: //p' "$folder/report.txt")
  printf '## %s\n\n`galet study %s`\n\n' "$title" "$name"
  for figure in "$folder"/*.svg; do
    [ -f "$figure" ] || continue
    stem=$(basename "$figure" .svg)
    printf '![%s](../benchmarks/results/studies/%s/%s.svg)\n' "$stem" "$name" "$stem"
  done
  printf '\n```\n'
  cat "$folder/report.txt"
  printf '```\n\n'
  if [ -f "$folder/finding.md" ]; then cat "$folder/finding.md"; echo; fi
  if [ -f "$folder/machine.txt" ]; then
    printf 'Measured on:\n\n```\n'
    cat "$folder/machine.txt"
    printf '```\n\n'
  fi
done
