#!/usr/bin/env bash
# The real window under a virtual display: opens the sample, presses keys, clicks, saves under another name, ends.
#   window_smoke.sh AXIL_STUDIO SAMPLE
# Exits with 77, which CTest counts as skipped, where Xvfb or xdotool is missing.
set -euo pipefail
command -v Xvfb >/dev/null && command -v xdotool >/dev/null || exit 77
studio=$(realpath "$1") sample=$(realpath "$2")
work=$(mktemp -d)
trap 'kill "${pids[@]}" 2>/dev/null || true; rm -rf "$work"' EXIT
pids=()
cp -r "$(dirname "$sample")/." "$work/plant"
exec {displayfd}<> <(:)
Xvfb -displayfd "$displayfd" -screen 0 1440x900x24 >/dev/null 2>&1 & pids+=($!)
read -r -t 20 -u "$displayfd" number
export DISPLAY=":$number" XDG_STATE_HOME="$work/state"
"$studio" "$work/plant/$(basename "$sample")" & window=$!; pids+=("$window")
id=$(timeout 40 xdotool search --sync --onlyvisible --name "Axil Studio" | head -1)
sleep 3
xdotool windowfocus "$id"
# Keys are held as a person holds them: the window looks at them once a frame.
press() { for key in "$@"; do xdotool keydown "$key"; done; sleep 0.4; for key in "$@"; do xdotool keyup "$key"; done; sleep 0.4; }
xdotool mousemove --window "$id" 100 435 click 1; sleep 0.5          # the first stem of the list
press ctrl h; press Escape
xdotool mousemove --window "$id" 100 435 click 1; sleep 0.5
xdotool mousemove --window "$id" 530 60 click 1; sleep 1             # in the front photo: the stem goes on
press ctrl s; sleep 1
press ctrl q
for _ in $(seq 40); do kill -0 "$window" 2>/dev/null || break; sleep 0.25; done
if kill -0 "$window" 2>/dev/null; then echo "the window did not end"; exit 1; fi
wait "$window"
nodes=$(grep -c '"clicks"' "$work/plant/$(basename "$sample")")
before=$(grep -c '"clicks"' "$sample")
[ "$nodes" -eq $((before + 1)) ] || { echo "the clicked node is not in the saved file: $before before, $nodes after"; exit 1; }
