#!/usr/bin/env bash
# Two builds of axil must write the same text and the same meshes, byte by byte.
#
#   compare_builds.sh AXIL_ONE AXIL_TWO
set -euo pipefail
one=$(realpath "$1") two=$(realpath "$2")
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# write AXIL FOLDER: everything that is text or mesh, of every sample.
write() {
  local axil=$1 out=$2 sample name kind dialect ending
  mkdir -p "$out"
  for sample in samples/*/*.axil; do
    name=$(basename "$sample" .axil)
    "$axil" skeleton "$sample" >"$out/$name.skeleton.json"
    "$axil" quantify "$sample" >"$out/$name.stems.csv"
    for kind in initial predictive structured; do
      "$axil" emit "$sample" --kind "$kind" >"$out/$name.$kind.simeco"
      "$axil" derive "$out/$name.$kind.simeco" >"$out/$name.$kind.string"
    done
    for dialect in cpfg lpy mtg; do "$axil" emit "$sample" --dialect "$dialect" >"$out/$name.$dialect"; done
    for ending in json glb obj ply; do "$axil" grow "$out/$name.predictive.simeco" -o "$out/$name.$ending"; done
  done
}

write "$one" "$work/one" && write "$two" "$work/two"
diff -rq "$work/one" "$work/two" && echo "the same bytes: $(find "$work/one" -type f | wc -l) files"
