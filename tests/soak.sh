#!/usr/bin/env bash
# Runs the virtual sensor with all of its faults for as long as one likes, and prints each minute what must stay flat.
#
#   tests/soak.sh [MINUTES] [PROGRAM]     [10] [build/release/saccade]
#
# Three programs run at once, one for each way in which a sensor can be lost: reported, in an error state, and silent; and
# where there is xvfb-run, the viewer on a virtual display with a sensor whose loss is reported. In all of them it comes
# late, stalls, gives short frames, and its settings have no effect. A line a minute for each: frames processed and
# dropped so far (not of the viewer), resident memory, descriptors, threads. At the end each gets SIGINT. Exit status 0 if
# all ended well within two seconds, their ledgers are balanced, and from the second minute on memory grew by less than a
# tenth, descriptors and threads by none.
set -euo pipefail
minutes=${1:-10}
program=$(realpath "${2:-$(dirname "${BASH_SOURCE[0]}")/../build/release/saccade}")
work=$(mktemp -d)
kinds=(event state silent)
command -v xvfb-run >/dev/null && kinds+=(viewer)
bad=0

note() { echo "$*"; bad=1; }

# All programs that still run end with this one.
stop() {
  local pid
  for pid in "$work"/*.pid; do
    [[ -f $pid ]] && kill -INT "$(<"$pid")" 2>/dev/null
  done
  wait
  rm -rf "$work"
}
trap 'stop || true' EXIT

# start KIND: a run on a terminal of its own, where the program shows its progress; or the viewer.
start() {
  local loss=$1 back_ms=700
  [[ $1 != viewer ]] || loss=event
  [[ $1 != silent ]] || back_ms=2600  # a silence counts as a loss after two seconds
  local faults="loss=$loss&loss_after=400&back_after_ms=$back_ms&late_ms=500&stall_ms=400&stall_after=150"
  faults+='&short_frame=50&ignores_settings=1&rate=30'
  export SACCADE_VIRTUAL_DEVICE="synthetic:table?size=160x120&noise=kinect&frames=60&$faults"
  local sensor="openni2 --mode 160x120 --levels 0..2" command="echo \$\$ >$work/$1.pid; exec '$program'"
  if [[ $1 == viewer ]]; then
    XDG_CONFIG_HOME=$work xvfb-run -a -s '-screen 0 1280x800x24' bash -c "$command view $sensor" >"$work/$1.log" 2>&1 &
  else
    TERM=xterm script -qefc "$command run $sensor --dump none --out $work/$1" /dev/null >"$work/$1.log" 2>&1 &
  fi
}

# "123 frames, 45 dropped" of the progress.
counts() {
  local line
  [[ $1 != viewer ]] || return 0
  line=$(tail -c 4000 "$work/$1.log" | tr '\r' '\n' | grep -a ' frames, ' | tail -1)
  echo "$(grep -o '[0-9]* frames' <<<"$line"), $(grep -o '[0-9]* dropped' <<<"$line")"
}

# "RSS in kB, descriptors, threads" of a process.
resources() {
  local rss threads descriptors
  rss=$(awk '/^VmRSS/ {print $2}' "/proc/$1/status")
  threads=$(awk '/^Threads/ {print $2}' "/proc/$1/status")
  descriptors=$(find "/proc/$1/fd" -mindepth 1 | wc -l)
  echo "$rss $descriptors $threads"
}

declare -A first
report() {
  local kind pid rss descriptors threads
  for kind in "${kinds[@]}"; do
    pid=$(<"$work/$kind.pid")
    if ! kill -0 "$pid" 2>/dev/null; then
      note "$1 min, $kind: ended: $(tail -c 300 "$work/$kind.log")"
      continue
    fi
    read -r rss descriptors threads < <(resources "$pid")
    printf '%3d min  %-6s  %-32s  %6d kB  %3d descriptors  %3d threads\n' "$1" "$kind" "$(counts "$kind")" "$rss" \
      "$descriptors" "$threads"
    if (($1 < 2)); then continue; fi
    [[ -v first[$kind] ]] || first[$kind]="$rss $descriptors $threads"
    local before=(${first[$kind]})
    ((rss * 10 <= before[0] * 11)) || note "$kind: memory grows"
    # A sensor that is just gone has fewer of both; a second one more at most is of its driver.
    ((descriptors <= before[1] + 4 && threads <= before[2] + 4)) || note "$kind: descriptors or threads grow"
  done
}

# count_of KEY FILE: the first number of that name.
count_of() { sed -nE "s/.*\"$1\": *([0-9]+).*/\1/p" "$2" | sed -n 1p; }

# finish KIND: the ledger of its manifest.
finish() {
  local begin end manifest=$work/$1/manifest.json pid
  pid=$(<"$work/$1.pid")
  begin=$(date +%s%N)
  kill -INT "$pid" 2>/dev/null || return 0  # reported already
  while kill -0 "$pid" 2>/dev/null; do sleep 0.02; done
  end=$((($(date +%s%N) - begin) / 1000000))
  ((end <= 2000)) || note "$1: it took too long to end"
  if [[ $1 == viewer ]]; then
    echo "$1: ended after $end ms"
    return
  fi
  local captured processed dropped rejected
  captured=$(count_of captured "$manifest")
  processed=$(count_of processed "$manifest")
  dropped=$(count_of dropped "$manifest")
  rejected=$(count_of rejected "$manifest")
  echo "$1: ended after $end ms; captured $captured = processed $processed + dropped $dropped + rejected $rejected;" \
    "losses $(count_of losses "$manifest")"
  ((captured == processed + dropped + rejected)) || note "$1: the ledger is not balanced"
  (($(wc -l <"$work/$1/fixations.jsonl") == processed)) || note "$1: fixations.jsonl does not have every frame"
}

for kind in "${kinds[@]}"; do start "$kind"; done
echo "$(date -u +%F\ %T) UTC, $minutes min, $program"
for ((minute = 1; minute <= minutes; ++minute)); do
  sleep 60
  report "$minute"
done
for kind in "${kinds[@]}"; do finish "$kind"; done
((bad == 0)) && echo "flat and balanced"
exit "$bad"
